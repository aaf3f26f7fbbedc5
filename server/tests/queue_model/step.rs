//! Random operations on the queue.

use std::time::Duration;

use proptest::prelude::*;
use server::queue::Transition;

/// Length of a lease, ms.
pub(crate) const LEASE_MS: i64 = 1_000;
pub(crate) const LEASE: Duration = Duration::from_millis(LEASE_MS.unsigned_abs());

/// An operation on the queue. Indices are taken modulo the number of jobs or claims; requests with a
/// number are made so many times.
#[derive(Debug, Clone)]
pub(crate) enum Step {
    Submit {
        priority: i32,
        deadline_s: Option<u32>,
    },
    Claim {
        slots: usize,
        times: usize,
    },
    Record {
        claim: usize,
        checkpoint: bool,
        times: usize,
    },
    /// The database has lost the write before.
    RecordAfterGap {
        claim: usize,
    },
    Renew {
        claim: usize,
    },
    Restart {
        claim: usize,
        times: usize,
    },
    End {
        claim: usize,
        transition: usize,
        times: usize,
    },
    Cancel {
        job: usize,
    },
    Retry {
        job: usize,
    },
    Reclaim,
    Expire,
    Delete {
        job: usize,
    },
    Wait {
        ms: i64,
    },
}

/// How often a request is made.
const TIMES: std::ops::Range<usize> = 1..3;

pub(crate) const ENDS: [Transition; 6] = [
    Transition::Succeed,
    Transition::Fail,
    Transition::Cancel,
    Transition::Release,
    Transition::Decline,
    Transition::WorkerLost,
];

pub(crate) fn step() -> impl Strategy<Value = Step> {
    prop_oneof![
        3 => (-3..=3_i32, prop::option::of(1..4_u32))
            .prop_map(|(priority, deadline_s)| Step::Submit { priority, deadline_s }),
        4 => (1..4_usize, TIMES).prop_map(|(slots, times)| Step::Claim { slots, times }),
        4 => (any::<usize>(), any::<bool>(), TIMES)
            .prop_map(|(claim, checkpoint, times)| Step::Record { claim, checkpoint, times }),
        1 => any::<usize>().prop_map(|claim| Step::RecordAfterGap { claim }),
        2 => any::<usize>().prop_map(|claim| Step::Renew { claim }),
        1 => (any::<usize>(), TIMES).prop_map(|(claim, times)| Step::Restart { claim, times }),
        3 => (any::<usize>(), 0..ENDS.len(), TIMES)
            .prop_map(|(claim, transition, times)| Step::End { claim, transition, times }),
        1 => any::<usize>().prop_map(|job| Step::Cancel { job }),
        1 => any::<usize>().prop_map(|job| Step::Retry { job }),
        2 => Just(Step::Reclaim),
        1 => Just(Step::Expire),
        1 => any::<usize>().prop_map(|job| Step::Delete { job }),
        3 => (0..LEASE_MS).prop_map(|ms| Step::Wait { ms }),
    ]
}
