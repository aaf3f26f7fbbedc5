//! Findings of a verification, for contents in objects and elsewhere.

use std::ops::Range;

use api::results::ResultFile;
use futures_util::StreamExt;

use crate::objects::{ObjectPart, Objects, ObjectsError};
use crate::store::IntegrityError;
use crate::store::checksum::Checksum;

/// Finding of the verification of a content.
#[derive(Debug)]
pub(in crate::store) enum CheckedRead {
    /// Compared with its checksum; the damage, if any.
    Compared(Option<String>),
    /// The object is missing.
    Missing(String),
    /// Deleted or replaced meanwhile.
    Gone,
    /// Unreadable at present.
    Unread(String),
    /// Stored elsewhere: in the folder of another machine, or by the original of a copy.
    Elsewhere(String),
}

impl From<Result<(), IntegrityError>> for CheckedRead {
    fn from(checked: Result<(), IntegrityError>) -> Self {
        match checked {
            Ok(()) => Self::Compared(None),
            Err(cause) if cause.is_damage() => Self::Compared(Some(cause.to_string())),
            Err(cause) => Self::Unread(cause.to_string()),
        }
    }
}

/// Compares a range of an object with an entry.
pub(in crate::store) async fn object(
    objects: &Objects,
    key: &str,
    range: Range<u64>,
    entry: &ResultFile,
) -> CheckedRead {
    let end = range.end;
    match checksum(&ObjectPart::new(objects, key, range)).await {
        Ok(found) => found.compare(entry).into(),
        Err(cause) => failed(objects, key, end, cause).await,
    }
}

/// Finding after an error of a request for the first bytes of an object: a short object is damaged, whatever its store reports.
pub(in crate::store) async fn failed(
    objects: &Objects,
    key: &str,
    bytes: u64,
    cause: ObjectsError,
) -> CheckedRead {
    if let ObjectsError::Missing(_) = cause {
        return CheckedRead::Missing(cause.to_string());
    }
    match objects.length(key).await {
        Ok(length) if length < bytes => CheckedRead::Compared(Some(format!(
            "the object {key} has {length} bytes, at least {bytes} are named"
        ))),
        _ => CheckedRead::Unread(cause.to_string()),
    }
}

/// Runs a long check on a thread for blocking operations.
pub(in crate::store) async fn in_background(
    check: impl FnOnce() -> Result<(), IntegrityError> + Send + 'static,
) -> Result<(), IntegrityError> {
    let checked = tokio::task::spawn_blocking(check).await;
    checked.unwrap_or_else(|cause| Err(std::io::Error::other(cause).into()))
}

/// The checksum of a part of an object.
async fn checksum(part: &ObjectPart) -> Result<Checksum, ObjectsError> {
    let mut checksum = Checksum::default();
    let mut chunks = part.stream(0..part.length()).await?;
    while let Some(chunk) = chunks.next().await {
        checksum.update(&chunk?);
    }
    Ok(checksum)
}
