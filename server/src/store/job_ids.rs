//! Ids of jobs, which begin with their time of creation (RFC 9562, UUID version 7), so that a time bounds a range of them.

use uuid::Uuid;

/// Longest time between the creation of a job and that of its id, ms: the wait for a commit, with a margin. Far fewer jobs are
/// submitted in it than are stored.
const SUBMISSION_MS: i64 = 600_000;

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
}
