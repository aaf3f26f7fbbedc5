//! Companions in threads of their own. They do not depend on the run that they belong to, so they are solved beside it.
//!
//! A companion that the run waits for hands its checkpoints over, so that the work can be stopped and resumed there; one
//! that is beside the run does not, and is solved again if the run is resumed.

use std::collections::BTreeMap;
use std::ops::ControlFlow;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{Receiver, Sender, channel};
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::thread::{Builder, Scope};

use super::companions;
use crate::SolveError;
use crate::checkpoint::{Checkpoint, EarlierRuns};
use crate::effects::EffectsPlan;
use crate::observer::{Event, Observer};
use crate::record::Summary;
use crate::run;
use crate::scene::Scene;

/// Result of a run.
type Solved = Result<Summary, SolveError>;

/// The companions of a scene, in as many threads as were begun. They are stopped when it is dropped.
pub(super) struct CompanionThreads<'scope, 'env> {
    scope: &'scope Scope<'scope, 'env>,
    scene: &'env Scene,
    plan: &'env EffectsPlan,
    queue: Arc<CompanionQueue>,
    /// For threads that are still to be begun.
    sender: Option<Sender<CompanionMessage>>,
    received: Receiver<CompanionMessage>,
    /// Companions that have ended, by their number.
    ended: BTreeMap<usize, Solved>,
}

/// State that all threads share.
struct CompanionQueue {
    /// Number of the next companion, and the checkpoint that it is resumed from.
    next: Mutex<(usize, Option<Checkpoint>)>,
    /// Number of the companion that the run waits for.
    awaited: AtomicUsize,
    stopped: AtomicBool,
}

/// Message of a thread about its companion.
enum CompanionMessage {
    /// A checkpoint of the one that is waited for. The companion waits for the answer, without which it stops.
    Checkpoint(Checkpoint, Sender<ControlFlow<()>>),
    /// The companion of a number has ended.
    Ended(usize, Box<Solved>),
}

impl<'scope, 'env> CompanionThreads<'scope, 'env> {
    /// The companions from one on, of which the first is resumed from a checkpoint if there is one.
    pub(super) fn new(
        scope: &'scope Scope<'scope, 'env>,
        scene: &'env Scene,
        plan: &'env EffectsPlan,
        first: usize,
        from: Option<Checkpoint>,
    ) -> Self {
        let (sender, received) = channel();
        // One with a checkpoint was waited for when the run was stopped, and is waited for next.
        let awaited = from.as_ref().map_or(usize::MAX, |_| first);
        Self {
            scope,
            scene,
            plan,
            queue: Arc::new(CompanionQueue {
                next: Mutex::new((first, from)),
                awaited: AtomicUsize::new(awaited),
                stopped: AtomicBool::new(false),
            }),
            sender: Some(sender),
            received,
            ended: BTreeMap::new(),
        }
    }

    /// Begins threads, at most one for each companion that no thread has taken, and as far as the system has any; none after the
    /// first wait.
    pub(super) fn begin(&self, threads: usize) {
        let left = companions::count(self.scene).saturating_sub(self.queue.next().0);
        for _ in 0..threads.min(left) {
            let Some(sender) = self.sender.clone() else {
                return;
            };
            let (queue, scene, plan) = (Arc::clone(&self.queue), self.scene, self.plan);
            let solve = move || queue.solve_all(scene, plan, &sender);
            // With fewer threads the same is solved, later.
            let _ = Builder::new().spawn_scoped(self.scope, solve);
        }
    }

    /// Waits for a companion; `on` receives its checkpoints meanwhile, and may stop it. `None` if no thread solves it.
    pub(super) fn wait(
        &mut self,
        number: usize,
        on: &mut dyn FnMut(Checkpoint) -> ControlFlow<()>,
    ) -> Option<Solved> {
        self.sender = None;
        self.queue.awaited.store(number, Ordering::Relaxed);
        loop {
            if let Some(solved) = self.ended.remove(&number) {
                return Some(solved);
            }
            match self.received.recv().ok()? {
                CompanionMessage::Ended(number, solved) => {
                    self.ended.insert(number, *solved);
                }
                CompanionMessage::Checkpoint(checkpoint, answer) => {
                    let flow = on(checkpoint);
                    if flow.is_break() {
                        self.queue.stop();
                    }
                    // A companion that does not wait for it has ended.
                    let _ = answer.send(flow);
                }
            }
        }
    }

    /// The checkpoint of the first companion, if no thread has taken it.
    pub(super) fn take_checkpoint(&self) -> Option<Checkpoint> {
        self.queue.next().1.take()
    }
}

impl Drop for CompanionThreads<'_, '_> {
    fn drop(&mut self) {
        self.queue.stop();
    }
}

impl CompanionQueue {
    fn stop(&self) {
        self.stopped.store(true, Ordering::Relaxed);
    }

    fn is_stopped(&self) -> bool {
        self.stopped.load(Ordering::Relaxed)
    }

    fn next(&self) -> MutexGuard<'_, (usize, Option<Checkpoint>)> {
        self.next.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// The number of the next companion that no thread has taken, and its checkpoint.
    fn take_next(&self) -> (usize, Option<Checkpoint>) {
        let mut next = self.next();
        let (number, from) = (next.0, next.1.take());
        next.0 += 1;
        (number, from)
    }

    /// Solves one companion after the other until none is left.
    fn solve_all(&self, scene: &Scene, plan: &EffectsPlan, sender: &Sender<CompanionMessage>) {
        while !self.is_stopped() {
            let (number, from) = self.take_next();
            let Some(companion) = companions::companion(scene, number) else {
                return;
            };
            let companion = Scene {
                threads: 1,
                ..companion
            };
            let mut observer = Watched {
                number,
                queue: self,
                sender,
            };
            let solved = run::by_plan(
                &companion,
                plan,
                from,
                &EarlierRuns::default(),
                &mut observer,
            );
            let ended = CompanionMessage::Ended(number, Box::new(solved));
            if sender.send(ended).is_err() {
                return;
            }
        }
    }
}

/// Observes a companion.
struct Watched<'a> {
    number: usize,
    queue: &'a CompanionQueue,
    sender: &'a Sender<CompanionMessage>,
}

impl Observer for Watched<'_> {
    fn on(&mut self, event: Event<'_>) -> ControlFlow<()> {
        if self.queue.is_stopped() {
            return ControlFlow::Break(());
        }
        let Event::Checkpoint(run) = event else {
            return ControlFlow::Continue(());
        };
        if self.queue.awaited.load(Ordering::Relaxed) != self.number {
            return ControlFlow::Continue(());
        }
        let (answer, answered) = channel();
        let message = CompanionMessage::Checkpoint(run.checkpoint(), answer);
        let sent = self.sender.send(message);
        // A message that was not received is dropped with the run, and the channel of its answer too.
        let flow = sent.ok().and_then(|()| answered.recv().ok());
        flow.unwrap_or(ControlFlow::Break(()))
    }
}
