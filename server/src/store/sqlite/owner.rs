//! The process that serves a database, as a row in it with heartbeats.
//!
//! The lock file beside the database prevents a second process, unless it was deleted or the file system has no locks. Then
//! the row remains: a process that finds one of another process waits for a heartbeat, and refuses to serve if there is one.

use std::os::unix::fs::MetadataExt;
use std::path::Path;
use std::time::Duration;

use sqlx::sqlite::SqlitePool;
use sqlx::{Sqlite, Transaction};
use uuid::Uuid;

use crate::clock::{Now, Origin, STEP_MS, boot};
use crate::store::StoreError;
use crate::store::sqlite::SqliteStore;
use crate::store::sqlite::queries::BEGIN;

/// Interval between two heartbeats; each is a small write.
pub const OWNER_HEARTBEAT: Duration = Duration::from_secs(5);
/// Longest wait for a heartbeat, and the interval between two queries.
const LONGEST_WAIT: Duration = Duration::from_secs(16);
const LOOK_AGAIN: Duration = Duration::from_millis(200);

/// The row of an owner.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(super) struct Row {
    id: String,
    process: String,
    beats: i64,
}

/// Waits until the last owner of a database has ended or writes no heartbeats, and returns its row; none for a database
/// without owner.
///
/// # Errors
/// [`StoreError::Served`] if it is alive.
pub(super) async fn await_end_of_last(
    writer: &SqlitePool,
    path: &Path,
) -> Result<Option<Row>, StoreError> {
    let tables: i64 = sqlx::query_scalar("SELECT count(*) FROM sqlite_master WHERE name = 'owner'")
        .fetch_one(writer)
        .await?;
    if tables == 0 {
        return Ok(None);
    }
    let Some(first) = row(writer).await? else {
        return Ok(None);
    };
    let mut waited = Duration::ZERO;
    while waited < LONGEST_WAIT && !has_ended(&first.process) {
        match row(writer).await? {
            Some(now) if now == first => {}
            Some(now) => return Err(served(path, now)),
            None => return Ok(None),
        }
        tokio::time::sleep(LOOK_AGAIN).await;
        waited += LOOK_AGAIN;
    }
    Ok(Some(first))
}

/// Becomes the owner of a database after the last one; returns the id of the owner.
///
/// # Errors
/// [`StoreError::Served`] if another process was faster.
pub(super) async fn become_owner(
    writer: &SqlitePool,
    path: &Path,
    last: Option<&Row>,
) -> Result<Uuid, StoreError> {
    let id = Uuid::now_v7();
    let mut transaction = writer.begin_with(BEGIN).await?;
    let now: Option<(String, String, i64)> = sqlx::query_as("SELECT id, process, beats FROM owner")
        .fetch_optional(&mut *transaction)
        .await?;
    if let Some(now) = now.map(Row::from)
        && Some(&now) != last
    {
        return Err(served(path, now));
    }
    sqlx::query("INSERT OR REPLACE INTO owner (one, id, process, beats) VALUES (1, ?, ?, 0)")
        .bind(id.to_string())
        .bind(this_process())
        .execute(&mut *transaction)
        .await?;
    move_times(&mut transaction).await?;
    transaction.commit().await?;
    Ok(id)
}

/// Stored clock of the last process: the step that it had found until its last heartbeat, ms; and where known, its
/// origin, as the start of the system and the offset since it, ms.
type LastClock = (i64, Option<String>, Option<i64>);

/// Offset from times that the last process measured to those of this one, ms: from the origins of both clocks if the system
/// was not restarted since, or else the step that the last process had found.
fn step_ms(last: LastClock, own: Option<&Origin>) -> i64 {
    match (last, own) {
        ((_, Some(boot), Some(offset_ms)), Some(own)) if boot == own.boot => {
            own.offset_ms.saturating_sub(offset_ms)
        }
        ((stepped_ms, ..), _) => stepped_ms,
    }
}

/// Converts times on the monotonic clock of the last process to that of this one.
async fn move_times(transaction: &mut Transaction<'_, Sqlite>) -> Result<(), StoreError> {
    let last: Option<LastClock> =
        sqlx::query_as("DELETE FROM clock RETURNING stepped_ms, boot, offset_ms")
            .fetch_optional(&mut **transaction)
            .await?;
    let own = Origin::of_this_process();
    let (boot, offset_ms) = own.as_ref().map(|own| (&own.boot, own.offset_ms)).unzip();
    sqlx::query("INSERT INTO clock (one, stepped_ms, boot, offset_ms) VALUES (1, 0, ?, ?)")
        .bind(boot)
        .bind(offset_ms)
        .execute(&mut **transaction)
        .await?;
    let step_ms = last.map_or(0, |last| step_ms(last, own.as_ref()));
    if step_ms.abs() < STEP_MS {
        return Ok(());
    }
    sqlx::query("UPDATE jobs SET queued_at = queued_at + ?1, place = place + ?1, deadline_at = deadline_at + ?1 WHERE finished_at IS NULL")
        .bind(step_ms)
        .execute(&mut **transaction)
        .await?;
    tracing::info!(
        step_ms,
        "the clock was stepped since the last service started; deadlines were moved"
    );
    Ok(())
}

