//! Three services on one PostgreSQL database, behind a proxy: whatever is killed, paused, cut off or stepped for less than a lease, every
//! accepted job is solved once, and none needs a second attempt.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use fastrand::Rng;
use futures_util::{StreamExt, stream};
use nix::sys::signal::Signal;
use server::client::Client;
use tests::{Haproxy, PostgresServer, Server, SteppedClock};
use uuid::Uuid;

use super::simulated::{Done, Harm, started};
use super::{AT_ONCE, SPEC, assert_once, is_long, load};

/// How long something is away: much shorter than a lease.
const AWAY: Duration = Duration::from_millis(1_500);
/// How long the store of objects is away in the long form: nothing depends on it.
const OBJECTS_AWAY: Duration = Duration::from_mins(1);
/// An hour, s.
const STEP_S: i64 = 3_600;
/// Settings of a server whose commits must survive.
const SETTINGS: [&str; 1] = ["max_connections=200"];
/// Seed of the order of harms.
const SEED: u64 = 1;

/// Fault of a part of the system.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
enum Fault {
    KillService,
    PauseService,
    StopService,
    /// No packet of the database arrives.
    CutOffDatabase,
    /// No packet of the workers arrives.
    CutOffWorkers,
    PauseDatabase,
    /// The store of objects refuses everything.
    RefuseObjects,
    StepClock,
    /// The primary is killed and the standby promoted.
    FailOver,
}

/// All of them but the last one, which happens once.
const FAULTS: [Fault; 8] = [
    Fault::KillService,
    Fault::PauseService,
    Fault::StopService,
    Fault::CutOffDatabase,
    Fault::CutOffWorkers,
    Fault::PauseDatabase,
    Fault::RefuseObjects,
    Fault::StepClock,
];

/// The services, what they depend on, and what leads to them.
struct System<'a> {
    folder: &'a Path,
    services: Vec<Server>,
    clocks: Vec<SteppedClock>,
    of_databases: Haproxy,
    of_services: Haproxy,
    primary: PostgresServer,
    standby: PostgresServer,
    has_failed_over: bool,
    objects: PathBuf,
    random: Rng,
}

impl<'a> System<'a> {
    fn start(folder: &'a Path, services: usize) -> Self {
        let primary = PostgresServer::start(&SETTINGS);
        let url = primary.new_database();
        let standby = primary.standby();
        let of_databases = Haproxy::of_databases(folder, &primary, &standby);
        let database = url.split_once("?host=").expect("a socket").0;
        let address = &of_databases.address;
        tests::use_database(folder, &format!("{database}?host={address}"));
        let objects = folder.join("objects");
        let clocks: Vec<_> = (0..services)
            .map(|number| {
                let folder = folder.join(format!("clock-{number}"));
                std::fs::create_dir(&folder).expect("a folder");
                SteppedClock::new(&folder)
            })
            .collect();
        let services: Vec<_> = clocks
            .iter()
            .map(|clock| service(folder, &objects, clock, None))
            .collect();
        let addresses: Vec<_> = services.iter().map(|server| &server.base[..]).collect();
        Self {
            folder,
            of_services: Haproxy::of_services(folder, &addresses),
            services,
            clocks,
            of_databases,
            primary,
            standby,
            has_failed_over: false,
            objects,
            random: Rng::with_seed(SEED),
        }
    }

    async fn harm(&mut self, fault: Fault) {
        let number = self.random.usize(..self.services.len());
        match fault {
            Fault::KillService => self.end_service(number, Signal::SIGKILL),
            Fault::StopService => self.end_service(number, Signal::SIGTERM),
            Fault::PauseService => {
                self.services[number].signal(Signal::SIGSTOP);
                tokio::time::sleep(AWAY).await;
                self.services[number].signal(Signal::SIGCONT);
            }
            Fault::CutOffDatabase => paused(&self.of_databases).await,
            Fault::CutOffWorkers => paused(&self.of_services).await,
            Fault::PauseDatabase => {
                let server = if self.has_failed_over {
                    &self.standby
                } else {
                    &self.primary
                };
                server.signal("STOP");
                tokio::time::sleep(AWAY).await;
                server.signal("CONT");
            }
            Fault::RefuseObjects => {
                let away = self.folder.join("objects-away");
                std::fs::rename(&self.objects, &away).expect("moved");
                std::fs::write(&self.objects, "").expect("a file in its place");
                let away_for = if is_long() { OBJECTS_AWAY } else { AWAY };
                tokio::time::sleep(away_for).await;
                std::fs::remove_file(&self.objects).expect("removed");
                std::fs::rename(&away, &self.objects).expect("moved back");
            }
            Fault::StepClock => {
                let step = if self.random.bool() { STEP_S } else { -STEP_S };
                self.clocks[number].set_to(step);
            }
            Fault::FailOver => {
                self.primary.kill();
                tokio::time::sleep(AWAY).await;
                self.standby.promote();
                self.has_failed_over = true;
            }
        }
    }

