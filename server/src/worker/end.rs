//! The end of a job by the end of its solving process.

use std::fmt;

use api::job::Outcome;

use crate::queue::Transition;
use crate::solve::ChildMessage;
use crate::solve::process::{Exit, ExitCause};
use crate::solve::protocol::{EXIT_DISK_FULL, EXIT_FILE_NOT_WRITTEN};
use crate::store::End;

/// Returns the end of a job. A result, a failure and a crash are final; a job whose process was killed from outside is
/// tried again; a job whose process was asked to stop returns to the queue.
pub(super) fn end_by_exit(last: Option<ChildMessage>, exit: &Exit) -> End {
    match (last, exit.cause) {
        (Some(ChildMessage::Summary(summary)), _) => End {
            transition: Transition::Succeed,
            reason: None,
            outcome: Some(summary.outcome),
            summary: Some(*summary),
        },
        (Some(ChildMessage::Failed(failure)), _) => failed(failure.outcome, failure.reason),
        (Some(ChildMessage::Stopped), _) => {
            End::without_result(Transition::Release, "its solving process was asked to stop")
        }
        (_, ExitCause::KilledForMemory) => {
            failed(Outcome::OutOfMemory, format!("the solving process {exit}"))
        }
        (_, ExitCause::Killed) => {
            End::without_result(Transition::WorkerLost, "its solving process was killed")
        }
        (_, ExitCause::Code(EXIT_DISK_FULL)) => declined(format!(
            "its solving process had no disk space for its files{}",
            exit.details()
        )),
        (_, ExitCause::Code(EXIT_FILE_NOT_WRITTEN)) => End::without_result(
            Transition::WorkerLost,
            "its solving process could not write its files",
        ),
        (_, ExitCause::Crashed(_)) => {
            let outcome = if exit.is_out_of_memory() {
                Outcome::OutOfMemory
            } else {
                Outcome::NotConverged
            };
            failed(outcome, format!("the solving process {exit}"))
        }
        (_, ExitCause::Code(_)) => {
            let reason = format!("the solving process {exit}, without a result");
            failed(Outcome::NotConverged, reason)
        }
    }
}

/// The end of an attempt whose solving process could not be started, or ended before it was ready: no fault of the job.
pub(super) fn not_started(cause: &impl fmt::Display) -> End {
    declined(format!("its solving process did not start: {cause}"))
}

/// The end of an attempt that this worker cannot make at present.
pub(super) fn declined(cause: impl Into<String>) -> End {
    End::without_result(Transition::Decline, cause)
}

/// Status reason of a job whose worker is asked to stop.
pub(super) const STOPPED: &str = "the service was stopped";

/// The end of a job that its user has cancelled.
pub(super) fn cancelled() -> End {
    End::without_result(Transition::Cancel, "cancelled while running")
}

/// The end of a job whose deadline has passed.
pub(super) fn deadline_passed() -> End {
    End {
        outcome: Some(Outcome::DeadlineExceeded),
        ..End::without_result(Transition::Expire, "its deadline passed while it ran")
    }
}

/// Returns the end of a job that would fail again.
pub(super) fn failed(outcome: Outcome, reason: impl Into<String>) -> End {
    End {
        outcome: Some(outcome),
        ..End::without_result(Transition::Fail, reason)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn only_a_process_that_was_ended_from_outside_is_tried_again() {
        let cases = [
            (None, ExitCause::Killed, Transition::WorkerLost, None),
            (
                None,
                ExitCause::KilledForMemory,
                Transition::Fail,
                Some(Outcome::OutOfMemory),
            ),
            (
                None,
                ExitCause::Code(EXIT_FILE_NOT_WRITTEN),
                Transition::WorkerLost,
                None,
            ),
            (
                None,
                ExitCause::Code(EXIT_DISK_FULL),
                Transition::Decline,
                None,
            ),
            (
                None,
                ExitCause::Code(1),
                Transition::Fail,
                Some(Outcome::NotConverged),
            ),
            (
                None,
                ExitCause::Crashed(6),
                Transition::Fail,
                Some(Outcome::NotConverged),
            ),
            (
                Some(ChildMessage::Stopped),
                ExitCause::Code(0),
                Transition::Release,
                None,
            ),
        ];
        for (last, cause, transition, outcome) in cases {
            let exit = Exit {
                cause,
                stderr: String::new(),
            };
            let found = end_by_exit(last, &exit);
            assert_eq!(
                (found.transition, found.outcome),
                (transition, outcome),
                "{cause:?}"
            );
        }
    }

    #[test]
    fn a_failed_allocation_is_distinguished_from_other_crashes() {
        let exit = Exit {
            cause: ExitCause::Crashed(6),
            stderr: "memory allocation of 8192 bytes failed".to_owned(),
        };
        let found = end_by_exit(None, &exit);
        assert_eq!(found.outcome, Some(Outcome::OutOfMemory));
        assert_eq!(
            found.reason.as_deref(),
            Some(
                "the solving process crashed with signal 6: memory allocation of 8192 bytes failed"
            )
        );
    }
}