fn served(path: &Path, owner: Row) -> StoreError {
    StoreError::Served {
        path: path.to_owned(),
        process: owner.process,
    }
}

impl From<(String, String, i64)> for Row {
    fn from((id, process, beats): (String, String, i64)) -> Self {
        Self { id, process, beats }
    }
}

async fn row(pool: &SqlitePool) -> Result<Option<Row>, StoreError> {
    let row = sqlx::query_as("SELECT id, process, beats FROM owner").fetch_optional(pool);
    let row: Option<(String, String, i64)> = row.await?;
    Ok(row.map(Row::from))
}

impl SqliteStore {
    pub(in crate::store) async fn beat(&self) -> Result<(), StoreError> {
        let file = std::fs::metadata(&self.path).map(|file| (file.dev(), file.ino()));
        if file.ok() != Some(self.file) && !self.process.disk.note_removed_database() {
            tracing::error!(path = %self.path.display(), "{}", StoreError::Removed);
        }
        let write = async || {
            let written = sqlx::query("UPDATE owner SET beats = beats + 1 WHERE id = ?")
                .bind(self.owner.to_string())
                .execute(&self.writer)
                .await?;
            self.store_step(Now::read().stepped_ms()).await?;
            Ok(written.rows_affected())
        };
        if self.process.disk.with_reserve(write).await? > 0 {
            return Ok(());
        }
        let other = row(&self.readers).await?;
        Err(StoreError::Served {
            path: self.path.clone(),
            process: other.map_or_else(String::new, |other| other.process),
        })
    }

    /// Stores how far the system's clock was stepped.
    async fn store_step(&self, stepped_ms: i64) -> Result<(), StoreError> {
        sqlx::query("UPDATE clock SET stepped_ms = ?1 WHERE abs(stepped_ms - ?1) > ?2")
            .bind(stepped_ms)
            .bind(STEP_MS)
            .execute(&self.writer)
            .await?;
        Ok(())
    }

    /// Removes this process as the owner of the database.
    pub(super) async fn disown(&self) {
        // If it fails, steps of the last seconds move deadlines, and only if the system is started again.
        let _ = self.store_step(Now::read().stepped_ms()).await;
        // If it fails, the next process finds that this one has ended, or waits for a heartbeat.
        let _ = sqlx::query("DELETE FROM owner WHERE id = ?")
            .bind(self.owner.to_string())
            .execute(&self.writer)
            .await;
    }
}

/// This process: its namespace (start of the system, namespace of process ids), its number, and its start. Empty where the
/// system does not report them.
fn this_process() -> String {
    let pid = std::process::id();
    let parts = || Some(format!("{} pid {pid} {}", namespace()?, started(pid)?));
    parts().unwrap_or_default()
}

/// Returns `true` if a process has certainly ended, or is this one.
fn has_ended(process: &str) -> bool {
    let parsed = || {
        let (space, rest) = process.split_once(" pid ")?;
        let (pid, start) = rest.split_once(' ')?;
        Some((space, pid.parse::<u32>().ok()?, start))
    };
    let Some((space, pid, start)) = parsed() else {
        return false;
    };
    let is_visible = namespace().is_some_and(|own| own == space);
    is_visible && (pid == std::process::id() || started(pid).is_none_or(|found| found != start))
}

/// Scope in which process numbers are unique: start of the system and namespace of process ids.
fn namespace() -> Option<String> {
    let boot = boot()?;
    let space = std::fs::read_link("/proc/self/ns/pid").ok()?;
    Some(format!("{boot} {}", space.display()))
}

/// Start of a process in clock ticks since the start of the system: field 22 of `/proc/PID/stat` (proc(5)), where the name in
/// the second one may have spaces.
fn started(pid: u32) -> Option<String> {
    let stat = std::fs::read_to_string(format!("/proc/{pid}/stat")).ok()?;
    let (_, after_name) = stat.rsplit_once(") ")?;
    after_name.split(' ').nth(19).map(str::to_owned)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_step_is_known_from_the_clocks_under_one_start_of_the_system() {
        let own = Origin {
            boot: "a".to_owned(),
            offset_ms: 9_000,
        };
        let last = |boot: &str| (700, Some(boot.to_owned()), Some(5_000));
        assert_eq!(step_ms(last("a"), Some(&own)), 4_000);
        assert_eq!(step_ms(last("b"), Some(&own)), 700, "another start");
        assert_eq!(step_ms(last("a"), None), 700);
        assert_eq!(step_ms((700, None, None), Some(&own)), 700);
    }

    #[test]
    fn only_processes_that_this_one_could_see_are_known_to_have_ended() {
        let own = this_process();
        assert!(has_ended(&own), "{own}");
        let (space, _) = own.split_once(" pid ").expect("Linux");
        assert!(has_ended(&format!("{space} pid {} 1", i32::MAX)));
        assert!(has_ended(&format!("{space} pid 1 0")), "another start");
        let init = started(1).expect("a process");
        assert!(!has_ended(&format!("{space} pid 1 {init}")));
        assert!(!has_ended("another system pid 1 0"));
        assert!(!has_ended(""));
    }
}
