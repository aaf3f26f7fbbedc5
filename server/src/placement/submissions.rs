//! Workers that were submitted and are not listed yet.
//!
//! A scheduler may accept a submission and not say so, as where its answer is lost, and may list late what it has accepted. Until it is
//! listed, each submission counts as workers that are there, so that it is not repeated.

use std::collections::HashSet;
use std::time::{Duration, Instant};

use uuid::Uuid;

/// Longest time for which a submission that is not listed counts. Arbitrary: a scheduler that is overloaded lists after minutes.
const LONGEST_UNLISTED: Duration = Duration::from_mins(10);

/// Submissions that are not listed yet.
#[derive(Debug, Default)]
pub struct Submissions(Vec<Submission>);

#[derive(Debug)]
struct Submission {
    /// Text by which a task names its submission.
    key: String,
    workers: u64,
    began: Instant,
}

impl Submissions {
    /// Notes a submission of so many workers; returns the key that its tasks have to name.
    pub fn begin(&mut self, workers: u64, now: Instant) -> String {
        let key = format!("fretwear-{}", Uuid::now_v7());
        self.0.push(Submission {
            key: key.clone(),
            workers,
            began: now,
        });
        key
    }

    /// Notes that a submission has not reached the scheduler.
    pub fn not_sent(&mut self, key: &str) {
        self.0.retain(|submission| submission.key != key);
    }

    /// Notes the keys of the tasks that are listed, which count by the list from now on.
    pub fn listed(&mut self, keys: &HashSet<String>, now: Instant) {
        self.0.retain(|submission| {
            let is_recent = now.saturating_duration_since(submission.began) < LONGEST_UNLISTED;
            is_recent && !keys.contains(&submission.key)
        });
    }

    /// Number of workers that may be there although they are not listed.
    pub fn unlisted(&self) -> u64 {
        self.0.iter().map(|submission| submission.workers).sum()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_submission_counts_until_it_is_listed_or_too_old() {
        let (mut submissions, start) = (Submissions::default(), Instant::now());
        let after = |seconds| start + Duration::from_secs(seconds);
        let first = submissions.begin(3, start);
        submissions.begin(4, after(60));
        submissions.listed(&HashSet::new(), after(599));
        assert_eq!(submissions.unlisted(), 7);
        submissions.listed(&HashSet::from([first]), after(599));
        assert_eq!(submissions.unlisted(), 4);
        submissions.listed(&HashSet::new(), after(659));
        assert_eq!(submissions.unlisted(), 4);
        submissions.listed(&HashSet::new(), after(660));
        assert_eq!(submissions.unlisted(), 0);
    }

    #[test]
    fn a_submission_that_was_not_sent_does_not_count() {
        let mut submissions = Submissions::default();
        let keys = [2, 5].map(|workers| submissions.begin(workers, Instant::now()));
        assert_ne!(keys[0], keys[1]);
        submissions.not_sent(&keys[1]);
        assert_eq!(submissions.unlisted(), 2);
    }
}
