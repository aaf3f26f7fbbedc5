//! HAProxy in front of servers, killed when it goes out of scope.

use std::net::TcpListener;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Stdio};
use std::time::Duration;

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;

use crate::postgres::PostgresServer;

/// How often another port is tried, if another process has taken the one that was free.
const TRIES: usize = 10;
/// Time in which it reports a fault of its configuration, or that its address is taken.
const START: Duration = Duration::from_millis(300);
/// A check may take as long as a busy machine needs; a server that was killed refuses it at once.
const DEFAULTS: &str = "defaults
  timeout connect 1s
  timeout check 5s
  timeout client 1h
  timeout server 1h
  default-server inter 200ms fall 2 rise 1 on-marked-down shutdown-sessions
";

/// A proxy.
#[derive(Debug)]
pub struct Haproxy {
    child: Child,
    /// Where it listens: the folder of a socket, or `http://127.0.0.1:PORT`.
    pub address: String,
}

impl Haproxy {
    /// One that leads to the first of two PostgreSQL servers, and to the second one while the first does not answer.
    ///
    /// # Panics
    /// If it does not start.
    pub fn of_databases(folder: &Path, first: &PostgresServer, second: &PostgresServer) -> Self {
        let folder = folder.join("haproxy");
        std::fs::create_dir(&folder).expect("a folder");
        let (socket, place) = (folder.join(".s.PGSQL.5432"), folder.display().to_string());
        let (first, second) = (first.socket(), second.socket());
        let configuration = format!(
            "{DEFAULTS}listen databases
  mode tcp
  bind unix@{} mode 666
  option pgsql-check user fretwear
  server a unix@{} check
  server b unix@{} check backup
",
            socket.display(),
            first.display(),
            second.display()
        );
        Self::start(&folder, &configuration, place).expect("it starts")
    }

    /// One that distributes requests among services.
    ///
    /// # Panics
    /// If it does not start.
    pub fn of_services(folder: &Path, services: &[&str]) -> Self {
        let folder = folder.join("haproxy-of-services");
        std::fs::create_dir(&folder).expect("a folder");
        let servers = services.iter().enumerate().map(|(number, address)| {
            let address = address.trim_start_matches("http://");
            format!("  server s{number} {address} check\n")
        });
        let servers: String = servers.collect();
        let started = (0..TRIES).find_map(|_| {
            let free = TcpListener::bind("127.0.0.1:0").expect("a port");
            let address = free.local_addr().expect("an address");
            drop(free);
            let configuration = format!(
                "{DEFAULTS}listen services\n  mode http\n  bind {address}\n  option httpchk GET /healthz\n{servers}"
            );
            Self::start(&folder, &configuration, format!("http://{address}"))
        });
        started.expect("it starts")
    }

    /// Sends it a signal.
    ///
    /// # Panics
    /// If it has ended.
    pub fn signal(&self, signal: Signal) {
        let id = i32::try_from(self.child.id()).expect("process ids are small");
        kill(Pid::from_raw(id), signal).expect("it runs");
    }

    fn start(folder: &Path, configuration: &str, address: String) -> Option<Self> {
        let file: PathBuf = folder.join("haproxy.cfg");
        std::fs::write(&file, configuration).expect("written");
        let mut child = Command::new("haproxy")
            .arg("-f")
            .arg(&file)
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn()
            .expect("haproxy can be started");
        std::thread::sleep(START);
        let ended = child.try_wait().expect("it can be asked for").is_some();
        (!ended).then_some(Self { child, address })
    }
}

impl Drop for Haproxy {
    fn drop(&mut self) {
        // The process may have ended.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
