//! Metrics for `/metrics` (Prometheus).

mod process;

use std::fmt;
use std::time::{Duration, Instant};

use api::job::Status;
use prometheus_client::encoding::text::encode;
use prometheus_client::metrics::counter::Counter;
use prometheus_client::metrics::family::Family;
use prometheus_client::metrics::gauge::Gauge;
use prometheus_client::metrics::histogram::Histogram;
use prometheus_client::metrics::info::Info;
use prometheus_client::registry::{Metric, Registry, Unit};

use process::ProcessMetrics;

/// Histogram bounds of the wait for a worker, s: from an idle worker to a queue of a day.
const WAIT_BOUNDS_S: [f64; 9] = [0.01, 0.1, 0.5, 1.0, 10.0, 60.0, 600.0, 3_600.0, 86_400.0];
/// Histogram bounds of a solve, s: from a draft to a run of a day.
const SOLVE_BOUNDS_S: [f64; 9] = [0.1, 0.5, 1.0, 5.0, 10.0, 60.0, 600.0, 3_600.0, 86_400.0];

/// Histogram bounds of an answer, s: from a poll to a long poll.
const ANSWER_BOUNDS_S: [f64; 9] = [0.001, 0.003, 0.01, 0.03, 0.1, 0.3, 1.0, 10.0, 60.0];

