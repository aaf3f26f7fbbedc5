//! Random operations on the queue.

use proptest::prelude::*;
use server::queue::Transition;

/// Length of a lease, ms.
pub(crate) const LEASE_MS: i64 = 1_000;

/// An operation on the queue. Indices are taken modulo the number of jobs or claims.
#[derive(Debug, Clone)]
pub(crate) enum Step {
    Submit {
        priority: i32,
        deadline_s: Option<u32>,
    },
    Claim,
    Record {
        claim: usize,
        checkpoint: bool,
    },
    Renew {
        claim: usize,
    },
    Restart {
        claim: usize,
    },
    End {
        claim: usize,
        transition: usize,
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

pub(crate) const ENDS: [Transition; 5] = [
    Transition::Succeed,
    Transition::Fail,
    Transition::Cancel,
    Transition::Release,
    Transition::WorkerLost,
];

pub(crate) fn step() -> impl Strategy<Value = Step> {
    prop_oneof![
        3 => (-3..=3_i32, prop::option::of(1..4_u32))
            .prop_map(|(priority, deadline_s)| Step::Submit { priority, deadline_s }),
        4 => Just(Step::Claim),
        4 => (any::<usize>(), any::<bool>())
            .prop_map(|(claim, checkpoint)| Step::Record { claim, checkpoint }),
        2 => any::<usize>().prop_map(|claim| Step::Renew { claim }),
        1 => any::<usize>().prop_map(|claim| Step::Restart { claim }),
        3 => (any::<usize>(), 0..ENDS.len()).prop_map(|(claim, transition)| Step::End { claim, transition }),
        1 => any::<usize>().prop_map(|job| Step::Cancel { job }),
        1 => any::<usize>().prop_map(|job| Step::Retry { job }),
        2 => Just(Step::Reclaim),
        1 => Just(Step::Expire),
        1 => any::<usize>().prop_map(|job| Step::Delete { job }),
        3 => (0..LEASE_MS).prop_map(|ms| Step::Wait { ms }),
    ]
}