    /// Ends a service and starts another one at its address.
    fn end_service(&mut self, number: usize, signal: Signal) {
        let ended = self.services.remove(number);
        let address = ended.base.trim_start_matches("http://").to_owned();
        ended.signal(signal);
        ended.wait();
        let clock = &self.clocks[number];
        let started = service(self.folder, &self.objects, clock, Some(&address));
        self.services.insert(number, started);
    }
}

/// A service with a clock of its own, at an address or a free one.
fn service(folder: &Path, objects: &Path, clock: &SteppedClock, address: Option<&str>) -> Server {
    let objects = format!("file://{}", objects.display());
    let mut options = vec!["--workers", "0", "--objects", &objects];
    options.extend(
        address
            .into_iter()
            .flat_map(|address| ["--listen", address]),
    );
    Server::start_in(folder, &options, &clock.environment())
}

/// Pauses a proxy: its connections stay open, and nothing arrives.
async fn paused(proxy: &Haproxy) {
    proxy.signal(Signal::SIGSTOP);
    tokio::time::sleep(AWAY).await;
    proxy.signal(Signal::SIGCONT);
}

/// Submits so many jobs through the proxy, each until it is accepted, several at the same time.
async fn accepted(client: &Client, jobs: usize) -> Vec<String> {
    let submissions = stream::iter(0..jobs).map(async |_| {
        let key = Uuid::now_v7().to_string();
        let job = client.submit(SPEC.into(), &[], &key).await;
        job.expect("it is accepted in the end").id.to_string()
    });
    submissions.buffered(AT_ONCE).collect().await
}

#[tokio::test(flavor = "multi_thread")]
#[cfg_attr(
    not(all(has_postgresql, has_haproxy, has_cc)),
    ignore = "needs the programs of PostgreSQL, HAProxy and a C compiler"
)]
#[expect(clippy::print_stdout, reason = "the figures that the book quotes")]
async fn what_is_away_for_less_than_a_lease_costs_no_job_and_no_attempt() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let (jobs, workers, services) = load();
    let services = services.max(3);
    let harms = std::env::var("FRETWEAR_HARMS").ok();
    let harms = harms.map_or(FAULTS.len() + 1, |text| text.parse().expect("a number"));
    let mut system = System::start(folder.path(), services);
    let client = Client::new(&system.of_services.address, None, None).expect("a client");
    let (done, mut ids, began) = (Arc::new(Done::default()), Vec::new(), Instant::now());
    for number in 0..harms {
        let fault = if number == harms / 2 {
            Fault::FailOver
        } else {
            FAULTS[number % FAULTS.len()]
        };
        // Half of the jobs of a round are submitted before the harm, the others while it lasts.
        let some = jobs.div_ceil(2 * harms);
        ids.extend(accepted(&client, some).await);
        let address = system.of_services.address.clone();
        let solving = started(
            folder.path(),
            &[&address],
            (workers, Harm::LostAnswers),
            &done,
        );
        let ((), more) = tokio::join!(system.harm(fault), accepted(&client, some));
        ids.extend(more);
        solving.join_all().await;
        started(folder.path(), &[&address], (1, Harm::None), &done)
            .join_all()
            .await;
    }
    let elapsed = began.elapsed();
    assert_once(&system.services[0], &ids, &done).await;
    if is_long() {
        let jobs = ids.len();
        println!(
            "{jobs} jobs, {services} services, {workers} workers, {harms} harms in {elapsed:.0?}: all jobs solved once"
        );
    }
}
