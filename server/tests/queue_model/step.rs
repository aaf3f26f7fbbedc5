//! What is done to the queue, drawn at random.

use proptest::prelude::*;
use server::queue::Transition;

/// How long a lease holds, ms.
pub(crate) const LEASE_MS: i64 = 1_000;

/// What is done to the queue. Numbers choose among jobs or claims, whatever their count is.
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
    BeginAnew {
        claim: usize,
    },
    End {
        claim: usize,
        step: usize,
    },
    Cancel {
        job: usize,
    },
    Rescue,
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
    Transition::GiveBack,
    Transition::Lose,
];

pub(crate) fn step() -> impl Strategy<Value = Step> {
    prop_oneof![
        3 => (-3..=3_i32, prop::option::of(1..4_u32))
            .prop_map(|(priority, deadline_s)| Step::Submit { priority, deadline_s }),
        4 => Just(Step::Claim),
        4 => (any::<usize>(), any::<bool>())
            .prop_map(|(claim, checkpoint)| Step::Record { claim, checkpoint }),
        2 => any::<usize>().prop_map(|claim| Step::Renew { claim }),
        1 => any::<usize>().prop_map(|claim| Step::BeginAnew { claim }),
        3 => (any::<usize>(), 0..ENDS.len()).prop_map(|(claim, step)| Step::End { claim, step }),
        1 => any::<usize>().prop_map(|job| Step::Cancel { job }),
        2 => Just(Step::Rescue),
        1 => Just(Step::Expire),
        1 => any::<usize>().prop_map(|job| Step::Delete { job }),
        3 => (0..LEASE_MS).prop_map(|ms| Step::Wait { ms }),
    ]
}
