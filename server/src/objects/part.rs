//! A range of an object.

use std::ops::Range;

use bytes::Bytes;
use futures_util::TryStreamExt;
use futures_util::stream::BoxStream;
use object_store::path::Path;
use object_store::{GetOptions, GetRange, ObjectStore};

use super::{Objects, ObjectsError};

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
    /// A range of an object, to be read later.
    pub fn new(objects: &Objects, key: &str, range: Range<u64>) -> Self {
        Self {
            objects: objects.clone(),
            key: key.to_owned(),
            range,
        }
    }

    /// Key of the object.
    pub(super) fn key(&self) -> &str {
        &self.key
    }

    /// Length of the whole object, bytes.
    ///
    /// # Errors
    /// [`ObjectsError`].
    pub async fn object_length(&self) -> Result<u64, ObjectsError> {
        self.objects.length(&self.key).await
    }

    /// Length, bytes.
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
        if from >= until {
            return Ok(Box::pin(futures_util::stream::empty()));
        }
        let path = Path::from(&*self.key);
        let options = GetOptions::new().with_range(Some(GetRange::Bounded(from..until)));
        let opened = self.objects.store.get_opts(&path, options);
        let opened = match opened.await {
            Ok(opened) => opened,
            Err(cause) => return Err(self.objects.failed_with(&self.key, cause).await),
        };
        let objects = self.objects.clone();
        let chunks = opened.into_stream();
        Ok(Box::pin(chunks.map_err(move |cause| objects.failed(cause))))
    }
}
