//! The queue's rules, as pure functions.
//!
//! Moves: `queued -> running -> succeeded | failed | cancelled`; a running job returns to the queue when its worker was
//! lost (a bounded number of times) or gave it back (which costs no attempt).

mod admission;
mod order;

use api::job::Status;

pub use admission::{Choice, Room, Waiting, choose};
pub use order::{MOST_PRIORITY, place, sweep_priority};

/// Why a job waits that nothing stands in the way of.
pub const WAITING_FOR_WORKER: &str = "waiting for a worker";
/// How the reason of jobs begins that wait because the disk is short.
pub const WAITING_FOR_DISK: &str = "waiting for disk space: ";

/// How often a job is tried before lost workers make it fail, unless the service is told otherwise.
pub const ATTEMPT_LIMIT: u32 = 3;

/// What happens to a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Transition {
    /// A worker takes it.
    Claim,
    /// The solve ended with a result.
    Succeed,
    /// The solve failed; the same input would fail again.
    Fail,
    /// It was cancelled: by the user while queued, by its worker while running.
    Cancel,
    /// Its worker gives it back at a graceful shutdown.
    GiveBack,
    /// Its worker was lost.
    Lose,
    /// Its deadline has passed.
    Expire,
}

impl Transition {
    /// Every move.
    pub const ALL: [Self; 7] = [
        Self::Claim,
        Self::Succeed,
        Self::Fail,
        Self::Cancel,
        Self::GiveBack,
        Self::Lose,
        Self::Expire,
    ];
}

/// How often a job was tried, and how often it may be.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Tries {
    /// Claims so far, those that were given back not counted.
    pub made: u32,
    /// How many there may be.
    pub limit: u32,
}

/// The status after a move, or nothing if the move is not allowed. `unwanted` tells whether the user has asked for the
/// job's end.
pub fn after(status: Status, step: Transition, tries: Tries, unwanted: bool) -> Option<Status> {
    match (status, step) {
        (Status::Queued, Transition::Claim) => Some(Status::Running),
        (Status::Queued | Status::Running, Transition::Cancel) => Some(Status::Cancelled),
        (Status::Running, Transition::Succeed) => Some(Status::Succeeded),
        (Status::Running, Transition::GiveBack | Transition::Lose) if unwanted => {
            Some(Status::Cancelled)
        }
        (Status::Running, Transition::GiveBack) => Some(Status::Queued),
        (Status::Running, Transition::Lose) if tries.made < tries.limit => Some(Status::Queued),
        (Status::Running, Transition::Lose | Transition::Fail)
        | (Status::Queued | Status::Running, Transition::Expire) => Some(Status::Failed),
        (
            Status::Queued,
            Transition::Succeed | Transition::Fail | Transition::GiveBack | Transition::Lose,
        )
        | (Status::Running, Transition::Claim)
        | (Status::Succeeded | Status::Failed | Status::Cancelled, _) => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Every status, move, number of attempts around the limit, and wish, against the table of the module's head.
    #[test]
    fn every_move_from_every_status_is_as_the_table_says() {
        for status in Status::ALL {
            for step in Transition::ALL {
                for made in 0..=ATTEMPT_LIMIT + 1 {
                    for unwanted in [false, true] {
                        let expected = match (status.as_str(), step) {
                            ("queued", Transition::Claim) => Some("running"),
                            ("queued" | "running", Transition::Cancel) => Some("cancelled"),
                            ("running", Transition::Succeed) => Some("succeeded"),
                            ("queued" | "running", Transition::Expire)
                            | ("running", Transition::Fail) => Some("failed"),
                            ("running", Transition::GiveBack | Transition::Lose) if unwanted => {
                                Some("cancelled")
                            }
                            ("running", Transition::Lose) if made >= ATTEMPT_LIMIT => {
                                Some("failed")
                            }
                            ("running", Transition::GiveBack | Transition::Lose) => Some("queued"),
                            _ => None,
                        };
                        let tries = Tries {
                            made,
                            limit: ATTEMPT_LIMIT,
                        };
                        let found = after(status, step, tries, unwanted).map(Status::as_str);
                        assert_eq!(found, expected, "{status:?} {step:?} {made} {unwanted}");
                    }
                }
            }
        }
    }

    #[test]
    fn nothing_follows_a_terminal_status() {
        let tries = Tries { made: 1, limit: 3 };
        for status in Status::ALL
            .into_iter()
            .filter(|status| status.is_terminal())
        {
            assert!(
                Transition::ALL
                    .into_iter()
                    .all(|step| after(status, step, tries, false).is_none())
            );
        }
    }
}
