//! Identification of a file before it is opened for writing: a database of this program, of an earlier or a later version
//! of it, or of another program.

use std::os::unix::fs::MetadataExt;
use std::path::Path;

use sqlx::sqlite::{SqliteConnectOptions, SqliteConnection};
use sqlx::{ConnectOptions, Connection};

use crate::store::StoreError;
use crate::store::database_errors::is_no_database;
use crate::store::migrations::newest_version;
use crate::store::sqlite::migrations::FILES;

/// `PRAGMA application_id` of the databases of this program: `frtw` in ASCII.
const APPLICATION_ID: i32 = 0x6672_7477;

/// Returns the version of the schema of a database of this program; `None` for a file that is empty or does not exist.
/// Writes nothing.
///
/// # Errors
/// [`StoreError::Foreign`] for a file of another program, [`StoreError::Newer`] for one of a later version,
/// [`StoreError::Linked`] for one with several names.
pub(super) async fn schema_version(path: &Path) -> Result<Option<i64>, StoreError> {
    let names = match std::fs::metadata(path) {
        Ok(file) if file.len() > 0 => file.nlink(),
        _ => return Ok(None),
    };
    // The write-ahead log belongs to a name: one process under each would destroy the database (sqlite.org/howtocorrupt.html,
    // 2.5).
    if names > 1 {
        return Err(StoreError::Linked {
            path: path.to_owned(),
            names,
        });
    }
    let foreign = |found| StoreError::Foreign {
        path: path.to_owned(),
        found,
    };
    let options = SqliteConnectOptions::new().filename(path).read_only(true);
    let version = match read_version(options).await {
        Ok(Schema::Version(version)) => version,
        Ok(Schema::Empty) => return Ok(None),
        Ok(Schema::Foreign(found)) => return Err(foreign(found)),
        Err(error) if is_no_database(&error) => {
            return Err(foreign("it is no SQLite database".to_owned()));
        }
        Err(error) => return Err(error.into()),
    };
    let known = newest_version(&FILES);
    if version > known {
        return Err(StoreError::Newer {
            path: path.to_owned(),
            found: version,
            known,
        });
    }
    Ok(Some(version))
}

enum Schema {
    Empty,
    Version(i64),
    /// A file of another program, with the evidence.
    Foreign(String),
}

async fn read_version(options: SqliteConnectOptions) -> Result<Schema, sqlx::Error> {
    let mut database = options.connect().await?;
    let schema = read_schema(&mut database).await?;
    database.close().await?;
    Ok(schema)
}

async fn read_schema(database: &mut SqliteConnection) -> Result<Schema, sqlx::Error> {
    let id: i32 = sqlx::query_scalar("PRAGMA application_id")
        .fetch_one(&mut *database)
        .await?;
    let tables: Vec<String> =
        sqlx::query_scalar("SELECT name FROM sqlite_master WHERE type = 'table' ORDER BY name")
            .fetch_all(&mut *database)
            .await?;
    let has = |name: &str| tables.iter().any(|table| table == name);
    match id {
        0 if tables.is_empty() => return Ok(Schema::Empty),
        // Earlier versions set no id.
        0 if has("_sqlx_migrations") && has("jobs") && has("request_keys") => {}
        APPLICATION_ID if tables.is_empty() => return Ok(Schema::Empty),
        APPLICATION_ID if has("_sqlx_migrations") => {}
        0 => {
            return Ok(Schema::Foreign(format!(
                "it has the tables {}",
                tables.join(", ")
            )));
        }
        id => return Ok(Schema::Foreign(format!("its application id is {id}"))),
    }
    // Null before the first migration.
    let version: Option<i64> = sqlx::query_scalar("SELECT max(version) FROM _sqlx_migrations")
        .fetch_one(database)
        .await?;
    Ok(version.map_or(Schema::Empty, Schema::Version))
}

/// Marks a database as one of this program.
pub(super) async fn mark(writer: &sqlx::SqlitePool) -> Result<(), StoreError> {
    let id: i32 = sqlx::query_scalar("PRAGMA application_id")
        .fetch_one(writer)
        .await?;
    if id != APPLICATION_ID {
        // A pragma takes no parameters.
        let pragma = format!("PRAGMA application_id = {APPLICATION_ID}");
        sqlx::query(sqlx::AssertSqlSafe(pragma))
            .execute(writer)
            .await?;
    }
    Ok(())
}
