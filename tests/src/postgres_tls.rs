//! A PostgreSQL server whose connections are encrypted.

use std::os::unix::fs::{MetadataExt, PermissionsExt, chown};

use crate::certificates::Certificates;
use crate::postgres::{PostgresServer, program};

impl PostgresServer {
    /// Lets the server encrypt its connections over TCP.
    ///
    /// # Panics
    /// If it cannot.
    pub fn encrypt(&self, certificates: &Certificates) {
        let data = self.folder.join("data");
        let owner = std::fs::metadata(&data).expect("its files");
        for (file, name) in [
            (&certificates.certificate, "server.crt"),
            (&certificates.key, "server.key"),
        ] {
            let path = data.join(name);
            std::fs::copy(file, &path).expect("copied");
            std::fs::set_permissions(&path, std::fs::Permissions::from_mode(0o600))
                .expect("private");
            chown(&path, Some(owner.uid()), Some(owner.gid())).expect("a file of the server");
        }
        self.answer("ALTER SYSTEM SET ssl = on");
        self.answer("SELECT pg_reload_conf()");
    }

    /// The answer to a statement, as text.
    ///
    /// # Panics
    /// If it fails.
    pub fn answer(&self, statement: &str) -> String {
        let ran = program("psql")
            .args([
                "-h",
                self.folder(),
                "-U",
                "fretwear",
                "-d",
                "postgres",
                "-Atc",
                statement,
            ])
            .output();
        let ran = ran.expect("psql");
        assert!(ran.status.success(), "{statement}");
        String::from_utf8(ran.stdout)
            .expect("text")
            .trim()
            .to_owned()
    }
}
