//! Ids of jobs, which begin with their time of creation (RFC 9562, UUID version 7), so that a time bounds a range of them.

use std::sync::{Mutex, PoisonError};

use uuid::timestamp::context::ContextV7;
use uuid::{Timestamp, Uuid};

/// Longest time between the creation of a job and that of its id, ms: the wait for a commit, with a margin. Far fewer jobs are
/// submitted in it than are stored.
const SUBMISSION_MS: i64 = 600_000;

/// A new id of a time, ms since 1970, by whatever clock. Those of one process follow each other.
pub(in crate::store) fn new_id(time: i64) -> Uuid {
    static CONTEXT: Mutex<ContextV7> = Mutex::new(ContextV7::new());
    let context = CONTEXT.lock().unwrap_or_else(PoisonError::into_inner);
    let time = u64::try_from(time).unwrap_or_default();
    let nanoseconds = u32::try_from(time % 1_000 * 1_000_000).unwrap_or_default();
    Uuid::new_v7(Timestamp::from_unix(&*context, time / 1_000, nanoseconds))
}

/// An id below those of all jobs that were created at a time, ms since 1970, or later.
pub(in crate::store) fn first_created_at(time: i64) -> Uuid {
    first_id(time.saturating_sub(SUBMISSION_MS))
}

/// An id above those of all jobs that were created before a time, ms since 1970.
pub(in crate::store) fn first_created_before(time: i64) -> Uuid {
    first_id(time.saturating_add(SUBMISSION_MS))
}

/// The first id that can be created at a time, ms since 1970.
fn first_id(time: i64) -> Uuid {
    let [.., a, b, c, d, e, f] = time.max(0).to_be_bytes();
    let mut bytes = [0; 16];
    bytes[..6].copy_from_slice(&[a, b, c, d, e, f]);
    Uuid::from_bytes(bytes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ids_of_later_times_are_larger_and_new_ones_are_within_their_time() {
        let id = Uuid::now_v7();
        let (seconds, nanoseconds) = id.get_timestamp().expect("a time").to_unix();
        let seconds = i64::try_from(seconds).expect("small");
        let now = 1_000 * seconds + i64::from(nanoseconds / 1_000_000);
        assert!(first_id(now) <= id && id < first_id(now + 1));
        assert!(first_id(0) < first_id(1) && first_id(-5) == first_id(0));
    }

    #[test]
    fn ids_of_another_clock_have_its_time_and_follow_each_other() {
        let time = 4_000_000_000_123;
        let ids: Vec<_> = (0..1_000).map(|_| new_id(time)).collect();
        assert!(ids.is_sorted() && ids[0] != ids[1]);
        assert!(first_id(time) <= ids[0] && ids[0] < first_id(time + 1));
    }
}
