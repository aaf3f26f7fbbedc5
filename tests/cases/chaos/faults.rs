//! Faults, each at a random moment.

use std::net::TcpStream;
use std::path::{Path, PathBuf};
use std::time::Duration;

use nix::sys::resource::{Resource, getrlimit, setrlimit};
use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;
use serde_json::json;
use tests::{Log, Server, database};

use super::trial::{Engine, Trial};

/// Longer than a lease of the service.
const PAST_A_LEASE: Duration = Duration::from_millis(1_500);
/// Most connections of a flood: more than the service accepts of one address.
const FLOOD: u64 = 3_500;
/// Steps of the clock, s: further than the deadlines of the jobs.
const LONGEST_STEP_S: i64 = 200_000;

/// A fault that is injected.
#[derive(Debug, Clone, Copy, PartialEq, Eq, PartialOrd, Ord)]
pub(super) enum Fault {
    KillChild,
    PauseChild,
    TerminateChild,
    KillServer,
    KillServerAndDamageCheckpoints,
    StopServer,
    PauseServer,
    /// The service is killed several times just after it has started.
    CrashLoop,
    StallStore,
    FillDisk,
    /// The service is killed while the disk is full, and started on it.
    StartOnFullDisk,
    /// A file of a result is overwritten, shortened or removed, and restored.
    DamageResult,
    StepClock,
    /// A task of the service panics, wherever it next reads the time.
    FailTask,
    IdleFlood,
    /// The folder of objects is not mounted for a while.
    ObjectsAway,
}

const FAULTS: [Fault; 16] = [
    Fault::KillChild,
    Fault::PauseChild,
    Fault::TerminateChild,
    Fault::KillServer,
    Fault::KillServerAndDamageCheckpoints,
    Fault::StopServer,
    Fault::PauseServer,
    Fault::CrashLoop,
    Fault::StallStore,
    Fault::FillDisk,
    Fault::StartOnFullDisk,
    Fault::DamageResult,
    Fault::StepClock,
    Fault::FailTask,
    Fault::IdleFlood,
    Fault::ObjectsAway,
];

impl Trial {
    fn can_inject(&self, fault: Fault) -> bool {
        match fault {
            Fault::FillDisk | Fault::StartOnFullDisk => self.disk.is_mounted(),
            Fault::ObjectsAway => self.engine == Engine::Services,
            _ => true,
        }
    }

    pub(super) fn had_every_fault(&self) -> bool {
        let mut faults = FAULTS.into_iter();
        faults.all(|fault| self.faults.contains_key(&fault) || !self.can_inject(fault))
    }

    /// Injects the next fault, and prints it: all of them in a random order, again and again.
    #[expect(clippy::print_stdout, reason = "what came before a failure")]
    pub(super) async fn inject_fault(&mut self) {
        if self.next.is_empty() {
            let possible = FAULTS.into_iter().filter(|fault| self.can_inject(*fault));
            self.next = possible.collect();
            self.rng.shuffle(&mut self.next);
        }
        let Some(fault) = self.next.pop() else {
            return;
        };
        self.hit_any();
        let moment = Duration::from_millis(self.rng.u64(..1_500));
        println!("{:8.1} s {fault:?}", self.began.elapsed().as_secs_f64());
        match fault {
            Fault::KillChild => drop(self.signal_child(Signal::SIGKILL)),
            Fault::TerminateChild => drop(self.signal_child(Signal::SIGTERM)),
            Fault::PauseChild => self.pause_child().await,
            Fault::KillServer => self.restart(Signal::SIGKILL).await,
            Fault::KillServerAndDamageCheckpoints => {
                self.end(Signal::SIGKILL).await;
                database::damage_checkpoints(&self.folder).await;
                self.start();
            }
            Fault::StopServer => self.restart(Signal::SIGTERM).await,
            Fault::PauseServer => {
                self.server().signal(Signal::SIGSTOP);
                tokio::time::sleep(PAST_A_LEASE + moment).await;
                self.server().signal(Signal::SIGCONT);
            }
            Fault::CrashLoop => self.crash_loop().await,
            Fault::StallStore => database::stall(&self.folder, moment * 3).await,
            Fault::FillDisk => self.disk.fill_for(moment).await,
            Fault::StartOnFullDisk => self.start_on_full_disk(moment).await,
            Fault::DamageResult => {
                let is_done = match self.engine {
                    Engine::Services => self.lose_object().await,
                    Engine::File | Engine::Server => self.damage_result().await,
                };
                if !is_done {
                    self.next.insert(0, fault);
                    return;
                }
            }
            Fault::StepClock => {
                let step = self.rng.i64(-LONGEST_STEP_S..LONGEST_STEP_S);
                self.clock.set_to(step);
            }
            Fault::FailTask => self.clock.fail_once(),
            Fault::IdleFlood => self.flood().await,
            Fault::ObjectsAway => self.objects_away_for(moment).await,
        }
        *self.faults.entry(fault).or_default() += 1;
        tokio::time::sleep(moment).await;
    }

    /// Signals one solving process, if there is any.
    fn signal_child(&mut self, signal: Signal) -> Option<Pid> {
        let children = self.server().solving();
        let child = self.rng.choice(children)?;
        // The process may have ended by itself.
        let _ = kill(child, signal);
        Some(child)
    }

    async fn pause_child(&mut self) {
        let paused = self.signal_child(Signal::SIGSTOP);
        tokio::time::sleep(PAST_A_LEASE).await;
        if let Some(child) = paused {
            // The process may have ended meanwhile.
            let _ = kill(child, Signal::SIGCONT);
        }
    }

