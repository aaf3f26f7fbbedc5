//! A standby of a PostgreSQL server, and what happens to the two.

use std::path::PathBuf;
use std::process::Command;

use crate::postgres::{PostgresServer, SETTINGS, new_folder, program};

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
        let standby = Self::of(folder, &SETTINGS);
        self.execute("ALTER SYSTEM SET synchronous_standby_names = 'b'");
        self.execute("SELECT pg_reload_conf()");
        standby
    }

    /// Lets a standby become the primary.
    ///
    /// # Panics
    /// If it cannot.
    pub fn promote(&self) {
        self.execute("SELECT pg_promote()");
    }

    /// Kills it, without a chance to write anything.
    ///
    /// # Panics
    /// If it does not run.
    pub fn kill(&self) {
        let file = self.folder.join("data/postmaster.pid");
        let text = std::fs::read_to_string(file).expect("it runs");
        let id = text.lines().next().expect("its process");
        let killed = Command::new("kill").args(["-KILL", id]).status();
        assert!(killed.expect("kill").success(), "no process {id}");
    }

    /// Its socket.
    pub fn socket(&self) -> PathBuf {
        self.folder.join(".s.PGSQL.5432")
    }

    fn execute(&self, statement: &str) {
        let done = program("psql")
            .args([
                "-q",
                "-o",
                "/dev/null",
                "-h",
                self.folder(),
                "-U",
                "fretwear",
            ])
            .args(["-d", "postgres", "-c", statement])
            .status();
        assert!(done.expect("psql").success(), "{statement}");
    }
}
