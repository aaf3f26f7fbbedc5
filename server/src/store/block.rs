//! Blocks: the small results of an ended job, one after the other and compressed together.
//!
//! Documents, history and snapshots of a job have most of their digits in common, so that together they take a tenth of their
//! length; each by itself takes a quarter, besides a row of its own.

mod files;

use std::collections::HashMap;
use std::ops::Range;

use api::results::{ResultFile, Snapshot};
use serde::{Deserialize, Serialize};
use serde_json::value::RawValue;
use solver::record::CycleReport;

use crate::export::documents::JSON;
use crate::export::files::{is_plain_name, manifest_entry};
use crate::store::compression::{compress, decompress};
use crate::store::{IntegrityError, SnapshotPart, checksum};

/// Largest length of the content of a block, bytes; it is read as a whole.
const LIMIT: usize = 4 << 20;

/// Content of an entry in a block.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
enum Kind {
    /// A document of the manifest.
    Document,
    /// The rows of the history.
    History,
    /// All snapshots.
    Snapshots,
    /// A file of the manifest that is not part of the content, but behind it in an object.
    File,
    /// Compressed events, behind the content in an object.
    Events,
}

impl Kind {
    fn is_listed(self) -> bool {
        matches!(self, Self::Document | Self::File)
    }

    fn is_behind(self) -> bool {
        matches!(self, Self::File | Self::Events)
    }
}

#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
struct Entry {
    kind: Kind,
    file: ResultFile,
}

/// The small results of a job.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct Block {
    entries: Vec<Entry>,
    content: Vec<u8>,
}

/// A compressed block.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct EncodedBlock {
    /// The entries, JSON.
    #[serde(with = "crate::json_bytes")]
    pub(in crate::store) entries: Vec<u8>,
    /// The content.
    #[serde(with = "crate::json_bytes")]
    pub(in crate::store) content: Vec<u8>,
    /// Names of its documents.
    pub(in crate::store) documents: Vec<String>,
    /// True if history and snapshots are part of it.
    pub(in crate::store) has_history: bool,
}

impl EncodedBlock {
    /// Checks that its entries can be read, are those of a block by itself, and have plain names, which it lists.
    ///
    /// # Errors
    /// [`BlockError`].
    pub fn check(&self) -> Result<(), BlockError> {
        let block = Block::decode(&self.entries, &[])?;
        let is_foreign =
            |entry: &&Entry| entry.kind.is_behind() || !is_plain_name(&entry.file.name);
        if let Some(entry) = block.entries.iter().find(is_foreign) {
            return Err(BlockError::Foreign(entry.file.name.clone()));
        }
        let names: Vec<_> = block.documents().map(|file| &file.name).collect();
        if names != self.documents.iter().collect::<Vec<_>>() {
            return Err(BlockError::Documents);
        }
        Ok(())
    }
}

/// Why a block cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum BlockError {
    /// The entries are damaged.
    #[error("its entries cannot be read: {0}")]
    Entries(#[from] serde_json::Error),
    /// An entry belongs to an object, or its name is not that of a file.
    #[error("`{0}` is no entry of a block")]
    Foreign(String),
    /// The names of its documents are others.
    #[error("its documents are not those that it lists")]
    Documents,
    /// History or its snapshots are damaged.
    #[error("{what}: {cause}")]
    Damaged {
        /// The entry.
        what: String,
        /// The damage.
        cause: IntegrityError,
    },
}

/// A snapshot whose documents are not parsed.
#[derive(Deserialize)]
struct RawSnapshot<'a> {
    #[serde(borrow)]
    profile: &'a RawValue,
    #[serde(borrow)]
    pressure: &'a RawValue,
    #[serde(borrow)]
    friction_loop: &'a RawValue,
}

#[derive(Deserialize)]
struct OfCycle {
    cycle: u64,
}

