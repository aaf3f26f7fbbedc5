//! Files that belong into an object, and how they are written.

use std::io;
use std::path::PathBuf;
use std::sync::Arc;

use bytes::Bytes;
use futures_util::stream::BoxStream;
use futures_util::{StreamExt, TryStreamExt, stream};
use object_store::buffered::BufWriter;
use object_store::path::Path;
use sha2::{Digest, Sha256};
use tokio::io::AsyncWriteExt;
use tokio_util::io::ReaderStream;

use super::{ObjectPart, Objects, ObjectsError};
use crate::export::files::{hexadecimal, sha256};

/// Length of the parts of a large object, and how many of them are sent at the same time: their memory is taken for each writer.
const PART_BYTES: usize = 8 << 20;
const PARTS: usize = 2;
/// Size of the chunks in which a file is read, bytes.
const CHUNK_BYTES: usize = 64 << 10;

/// A file that belongs into an object.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct ObjectFile {
    /// Place of the content.
    pub source: Source,
    /// Length.
    pub bytes: u64,
    /// SHA-256, hexadecimal.
    pub sha256: String,
}

/// Place of the content of a file.
#[derive(Debug, Clone, PartialEq, Eq)]
pub enum Source {
    /// On this machine.
    File(PathBuf),
    /// In an object.
    Object(ObjectPart),
    /// In memory.
    Bytes(Bytes),
}

impl Objects {
    /// Writes an object: bytes, and the contents of files behind them, which are compared with what they should be. After an error there may be
    /// an object or not.
    ///
    /// # Errors
    /// [`ObjectsError`].
    pub async fn put(
        &self,
        key: &str,
        head: &[u8],
        files: &[ObjectFile],
    ) -> Result<(), ObjectsError> {
        self.check_folder()?;
        let path = Path::from(key);
        let mut writer = BufWriter::with_capacity(Arc::clone(&self.store), path, PART_BYTES)
            .with_max_concurrency(PARTS);
        let failed = |cause: std::io::Error| self.failed(cause);
        let written = async {
            writer.write_all(head).await.map_err(failed)?;
            for file in files {
                self.append(&mut writer, file).await?;
            }
            Ok(())
        };
        let written = written.await;
        if written.is_err() {
            // Parts that cannot be removed are an incomplete upload, which the rules of a bucket remove.
            let _ = writer.abort().await;
            return written;
        }
        writer.shutdown().await.map_err(failed)?;
        self.check_folder()
    }

    /// Writes a file, and compares length and checksum.
    async fn append(&self, writer: &mut BufWriter, file: &ObjectFile) -> Result<(), ObjectsError> {
        let (mut bytes, mut sha256) = (0, Sha256::new());
        let mut chunks = file.source.open().await?;
        while let Some(chunk) = chunks.next().await {
            let chunk = chunk?;
            sha256.update(&chunk);
            bytes += u64::try_from(chunk.len()).unwrap_or(u64::MAX);
            let written = writer.write_all(&chunk).await;
            written.map_err(|cause| self.failed(cause))?;
        }
        file.check(bytes, &hexadecimal(&sha256.finalize()))
    }
}

impl ObjectFile {
    /// Reads the whole file.
    ///
    /// # Errors
    /// [`ObjectsError`] if it cannot be read, or is missing or another one.
    pub async fn read(&self) -> Result<Vec<u8>, ObjectsError> {
        let (mut bytes, mut chunks) = (Vec::new(), self.source.open().await?);
        while let Some(chunk) = chunks.next().await {
            bytes.extend_from_slice(&chunk?);
        }
        let length = u64::try_from(bytes.len()).unwrap_or(u64::MAX);
        self.check(length, &sha256(&bytes))?;
        Ok(bytes)
    }

    /// Compares length and checksum of what was read.
    fn check(&self, bytes: u64, sha256: &str) -> Result<(), ObjectsError> {
        if (bytes, sha256) == (self.bytes, &self.sha256) {
            return Ok(());
        }
        Err(self.source.damaged(format!(
            "it has {bytes} bytes with the SHA-256 {sha256}, and should have {} with {}",
            self.bytes, self.sha256
        )))
    }
}

impl Source {
    /// Reads the file in chunks.
    async fn open(&self) -> Result<BoxStream<'static, Result<Bytes, ObjectsError>>, ObjectsError> {
        match self {
            Self::File(path) => {
                let file = tokio::fs::File::open(path).await;
                let file = file.map_err(|cause| unread(path.clone(), cause))?;
                let chunks = ReaderStream::with_capacity(file, CHUNK_BYTES);
                let path = path.clone();
                Ok(chunks
                    .map_err(move |cause| unread(path.clone(), cause))
                    .boxed())
            }
            Self::Object(part) => match part.stream(0..part.length()).await {
                Err(error @ ObjectsError::Missing(_)) => Err(self.damaged(error.to_string())),
                chunks => chunks,
            },
            Self::Bytes(bytes) => {
                let bytes = bytes.clone();
                Ok(stream::once(async { Ok(bytes) }).boxed())
            }
        }
    }

    /// The error of a file that is missing or another one.
    fn damaged(&self, how: String) -> ObjectsError {
        let what = match self {
            Self::File(path) => path.display().to_string(),
            Self::Object(part) => format!("the object {}", part.key()),
            Self::Bytes(_) => "a file of the database".to_owned(),
        };
        ObjectsError::Damaged { what, how }
    }
}

/// The error of a file that cannot be read.
fn unread(path: PathBuf, cause: io::Error) -> ObjectsError {
    match cause.kind() {
        io::ErrorKind::NotFound => ObjectsError::Damaged {
            what: path.display().to_string(),
            how: "it does not exist".to_owned(),
        },
        _ => ObjectsError::File { path, cause },
    }
}
