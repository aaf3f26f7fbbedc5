//! Results of jobs as they are written to objects.

use api::results::ResultFile;
use uuid::Uuid;

use crate::export::documents::JSON;
use crate::export::files::manifest_entry;
use crate::objects::Source;
use crate::store::block::Block;
use crate::store::packed::{listed, pack};
use crate::store::process_state::ProcessState;
use crate::store::rows::{StoredRow, entry, integer};
use crate::store::stored_block::{StoredBlock, pack_events, unreadable};
use crate::store::stored_file::source;
use crate::store::{StoreError, StoredEvent, checksum};

/// Results that were written to an object.
pub(in crate::store) struct Moved {
    pub(in crate::store) id: Uuid,
    pub(in crate::store) key: String,
    /// The entries of the block before, and now.
    pub(in crate::store) entries: (Vec<u8>, Vec<u8>),
    pub(in crate::store) content_bytes: i64,
    /// Specification and plan, compressed, and the part of the specification that stays.
    pub(in crate::store) documents: Vec<u8>,
    pub(in crate::store) listed: String,
}

/// Results that can be written to an object.
pub(in crate::store) struct Prepared {
    pub(in crate::store) moved: Moved,
    /// The content of the block and the events.
    pub(in crate::store) head: Vec<u8>,
    pub(in crate::store) files: Vec<StoredFile>,
}

/// A file of a job.
pub(in crate::store) struct StoredFile {
    pub(in crate::store) entry: ResultFile,
    /// `None` if its content is in its row.
    pub(in crate::store) source: Option<Source>,
}

/// Results of a job as they were read from the database.
pub(in crate::store) struct Stored {
    pub(in crate::store) id: Uuid,
    pub(in crate::store) block: StoredBlock,
    /// Specification and plan, JSON.
    pub(in crate::store) texts: (String, String),
    /// All but the last one.
    pub(in crate::store) events: Vec<StoredEvent>,
    /// An error if the place of one cannot be read.
    pub(in crate::store) files: Result<Vec<StoredFile>, StoreError>,
}

impl Stored {
    /// Checks the results and compresses what is not yet.
    pub(in crate::store) async fn prepare(self, key: String) -> Result<Prepared, StoreError> {
        let prepare = move || {
            let StoredBlock {
                entries, content, ..
            } = self.block;
            let (id, (spec, plan)) = (self.id, self.texts);
            check(id, &entries, &content)?;
            let events = pack_events(&self.events)?;
            let events_entry = manifest_entry("events", None, JSON, &events);
            let files = self.files?;
            let of_files: Vec<_> = files.iter().map(|file| file.entry.clone()).collect();
            let with_files = Block::with_files(&entries, events_entry, of_files);
            let with_files = with_files.map_err(|cause| unreadable(id, &cause))?;
            let moved = Moved {
                id,
                key,
                content_bytes: integer(content.len()),
                documents: pack(&spec, &plan),
                listed: listed(id, &spec)?,
                entries: (entries, with_files),
            };
            let head = [&content[..], &events].concat();
            Ok(Prepared { moved, head, files })
        };
        // Decompression takes milliseconds.
        let prepared = tokio::task::spawn_blocking(prepare).await;
        prepared.unwrap_or(Err(StoreError::Unwritten))
    }
}

/// A file of a manifest, from its row, and where it is.
pub(in crate::store) fn file_to_move(
    process: &ProcessState,
    id: Uuid,
    row: &impl StoredRow,
    object: Option<&str>,
) -> Result<StoredFile, StoreError> {
    let entry = entry(row)?;
    let source = source(process, id, &entry, row, object)?;
    Ok(StoredFile { entry, source })
}

/// Checks the content of a block: the object will be the only copy of it.
fn check(id: Uuid, entries: &[u8], content: &[u8]) -> Result<(), StoreError> {
    let block = Block::decode(entries, content).map_err(|cause| unreadable(id, &cause))?;
    for (entry, bytes) in block.all() {
        checksum::check_bytes(entry, bytes).map_err(|cause| StoreError::DamagedResults {
            id,
            cause: format!("{}: {cause}", entry.name),
        })?;
    }
    Ok(())
}
