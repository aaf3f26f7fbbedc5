//! The queue's allowed moves, as a pure function.
//!
//! `queued -> running -> succeeded | failed | cancelled`; a running job returns to the queue when its worker was
//! lost (a bounded number of times) or gave it back (which costs no attempt).

use api::job::Status;

/// How often a job is tried before lost workers make it fail.
pub const ATTEMPT_LIMIT: u32 = 3;

/// What happens to a job.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Move {
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
}

impl Move {
    /// Every move.
    pub const ALL: [Self; 6] = [
        Self::Claim,
        Self::Succeed,
        Self::Fail,
        Self::Cancel,
        Self::GiveBack,
        Self::Lose,
    ];
}

/// The status after a move, or nothing if the move is not allowed. `attempts` counts the claims so far, and
/// `cancel_requested` tells whether the user no longer wants the job.
pub fn after(status: Status, step: Move, attempts: u32, cancel_requested: bool) -> Option<Status> {
    match (status, step) {
        (Status::Queued, Move::Claim) => Some(Status::Running),
        (Status::Queued | Status::Running, Move::Cancel) => Some(Status::Cancelled),
        (Status::Running, Move::Succeed) => Some(Status::Succeeded),
        (Status::Running, Move::GiveBack | Move::Lose) if cancel_requested => {
            Some(Status::Cancelled)
        }
        (Status::Running, Move::GiveBack) => Some(Status::Queued),
        (Status::Running, Move::Lose) if attempts < ATTEMPT_LIMIT => Some(Status::Queued),
        (Status::Running, Move::Lose | Move::Fail) => Some(Status::Failed),
        (Status::Queued, Move::Succeed | Move::Fail | Move::GiveBack | Move::Lose)
        | (Status::Running, Move::Claim)
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
            for step in Move::ALL {
                for attempts in 0..=ATTEMPT_LIMIT + 1 {
                    for unwanted in [false, true] {
                        let expected = match (status.as_str(), step) {
                            ("queued", Move::Claim) => Some("running"),
                            ("queued" | "running", Move::Cancel) => Some("cancelled"),
                            ("running", Move::Succeed) => Some("succeeded"),
                            ("running", Move::Fail) => Some("failed"),
                            ("running", Move::GiveBack | Move::Lose) if unwanted => {
                                Some("cancelled")
                            }
                            ("running", Move::Lose) if attempts >= ATTEMPT_LIMIT => Some("failed"),
                            ("running", Move::GiveBack | Move::Lose) => Some("queued"),
                            _ => None,
                        };
                        let found = after(status, step, attempts, unwanted).map(Status::as_str);
                        assert_eq!(found, expected, "{status:?} {step:?} {attempts} {unwanted}");
                    }
                }
            }
        }
    }

    #[test]
    fn nothing_follows_a_terminal_status() {
        for status in Status::ALL
            .into_iter()
            .filter(|status| status.is_terminal())
        {
            assert!(
                Move::ALL
                    .into_iter()
                    .all(|step| after(status, step, 1, false).is_none())
            );
        }
    }
}
