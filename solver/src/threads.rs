//! Threads of a run. Results depend neither on their number nor on which of them is done first.

use std::panic::resume_unwind;
use std::thread::{Builder, ScopedJoinHandle};

use rayon::{ThreadPool, ThreadPoolBuilder};

use crate::sides::{Side, Sides};

/// The threads of a run: none besides the caller's own where no others were asked for or could be started.
#[derive(Default)]
pub(crate) struct Threads(Option<ThreadPool>);

impl Threads {
    pub(crate) fn new(count: usize) -> Self {
        let others = (count > 1).then(|| ThreadPoolBuilder::new().num_threads(count).build());
        Self(others.and_then(Result::ok))
    }

    /// Does work that may be shared among the threads.
    pub(crate) fn within<R: Send>(&self, work: impl FnOnce() -> R + Send) -> R {
        match &self.0 {
            Some(pool) => pool.install(work),
            None => work(),
        }
    }
}

/// Does work for both bodies: with more than one thread one beside the other, the receptacle in the caller's thread. It is the larger body in
/// most scenes, and what a thread has freed is there for its next allocations.
pub(crate) fn for_both<T: Send, R: Send>(
    threads: usize,
    Sides {
        mut slider,
        mut receptacle,
    }: Sides<T>,
    work: impl Fn(Side, &mut T) -> R + Sync,
) -> Sides<R> {
    let (beside, receptacle) = std::thread::scope(|scope| {
        let of_slider = || work(Side::Slider, &mut slider);
        let beside = (threads > 1).then(|| Builder::new().spawn_scoped(scope, of_slider));
        let receptacle = work(Side::Receptacle, &mut receptacle);
        let beside = beside.and_then(Result::ok).map(ScopedJoinHandle::join);
        let beside = beside.map(|done| done.unwrap_or_else(|panic| resume_unwind(panic)));
        (beside, receptacle)
    });
    Sides {
        slider: beside.unwrap_or_else(|| work(Side::Slider, &mut slider)),
        receptacle,
    }
}
