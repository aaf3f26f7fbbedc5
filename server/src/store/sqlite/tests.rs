//! Backups, opening and damage of a SQLite database.

mod backups;
mod damage;
mod opening;

use std::path::Path;

use sqlx::ConnectOptions;
use sqlx::sqlite::{SqliteConnectOptions, SqliteConnection};

use crate::store::Store;
use crate::store::operations::Engine;
use crate::store::sqlite::SqliteStore;

impl Store {
    /// The store as it is in a file.
    pub(in crate::store) fn sqlite(&self) -> &SqliteStore {
        let Engine::Sqlite(store) = &self.0 else {
            panic!("another engine");
        };
        store
    }
}

/// Keeps a database at its present size, which SQLite reports like a full disk.
pub(crate) async fn fill_disk(store: &Store) {
    // A limit below the present size is raised to it (sqlite.org/pragma.html#pragma_max_page_count). It belongs to the
    // connection, which the pool replaces after each failure.
    let store = store.sqlite();
    let options = store.writer.connect_options().as_ref().clone();
    let limited = options.pragma("max_page_count", "1");
    store.writer.set_connect_options(limited);
    sqlx::query("PRAGMA max_page_count = 1")
        .execute(&store.writer)
        .await
        .expect("a limit");
}

/// Holds the write lock of a database, as another process that writes, as long as the connection lives.
pub(crate) async fn hold_write_lock(database: &Path) -> SqliteConnection {
    let options = SqliteConnectOptions::new().filename(database);
    let mut other = options.connect().await.expect("another process");
    sqlx::query("BEGIN IMMEDIATE")
        .execute(&mut other)
        .await
        .expect("the lock");
    other
}
