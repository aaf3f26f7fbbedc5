//! Backups, opening and damage of a SQLite database.

mod backups;
mod damage;
mod opening;

use std::path::Path;

use sqlx::ConnectOptions;
use sqlx::sqlite::{SqliteConnectOptions, SqliteConnection};

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
