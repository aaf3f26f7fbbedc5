//! Opening the store: address, connections, migrations.

use std::path::{Path, PathBuf};
use std::str::FromStr;
use std::time::Duration;

use reqwest::Url;
use sqlx::Connection;
use sqlx::postgres::{PgConnectOptions, PgConnection, PgPool, PgPoolOptions, PgSslMode};
use tokio::sync::mpsc;
use tokio_util::task::AbortOnDropHandle;
use uuid::Uuid;

use crate::clock::Clock;
use crate::export::files::parent;
use crate::groups::Groups;
use crate::store::leases::ENDED_BY_RESTORE;
use crate::store::migrations::{migrator_of, newest_version};
use crate::store::postgres::PostgresStore;
use crate::store::postgres::durability;
use crate::store::postgres::migrations::FILES;
use crate::store::postgres::notifications::{hear, notify};
use crate::store::process_state::ProcessState;
use crate::store::{BackupError, Lease, Limits, StoreError};

/// Number of connections for claims and writes, among them one that sends notifications.
const WRITERS: u32 = 9;
/// Number of connections for reads.
const READERS: u32 = 5;
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
/// The same for a verification, which reads large contents over any line.
const TIMEOUT_TO_VERIFY: Duration = Duration::from_mins(10);
const SETTINGS_TO_VERIFY: [(&str, &str); 2] =
    [("statement_timeout", "10min"), ("lock_timeout", "10s")];
/// Parameters of an address.
const PARAMETERS: [&str; 9] = [
    "sslmode",
    "sslrootcert",
    "sslcert",
    "sslkey",
    "host",
    "port",
    "dbname",
    "user",
    "password",
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
        migrate(&options).await?;
        let options = options.options(SETTINGS);
        let pool = connect(WRITERS, options.clone(), CONNECTION_TIMEOUT).await?;
        let readers = connect(READERS, options, CONNECTION_TIMEOUT).await?;
        let machine = nix::unistd::gethostname().unwrap_or_default();
        let machine = machine.to_string_lossy();
        let clock = match clock {
            Clock::Manual(_) => clock,
            Clock::System | Clock::Database => Clock::Database,
        };
        let mut process = ProcessState::prepare(files, Some(&machine), limits, clock);
        let (others, notifications) = mpsc::unbounded_channel();
        process.others = Some(others);
        let sender = Uuid::now_v7();
        let (changes, waiting) = (process.changes.clone(), process.waiting.clone());
        let tasks = [
            tokio::spawn(notify(pool.clone(), sender, notifications)),
            tokio::spawn(hear(pool.clone(), sender, changes, waiting)),
        ];
        let store = Self {
            process,
            writer: pool,
            readers,
            claims: Groups::default(),
            writes: Groups::default(),
            demands: Groups::default(),
            mover: tokio::sync::Mutex::default(),
            last_probe: tokio::sync::Mutex::default(),
            compared: tokio::sync::Mutex::default(),
            tasks: tasks.map(AbortOnDropHandle::new),
        };
        store.remove_unnamed_files(None).await?;
        Ok(store)
    }

    /// Closes all connections.
    pub(in crate::store) async fn close(&self) {
        for task in &self.tasks {
            task.abort();
        }
        *self.mover.lock().await = None;
        self.readers.close().await;
        self.writer.close().await;
    }
}

/// Connections to the database at `url` for a verification, whose schema this version knows.
pub(super) async fn open_to_verify(url: &str) -> Result<PgPool, BackupError> {
    let options = options(url)?;
    let path = PathBuf::from(options.get_database().unwrap_or_default());
    let options = options.options(SETTINGS_TO_VERIFY);
    // A pool would repeat a refused connection until its timeout.
    let mut server = PgConnection::connect_with(&options).await?;
    refuse_standby(&mut server).await?;
    check_version(&mut server).await?;
    let found = applied(&mut server).await?;
    server.close().await?;
    let known = newest_version(&FILES);
    match found {
        None => Err(BackupError::NoDatabase(path)),
        Some(found) if found < known => Err(BackupError::Older { path, found, known }),
        Some(found) if found > known => Err(StoreError::Newer { path, found, known }.into()),
        Some(_) => Ok(connect(READERS, options, TIMEOUT_TO_VERIFY).await?),
    }
}

