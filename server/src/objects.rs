//! Objects: results of ended jobs in a store of objects, a folder (`file:///PATH`) or a bucket (`s3://BUCKET/PREFIX`), by the crate
//! `object_store`. An object is written once, whole or not at all, and never changed. Knows neither jobs nor SQL.

use std::fmt;
use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use bytes::Bytes;
use futures_util::TryStreamExt;
use futures_util::stream::BoxStream;
use object_store::aws::AmazonS3Builder;
use object_store::buffered::BufWriter;
use object_store::local::LocalFileSystem;
use object_store::path::Path;
use object_store::prefix::PrefixStore;
use object_store::{GetOptions, GetRange, ObjectStore, ObjectStoreExt, RetryConfig};
use tokio::io::{AsyncWriteExt, copy};

/// Retries of a request, and the longest time for them: the caller tries again later, too.
const RETRIES: usize = 3;
const RETRY_TIMEOUT: Duration = Duration::from_secs(10);

/// Why an object cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum ObjectsError {
    /// No address of a store.
    #[error(
        "`{0}` is not the address of a store of objects such as s3://bucket/prefix or file:///path"
    )]
    Address(String),
    /// A file that belongs into an object cannot be read.
    #[error("cannot read {}: {cause}", .path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// The system's error.
        cause: std::io::Error,
    },
    /// There is no such object.
    #[error("the object {0} does not exist")]
    Missing(String),
    /// The store of objects refused a request or cannot be reached.
    #[error("{location}: {cause}")]
    Store {
        /// Its address.
        location: String,
        /// The cause.
        cause: Box<dyn std::error::Error + Send + Sync>,
    },
}

/// A store of objects.
#[derive(Clone)]
pub struct Objects {
    store: Arc<dyn ObjectStore>,
    location: Arc<str>,
}

impl fmt::Debug for Objects {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_tuple("Objects").field(&self.location).finish()
    }
}

impl Objects {
    /// The store at an address. A bucket's endpoint, region and keys are those of the environment (`AWS_ENDPOINT_URL`, `AWS_REGION`,
    /// `AWS_ACCESS_KEY_ID`, ..), or those of the machine's role; a folder is created.
    ///
    /// # Errors
    /// [`ObjectsError`] if it is none, or if it lacks something; whether it can be reached is not checked.
    pub fn open(address: &str) -> Result<Self, ObjectsError> {
        let failed = |cause: Box<dyn std::error::Error + Send + Sync>| ObjectsError::Store {
            location: address.to_owned(),
            cause,
        };
        let store: Arc<dyn ObjectStore> = if let Some(folder) = address.strip_prefix("file://")
            && folder.starts_with('/')
        {
            fs_err::create_dir_all(folder).map_err(|cause| failed(cause.into()))?;
            let local = LocalFileSystem::new_with_prefix(folder);
            let local = local.map_err(|cause| failed(cause.into()))?;
            Arc::new(local.with_fsync(true))
        } else if let Some(bucket) = address.strip_prefix("s3://")
            && let (bucket, prefix) = bucket.split_once('/').unwrap_or((bucket, ""))
            && !bucket.is_empty()
        {
            let prefix = Path::parse(prefix).map_err(|cause| failed(cause.into()))?;
            let retry = RetryConfig {
                max_retries: RETRIES,
                retry_timeout: RETRY_TIMEOUT,
                ..RetryConfig::default()
            };
            let bucket = AmazonS3Builder::from_env().with_bucket_name(bucket);
            let bucket = bucket.with_retry(retry).build();
            let bucket = bucket.map_err(|cause| failed(cause.into()))?;
            Arc::new(PrefixStore::new(bucket, prefix))
        } else {
            return Err(ObjectsError::Address(address.to_owned()));
        };
        Ok(Self {
            store,
            location: address.trim_end_matches('/').into(),
        })
    }

    /// Its address.
    pub fn location(&self) -> &str {
        &self.location
    }

    /// Writes an object: bytes, and the contents of files of these lengths behind them. After an error there may be an object or not.
    ///
    /// # Errors
    /// [`ObjectsError`].
    pub async fn put(
        &self,
        key: &str,
        head: &[u8],
        files: &[(PathBuf, u64)],
    ) -> Result<(), ObjectsError> {
        let mut writer = BufWriter::new(Arc::clone(&self.store), Path::from(key));
        let failed = |cause: std::io::Error| self.failed(cause.into());
        let written = async {
            writer.write_all(head).await.map_err(failed)?;
            for (path, bytes) in files {
                let unread = |cause| ObjectsError::File {
                    path: path.clone(),
                    cause,
                };
                let mut file = tokio::fs::File::open(path).await.map_err(unread)?;
                let copied = copy(&mut file, &mut writer).await.map_err(failed)?;
                if copied != *bytes {
                    let cause = format!("it has {copied} bytes instead of {bytes}");
                    return Err(unread(std::io::Error::other(cause)));
                }
            }
            Ok(())
        };
        let written = written.await;
        if written.is_err() {
            // Parts that cannot be removed are an incomplete upload, which the rules of a bucket remove.
            let _ = writer.abort().await;
            return written;
        }
        writer.shutdown().await.map_err(failed)
    }

    /// Reads a range of an object.
    ///
    /// # Errors
    /// [`ObjectsError`].
    pub async fn get(&self, key: &str, range: Range<u64>) -> Result<Vec<u8>, ObjectsError> {
        if range.is_empty() {
            return Ok(Vec::new());
        }
        let bytes = self.store.get_range(&Path::from(key), range).await;
        Ok(bytes.map_err(|cause| self.failed_with(key, cause))?.into())
    }

