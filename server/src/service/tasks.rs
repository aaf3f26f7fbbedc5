//! The long-lived tasks of a service, each restarted if it fails.

use std::sync::Arc;

use tokio::task::JoinSet;
use tokio_util::sync::CancellationToken;

use crate::http::App;
use crate::service::{batch_endings, expansions, maintenance, workers};
use crate::store::{Reclaimed, Store};
use crate::supervision::{Supervisor, TaskName, WORKER};
use crate::worker;
use crate::worker::{WorkerConfig, WorkerHealth, WorkerProcess};

/// Tasks that are being started.
pub(super) struct Tasks {
    pub(super) running: JoinSet<()>,
    supervisor: Arc<Supervisor>,
    store: Arc<Store>,
    stopping: CancellationToken,
}

impl Tasks {
    pub(super) fn new(
        store: &Arc<Store>,
        supervisor: &Arc<Supervisor>,
        stopping: &CancellationToken,
    ) -> Self {
        Self {
            running: JoinSet::new(),
            supervisor: Arc::clone(supervisor),
            store: Arc::clone(store),
            stopping: stopping.clone(),
        }
    }

    pub(super) fn start<F>(&mut self, name: TaskName, start: impl FnMut() -> F + Send + 'static)
    where
        F: Future<Output = ()> + Send + 'static,
    {
        let (supervisor, metrics) = (
            Arc::clone(&self.supervisor),
            Arc::clone(self.store.metrics()),
        );
        let stopping = self.stopping.clone();
        self.running
            .spawn(supervisor.run(name, metrics, stopping, start));
    }

    /// Starts a task that there is once, with the store until the service stops.
    pub(super) fn start_one<F>(
        &mut self,
        name: &'static str,
        mut task: impl FnMut(Arc<Store>, CancellationToken) -> F + Send + 'static,
    ) where
        F: Future<Output = ()> + Send + 'static,
    {
        let (store, stopping) = (Arc::clone(&self.store), self.stopping.clone());
        self.start((name, 0), move || {
            task(Arc::clone(&store), stopping.clone())
        });
    }

    /// Starts the workers of this process; returns their health.
    pub(super) fn start_workers(
        &mut self,
        count: usize,
        config: &Arc<WorkerConfig>,
    ) -> Arc<WorkerHealth> {
        let process = WorkerProcess::new(config.memory_mb, false);
        let process = Arc::new(if self.store.is_shared() {
            process.beside_others()
        } else {
            process
        });
        for number in 0..count {
            let (store, stopping) = (Arc::clone(&self.store), self.stopping.clone());
            let (process, config) = (Arc::clone(&process), Arc::clone(config));
            self.start((WORKER, number), move || {
                let work = worker::work(
                    Arc::clone(&store),
                    Arc::clone(&process),
                    Arc::clone(&config),
                    stopping.clone(),
                );
                async move {
                    if let Err(error) = work.await {
                        tracing::error!(%error, "a worker has ended");
                    }
                }
            });
        }
        Arc::clone(process.health())
    }

    /// Starts what keeps the store in order: lost jobs, deadlines, old jobs, the ownership of a file, contacts with remote workers,
    /// ends of jobs of large sweeps.
    /// `reclaimed` are the jobs that were reclaimed at the start.
    pub(super) fn start_upkeep(
        &mut self,
        app: &App,
        config: &Arc<WorkerConfig>,
        keep_days: Option<u32>,
        reclaimed: Reclaimed,
    ) {
        let (mut reclaimed, config) = (Some(reclaimed), Arc::clone(config));
        self.start_one("maintenance", move |store, stopping| {
            let reclaimed = reclaimed.take().unwrap_or_default();
            maintenance::maintain(store, Arc::clone(&config), keep_days, reclaimed, stopping)
        });
        self.start_one("heartbeat", maintenance::beat);
        let registry = Arc::clone(&app.workers);
        self.start_one("workers", move |store, stopping| {
            workers::note_workers(store, Arc::clone(&registry), stopping)
        });
        self.start_one("batch endings", batch_endings::end_jobs);
    }

    /// Starts what queues the jobs of large sweeps, so many of each ahead of the workers.
    pub(super) fn start_queueing(&mut self, app: &App, ahead: u64) {
        let machine = app.machine.clone();
        self.start_one("expansions", move |store, stopping| {
            expansions::queue_ahead(store, machine.clone(), ahead, stopping)
        });
    }
}
