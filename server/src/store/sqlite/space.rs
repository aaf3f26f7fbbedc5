//! Space of the database file: free pages, and the write-ahead log.

use std::time::Duration;

use sqlx::sqlite::SqliteConnection;

use crate::store::StoreError;
use crate::store::sqlite::SqliteStore;
use crate::store::sqlite::open::{BUSY_TIMEOUT, LARGEST_WAL};

/// Free pages that are not released, because the next writes need some.
const KEPT_PAGES: u64 = 1024;
/// Pages that are released at once, each with a copy of another page at most; bounds how long other writes wait.
const PAGES_AT_ONCE: u64 = 2048;

impl SqliteStore {
    pub(in crate::store) async fn give_pages_back(&self) -> Result<(), StoreError> {
        let (free, bytes, is_incremental): (i64, i64, bool) = sqlx::query_as(
            "SELECT freelist_count, page_size, auto_vacuum = 2 \
             FROM pragma_freelist_count, pragma_page_size, pragma_auto_vacuum",
        )
        .fetch_one(&self.readers)
        .await?;
        let (free, bytes) = (free.unsigned_abs(), bytes.unsigned_abs());
        self.process.disk.set_free_in_database(free * bytes);
        if !is_incremental || free <= KEPT_PAGES {
            return Ok(());
        }
        let pages = PAGES_AT_ONCE.min(free - KEPT_PAGES);
        let vacuum = async || {
            sqlx::query(sqlx::AssertSqlSafe(format!(
                "PRAGMA incremental_vacuum({pages})"
            )))
            .execute(&self.writer)
            .await?;
            Ok(())
        };
        self.process.disk.with_reserve(vacuum).await
    }

    pub(in crate::store) async fn checkpoint_wal(&self) -> Result<(), StoreError> {
        let mut writer = self.writer.acquire().await?;
        let (_, written, moved) = checkpoint(&mut writer, "PASSIVE").await?;
        if moved < written {
            let bytes = tokio::fs::metadata(&self.wal)
                .await
                .map_or(0, |file| file.len());
            if bytes > LARGEST_WAL {
                tracing::warn!(
                    path = %self.wal.display(),
                    bytes,
                    "the write-ahead log grows: a reader of the database, perhaps another program, holds an old state of it"
                );
            }
            return Ok(());
        }
        // Readers of its end still need the file; they are not waited for.
        set_busy_timeout(&mut writer, Duration::ZERO).await?;
        let truncated = checkpoint(&mut writer, "TRUNCATE").await;
        set_busy_timeout(&mut writer, BUSY_TIMEOUT).await?;
        truncated.map(drop)
    }
}

/// Checkpoints the write-ahead log; returns whether others prevented its end, the pages in the log, and those in the database.
async fn checkpoint(
    writer: &mut SqliteConnection,
    mode: &str,
) -> Result<(bool, i64, i64), StoreError> {
    let sql = sqlx::AssertSqlSafe(format!("PRAGMA wal_checkpoint({mode})"));
    Ok(sqlx::query_as(sql).fetch_one(writer).await?)
}

async fn set_busy_timeout(
    writer: &mut SqliteConnection,
    timeout: Duration,
) -> Result<(), StoreError> {
    let sql = format!("PRAGMA busy_timeout = {}", timeout.as_millis());
    sqlx::query(sqlx::AssertSqlSafe(sql))
        .execute(writer)
        .await?;
    Ok(())
}

#[cfg(test)]
mod tests {
    use std::path::PathBuf;

    use sqlx::{ConnectOptions, Connection};

    use super::*;
    use crate::store::sqlite::backup::{at, copy_database};
    use crate::store::tests::Fixture;

    impl Fixture {
        fn database(&self) -> PathBuf {
            self.folder.path().join("test.db")
        }
    }

    async fn free_pages(fixture: &Fixture) -> i64 {
        let mut database = at(&fixture.database())
            .connect()
            .await
            .expect("the database");
        let free = sqlx::query_scalar("PRAGMA freelist_count").fetch_one(&mut database);
        free.await.expect("a number")
    }

    async fn execute(database: &mut SqliteConnection, sql: &'static str) {
        sqlx::query(sql).execute(database).await.expect("executed");
    }

    /// Writes 40 MB into a table and deletes it.
    async fn with_free_pages(fixture: &Fixture) {
        let mut database = at(&fixture.database())
            .connect()
            .await
            .expect("the database");
        for sql in [
            "CREATE TABLE large AS SELECT zeroblob(40 << 20) AS content",
            "DROP TABLE large",
        ] {
            execute(&mut database, sql).await;
        }
        database.close().await.expect("closed");
    }

    #[tokio::test]
    async fn free_pages_are_free_space_until_they_are_given_back() {
        let fixture = Fixture::new().await;
        with_free_pages(&fixture).await;
        let store = &fixture.store;
        let size = || std::fs::metadata(fixture.database()).expect("a file").len();
        store.checkpoint_wal().await.expect("the store");
        assert!(size() > 40 << 20);
        let mut free = free_pages(&fixture).await;
        store.give_pages_back().await.expect("the store");
        assert!(store.disk().free_in_database_mb() >= 40);
        while free > i64::try_from(KEPT_PAGES).expect("small") {
            let left = free_pages(&fixture).await;
            assert!(left < free);
            free = left;
            store.give_pages_back().await.expect("the store");
        }
        store.checkpoint_wal().await.expect("the store");
        assert!(size() < 8 << 20, "{}", size());
        store.give_pages_back().await.expect("the store");
        assert!(store.disk().free_in_database_mb() <= 4);
    }

    #[tokio::test]
    async fn the_log_is_truncated_unless_a_reader_needs_it() {
        let fixture = Fixture::new().await;
        let wal = fixture.database().with_extension("db-wal");
        let size = || std::fs::metadata(&wal).expect("a log").len();
        let mut reader = at(&fixture.database())
            .connect()
            .await
            .expect("the database");
        execute(&mut reader, "BEGIN").await;
        execute(&mut reader, "SELECT count(*) FROM jobs").await;
        fixture.queued().await;
        fixture.store.checkpoint_wal().await.expect("the store");
        assert!(size() > 0);
        execute(&mut reader, "COMMIT").await;
        fixture.store.checkpoint_wal().await.expect("the store");
        assert_eq!(size(), 0);
        // The writer still waits for others.
        let timeout = sqlx::query_scalar("PRAGMA busy_timeout");
        let timeout: i64 = timeout
            .fetch_one(&fixture.store.sqlite().writer)
            .await
            .expect("a number");
        assert_eq!(u128::from(timeout.unsigned_abs()), BUSY_TIMEOUT.as_millis());
    }

    #[tokio::test]
    async fn a_copy_of_a_database_of_an_earlier_version_gives_pages_back() {
        let folder = tempfile::tempdir().expect("a folder");
        let [source, target] = ["source.db", "target.db"].map(|name| folder.path().join(name));
        let created = at(&source).create_if_missing(true).connect().await;
        let mut database = created.expect("a database");
        execute(&mut database, "CREATE TABLE jobs (id INTEGER)").await;
        copy_database(&source, &target).await.expect("copied");
        let mut copy = at(&target).connect().await.expect("the copy");
        let vacuum = sqlx::query_scalar("PRAGMA auto_vacuum").fetch_one(&mut copy);
        let vacuum: i64 = vacuum.await.expect("a number");
        assert_eq!(vacuum, 2);
    }
}
