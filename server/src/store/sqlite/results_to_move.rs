//! Results of a job as they are written to an object.

use api::results::ResultFile;
use sqlx::{Row, SqliteConnection};
use uuid::Uuid;

use crate::export::documents::JSON;
use crate::export::files::manifest_entry;
use crate::objects::ObjectFile;
use crate::store::block::Block;
use crate::store::sqlite::blocks::{StoredBlock, unreadable};
use crate::store::sqlite::events::pack_events;
use crate::store::sqlite::files::entry;
use crate::store::sqlite::packed::{listed, pack};
use crate::store::sqlite::queries::{corrupt, integer};
use crate::store::{Store, StoreError, integrity};

/// Results that were written to an object.
pub(super) struct Moved {
    pub(super) id: Uuid,
    pub(super) key: String,
    /// The entries of the block before, and now.
    pub(super) entries: (Vec<u8>, Vec<u8>),
    pub(super) content_bytes: i64,
    /// Specification and plan, compressed, and the part of the specification that stays.
    pub(super) documents: Vec<u8>,
    pub(super) listed: String,
}

/// Results that can be written to an object.
pub(super) struct Prepared {
    pub(super) moved: Moved,
    /// The content of the block and the events.
    pub(super) head: Vec<u8>,
    pub(super) files: Vec<ObjectFile>,
}

impl Store {
    /// Reads and checks the results of a job; `None` if it was deleted.
    pub(super) async fn prepare(
        &self,
        id: Uuid,
        key: String,
    ) -> Result<Option<Prepared>, StoreError> {
        let mut connection = self.readers.acquire().await?;
        let stored = StoredBlock::of(&mut connection, id).await?;
        let texts: Option<(String, String)> =
            sqlx::query_as("SELECT spec, plan FROM jobs WHERE id = ?")
                .bind(id.to_string())
                .fetch_optional(&mut *connection)
                .await?;
        let (Some(stored), Some((spec, plan))) = (stored, texts) else {
            return Ok(None);
        };
        let events = pack_events(&mut connection, id).await?;
        let files = self.files_to_move(&mut connection, id).await?;
        drop(connection);
        let StoredBlock {
            entries, content, ..
        } = stored;
        let listed = listed(id, &spec)?;
        let prepare = move || {
            check(id, &entries, &content)?;
            let events_entry = manifest_entry("events", None, JSON, &events);
            let (of_files, files): (Vec<_>, _) = files.into_iter().unzip();
            let with_files = Block::with_files(&entries, events_entry, of_files);
            let with_files = with_files.map_err(|cause| unreadable(id, &cause))?;
            let moved = Moved {
                id,
                key,
                content_bytes: integer(content.len()),
                documents: pack(&spec, &plan),
                listed,
                entries: (entries, with_files),
            };
            let head = [&content[..], &events].concat();
            Ok(Some(Prepared { moved, head, files }))
        };
        // Decompression takes milliseconds.
        let prepared = tokio::task::spawn_blocking(prepare).await;
        prepared.unwrap_or(Err(StoreError::Unwritten))
    }

    /// The files of a job's manifest, with their places.
    async fn files_to_move(
        &self,
        connection: &mut SqliteConnection,
        id: Uuid,
    ) -> Result<Vec<(ResultFile, ObjectFile)>, StoreError> {
        let rows = sqlx::query(
            "SELECT name, cycle, media_type, bytes, sha256, damaged, place FROM result_files \
             WHERE job_id = ? AND place IS NOT NULL ORDER BY name",
        )
        .bind(id.to_string())
        .fetch_all(connection)
        .await?;
        let file = |row| {
            let (entry, place) = (entry(row)?, row.try_get::<&str, _>("place")?);
            let path = self.folder.path(place);
            let file = ObjectFile {
                path: path.ok_or_else(|| corrupt(id, "path of a file", &place))?,
                bytes: entry.bytes,
                sha256: entry.sha256.clone(),
            };
            Ok((entry, file))
        };
        rows.iter().map(file).collect()
    }
}

/// Checks the content of a block: the object will be the only copy of it.
fn check(id: Uuid, entries: &[u8], content: &[u8]) -> Result<(), StoreError> {
    let block = Block::decode(entries, content).map_err(|cause| unreadable(id, &cause))?;
    for (entry, bytes) in block.all() {
        integrity::check_bytes(entry, bytes).map_err(|cause| StoreError::DamagedResults {
            id,
            cause: format!("{}: {cause}", entry.name),
        })?;
    }
    Ok(())
}
