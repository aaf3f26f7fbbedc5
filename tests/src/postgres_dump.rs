//! A copy of a database of a server, as of the time at which it was made.

use std::path::{Path, PathBuf};

use crate::postgres::{PostgresServer, program};

impl PostgresServer {
    /// Writes a dump of a database, which may be in use; returns its file.
    ///
    /// # Panics
    /// If it cannot be written.
    pub fn dump(&self, url: &str) -> PathBuf {
        let name = url.rsplit('/').find_map(|part| part.split('?').next());
        let file = self.folder.join(format!("{}.dump", name.expect("a name")));
        let dumped = program("pg_dump")
            .args(["--format=custom", "--file"])
            .arg(&file)
            .arg(url)
            .status();
        assert!(dumped.expect("pg_dump").success(), "no dump");
        file
    }

    /// Restores a dump as a new database; returns its address.
    ///
    /// # Panics
    /// If it cannot be restored.
    pub fn restored(&self, dump: &Path) -> String {
        let url = self.new_database();
        let restored = program("pg_restore")
            .args(["--dbname", &url])
            .arg(dump)
            .status();
        assert!(restored.expect("pg_restore").success(), "not restored");
        url
    }
}
