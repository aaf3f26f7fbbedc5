//! The order of waiting jobs: age, moved by priority.
//!
//! A job of priority p counts as p minutes older than it is. So a preferred job goes first among its contemporaries, and
//! no job waits for ever: one of the lowest priority precedes whatever comes 200 minutes after it.

/// The largest priority; its negative is the smallest.
pub const MOST_PRIORITY: i32 = 100;

/// What a step of priority is worth, ms.
const STEP_MS: i64 = 60_000;

/// The place in the queue of a job submitted at this time (ms); smaller is earlier.
pub fn place(submitted_at: i64, priority: i32) -> i64 {
    let priority = priority.clamp(-MOST_PRIORITY, MOST_PRIORITY);
    submitted_at.saturating_sub(i64::from(priority) * STEP_MS)
}

/// The priority of a job at this position of a sweep: each counts a minute younger than the one before it, so that a
/// study that comes later does not wait for all of a long sweep.
pub fn sweep_priority(position: usize) -> i32 {
    i32::try_from(position).map_or(-MOST_PRIORITY, |position| -position.min(MOST_PRIORITY))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_preferred_job_goes_first_but_the_others_age() {
        let minute = 60_000;
        assert!(place(minute, 5) < place(0, 0));
        assert!(place(0, -MOST_PRIORITY) < place(201 * minute, MOST_PRIORITY));
        assert_eq!(place(7, 1_000), place(7, MOST_PRIORITY));
    }

    #[test]
    fn a_study_does_not_wait_for_all_of_a_sweep_before_it() {
        assert!(place(0, sweep_priority(3)) > place(60_000, 0));
        assert!(place(0, sweep_priority(0)) < place(60_000, 0));
        assert_eq!(sweep_priority(usize::MAX), -MOST_PRIORITY);
    }
}
