//! Services under fault injection, and the jobs submitted to them.

use std::collections::BTreeMap;
use std::path::PathBuf;
use std::time::Instant;

use fastrand::Rng;
use serde_json::Value;
use tests::{Disk, Log, Server, SteppedClock, use_database, use_postgresql};

use super::faults::Fault;

const OPTIONS: [&str; 10] = [
    "--workers",
    "2",
    "--lease-s",
    "1",
    "--checkpoint-every-s",
    "0",
    "--attempts",
    "1000",
    "--least-free-disk-mb",
    "0",
];
/// Size of the disk that is filled up: empty, and for the results of a job, MB.
const DISK_MB: (usize, usize) = (64, 2);
/// Deadline of each job, s: shorter than the steps of the clock, longer than a trial.
const DEADLINE_S: u32 = 7_200;

/// Storage of the jobs.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Engine {
    /// A file of SQLite.
    File,
    /// A PostgreSQL server.
    Server,
    /// A PostgreSQL server of two services, which have a store of objects and no folder in common.
    Services,
}

/// One of the services.
struct Service {
    /// Where its files are.
    folder: PathBuf,
    server: Option<Server>,
}

/// The services, what they run on, and what was done.
pub(super) struct Trial {
    pub(super) engine: Engine,
    pub(super) began: Instant,
    pub(super) disk: Disk,
    pub(super) clock: SteppedClock,
    pub(super) folder: PathBuf,
    /// Where the files of results are, or their objects.
    pub(super) results: PathBuf,
    services: Vec<Service>,
    /// Number of the service that gets the requests and the faults.
    hit: usize,
    pub(super) rng: Rng,
    pub(super) accepted: Vec<String>,
    pub(super) faults: BTreeMap<Fault, u32>,
    /// Faults that come next, in a random order.
    pub(super) next: Vec<Fault>,
    /// Starts of the service by what became of its log.
    pub(super) logs: BTreeMap<&'static str, u32>,
    /// Tasks of the service that ended unexpectedly.
    pub(super) failed_tasks: u64,
}

impl Trial {
    pub(super) fn new(engine: Engine, jobs: usize, seed: u64) -> Self {
        let disk = Disk::new(DISK_MB.0 + DISK_MB.1 * jobs);
        let folder = disk.path().to_owned();
        let mut folders = vec![folder.clone()];
        if engine != Engine::File {
            let address = use_postgresql(&folder);
            if engine == Engine::Services {
                let beside = folder.join("beside");
                std::fs::create_dir(&beside).expect("a folder");
                use_database(&beside, &address);
                folders.push(beside);
            }
        }
        let services = folders.into_iter().map(|folder| Service {
            folder,
            server: None,
        });
        let mut trial = Self {
            engine,
            began: Instant::now(),
            clock: SteppedClock::new(&folder),
            disk,
            results: folder.join(match engine {
                Engine::File => "fretwear.db.results",
                Engine::Server => "fretwear.results",
                Engine::Services => "objects",
            }),
            folder,
            services: services.collect(),
            hit: 0,
            rng: Rng::with_seed(seed),
            accepted: Vec::new(),
            faults: BTreeMap::new(),
            next: Vec::new(),
            logs: BTreeMap::new(),
            failed_tasks: 0,
        };
        for number in 0..trial.services.len() {
            trial.hit = number;
            trial.start();
        }
        trial
    }

    /// Lets the next faults be of any of the services.
    pub(super) fn hit_any(&mut self) {
        if self.services.len() > 1 {
            self.hit = self.rng.usize(..self.services.len());
        }
    }

    pub(super) fn server(&self) -> &Server {
        let server = self.services[self.hit].server.as_ref();
        server.expect("the service runs")
    }

    /// Starts the service, with one of the logs.
    pub(super) fn start(&mut self) {
        let (name, log) = match self.rng.u32(..4) {
            0 => ("read", Log::Read),
            1 => ("unread", Log::Unread),
            2 => ("closed", Log::Closed),
            _ => ("on the disk", Log::File(self.folder.join("log"))),
        };
        *self.logs.entry(name).or_default() += 1;
        assert!(self.start_logging(&log), "the service ended at its start");
    }

    /// Starts the service with a log; whether it serves.
    pub(super) fn start_logging(&mut self, log: &Log) -> bool {
        let objects = format!("file://{}", self.results.display());
        let mut options = OPTIONS.to_vec();
        if self.engine == Engine::Services {
            options.extend(["--objects", &objects]);
        }
        let environment = self.clock.environment();
        let service = &mut self.services[self.hit];
        service.server = Server::start_logging(&service.folder, &options, &environment, log);
        service.server.is_some()
    }

    /// Takes the service, to end it.
    pub(super) async fn take(&mut self) -> Server {
        self.count_failed_tasks().await;
        let server = self.services[self.hit].server.take();
        server.expect("the service runs")
    }

    /// Adds the failures of tasks that the services have counted.
    pub(super) async fn count_all_failed_tasks(&mut self) {
        for number in 0..self.services.len() {
            self.hit = number;
            self.count_failed_tasks().await;
        }
    }

    /// Adds the failures of tasks that this service has counted.
    async fn count_failed_tasks(&mut self) {
        let server = self.server();
        let request = server.client.get(format!("{}/metrics", server.base));
        let Ok(answer) = request.send().await else {
            return;
        };
        let metrics = answer.text().await.unwrap_or_default();
        let failures = metrics
            .lines()
            .filter(|line| line.starts_with("fretwear_task_failures_total"));
        let number = |line: &str| line.rsplit_once(' ')?.1.parse::<u64>().ok();
        self.failed_tasks += failures.filter_map(number).sum::<u64>();
    }

    /// Submits the next job with an idempotency key, so that the request can be repeated.
    pub(super) async fn submit(&mut self, specs: &[Value]) {
        let number = self.accepted.len();
        let server = self.server();
        let request = server
            .client
            .post(format!("{}/v1/jobs?deadline_s={DEADLINE_S}", server.base))
            .header("content-type", "application/json")
            .header("idempotency-key", format!("chaos-{number}"))
            .body(specs[number % specs.len()].to_string());
        let Ok(response) = request.send().await else {
            return;
        };
        if response.status() == 202 {
            let job: Value = response.json().await.expect("a job");
            self.accepted
                .push(job["id"].as_str().expect("an id").to_owned());
        }
    }

    /// Number of accepted jobs that have not ended.
    pub(super) async fn open(&self) -> usize {
        let path = "/v1/jobs?status=queued,running&limit=500";
        loop {
            let (status, list) = self.server().get_in_the_end(path).await;
            if status == 200 {
                return list["jobs"].as_array().expect("jobs").len();
            }
        }
    }
}
