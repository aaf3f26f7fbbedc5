//! Blocks of results of ended jobs, as they are stored: the content is in the database, or in an object.

use std::ops::Range;

use api::results::ResultFile;
use uuid::Uuid;

use crate::objects::{ObjectPart, Objects};
use crate::store::block::{Block, BlockError};
use crate::store::compression::{compress, decompress};
use crate::store::{Content, StoreError, StoredEvent, checksum};

/// Largest length of all events of a job, bytes.
const EVENTS_LIMIT: usize = 64 << 20;

/// A block as it is stored: its content is in the database, or in an object.
#[derive(Debug)]
pub(in crate::store) struct StoredBlock {
    pub(in crate::store) entries: Vec<u8>,
    pub(in crate::store) content: Vec<u8>,
    pub(in crate::store) object: Option<StoredObject>,
}

/// The object of a block.
#[derive(Debug, Clone)]
pub(in crate::store) struct StoredObject {
    pub(in crate::store) key: String,
    /// Length of the content at the start of the object, bytes.
    content_bytes: u64,
}

impl StoredObject {
    /// Key of the object, and length of the content at its start, bytes.
    pub(in crate::store) fn content(&self) -> (String, u64) {
        (self.key.clone(), self.content_bytes)
    }

    /// Returns a part of the object by its range behind the content.
    ///
    /// # Errors
    /// [`StoreError::NoObjects`].
    pub(in crate::store) fn behind(
        &self,
        objects: Option<&Objects>,
        range: &Range<u64>,
    ) -> Result<ObjectPart, StoreError> {
        let objects = objects.ok_or(StoreError::NoObjects)?;
        let from = self.content_bytes;
        let range = from + range.start..from + range.end;
        Ok(ObjectPart::new(objects, &self.key, range))
    }
}

impl StoredBlock {
    /// Block of the columns of a row.
    pub(in crate::store) fn new(
        entries: Vec<u8>,
        content: Vec<u8>,
        key: Option<String>,
        content_bytes: Option<i64>,
    ) -> Self {
        let content_bytes = content_bytes.and_then(|bytes| bytes.try_into().ok());
        let object = key.zip(content_bytes);
        Self {
            entries,
            content,
            object: object.map(|(key, content_bytes)| StoredObject { key, content_bytes }),
        }
    }

    /// Decompresses the block; reads its content from the store of objects if it was moved there.
    pub(in crate::store) async fn decoded(
        self,
        id: Uuid,
        objects: Option<&Objects>,
    ) -> Result<Block, StoreError> {
        let content = match &self.object {
            None => self.content,
            Some(StoredObject { key, content_bytes }) => {
                let objects = objects.ok_or(StoreError::NoObjects)?;
                objects.get(key, 0..*content_bytes).await?
            }
        };
        Block::decode(&self.entries, &content).map_err(|cause| unreadable(id, &cause))
    }

    /// Returns a document of the block, or a file behind it in an object.
    pub(in crate::store) async fn file(
        self,
        id: Uuid,
        name: &str,
        objects: Option<&Objects>,
    ) -> Result<Option<(ResultFile, Content)>, StoreError> {
        let entries = Block::decode(&self.entries, &[]).map_err(|cause| unreadable(id, &cause))?;
        if let Some(object) = &self.object
            && let Some((entry, range)) = entries.files().find(|(entry, _)| entry.name == name)
        {
            let part = object.behind(objects, &range)?;
            return Ok(Some((entry.clone(), Content::Object(part))));
        }
        if !entries.has_document(name) {
            return Ok(None);
        }
        let block = self.decoded(id, objects).await?;
        let document = block.document(name);
        Ok(document.map(|(entry, bytes)| (entry, Content::Inline(bytes))))
    }

    /// Returns the events behind the block in an object: those before the last one. None without an object.
    pub(in crate::store) async fn events(
        self,
        id: Uuid,
        objects: Option<&Objects>,
    ) -> Result<Vec<StoredEvent>, StoreError> {
        let Some(object) = &self.object else {
            return Ok(Vec::new());
        };
        let block = Block::decode(&self.entries, &[]).map_err(|cause| unreadable(id, &cause))?;
        let Some((entry, range)) = block.events() else {
            return Ok(Vec::new());
        };
        let bytes = object.behind(objects, &range)?.read().await?;
        let damaged = |cause: String| StoreError::DamagedResults {
            id,
            cause: format!("events: {cause}"),
        };
        checksum::check_bytes(entry, &bytes).map_err(|cause| damaged(cause.to_string()))?;
        serde_json::from_slice(&decompress(&bytes, EVENTS_LIMIT))
            .map_err(|cause| damaged(cause.to_string()))
    }
}

/// Compresses events as they are behind a block.
pub(in crate::store) fn pack_events(events: &[StoredEvent]) -> Result<Vec<u8>, StoreError> {
    Ok(compress(&serde_json::to_vec(events)?))
}

/// The error of a block that cannot be read.
pub(in crate::store) fn unreadable(id: Uuid, cause: &BlockError) -> StoreError {
    StoreError::DamagedResults {
        id,
        cause: cause.to_string(),
    }
}
