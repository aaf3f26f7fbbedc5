//! Objects: results of ended jobs, checkpoints and files of attempts in a store of objects, a folder (`file:///PATH`) or a bucket (`s3://BUCKET/PREFIX`), by the crate
//! `object_store`. An object is written once, whole or not at all, and never changed. Knows neither jobs nor SQL.

mod files;
mod part;

use std::fmt;
use std::ops::Range;
use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use object_store::aws::{AmazonS3Builder, AmazonS3ConfigKey};
use object_store::local::LocalFileSystem;
use object_store::path::Path;
use object_store::prefix::PrefixStore;
use object_store::{ClientConfigKey, ObjectStore, ObjectStoreExt, RetryConfig};

pub use files::{ObjectFile, Source};
pub use part::ObjectPart;

/// Retries of a request, and the longest time for them: the caller tries again later, too.
const RETRIES: usize = 3;
const RETRY_TIMEOUT: Duration = Duration::from_secs(10);
/// Longest time of a request: an object is read as slowly as a user's line takes it. The default of the crate, 30 s, is for all of it.
const LONGEST: &str = "1day";
/// Longest time without any bytes.
const READ_TIMEOUT: &str = "30s";
/// Key of the object that marks a store: one without it is another one, or a folder that is not mounted.
const MARK: &str = "fretwear-objects";

/// Why an object cannot be used.
#[derive(Debug, thiserror::Error)]
pub enum ObjectsError {
    /// No address of a store.
    #[error(
        "`{0}` is not the address of a store of objects such as s3://bucket/prefix or file:///path"
    )]
    Address(String),
    /// A file that belongs into an object cannot be read at present.
    #[error("cannot read {}: {cause}", .path.display())]
    File {
        /// The file.
        path: PathBuf,
        /// The system's error.
        cause: std::io::Error,
    },
    /// A file that belongs into an object is missing or another one.
    #[error("{what} is damaged: {how}")]
    Damaged {
        /// The file.
        what: String,
        /// The difference.
        how: String,
    },
    /// There is no such object.
    #[error("the object {0} does not exist")]
    Missing(String),
    /// The store has no mark: nothing is known to be missing there, and nothing is to be written.
    #[error(
        "{0} has no object {MARK}, which marks the store of this database; it is another one, or is not mounted"
    )]
    Unmarked(String),
    /// The store of objects refused a request or cannot be reached.
    #[error("{location}: {cause}")]
    Store {
        /// Address.
        location: String,
        /// The cause.
        cause: Box<dyn std::error::Error + Send + Sync>,
    },
}

impl ObjectsError {
    /// Checks whether the store refuses its settings: keys, rights or the name of its bucket.
    pub fn is_of_settings(&self) -> bool {
        let Self::Store { cause, .. } = self else {
            return false;
        };
        matches!(
            cause.downcast_ref(),
            Some(
                object_store::Error::NotFound { .. }
                    | object_store::Error::PermissionDenied { .. }
                    | object_store::Error::Unauthenticated { .. }
            )
        )
    }
}