impl Block {
    /// Adds history and snapshots; false if they are too long.
    ///
    /// # Errors
    /// If they cannot be written as JSON.
    pub fn push_history(
        &mut self,
        rows: &[CycleReport],
        snapshots: &[Snapshot],
    ) -> Result<bool, serde_json::Error> {
        let (history, snapshots) = (serde_json::to_vec(rows)?, serde_json::to_vec(snapshots)?);
        if !self.has_room(history.len() + snapshots.len()) {
            return Ok(false);
        }
        for (kind, name, bytes) in [
            (Kind::History, "history", history),
            (Kind::Snapshots, "snapshots", snapshots),
        ] {
            self.push(kind, manifest_entry(name, None, JSON, &bytes), &bytes);
        }
        Ok(true)
    }

    /// Adds a document of the manifest; false if the block is full.
    pub fn push_document(&mut self, file: &ResultFile, bytes: &[u8]) -> bool {
        let has_room = self.has_room(bytes.len());
        if has_room {
            self.push(Kind::Document, file.clone(), bytes);
        }
        has_room
    }

    /// Compresses the block.
    ///
    /// # Errors
    /// If the entries cannot be written as JSON.
    pub fn encode(&self) -> Result<EncodedBlock, serde_json::Error> {
        Ok(EncodedBlock {
            entries: compress(&serde_json::to_vec(&self.entries)?),
            content: compress(&self.content),
            documents: self.documents().map(|file| file.name.clone()).collect(),
            has_history: self.range(Kind::History).is_some(),
        })
    }

    /// Decompresses a block. Damaged bytes are missing from the content; the checksums of the entries expose that.
    ///
    /// # Errors
    /// [`BlockError::Entries`].
    pub(in crate::store) fn decode(entries: &[u8], content: &[u8]) -> Result<Self, BlockError> {
        Ok(Self {
            entries: serde_json::from_slice(&decompress(entries, LIMIT))?,
            content: decompress(content, LIMIT),
        })
    }

    /// Returns the entries of documents and files, by a block's compressed entries only.
    ///
    /// # Errors
    /// [`BlockError::Entries`].
    pub(in crate::store) fn listed(entries: &[u8]) -> Result<Vec<ResultFile>, BlockError> {
        let block = Self::decode(entries, &[])?;
        let listed = block.entries.into_iter();
        let listed = listed.filter(|entry| entry.kind.is_listed());
        Ok(listed.map(|entry| entry.file).collect())
    }

    /// Returns all entries of the content with their parts of it, checked or not.
    pub(in crate::store) fn all(&self) -> impl Iterator<Item = (&ResultFile, &[u8])> {
        let entries = self.entries.iter().zip(self.ranges());
        let entries = entries.filter(|(entry, _)| !entry.kind.is_behind());
        entries.map(|(entry, range)| (&entry.file, self.slice(range)))
    }

    /// Returns a document, unchecked.
    pub(in crate::store) fn document(&self, name: &str) -> Option<(ResultFile, Vec<u8>)> {
        let mut entries = self.entries.iter().zip(self.ranges());
        let is_it = |entry: &Entry| entry.kind == Kind::Document && entry.file.name == name;
        let (entry, range) = entries.find(|(entry, _)| is_it(entry))?;
        Some((entry.file.clone(), self.slice(range).to_vec()))
    }

    /// Returns the contents of all documents by name, unchecked.
    pub(in crate::store) fn into_documents(self) -> HashMap<String, Vec<u8>> {
        let documents = self.entries.iter().zip(self.ranges());
        let documents = documents.filter(|(entry, _)| entry.kind == Kind::Document);
        documents
            .map(|(entry, range)| (entry.file.name.clone(), self.slice(range).to_vec()))
            .collect()
    }

    /// Returns the rows of the history; `None` if they are not part of the block.
    ///
    /// # Errors
    /// [`BlockError`] if they are damaged.
    pub(in crate::store) fn history(&self) -> Result<Option<Vec<CycleReport>>, BlockError> {
        let bytes = self.checked(Kind::History)?;
        Ok(bytes.map(serde_json::from_slice).transpose()?)
    }

