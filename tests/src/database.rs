//! Reads and damages a service's database from outside.

use std::path::Path;
use std::time::Duration;

use sqlx::sqlite::{SqliteConnectOptions, SqliteConnection};
use sqlx::{Connection, Executor};

/// Opens the database of the service in a folder.
///
/// # Panics
/// If it cannot be opened.
pub async fn open(folder: &Path) -> SqliteConnection {
    let options = SqliteConnectOptions::new()
        .filename(folder.join("fretwear.db"))
        .busy_timeout(Duration::from_secs(20));
    SqliteConnection::connect_with(&options)
        .await
        .expect("the database can be opened")
}

/// Corrupts all checkpoints; returns their number.
///
/// # Panics
/// If the database cannot be written.
pub async fn damage_checkpoints(folder: &Path) -> u64 {
    let mut database = open(folder).await;
    let done = database
        .execute("UPDATE checkpoints SET state = CAST(substr(state, 2) AS BLOB)")
        .await
        .expect("the database can be written");
    database.close().await.expect("the database can be closed");
    done.rows_affected()
}

/// Overwrites the small results of all jobs that have ended; returns their number.
///
/// # Panics
/// If the database cannot be written.
pub async fn damage_results(folder: &Path) -> u64 {
    let mut database = open(folder).await;
    let done = database
        .execute("UPDATE result_blocks SET content = zeroblob(length(content))")
        .await
        .expect("the database can be written");
    database.close().await.expect("the database can be closed");
    done.rows_affected()
}

/// Holds the write lock for a while.
///
/// # Panics
/// If the database cannot be written.
pub async fn stall(folder: &Path, time: Duration) {
    let mut database = open(folder).await;
    database
        .execute("BEGIN IMMEDIATE")
        .await
        .expect("the database can be locked");
    tokio::time::sleep(time).await;
    database
        .execute("ROLLBACK")
        .await
        .expect("the database can be unlocked");
    database.close().await.expect("the database can be closed");
}

/// Returns the number that a query yields.
///
/// # Panics
/// If it cannot be read.
pub async fn number(folder: &Path, query: &'static str) -> i64 {
    let mut database = open(folder).await;
    let found = sqlx::query_scalar(query).fetch_one(&mut database).await;
    database.close().await.expect("the database can be closed");
    found.expect("the database can be read")
}