/// Opens a pool of so many connections.
async fn connect(
    connections: u32,
    options: PgConnectOptions,
    timeout: Duration,
) -> Result<PgPool, sqlx::Error> {
    PgPoolOptions::new()
        .max_connections(connections)
        .acquire_timeout(timeout)
        .after_connect(|connection, _| Box::pin(refuse_standby(connection)))
        .connect_with(options)
        .await
}

/// Returns the options to connect to the server at `url`. Beyond this machine, connections are encrypted and the server's name is
/// verified.
fn options(url: &str) -> Result<PgConnectOptions, StoreError> {
    let invalid = |cause: String| StoreError::Server { cause };
    let parsed = Url::parse(url).map_err(|cause| invalid(cause.to_string()))?;
    // Unknown ones would be written into the log with their values.
    let mut names = parsed.query_pairs().map(|(name, _)| name);
    if let Some(unknown) = names.find(|name| !PARAMETERS.contains(&&**name)) {
        let known = PARAMETERS.join(", ");
        return Err(invalid(format!(
            "`{unknown}` is none of its parameters, {known}"
        )));
    }
    let options = PgConnectOptions::from_str(url).map_err(|cause| invalid(cause.to_string()))?;
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
    Ok(options.application_name("fretwear"))
}

/// Refuses a connection to a standby, where a proxy leads while the primary does not answer: it would stay there.
pub(super) async fn refuse_standby(connection: &mut PgConnection) -> Result<(), sqlx::Error> {
    let is_standby: bool = sqlx::query_scalar("SELECT pg_is_in_recovery()")
        .fetch_one(connection)
        .await?;
    if is_standby {
        return Err(sqlx::Error::Configuration("the server is a standby".into()));
    }
    Ok(())
}

async fn check_version(server: &mut PgConnection) -> Result<(), StoreError> {
    let number: String = sqlx::query_scalar("SHOW server_version_num")
        .fetch_one(server)
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

/// Migrates the schema, unless it is migrated already, so that a role that may not change it can serve the database. A database of a
/// later version is refused. Processes that start together take turns, without the limits of other connections: an index may take long.
async fn migrate(options: &PgConnectOptions) -> Result<(), StoreError> {
    let mut server = PgConnection::connect_with(options).await?;
    refuse_standby(&mut server).await?;
    check_version(&mut server).await?;
    durability::warn(&mut server).await;
    if applied(&mut server).await? != Some(newest_version(&FILES)) {
        migrator_of(&FILES).run(&mut server).await?;
    }
    // The transactions of another cluster, from which the database was restored, had higher numbers. That of this statement is above all
    // that have ended in this one.
    let mut transaction = server.begin().await?;
    let restored = sqlx::query(
        "UPDATE revisions SET last = last + behind FROM (SELECT max(revision) - fretwear_revision() AS behind FROM jobs) AS jobs \
         WHERE behind > 0",
    )
    .execute(&mut *transaction)
    .await?;
    if restored.rows_affected() > 0 {
        // Workers of the original may have written more to it.
        sqlx::query(
            "UPDATE jobs SET lease = lease + $1, lease_expires_at = $2 WHERE status = 'running'",
        )
        .bind(Lease::step())
        .bind(ENDED_BY_RESTORE)
        .execute(&mut *transaction)
        .await?;
    }
    transaction.commit().await?;
    Ok(server.close().await?)
}

/// Version of the last migration of a database; none if there was none.
async fn applied(server: &mut PgConnection) -> Result<Option<i64>, StoreError> {
    let is_new: bool = sqlx::query_scalar("SELECT to_regclass('_sqlx_migrations') IS NULL")
        .fetch_one(&mut *server)
        .await?;
    if is_new {
        return Ok(None);
    }
    let last = sqlx::query_scalar("SELECT max(version) FROM _sqlx_migrations WHERE success");
    Ok(last.fetch_one(server).await?)
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

    #[test]
    fn unknown_parameters_are_refused_without_their_values() {
        let refused = options("postgres://fretwear@127.0.0.1/fretwear?pasword=a-secret");
        let said = refused.expect_err("refused").to_string();
        assert!(
            said.contains("pasword") && !said.contains("a-secret"),
            "{said}"
        );
    }
}