    async fn end(&mut self, signal: Signal) {
        let server = self.take().await;
        server.signal(signal);
        server.wait();
    }

    async fn restart(&mut self, signal: Signal) {
        self.end(signal).await;
        self.start();
    }

    async fn crash_loop(&mut self) {
        for _ in 0..self.rng.u32(2..6) {
            self.restart(Signal::SIGKILL).await;
            tokio::time::sleep(Duration::from_millis(self.rng.u64(..300))).await;
        }
    }

    /// A service that cannot start on a full disk is started again when there is space.
    async fn start_on_full_disk(&mut self, moment: Duration) {
        self.disk.fill();
        self.end(Signal::SIGKILL).await;
        let serves = self.start_logging(&Log::Read);
        tokio::time::sleep(moment).await;
        self.disk.free();
        if !serves {
            self.start();
        }
    }

    /// Damages a file of a job that has ended; it must not be sent until it is restored. Whether there is any.
    async fn damage_result(&mut self) -> bool {
        let (_, list) = self
            .server()
            .get_in_the_end("/v1/jobs?status=succeeded&limit=100")
            .await;
        let ids = list["jobs"].as_array().into_iter().flatten();
        let ids = ids.filter_map(|job| job["id"].as_str());
        let files = ids.flat_map(|id| files_of(&self.results, id));
        let files: Vec<(String, PathBuf)> = files.collect();
        let Some((id, path)) = self.rng.choice(files) else {
            return false;
        };
        let bytes = std::fs::read(&path).expect("the file can be read");
        match self.rng.u32(..3) {
            0 => {
                let mut damaged = bytes.clone();
                damaged[bytes.len() / 2] ^= 1;
                std::fs::write(&path, damaged).expect("damage");
            }
            1 => std::fs::write(&path, &bytes[..bytes.len() / 2]).expect("damage"),
            _ => std::fs::remove_file(&path).expect("damage"),
        }
        let name = path
            .file_name()
            .and_then(|name| name.to_str())
            .expect("a name");
        let url = format!("/v1/jobs/{id}/results/files/{name}");
        let (status, problem) = self.server().get_in_the_end(&url).await;
        let kind = &problem["type"];
        assert_eq!(
            (status, kind),
            (500, &json!("/problems/result-damaged")),
            "{name}"
        );
        std::fs::write(&path, &bytes).expect("the file can be restored");
        let sent = self.server().bytes_in_the_end(&url).await;
        assert!(sent == bytes, "{name} was restored");
        true
    }

    /// Removes the object of a job; its results must not be sent until it is restored. Whether there is any.
    async fn lose_object(&mut self) -> bool {
        let objects = files_below(&self.results.join("jobs"));
        let Some(path) = self.rng.choice(objects) else {
            return false;
        };
        let bytes = std::fs::read(&path).expect("the object can be read");
        let id = path.parent().and_then(|folder| folder.file_name());
        let id = id.and_then(|id| id.to_str()).expect("the id of a job");
        let results = format!("/v1/jobs/{id}/results");
        let (_, manifest) = self.server().get_in_the_end(&results).await;
        let name = manifest["files"][0]["name"].as_str().expect("a file");
        let url = format!("{results}/files/{name}");
        std::fs::remove_file(&path).expect("removed");
        let (status, problem) = self.server().get_in_the_end(&url).await;
        std::fs::write(&path, &bytes).expect("the object can be restored");
        let kind = &problem["type"];
        assert_eq!(
            (status, kind),
            (500, &json!("/problems/result-damaged")),
            "{name}"
        );
        self.server().bytes_in_the_end(&url).await;
        true
    }

    async fn objects_away_for(&self, moment: Duration) {
        let away = self.folder.join("away");
        std::fs::rename(&self.results, &away).expect("renamed");
        tokio::time::sleep(moment).await;
        // A write in progress has created a folder in its place, and has failed.
        let _ = std::fs::remove_dir_all(&self.results);
        std::fs::rename(&away, &self.results).expect("renamed");
    }

    /// Opens more connections than the service accepts, sends nothing, and asks for its health.
    async fn flood(&self) {
        let (_, most) = getrlimit(Resource::RLIMIT_NOFILE).expect("a limit");
        setrlimit(Resource::RLIMIT_NOFILE, most, most).expect("a higher limit");
        let idle = (0..FLOOD.min(most / 2)).map(|_| connection(self.server()));
        let idle: Vec<TcpStream> = idle.collect();
        let (status, _) = self.server().get_in_the_end("/v1/systems").await;
        assert_eq!(status, 200);
        drop(idle);
    }
}

fn connection(server: &Server) -> TcpStream {
    let address = server.base.trim_start_matches("http://");
    TcpStream::connect(address).expect("a connection")
}

/// The files of a job's results: in one folder for each lease, of which the last one remains.
fn files_of(results: &Path, id: &str) -> Vec<(String, PathBuf)> {
    let leases = entries(&results.join(id));
    let files = leases.iter().flat_map(|lease| entries(lease));
    files.map(|path| (id.to_owned(), path)).collect()
}

/// All files below a folder.
pub(super) fn files_below(folder: &Path) -> Vec<PathBuf> {
    let below = entries(folder).into_iter().flat_map(|path| {
        if path.is_dir() {
            files_below(&path)
        } else {
            vec![path]
        }
    });
    below.collect()
}

fn entries(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).into_iter().flatten().flatten();
    entries.map(|entry| entry.path()).collect()
}
