//! A standby of a PostgreSQL server, and what happens to the two.

use std::path::PathBuf;
use std::process::Command;

use crate::postgres::{PostgresServer, SETTINGS, new_folder, program, wait_until};

impl PostgresServer {
    /// Starts a standby of this server, which from now on confirms every commit.
    ///
    /// # Panics
    /// If it does not start.
    #[must_use]
    pub fn standby(&self) -> Self {
        let folder = new_folder();
        let data = folder.join("data");
        let source = format!("host={} user=fretwear application_name=b", self.folder());
        let copied = program("pg_basebackup")
            .args(["-d", &source, "-D", data.to_str().expect("text")])
            .args(["-R", "-C", "-S", "b", "-c", "fast"])
            .status();
        assert!(copied.expect("pg_basebackup").success(), "no standby");
        // A connection that fails is tried again at once, not after 5 s: commits wait for it.
        let settings = [&SETTINGS[..], &["wal_retrieve_retry_interval=100ms"]].concat();
        let standby = Self::of(folder, &settings);
        self.wait_for_standby();
        self.answer("ALTER SYSTEM SET synchronous_standby_names = 'b'");
        self.answer("SELECT pg_reload_conf()");
        standby
    }

    /// Waits until a standby receives what is written: before, commits would wait for it, and requests with them.
    fn wait_for_standby(&self) {
        let query = "SELECT count(*) FROM pg_stat_replication WHERE application_name = 'b' AND state = 'streaming'";
        wait_until("the standby streams", || self.answer(query) == "1");
    }

    /// Lets a standby become the primary.
    ///
    /// # Panics
    /// If it cannot.
    pub fn promote(&self) {
        self.answer("SELECT pg_promote()");
    }

    /// Kills it, without a chance to write anything.
    ///
    /// # Panics
    /// If it does not run.
    pub fn kill(&self) {
        self.signal_first("KILL");
    }

    /// Sends a signal to its processes: those of its connections, too.
    ///
    /// # Panics
    /// If it does not run.
    pub fn signal(&self, signal: &str) {
        self.signal_first(signal);
        let parent = self.first_process();
        // Some may end meanwhile.
        let _ = Command::new("pkill")
            .args([&format!("-{signal}"), "-P", &parent])
            .status();
    }

    fn signal_first(&self, signal: &str) {
        let process = self.first_process();
        let sent = Command::new("kill")
            .args([&format!("-{signal}"), &process])
            .status();
        assert!(sent.expect("kill").success(), "no process {process}");
    }

    fn first_process(&self) -> String {
        let file = self.folder.join("data/postmaster.pid");
        let text = std::fs::read_to_string(file).expect("it runs");
        text.lines().next().expect("its process").to_owned()
    }

    /// Socket.
    pub fn socket(&self) -> PathBuf {
        self.folder.join(".s.PGSQL.5432")
    }
}
