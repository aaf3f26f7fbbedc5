//! Places for the databases of tests.

use std::path::PathBuf;

use tempfile::TempDir;

use super::postgres::PostgresServer;

/// An empty database, and a folder.
pub(crate) struct Place {
    pub(crate) folder: TempDir,
    pub(crate) url: String,
}

impl Place {
    /// In a file in the folder.
    pub(crate) fn sqlite() -> Self {
        let folder = TempDir::new().expect("a temporary folder");
        let url = format!("sqlite://{}", folder.path().join("test.db").display());
        Self { folder, url }
    }

    /// In a server that the tests share.
    pub(crate) fn postgres() -> Self {
        Self {
            folder: TempDir::new().expect("a temporary folder"),
            url: PostgresServer::shared().new_database(),
        }
    }

    /// Where large results are.
    pub(crate) fn files(&self) -> PathBuf {
        self.folder.path().join("test.db")
    }
}