/// A store of objects.
#[derive(Clone)]
pub struct Objects {
    store: Arc<dyn ObjectStore>,
    location: Arc<str>,
    /// Where it is a folder.
    folder: Option<PathBuf>,
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
        let folder = address.strip_prefix("file://");
        let folder = folder.filter(|folder| folder.starts_with('/'));
        let store: Arc<dyn ObjectStore> = if let Some(folder) = folder {
            fs_err::create_dir_all(folder).map_err(|cause| failed(cause.into()))?;
            let local = LocalFileSystem::new_with_prefix(folder);
            let local = local.map_err(|cause| failed(cause.into()))?;
            Arc::new(local.with_fsync(true).with_automatic_cleanup(true))
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
            let bucket = bucket
                .with_retry(retry)
                .with_config(AmazonS3ConfigKey::Client(ClientConfigKey::Timeout), LONGEST)
                .with_config(
                    AmazonS3ConfigKey::Client(ClientConfigKey::ReadTimeout),
                    READ_TIMEOUT,
                )
                .build();
            let bucket = bucket.map_err(|cause| failed(cause.into()))?;
            Arc::new(PrefixStore::new(bucket, prefix))
        } else {
            return Err(ObjectsError::Address(address.to_owned()));
        };
        Ok(Self {
            store,
            location: address.trim_end_matches('/').into(),
            folder: folder.map(PathBuf::from),
        })
    }

    /// Address.
    pub fn location(&self) -> &str {
        &self.location
    }

    /// Checks whether the store has its mark.
    ///
    /// # Errors
    /// [`ObjectsError`] if it cannot be reached.
    pub async fn is_marked(&self) -> Result<bool, ObjectsError> {
        match self.store.head(&Path::from(MARK)).await {
            Ok(_) => Ok(true),
            Err(object_store::Error::NotFound { .. }) => Ok(false),
            Err(cause) => Err(self.failed(cause)),
        }
    }

    /// Writes the mark of the store.
    ///
    /// # Errors
    /// [`ObjectsError`].
    pub async fn mark(&self) -> Result<(), ObjectsError> {
        let text = "Objects of fretwear are here. Without this one they are not read, written or removed.\n";
        let put = self.store.put(&Path::from(MARK), text.into()).await;
        put.map_err(|cause| self.failed(cause))?;
        Ok(())
    }

    /// Writes an object in one request: nothing of it is left if that is given up.
    ///
    /// # Errors
    /// [`ObjectsError`].
    pub async fn put_whole(&self, key: &str, bytes: Vec<u8>) -> Result<(), ObjectsError> {
        self.check_folder()?;
        let put = self.store.put(&Path::from(key), bytes.into()).await;
        put.map_err(|cause| self.failed(cause))?;
        self.check_folder()
    }

    /// Reads a range of an object.
    ///
    /// # Errors
    /// [`ObjectsError`].
    pub async fn get(&self, key: &str, range: Range<u64>) -> Result<Vec<u8>, ObjectsError> {
        if range.is_empty() {
            return Ok(Vec::new());
        }
        match self.store.get_range(&Path::from(key), range).await {
            Ok(bytes) => Ok(bytes.into()),
            Err(cause) => Err(self.failed_with(key, cause).await),
        }
    }

    /// Reads an object.
    ///
    /// # Errors
    /// [`ObjectsError`].
    pub async fn get_all(&self, key: &str) -> Result<Vec<u8>, ObjectsError> {
        let read = async { self.store.get(&Path::from(key)).await?.bytes().await };
        match read.await {
            Ok(bytes) => Ok(bytes.into()),
            Err(cause) => Err(self.failed_with(key, cause).await),
        }
    }

    /// Length of an object, bytes.
    ///
    /// # Errors
    /// [`ObjectsError`].
    pub async fn length(&self, key: &str) -> Result<u64, ObjectsError> {
        match self.store.head(&Path::from(key)).await {
            Ok(object) => Ok(object.size),
            Err(cause) => Err(self.failed_with(key, cause).await),
        }
    }

    /// Removes an object; there may be none.
    ///
    /// # Errors
    /// [`ObjectsError`].
    pub async fn remove(&self, key: &str) -> Result<(), ObjectsError> {
        let Err(cause) = self.store.delete(&Path::from(key)).await else {
            return Ok(());
        };
        match self.failed_with(key, cause).await {
            ObjectsError::Missing(_) => Ok(()),
            error => Err(error),
        }
    }

    /// Checks the mark of a folder, before and after an object is written: what is not mounted takes one all the same.
    fn check_folder(&self) -> Result<(), ObjectsError> {
        match &self.folder {
            Some(folder) if !folder.join(MARK).exists() => Err(self.unmarked()),
            _ => Ok(()),
        }
    }

    fn unmarked(&self) -> ObjectsError {
        ObjectsError::Unmarked(self.location.to_string())
    }

    /// The error of a request that failed.
    pub fn failed(
        &self,
        cause: impl Into<Box<dyn std::error::Error + Send + Sync>>,
    ) -> ObjectsError {
        ObjectsError::Store {
            location: self.location.to_string(),
            cause: cause.into(),
        }
    }

    /// The error of a request for an object: it is missing only in a store with the mark.
    async fn failed_with(&self, key: &str, cause: object_store::Error) -> ObjectsError {
        let object_store::Error::NotFound { .. } = cause else {
            return self.failed(cause);
        };
        match self.is_marked().await {
            Ok(true) => ObjectsError::Missing(key.to_owned()),
            Ok(false) => self.unmarked(),
            Err(error) => error,
        }
    }
}

#[cfg(test)]
mod tests;
