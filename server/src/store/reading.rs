//! Reading of events and results: from their rows, or from the block that they were packed into when the job ended.

use std::collections::HashMap;

use api::results::{ResultFile, Snapshot};
use solver::record::CycleReport;
use uuid::Uuid;

use crate::store::block::{Block, BlockError};
use crate::store::stored_block::unreadable;
use crate::store::{Content, SnapshotPart, Store, StoreError, StoredEvent, events};

impl Store {
    /// Returns the events of a job after number `after`, oldest first; at most a page of them.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn events(&self, id: Uuid, after: i64) -> Result<Vec<StoredEvent>, StoreError> {
        let stored = self.event_rows(id, after).await?;
        if events::is_whole(&stored, after) {
            return Ok(stored);
        }
        let moved = match self.stored_block(id).await? {
            None => Vec::new(),
            Some(block) => block.events(id, self.process().objects.as_ref()).await?,
        };
        Ok(events::page(moved, stored, after))
    }

    /// Returns the rows of the wear history so far, by cycle.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails or a row cannot be read.
    pub async fn history(&self, id: Uuid) -> Result<Vec<CycleReport>, StoreError> {
        let rows = self.history_rows(id).await?;
        if !rows.is_empty() {
            return Ok(rows);
        }
        let packed = self.in_block(id, Block::history).await?;
        Ok(packed.unwrap_or_default())
    }

    /// Returns a document (JSON) of the snapshot nearest to a cycle; of the last snapshot if no cycle is given.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn snapshot(
        &self,
        id: Uuid,
        part: SnapshotPart,
        cycle: Option<u64>,
    ) -> Result<Option<String>, StoreError> {
        let row = self.snapshot_row(id, part, cycle).await?;
        if row.is_some() {
            return Ok(row);
        }
        let nearest = |block: &Block| block.snapshot(part, cycle.unwrap_or(u64::MAX));
        self.in_block(id, nearest).await
    }

    /// Returns all snapshots of a job, by cycle.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails or a document cannot be read.
    pub async fn snapshots(&self, id: Uuid) -> Result<Vec<Snapshot>, StoreError> {
        let rows = self.snapshot_rows(id).await?;
        if !rows.is_empty() {
            return Ok(rows);
        }
        let packed = self.in_block(id, Block::snapshots).await?;
        Ok(packed.unwrap_or_default())
    }

    /// Returns a file that the manifest names, and its content.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn result_file(
        &self,
        id: Uuid,
        name: &str,
    ) -> Result<Option<(ResultFile, Content)>, StoreError> {
        let row = self.file_row(id, name).await?;
        if row.is_some() {
            return Ok(row);
        }
        match self.stored_block(id).await? {
            None => Ok(None),
            Some(stored) => stored.file(id, name, self.process().objects.as_ref()).await,
        }
    }

    /// Returns the documents of a job's block, by name.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails or the block cannot be read.
    pub async fn block_documents(&self, id: Uuid) -> Result<HashMap<String, Vec<u8>>, StoreError> {
        let block = self.block(id).await?.unwrap_or_default();
        Ok(block.into_documents())
    }

    /// Returns the block of a job; `None` if it has none.
    async fn block(&self, id: Uuid) -> Result<Option<Block>, StoreError> {
        match self.stored_block(id).await? {
            None => Ok(None),
            Some(stored) => {
                let block = stored.decoded(id, self.process().objects.as_ref()).await;
                block.map(Some)
            }
        }
    }

    /// Returns what is read of a job's block; `None` if it has none, or if it is not part of it.
    async fn in_block<T>(
        &self,
        id: Uuid,
        read: impl FnOnce(&Block) -> Result<Option<T>, BlockError>,
    ) -> Result<Option<T>, StoreError> {
        let Some(block) = self.block(id).await? else {
            return Ok(None);
        };
        read(&block).map_err(|cause| unreadable(id, &cause))
    }
}
