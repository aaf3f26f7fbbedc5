//! What the end of a solving process means for its job.

use api::job::Outcome;

use crate::queue::Transition;
use crate::solve::{Line, UNWRITTEN};
use crate::store::End;
use crate::worker::child::{Ended, OUT_OF_MEMORY};

/// A result, a failure or a crash of its own is final; killed from outside, the job is tried again; asked to stop, it
/// goes back to the queue.
pub(super) fn verdict(last: Option<Line>, ended: Ended, words: Option<String>) -> End {
    match (last, ended) {
        (Some(Line::Summary(summary)), _) => End {
            step: Transition::Succeed,
            reason: None,
            outcome: Some(summary.outcome),
            summary: Some(*summary),
        },
        (Some(Line::Failed(failure)), _) => End {
            outcome: Some(failure.outcome),
            ..end(Transition::Fail, failure.reason)
        },
        (Some(Line::Stopped), _) => end(
            Transition::GiveBack,
            "its solving process was asked to stop",
        ),
        (_, Ended::Killed) => end(Transition::Lose, "its solving process was killed"),
        (_, Ended::Code(UNWRITTEN)) => end(
            Transition::Lose,
            "its solving process could not write its files",
        ),
        (_, Ended::Crashed(signal)) => crashed(signal, words),
        (_, Ended::Code(code)) => End {
            outcome: Some(Outcome::NotConverged),
            ..end(
                Transition::Fail,
                format!(
                    "the solving process ended with code {code} and without a result{}",
                    said(words)
                ),
            )
        },
    }
}

fn crashed(signal: i32, words: Option<String>) -> End {
    let starved = words
        .as_deref()
        .is_some_and(|words| words.starts_with(OUT_OF_MEMORY));
    let outcome = if starved {
        Outcome::OutOfMemory
    } else {
        Outcome::NotConverged
    };
    End {
        outcome: Some(outcome),
        ..end(
            Transition::Fail,
            format!(
                "the solving process crashed with signal {signal}{}",
                said(words)
            ),
        )
    }
}

fn said(words: Option<String>) -> String {
    words.map_or_else(String::new, |words| format!(": {words}"))
}

/// An end without a result.
pub(super) fn end(step: Transition, reason: impl Into<String>) -> End {
    End {
        step,
        reason: Some(reason.into()),
        outcome: None,
        summary: None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_what_comes_from_outside_is_tried_again() {
        let cases = [
            (None, Ended::Killed, Transition::Lose, None),
            (None, Ended::Code(UNWRITTEN), Transition::Lose, None),
            (
                None,
                Ended::Code(1),
                Transition::Fail,
                Some(Outcome::NotConverged),
            ),
            (
                None,
                Ended::Crashed(6),
                Transition::Fail,
                Some(Outcome::NotConverged),
            ),
            (
                Some(Line::Stopped),
                Ended::Code(0),
                Transition::GiveBack,
                None,
            ),
        ];
        for (last, ended, step, outcome) in cases {
            let found = verdict(last, ended, None);
            assert_eq!((found.step, found.outcome), (step, outcome), "{ended:?}");
        }
    }

    #[test]
    fn a_failed_allocation_is_told_from_other_crashes() {
        let words = "memory allocation of 8192 bytes failed".to_owned();
        let found = verdict(None, Ended::Crashed(6), Some(words));
        assert_eq!(found.outcome, Some(Outcome::OutOfMemory));
        assert_eq!(
            found.reason.as_deref(),
            Some(
                "the solving process crashed with signal 6: memory allocation of 8192 bytes failed"
            )
        );
    }
}
