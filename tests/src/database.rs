//! Reads and damages a service's database from outside.

use std::path::Path;
use std::time::Duration;

use sqlx::postgres::PgConnection;
use sqlx::sqlite::{SqliteConnectOptions, SqliteConnection};
use sqlx::{Connection, Executor};

use crate::served_database::address_of_database;

/// Opens the file of the database of the service in a folder.
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

/// Opens the database of the services of a folder, if it is one of a server.
async fn open_served(folder: &Path) -> Option<PgConnection> {
    let url = address_of_database(folder);
    if url.starts_with("sqlite:") {
        return None;
    }
    let database = PgConnection::connect(&url).await;
    Some(database.expect("the database can be opened"))
}

/// Executes the statement of a file or that of a server; returns the number of rows that it has changed.
async fn execute(folder: &Path, of_file: &'static str, of_server: &'static str) -> u64 {
    let rows = if let Some(mut database) = open_served(folder).await {
        let done = database.execute(of_server).await;
        done.map(|done| done.rows_affected())
    } else {
        let mut database = open(folder).await;
        let done = database.execute(of_file).await;
        database.close().await.expect("the database can be closed");
        done.map(|done| done.rows_affected())
    };
    rows.expect("the database can be written")
}

/// Corrupts all checkpoints; returns their number.
///
/// # Panics
/// If the database cannot be written.
pub async fn damage_checkpoints(folder: &Path) -> u64 {
    execute(
        folder,
        "UPDATE checkpoints SET state = CAST(substr(state, 2) AS BLOB)",
        "UPDATE checkpoints SET state = substr(state, 2)",
    )
    .await
}

/// Lets the time pass after which objects that no update has named are removed; returns their number.
///
/// # Panics
/// If the database cannot be written.
pub async fn age_unnamed_objects(folder: &Path) -> u64 {
    let statement = "UPDATE unnamed_objects SET noted_at = 0";
    execute(folder, statement, statement).await
}

/// Overwrites the small results of all jobs that have ended; returns their number.
///
/// # Panics
/// If the database cannot be written.
pub async fn damage_results(folder: &Path) -> u64 {
    execute(
        folder,
        "UPDATE result_blocks SET content = zeroblob(length(content))",
        "UPDATE result_blocks SET content = decode(repeat('00', length(content)), 'hex')",
    )
    .await
}

/// Holds up all writes for a while.
///
/// # Panics
/// If the database cannot be written.
pub async fn stall(folder: &Path, time: Duration) {
    if let Some(mut database) = open_served(folder).await {
        for statement in ["BEGIN", "LOCK TABLE jobs IN EXCLUSIVE MODE"] {
            let done = database.execute(statement).await;
            done.expect("the table can be locked");
        }
        // The end of the connection ends the transaction.
        tokio::time::sleep(time).await;
        return database.close().await.expect("the database can be closed");
    }
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

/// Returns the texts that a query to a database of a server yields.
///
/// # Panics
/// If they cannot be read.
pub async fn texts(folder: &Path, query: &'static str) -> Vec<String> {
    let mut database = open_served(folder).await.expect("a server");
    let found = sqlx::query_scalar(query).fetch_all(&mut database).await;
    found.expect("the database can be read")
}

/// Returns the number that a query yields.
///
/// # Panics
/// If it cannot be read.
pub async fn number(folder: &Path, query: &'static str) -> i64 {
    if let Some(mut database) = open_served(folder).await {
        let found = sqlx::query_scalar(query).fetch_one(&mut database).await;
        return found.expect("the database can be read");
    }
    let mut database = open(folder).await;
    let found = sqlx::query_scalar(query).fetch_one(&mut database).await;
    database.close().await.expect("the database can be closed");
    found.expect("the database can be read")
}
