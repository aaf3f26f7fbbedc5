//! The order of waiting jobs: age, shifted by priority.
//!
//! A job of priority p counts as p minutes older than it is: it precedes jobs of the same age, and no job starves. One
//! of the lowest priority precedes every job submitted more than 200 minutes after it.

/// The largest priority; its negative is the smallest.
pub const MAX_PRIORITY: i32 = 100;

/// Age that one unit of priority adds, ms.
const AGE_PER_PRIORITY_MS: i64 = 60_000;

/// Returns the sort key of a job submitted at this time (ms); the smallest is claimed first.
pub fn sort_key(submitted_at: i64, priority: i32) -> i64 {
    let priority = priority.clamp(-MAX_PRIORITY, MAX_PRIORITY);
    submitted_at.saturating_sub(i64::from(priority) * AGE_PER_PRIORITY_MS)
}

/// Returns the priority of the job at this position of a parameter sweep: each counts one minute younger than the one
/// before it, so that a job submitted later does not wait for all of a long sweep.
pub fn batch_priority(position: u64) -> i32 {
    i32::try_from(position).map_or(-MAX_PRIORITY, |position| -position.min(MAX_PRIORITY))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_higher_priority_precedes_but_older_jobs_do_not_starve() {
        let minute = 60_000;
        assert!(sort_key(minute, 5) < sort_key(0, 0));
        assert!(sort_key(0, -MAX_PRIORITY) < sort_key(201 * minute, MAX_PRIORITY));
        assert_eq!(sort_key(7, 1_000), sort_key(7, MAX_PRIORITY));
    }

    #[test]
    fn a_later_job_does_not_wait_for_a_whole_sweep() {
        assert!(sort_key(0, batch_priority(3)) > sort_key(60_000, 0));
        assert!(sort_key(0, batch_priority(0)) < sort_key(60_000, 0));
        assert_eq!(batch_priority(u64::MAX), -MAX_PRIORITY);
    }
}