type ByRoute<M, F> = Family<[(&'static str, String); 2], M, F>;

type ByStatus = Family<[(&'static str, &'static str); 1], Gauge>;

/// Gauges that the store reads on request.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Gauges {
    /// Status, number of jobs, age of the oldest job in s.
    pub jobs: Vec<(Status, i64, i64)>,
    /// Age of the oldest checkpoint of a running job, s; 0 if there is none.
    pub oldest_checkpoint_s: i64,
    /// Age of the oldest progress of a running job, s; 0 if there is none.
    pub oldest_progress_s: i64,
    /// Size of the write-ahead log, bytes.
    pub wal_bytes: i64,
    /// Size of the database, bytes.
    pub database_bytes: i64,
    /// Free space on its disk, bytes.
    pub disk_free_bytes: i64,
    /// Workers that run in this process.
    pub workers_alive: i64,
    /// Slots of remote workers.
    pub remote_slots: i64,
    /// Processes with workers that start no solves at present.
    pub workers_failing: i64,
    /// Estimated processor time of the waiting jobs, s.
    pub demand_cpu_s: i64,
    /// Jobs whose results wait to be moved to the store of objects.
    pub results_to_move: i64,
}

/// Counters, histograms and the last read gauges.
pub struct Metrics {
    registry: Registry,
    jobs: ByStatus,
    oldest: ByStatus,
    ended: Family<[(&'static str, &'static str); 1], Counter>,
    oldest_checkpoint: Gauge,
    oldest_progress: Gauge,
    wal: Gauge,
    database: Gauge,
    disk_free: Gauge,
    workers_alive: Gauge,
    workers_busy: Gauge,
    remote_slots: Gauge,
    workers_failing: Gauge,
    demand_cpu: Gauge,
    results_to_move: Gauge,
    answers: Family<[(&'static str, String); 3], Counter>,
    answer_time: ByRoute<Histogram, fn() -> Histogram>,
    process: ProcessMetrics,
    /// Time from a job's submission to its first claim, s.
    pub claim_latency: Histogram,
    /// Time from a claim to the end of its attempt, s.
    pub solve_duration: Histogram,
    /// Claims by workers.
    pub attempts: Counter,
    /// Jobs reclaimed from lost workers.
    pub reclaimed: Counter,
    /// Writes that were discarded because their lease was lost.
    pub stale_writes: Counter,
    /// Stored checkpoints.
    pub checkpoints: Counter,
    /// Jobs whose results were moved to the store of objects.
    pub results_moved: Counter,
    task_failures: Family<[(&'static str, &'static str); 1], Counter>,
    streams_open: Gauge,
}

/// Guard of a busy worker.
#[derive(Debug)]
pub struct Busy {
    _counted: Counted,
    started: Instant,
    solve_duration: Histogram,
}

impl Drop for Busy {
    fn drop(&mut self) {
        self.solve_duration
            .observe(self.started.elapsed().as_secs_f64());
    }
}

/// Guard of something that is counted as long as the guard lives: an open event stream, a busy worker.
#[derive(Debug)]
pub struct Counted(Gauge);

impl Drop for Counted {
    fn drop(&mut self) {
        self.0.dec();
    }
}

impl Metrics {
    /// Counts an open event stream.
    pub fn stream(&self) -> Counted {
        counted(&self.streams_open)
    }

    /// Counts a worker that has a job, and the time of its attempt.
    pub fn busy_worker(&self) -> Busy {
        Busy {
            _counted: counted(&self.workers_busy),
            started: Instant::now(),
            solve_duration: self.solve_duration.clone(),
        }
    }

    /// Number of workers in this process that have a job.
    pub fn busy_workers(&self) -> u64 {
        u64::try_from(self.workers_busy.get()).unwrap_or_default()
    }

    /// Counts a claim; if it is the first one of a job, with the time since its submission.
    pub fn claimed(&self, is_first: bool, waited_ms: i64) {
        self.attempts.inc();
        if is_first {
            let waited = Duration::from_millis(u64::try_from(waited_ms).unwrap_or_default());
            self.claim_latency.observe(waited.as_secs_f64());
        }
    }

    /// Counts an answer of a route, with its status and the time until its head.
    pub fn answered(&self, method: &str, route: &str, status: u16, time: Duration) {
        let of = |status: String| {
            [
                ("method", method.to_owned()),
                ("route", route.to_owned()),
                ("status", status),
            ]
        };
        let [method, route, _] = of(String::new());
        self.answers.get_or_create(&of(status.to_string())).inc();
        let times = self.answer_time.get_or_create(&[method, route]);
        times.observe(time.as_secs_f64());
    }

    /// Counts an ended job.
    pub fn ended(&self, status: Status) {
        self.ended
            .get_or_create(&[("status", status.as_str())])
            .inc();
    }

    /// Counts the failure of a long-lived task of a kind.
    pub fn task_failed(&self, kind: &'static str) {
        self.task_failures.get_or_create(&[("task", kind)]).inc();
    }

    /// Returns the exposition, with these gauges.
    ///
    /// # Errors
    /// [`fmt::Error`] if it cannot be formatted.
    pub fn text(&self, gauges: &Gauges) -> Result<String, fmt::Error> {
        for (status, count, oldest_s) in &gauges.jobs {
            let label = [("status", status.as_str())];
            self.jobs.get_or_create(&label).set(*count);
            self.oldest.get_or_create(&label).set(*oldest_s);
        }
        self.oldest_checkpoint.set(gauges.oldest_checkpoint_s);
        self.oldest_progress.set(gauges.oldest_progress_s);
        self.wal.set(gauges.wal_bytes);
        self.database.set(gauges.database_bytes);
        self.disk_free.set(gauges.disk_free_bytes);
        self.workers_alive.set(gauges.workers_alive);
        self.remote_slots.set(gauges.remote_slots);
        self.workers_failing.set(gauges.workers_failing);
        self.demand_cpu.set(gauges.demand_cpu_s);
        self.results_to_move.set(gauges.results_to_move);
        self.process.read();
        let mut text = String::new();
        encode(&mut text, &self.registry)?;
        Ok(text)
    }
}

impl Default for Metrics {
    fn default() -> Self {
        let mut registry = Registry::default();
        let process = ProcessMetrics::register(&mut registry);
        let r = registry.sub_registry_with_prefix("fretwear");
        let build = [
            ("version", env!("CARGO_PKG_VERSION")),
            ("commit", env!("FRETWEAR_COMMIT")),
        ];
        r.register("build", "The program", Info::new(build));
        let to_claim = ("claim_latency", "From submission to the first claim");
        let to_end = ("solve_duration", "From a claim to the end of its job");
        let oldest = ("oldest_job_age", "Age of the oldest job by status");
        let checkpoint = (
            "oldest_checkpoint_age",
            "Age of the oldest checkpoint of a running job",
        );
        let progress = (
            "oldest_progress_age",
            "Age of the oldest progress of a running job",
        );
        let answer = (
            "http_request_duration",
            "From a request to the head of its answer; long polls wait on purpose",
        );
        let answer_time: ByRoute<_, fn() -> Histogram> =
            Family::new_with_constructor(|| Histogram::new(ANSWER_BOUNDS_S));
        let database = ("database_size", "Size of the database");
        let disk_free = (
            "disk_free",
            "Free space on the disk of the database, and in the database",
        );
        let wal = ("wal_size", "Size of the write-ahead log");
        let demand = ("demand", "Estimated processor time of the waiting jobs");
        let stale = "Writes discarded because their lease was lost";
        let (wait_s, solve_s) = (
            Histogram::new(WAIT_BOUNDS_S),
            Histogram::new(SOLVE_BOUNDS_S),
        );
        Self {
            jobs: add(r, "jobs", "Jobs by status"),
            oldest: add_in(r, Unit::Seconds, oldest, <_>::default()),
            ended: add(r, "jobs_ended", "Ended jobs"),
            claim_latency: add_in(r, Unit::Seconds, to_claim, wait_s),
            solve_duration: add_in(r, Unit::Seconds, to_end, solve_s),
            attempts: add(r, "attempts", "Claims by workers"),
            reclaimed: add(r, "rescues", "Jobs reclaimed from lost workers"),
            stale_writes: add(r, "stale_writes_refused", stale),
            checkpoints: add(r, "checkpoints", "Checkpoints stored"),
            oldest_checkpoint: add_in(r, Unit::Seconds, checkpoint, <_>::default()),
            oldest_progress: add_in(r, Unit::Seconds, progress, <_>::default()),
            wal: add_in(r, Unit::Bytes, wal, <_>::default()),
            database: add_in(r, Unit::Bytes, database, <_>::default()),
            disk_free: add_in(r, Unit::Bytes, disk_free, <_>::default()),
            workers_alive: add(r, "workers_alive", "Workers that run"),
            workers_busy: add(r, "workers_busy", "Workers that have a job"),
            remote_slots: add(r, "remote_slots", "Slots of remote workers"),
            workers_failing: add(
                r,
                "workers_failing",
                "Processes with workers that start no solves at present",
            ),
            demand_cpu: add_in(
                r,
                Unit::Other("cpu_seconds".to_owned()),
                demand,
                <_>::default(),
            ),
            results_to_move: add(
                r,
                "results_to_move",
                "Jobs whose results wait to be moved to the store of objects",
            ),
            results_moved: add(
                r,
                "results_moved",
                "Jobs whose results were moved to the store of objects",
            ),
            answers: add(r, "http_requests", "Answered requests by route and status"),
            answer_time: add_in(r, Unit::Seconds, answer, answer_time),
            task_failures: add(
                r,
                "task_failures",
                "Tasks of the service that ended before it stopped",
            ),
            streams_open: add(r, "streams_open", "Open event streams"),
            process,
            registry,
        }
    }
}

/// Counts something as long as the guard lives.
fn counted(gauge: &Gauge) -> Counted {
    gauge.inc();
    Counted(gauge.clone())
}

/// Creates and registers a metric.
fn add<M: Metric + Clone + Default>(registry: &mut Registry, name: &str, help: &str) -> M {
    let metric = M::default();
    registry.register(name, help, metric.clone());
    metric
}

/// Registers a metric with a unit.
fn add_in<M: Metric + Clone>(
    registry: &mut Registry,
    unit: Unit,
    (name, help): (&str, &str),
    metric: M,
) -> M {
    registry.register_with_unit(name, help, unit, metric.clone());
    metric
}

impl fmt::Debug for Metrics {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_struct("Metrics").finish_non_exhaustive()
    }
}

#[cfg(test)]
mod tests;
