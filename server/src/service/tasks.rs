//! The long-lived tasks of a service, each restarted if it fails.

use std::sync::Arc;

use tokio::task::JoinSet;
use tokio_util::sync::CancellationToken;

use crate::http::App;
use crate::service::{batch_endings, expansions, maintenance, objects, workers};
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
            let (store, stopping) = self.shared();
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

    /// Starts what keeps the store in order: lost jobs, deadlines, old jobs, the ownership of a file, contacts with remote workers.
    /// `reclaimed` are the jobs that were reclaimed at the start.
    pub(super) fn start_upkeep(
        &mut self,
        app: &App,
        config: &Arc<WorkerConfig>,
        keep_days: Option<u32>,
        reclaimed: Reclaimed,
    ) {
        let mut reclaimed = Some(reclaimed);
        let ((store, stopping), config) = (self.shared(), Arc::clone(config));
        self.start(("maintenance", 0), move || {
            let (store, config, stopping) =
                (Arc::clone(&store), Arc::clone(&config), stopping.clone());
            let reclaimed = reclaimed.take().unwrap_or_default();
            maintenance::maintain(store, config, keep_days, reclaimed, stopping)
        });
        let (store, stopping) = self.shared();
        self.start(("heartbeat", 0), move || {
            maintenance::beat(Arc::clone(&store), stopping.clone())
        });
        let ((store, stopping), registry) = (self.shared(), Arc::clone(&app.workers));
        self.start(("workers", 0), move || {
            workers::note_workers(Arc::clone(&store), Arc::clone(&registry), stopping.clone())
        });
    }

    /// Starts what moves results to the store of objects.
    pub(super) fn start_mover(&mut self) {
        let (store, stopping) = self.shared();
        self.start(("objects", 0), move || {
            objects::move_results(Arc::clone(&store), stopping.clone())
        });
    }

    /// Starts what cancels and deletes the jobs of large sweeps.
    pub(super) fn start_batch_endings(&mut self) {
        let (store, stopping) = self.shared();
        self.start(("batch endings", 0), move || {
            batch_endings::end_jobs(Arc::clone(&store), stopping.clone())
        });
    }

    /// Starts what queues the jobs of large sweeps, so many of each ahead of the workers.
    pub(super) fn start_queueing(&mut self, app: &App, ahead: u64) {
        let ((store, stopping), machine) = (self.shared(), app.machine.clone());
        self.start(("expansions", 0), move || {
            expansions::queue_ahead(Arc::clone(&store), machine.clone(), ahead, stopping.clone())
        });
    }

    fn shared(&self) -> (Arc<Store>, CancellationToken) {
        (Arc::clone(&self.store), self.stopping.clone())
    }
}