    /// Returns all snapshots; `None` if they are not part of the block.
    ///
    /// # Errors
    /// [`BlockError`] if they are damaged.
    pub(in crate::store) fn snapshots(&self) -> Result<Option<Vec<Snapshot>>, BlockError> {
        let bytes = self.checked(Kind::Snapshots)?;
        Ok(bytes.map(serde_json::from_slice).transpose()?)
    }

    /// Returns a document (JSON) of the snapshot nearest to a cycle, of the earlier one of two.
    ///
    /// # Errors
    /// [`BlockError`] if the snapshots are damaged.
    pub(in crate::store) fn snapshot(
        &self,
        part: SnapshotPart,
        cycle: u64,
    ) -> Result<Option<String>, BlockError> {
        let Some(bytes) = self.checked(Kind::Snapshots)? else {
            return Ok(None);
        };
        let mut nearest: Option<(u64, &RawValue)> = None;
        for snapshot in serde_json::from_slice::<Vec<RawSnapshot<'_>>>(bytes)? {
            let document = match part {
                SnapshotPart::Profile => snapshot.profile,
                SnapshotPart::Pressure => snapshot.pressure,
                SnapshotPart::Loop => snapshot.friction_loop,
            };
            let OfCycle { cycle: found } = serde_json::from_str(document.get())?;
            let distance = found.abs_diff(cycle);
            if nearest.is_none_or(|(least, _)| distance < least) {
                nearest = Some((distance, document));
            }
        }
        Ok(nearest.map(|(_, document)| document.get().to_owned()))
    }

    /// Marks documents as damaged, or no longer; returns the new compressed entries if there is a change.
    ///
    /// # Errors
    /// If the entries cannot be written as JSON.
    pub(in crate::store) fn mark(
        &mut self,
        name: &str,
        how: Option<&str>,
    ) -> Result<Option<Vec<u8>>, serde_json::Error> {
        let mut entries = self.entries.iter_mut();
        let Some(entry) = entries.find(|entry| entry.file.name == name) else {
            return Ok(None);
        };
        if entry.file.damaged.as_deref() == how {
            return Ok(None);
        }
        entry.file.damaged = how.map(str::to_owned);
        Ok(Some(compress(&serde_json::to_vec(&self.entries)?)))
    }

    fn documents(&self) -> impl Iterator<Item = &ResultFile> {
        let is_document = |entry: &&Entry| entry.kind == Kind::Document;
        self.entries
            .iter()
            .filter(is_document)
            .map(|entry| &entry.file)
    }

    fn has_room(&self, bytes: usize) -> bool {
        self.content.len() + bytes <= LIMIT
    }

    fn push(&mut self, kind: Kind, file: ResultFile, bytes: &[u8]) {
        self.entries.push(Entry { kind, file });
        self.content.extend_from_slice(bytes);
    }

    /// Returns a part that is no document, after its check.
    fn checked(&self, kind: Kind) -> Result<Option<&[u8]>, BlockError> {
        let Some((entry, range)) = self.range(kind) else {
            return Ok(None);
        };
        let bytes = self.slice(range);
        checksum::check_bytes(entry, bytes).map_err(|cause| BlockError::Damaged {
            what: entry.name.clone(),
            cause,
        })?;
        Ok(Some(bytes))
    }

    fn range(&self, kind: Kind) -> Option<(&ResultFile, Range<usize>)> {
        let mut entries = self.entries.iter().zip(self.ranges());
        let (entry, range) = entries.find(|(entry, _)| entry.kind == kind)?;
        Some((&entry.file, range))
    }

    fn ranges(&self) -> impl Iterator<Item = Range<usize>> {
        self.entries.iter().scan(0_usize, |from, entry| {
            let length = usize::try_from(entry.file.bytes).unwrap_or(usize::MAX);
            let range = *from..from.saturating_add(length);
            *from = range.end;
            Some(range)
        })
    }

    /// The part of a range that could be decompressed.
    fn slice(&self, range: Range<usize>) -> &[u8] {
        let length = self.content.len();
        &self.content[range.start.min(length)..range.end.min(length)]
    }
}

#[cfg(test)]
mod tests;
