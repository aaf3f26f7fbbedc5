//! Supervision of the service's long-lived tasks, as a supervisor of Erlang/OTP: a task that ends before the service stops, by
//! a panic or without one, is restarted after a pause. One that ends repeatedly makes the service not ready.

use std::collections::BTreeMap;
use std::sync::{Arc, Mutex, PoisonError};
use std::time::{Duration, Instant};

use tokio::task::AbortHandle;
use tokio_util::sync::CancellationToken;
use tokio_util::task::AbortOnDropHandle;

use crate::backoff::Backoff;
use crate::metrics::Metrics;

/// Recent failures of a task from which on the service is not ready. Arbitrary: a bug that one rare job triggers fails
/// less often.
const REPEATED: usize = 3;

/// When tasks are restarted.
#[derive(Debug, Clone, Copy)]
struct RestartPolicy {
    /// Pauses before restarts, by the number of recent failures.
    pauses: Backoff,
    /// Time for which a failure counts as recent.
    recent: Duration,
}

impl Default for RestartPolicy {
    fn default() -> Self {
        Self {
            pauses: Backoff {
                first: Duration::from_secs(1),
                longest: Duration::from_secs(30),
            },
            recent: Duration::from_mins(5),
        }
    }
}

/// Kind of the workers.
pub const WORKER: &str = "worker";

/// A kind of task, and its number where there are several.
pub type TaskName = (&'static str, usize);

/// The supervised tasks.
#[derive(Debug, Default)]
pub struct Supervisor {
    policy: RestartPolicy,
    tasks: Mutex<BTreeMap<TaskName, Supervised>>,
}

#[derive(Debug, Default)]
struct Supervised {
    /// The running task; none while it waits for its restart.
    running: Option<AbortHandle>,
    /// When it failed recently.
    failed: Vec<Instant>,
}

impl Supervised {
    fn forget_failures_before(&mut self, recent: Duration) {
        self.failed.retain(|at| at.elapsed() < recent);
    }
}

impl Supervisor {
    /// Names of the tasks that run.
    pub fn running(&self) -> Vec<TaskName> {
        let tasks = self.tasks.lock().unwrap_or_else(PoisonError::into_inner);
        let running = tasks.iter().filter(|(_, task)| task.running.is_some());
        running.map(|(name, _)| *name).collect()
    }

    /// Number of the workers that run.
    pub fn running_workers(&self) -> usize {
        let running = self.running();
        running.iter().filter(|(kind, _)| *kind == WORKER).count()
    }

    /// Runs a task until the service stops, and starts it again whenever it ends before.
    pub async fn run<F>(
        self: Arc<Self>,
        name: TaskName,
        metrics: Arc<Metrics>,
        stopping: CancellationToken,
        mut start: impl FnMut() -> F,
    ) where
        F: Future<Output = ()> + Send + 'static,
    {
        loop {
            let task = tokio::spawn(start());
            self.with(name, |task_of| task_of.running = Some(task.abort_handle()));
            let ended = AbortOnDropHandle::new(task).await;
            if stopping.is_cancelled() {
                return;
            }
            let (kind, number) = name;
            let cause = ended.map_or_else(|error| error.to_string(), |()| "it returned".to_owned());
            tracing::error!(task = kind, number, cause, "a task ended and is restarted");
            metrics.task_failed(kind);
            let pause = self.with(name, |task_of| {
                task_of.running = None;
                task_of.forget_failures_before(self.policy.recent);
                task_of.failed.push(Instant::now());
                self.policy.pauses.pause_after(task_of.failed.len())
            });
            tokio::select! {
                () = tokio::time::sleep(pause) => {}
                () = stopping.cancelled() => return,
            }
        }
    }

    /// The kinds of tasks that fail repeatedly.
    pub fn failing(&self) -> Vec<&'static str> {
        let mut tasks = self.tasks.lock().unwrap_or_else(PoisonError::into_inner);
        let mut kinds: Vec<&'static str> = tasks
            .iter_mut()
            .filter_map(|(name, task)| {
                task.forget_failures_before(self.policy.recent);
                (task.failed.len() >= REPEATED).then_some(name.0)
            })
            .collect();
        kinds.dedup();
        kinds
    }

    fn with<R>(&self, name: TaskName, change: impl FnOnce(&mut Supervised) -> R) -> R {
        let mut tasks = self.tasks.lock().unwrap_or_else(PoisonError::into_inner);
        change(tasks.entry(name).or_default())
    }
}

#[cfg(test)]
pub(crate) mod tests {
    use std::future::pending;

    use super::*;

    impl Supervisor {
        /// Ends a task as a panic would; whether it ran.
        pub(crate) fn kill(&self, name: TaskName) -> bool {
            self.with(name, |task| match task.running.take() {
                Some(running) => {
                    running.abort();
                    true
                }
                None => false,
            })
        }
    }

    const SHORT: RestartPolicy = RestartPolicy {
        pauses: Backoff {
            first: Duration::from_millis(1),
            longest: Duration::from_millis(5),
        },
        recent: Duration::from_hours(1),
    };

    /// Supervises a task that panics at its first starts until it no longer does; returns the supervisor and the metrics.
    async fn supervised(policy: RestartPolicy, panics: usize) -> (Arc<Supervisor>, Arc<Metrics>) {
        let tasks = Mutex::default();
        let (supervisor, metrics) = (Arc::new(Supervisor { policy, tasks }), Arc::default());
        let (lasting, mut lasts) = tokio::sync::mpsc::unbounded_channel();
        let mut starts = 0;
        let start = move || {
            starts += 1;
            let (number, lasting) = (starts, lasting.clone());
            async move {
                assert!(number > panics, "as the test asked for");
                lasting.send(()).expect("the test waits");
                pending::<()>().await;
            }
        };
        let (of, stopping) = (Arc::clone(&metrics), CancellationToken::new());
        tokio::spawn(Arc::clone(&supervisor).run(("test", 0), of, stopping, start));
        lasts.recv().await.expect("it lasts in the end");
        (supervisor, metrics)
    }

    #[tokio::test]
    async fn a_task_that_panics_is_restarted_and_counted() {
        let (supervisor, metrics) = supervised(SHORT, REPEATED - 1).await;
        assert_eq!(supervisor.running(), [("test", 0)]);
        assert!(supervisor.failing().is_empty());
        let text = metrics.text(&<_>::default()).expect("text");
        assert!(text.contains("fretwear_task_failures_total{task=\"test\"} 2"));
    }

    #[tokio::test]
    async fn a_task_that_panics_repeatedly_is_failing_for_a_while() {
        let (supervisor, _) = supervised(SHORT, REPEATED).await;
        assert_eq!(supervisor.failing(), ["test"]);
        let recent = Duration::ZERO;
        let (supervisor, _) = supervised(RestartPolicy { recent, ..SHORT }, REPEATED).await;
        assert!(supervisor.failing().is_empty());
    }

    #[tokio::test]
    async fn a_task_that_ends_because_the_service_stops_is_not_restarted() {
        let supervisor = Arc::new(Supervisor::default());
        let stopping = CancellationToken::new();
        let token = stopping.clone();
        let start = move || token.clone().cancelled_owned();
        let run = Arc::clone(&supervisor).run(("test", 0), Arc::default(), stopping.clone(), start);
        let running = tokio::spawn(run);
        stopping.cancel();
        running.await.expect("it ends");
        assert!(supervisor.failing().is_empty());
    }
}
