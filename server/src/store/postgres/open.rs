//! Opening the store: address, connections, migrations.

use std::path::Path;
use std::str::FromStr;
use std::time::Duration;

use sqlx::postgres::{PgConnectOptions, PgConnection, PgPool, PgPoolOptions, PgSslMode};
use tokio::sync::mpsc;
use tokio_util::task::AbortOnDropHandle;
use uuid::Uuid;

use crate::clock::Clock;
use crate::export::files::parent;
use crate::store::groups::Groups;
use crate::store::local::Local;
use crate::store::postgres::PostgresStore;
use crate::store::postgres::migrations::migrator;
use crate::store::postgres::notifications::{hear, tell};
use crate::store::{Limits, StoreError};

/// Number of connections beside the one that hears changes.
const CONNECTIONS: u32 = 8;
/// Longest wait for a connection; shorter than a lease, because workers wait too.
const CONNECTION_TIMEOUT: Duration = Duration::from_secs(5);
/// Settings of a connection. A plan that was made while a table was empty must not be used when it is full; a statement, a lock or a
/// process that stalls must not hold up the others.
const SETTINGS: [(&str, &str); 4] = [
    ("plan_cache_mode", "force_custom_plan"),
    ("statement_timeout", "30s"),
    ("lock_timeout", "10s"),
    ("idle_in_transaction_session_timeout", "30s"),
];
/// The first version that has all that the statements use: SQL functions with `RETURN`.
const OLDEST_SERVER: i64 = 14;

impl PostgresStore {
    /// Opens the database at `url` (`postgres://USER@HOST/NAME`) and migrates its schema. `files` is where the large results are:
    /// in the folder `files`.results, which all processes share that serve the database.
    pub(in crate::store) async fn open(
        url: &str,
        files: &Path,
        limits: Limits,
        clock: Clock,
    ) -> Result<Self, StoreError> {
        let options = options(url)?;
        let folder = parent(files);
        if !folder.is_dir() {
            return Err(StoreError::NoFolder {
                path: folder.to_owned(),
            });
        }
        let pool = PgPoolOptions::new()
            .max_connections(CONNECTIONS + 1)
            .acquire_timeout(CONNECTION_TIMEOUT)
            .after_connect(|connection, _| Box::pin(refuse_standby(connection)))
            .connect_with(options)
            .await?;
        check_version(&pool).await?;
        migrate(&pool).await?;
        let clock = match clock {
            Clock::Manual(_) => clock,
            Clock::System | Clock::Database => Clock::Database,
        };
        let mut local = Local::prepare(files, limits, clock);
        let (others, told) = mpsc::unbounded_channel();
        local.others = Some(others);
        let process = Uuid::now_v7();
        let (changes, waiting) = (local.changes.clone(), local.waiting.clone());
        let tasks = [
            tokio::spawn(tell(pool.clone(), process, told)),
            tokio::spawn(hear(pool.clone(), process, changes, waiting)),
        ];
        Ok(Self {
            local,
            pool,
            claims: Groups::default(),
            mover: tokio::sync::Mutex::default(),
            last_probe: tokio::sync::Mutex::default(),
            tasks: tasks.map(AbortOnDropHandle::new),
        })
    }

    /// Closes all connections.
    pub(in crate::store) async fn close(&self) {
        for task in &self.tasks {
            task.abort();
        }
        *self.mover.lock().await = None;
        self.pool.close().await;
    }
}

/// Returns the options to connect to the server at `url`. Beyond this machine, connections are encrypted and the server's name is
/// verified.
fn options(url: &str) -> Result<PgConnectOptions, StoreError> {
    let options = PgConnectOptions::from_str(url).map_err(|cause| StoreError::Server {
        cause: cause.to_string(),
    })?;
    let host = options.get_host();
    let is_here = options.get_socket().is_some()
        || host.starts_with('/')
        || host == "localhost"
        || host
            .parse::<std::net::IpAddr>()
            .is_ok_and(|host| host.is_loopback());
    let is_verified = matches!(options.get_ssl_mode(), PgSslMode::VerifyFull);
    if !is_here && !is_verified {
        return Err(StoreError::Unverified {
            host: host.to_owned(),
        });
    }
    Ok(options.application_name("fretwear").options(SETTINGS))
}

/// Refuses a connection to a standby, where a proxy leads while the primary does not answer: it would stay there.
async fn refuse_standby(connection: &mut PgConnection) -> Result<(), sqlx::Error> {
    let is_standby: bool = sqlx::query_scalar("SELECT pg_is_in_recovery()")
        .fetch_one(connection)
        .await?;
    if is_standby {
        return Err(sqlx::Error::Configuration("the server is a standby".into()));
    }
    Ok(())
}

async fn check_version(pool: &PgPool) -> Result<(), StoreError> {
    let number: String = sqlx::query_scalar("SHOW server_version_num")
        .fetch_one(pool)
        .await?;
    let version = number.parse::<i64>().unwrap_or_default() / 10_000;
    if version < OLDEST_SERVER {
        return Err(StoreError::OldServer {
            found: version,
            oldest: OLDEST_SERVER,
        });
    }
    Ok(())
}

/// Migrates the schema; a database of a later version is refused. Processes that start together take turns.
async fn migrate(pool: &PgPool) -> Result<(), StoreError> {
    migrator().run(pool).await?;
    // The transactions of another cluster, from which the database was restored, had higher numbers.
    sqlx::query(
        "UPDATE revisions SET last = last + greatest(0, (SELECT max(revision) FROM jobs) - fretwear_last_revision())",
    )
    .execute(pool)
    .await?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn servers_elsewhere_are_verified() {
        for url in [
            "postgres://fretwear@db.example.com/fretwear",
            "postgres://fretwear@10.0.0.7/fretwear?sslmode=require",
        ] {
            let refused = options(url);
            assert!(
                matches!(refused, Err(StoreError::Unverified { .. })),
                "{url}"
            );
        }
        for url in [
            "postgres://fretwear@db.example.com/fretwear?sslmode=verify-full",
            "postgres://fretwear@127.0.0.1/fretwear",
            "postgres://fretwear@localhost/fretwear?host=/run/postgresql",
        ] {
            assert!(options(url).is_ok(), "{url}");
        }
    }
}
