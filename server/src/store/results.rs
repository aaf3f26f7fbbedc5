//! Events and results as they are stored.

use std::io;
use std::io::SeekFrom;
use std::ops::Range;
use std::path::PathBuf;

use api::results::ResultFile;
use bytes::Bytes;
use futures_util::stream::BoxStream;
use futures_util::{TryStreamExt, stream};
use serde::{Deserialize, Serialize};
use tokio::fs::File;
use tokio::io::{AsyncReadExt, AsyncSeekExt};
use tokio_util::io::ReaderStream;

use crate::objects::{ObjectPart, ObjectsError};

/// Size of the chunks in which a file is read, bytes.
const CHUNK_BYTES: usize = 64 << 10;

/// A stored event.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct StoredEvent {
    /// Number within the job, from 1 without gaps.
    pub seq: i64,
    /// Name.
    pub name: String,
    /// Document, JSON.
    pub data: String,
}

/// A file to be added to a manifest.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct NewFile {
    /// Entry in the manifest.
    pub file: ResultFile,
    /// Content.
    pub content: NewContent,
}

/// Where the content of a new file is.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "snake_case")]
pub enum NewContent {
    /// Here.
    Inline(Vec<u8>),
    /// In a file of its name in the folder of the attempt.
    Folder,
    /// In an object of this key, which was written before ([`Store::put_file`](crate::store::Store::put_file)).
    Object(String),
}

/// Why a content cannot be read.
#[derive(Debug, thiserror::Error)]
pub enum ContentError {
    /// File.
    #[error(transparent)]
    File(#[from] io::Error),
    /// Object.
    #[error(transparent)]
    Object(#[from] ObjectsError),
}

/// Parts of a content, one after the other.
pub type Chunks = BoxStream<'static, io::Result<Bytes>>;

/// Content of a result file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Content {
    /// The bytes, from the database.
    Inline(Vec<u8>),
    /// Path of the file.
    File(PathBuf),
    /// A range of an object.
    Object(ObjectPart),
}

impl Content {
    /// Reads all of it.
    ///
    /// # Errors
    /// [`ContentError`].
    pub async fn read(self) -> Result<Vec<u8>, ContentError> {
        match self {
            Self::Inline(bytes) => Ok(bytes),
            Self::File(path) => Ok(tokio::fs::read(path).await?),
            Self::Object(part) => Ok(part.read().await?),
        }
    }

    /// Reads a range of it in chunks.
    ///
    /// # Errors
    /// [`ContentError`] if a file or an object cannot be opened.
    pub async fn chunks(self, range: Range<u64>) -> Result<Chunks, ContentError> {
        Ok(match self {
            Self::Inline(bytes) => {
                let index = |at: u64| usize::try_from(at).unwrap_or(usize::MAX).min(bytes.len());
                let (from, until) = (index(range.start), index(range.end));
                let part = Bytes::from(bytes).slice(from..until);
                Box::pin(stream::once(async { Ok(part) }))
            }
            Self::File(path) => {
                let mut file = File::open(path).await?;
                file.seek(SeekFrom::Start(range.start)).await?;
                let part = file.take(range.end - range.start);
                Box::pin(ReaderStream::with_capacity(part, CHUNK_BYTES))
            }
            Self::Object(part) => {
                let chunks = part.stream(range).await?;
                Box::pin(chunks.map_err(io::Error::other))
            }
        })
    }
}

/// A document of a snapshot.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum SnapshotPart {
    /// Worn depth.
    Profile,
    /// Contact tractions.
    Pressure,
    /// Friction loop.
    Loop,
}

impl SnapshotPart {
    /// The column that has it.
    pub(in crate::store) fn column(self) -> &'static str {
        match self {
            Self::Profile => "profile",
            Self::Pressure => "pressure",
            Self::Loop => "friction_loop",
        }
    }
}
