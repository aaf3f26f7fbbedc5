//! Files of manifests, from their rows.

use api::results::ResultFile;
use uuid::Uuid;

use crate::store::folder::Folder;
use crate::store::rows::{StoredRow, corrupt, entry};
use crate::store::{Content, StoreError};

/// A file and its content: in its row, or at a place in the folder of large results.
pub(in crate::store) fn file(
    folder: &Folder,
    id: Uuid,
    row: &impl StoredRow,
) -> Result<(ResultFile, Content), StoreError> {
    let content = if let Some(content) = row.optional_bytes("content")? {
        Content::Inline(content)
    } else {
        let place = row.text("place")?;
        let path = folder.path(&place);
        Content::File(path.ok_or_else(|| corrupt(id, "path of a file", &place))?)
    };
    Ok((entry(row)?, content))
}