    /// A range of an object, to be read later.
    pub fn part(&self, key: &str, range: Range<u64>) -> ObjectPart {
        ObjectPart::new(self.clone(), key.to_owned(), range)
    }

    /// Removes an object; there may be none.
    ///
    /// # Errors
    /// [`ObjectsError`].
    pub async fn remove(&self, key: &str) -> Result<(), ObjectsError> {
        match self.store.delete(&Path::from(key)).await {
            Ok(()) | Err(object_store::Error::NotFound { .. }) => Ok(()),
            Err(cause) => Err(self.failed_with(key, cause)),
        }
    }

    /// Checks that the store can be reached and read.
    ///
    /// # Errors
    /// [`ObjectsError`].
    pub async fn check(&self) -> Result<(), ObjectsError> {
        let first = self.store.list(None).try_next().await;
        first.map(drop).map_err(|cause| self.failed(cause.into()))
    }

    fn failed(&self, cause: Box<dyn std::error::Error + Send + Sync>) -> ObjectsError {
        ObjectsError::Store {
            location: self.location.to_string(),
            cause,
        }
    }

    fn failed_with(&self, key: &str, cause: object_store::Error) -> ObjectsError {
        match cause {
            object_store::Error::NotFound { .. } => ObjectsError::Missing(key.to_owned()),
            cause => self.failed(cause.into()),
        }
    }
}

/// A range of an object.
#[derive(Debug, Clone)]
pub struct ObjectPart {
    objects: Objects,
    key: String,
    range: Range<u64>,
}

impl PartialEq for ObjectPart {
    /// An object never changes.
    fn eq(&self, other: &Self) -> bool {
        (&self.key, &self.range) == (&other.key, &other.range)
    }
}

impl Eq for ObjectPart {}

impl ObjectPart {
    fn new(objects: Objects, key: String, range: Range<u64>) -> Self {
        Self {
            objects,
            key,
            range,
        }
    }

    /// Its length, bytes.
    pub fn length(&self) -> u64 {
        self.range.end - self.range.start
    }

    /// Reads all of it.
    ///
    /// # Errors
    /// [`ObjectsError`].
    pub async fn read(&self) -> Result<Vec<u8>, ObjectsError> {
        self.objects.get(&self.key, self.range.clone()).await
    }

    /// Reads a range of it, in chunks.
    ///
    /// # Errors
    /// [`ObjectsError`] if it cannot be opened.
    pub async fn stream(
        &self,
        within: Range<u64>,
    ) -> Result<BoxStream<'static, Result<Bytes, ObjectsError>>, ObjectsError> {
        let from = self.range.start + within.start;
        let until = self.range.end.min(self.range.start + within.end);
        let path = Path::from(&*self.key);
        let options = GetOptions::new().with_range(Some(GetRange::Bounded(from..until)));
        let opened = self.objects.store.get_opts(&path, options);
        let opened = opened
            .await
            .map_err(|cause| self.objects.failed_with(&self.key, cause))?;
        let (objects, key) = (self.objects.clone(), self.key.clone());
        let chunks = opened.into_stream();
        Ok(Box::pin(
            chunks.map_err(move |cause| objects.failed_with(&key, cause)),
        ))
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[tokio::test]
    async fn an_object_has_its_head_and_its_files_and_is_read_in_parts() {
        let folder = tempfile::tempdir().expect("a folder");
        let file = folder.path().join("a.vtu");
        std::fs::write(&file, "fields").expect("written");
        let address = format!("file://{}/objects", folder.path().display());
        let objects = Objects::open(&address).expect("opened");
        objects.check().await.expect("it can be reached");
        let files = [(file.clone(), 6), (file, 6)];
        let written = objects.put("jobs/1/a", b"head", &files).await;
        written.expect("written");
        let whole = objects.get("jobs/1/a", 0..16).await.expect("read");
        assert_eq!(whole, b"headfieldsfields");
        let part = objects.part("jobs/1/a", 4..10);
        assert_eq!(part.read().await.expect("read"), b"fields");
        let some: Vec<_> = part
            .stream(2..5)
            .await
            .expect("a stream")
            .try_collect()
            .await
            .expect("read");
        assert_eq!(some.concat(), b"eld");
        objects.remove("jobs/1/a").await.expect("removed");
        objects
            .remove("jobs/1/a")
            .await
            .expect("a repeated request");
        let gone = objects.get("jobs/1/a", 0..4).await;
        assert!(matches!(gone, Err(ObjectsError::Missing(_))), "{gone:?}");
    }

    #[tokio::test]
    async fn an_object_whose_files_are_missing_is_not_written() {
        let folder = tempfile::tempdir().expect("a folder");
        let objects = Objects::open(&format!("file://{}", folder.path().display()));
        let objects = objects.expect("opened");
        let shorter = folder.path().join("a.vtu");
        std::fs::write(&shorter, "field").expect("written");
        for file in [folder.path().join("b.vtu"), shorter] {
            let written = objects.put("a", b"head", &[(file, 6)]).await;
            assert!(
                matches!(written, Err(ObjectsError::File { .. })),
                "{written:?}"
            );
            assert!(objects.get("a", 0..4).await.is_err());
        }
    }

    #[test]
    fn other_addresses_are_refused() {
        for address in [
            "",
            "objects",
            "file://relative",
            "s3://",
            "gs://bucket",
            "sqlite://x.db",
        ] {
            let opened = Objects::open(address);
            assert!(matches!(opened, Err(ObjectsError::Address(_))), "{address}");
        }
    }
}
