//! Files of manifests, from their rows.

use api::results::ResultFile;
use uuid::Uuid;

use crate::objects::{ObjectPart, Source};
use crate::store::process_state::ProcessState;
use crate::store::rows::{StoredRow, corrupt, entry};
use crate::store::{Content, StoreError};

/// A file and its content.
pub(in crate::store) fn file(
    process: &ProcessState,
    id: Uuid,
    row: &impl StoredRow,
    object: Option<&str>,
) -> Result<(ResultFile, Content), StoreError> {
    if let Some(content) = row.value("content")? {
        return Ok((entry(row)?, Content::Inline(content)));
    }
    let entry = entry(row)?;
    let content = match source(process, id, &entry, row, object)? {
        Some(Source::File(path)) => Content::File(path),
        Some(Source::Object(part)) => Content::Object(part),
        Some(Source::Bytes(_)) | None => {
            return Err(corrupt(id, "row of a file", &entry.name));
        }
    };
    Ok((entry, content))
}

/// Where the content of a file is: in an object, or at a place in the folder of large results; `None` if it is in its row.
pub(in crate::store) fn source(
    process: &ProcessState,
    id: Uuid,
    entry: &ResultFile,
    row: &impl StoredRow,
    object: Option<&str>,
) -> Result<Option<Source>, StoreError> {
    if let Some(key) = object {
        let objects = process.objects.as_ref().ok_or(StoreError::NoObjects)?;
        let part = ObjectPart::new(objects, key, 0..entry.bytes);
        return Ok(Some(Source::Object(part)));
    }
    let Some(place) = row.value::<Option<String>>("place")? else {
        return Ok(None);
    };
    let path = process.folder.path(&place);
    let path = path.ok_or_else(|| corrupt(id, "path of a file", &place))?;
    Ok(Some(Source::File(path)))
}
