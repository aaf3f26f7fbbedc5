//! The documents of a job that ends.

use std::path::{Path, PathBuf};
use std::sync::Arc;

use api::results::Summary;
use api::spec::Spec;
use uuid::Uuid;

use crate::export::documents;
use crate::export::documents::{Document, DocumentError, Results};
use crate::export::files;
use crate::export::files::FilesError;
use crate::store::block::{Block, EncodedBlock};
use crate::store::{NewContent, NewFile, StoreError};
use crate::worker::computed::Computed;

/// Largest document that is stored in the block of the database instead of a file, bytes. Below some 100 kB a row is read
/// faster than a file (sqlite.org/intern-v-extern-blob.html).
const INLINE_LIMIT: usize = 64 << 10;

/// Documents of a job that ends: files, which are in the folder of the attempt, and a block.
pub(super) type Documents = (Vec<NewFile>, Option<EncodedBlock>);

/// Makes all documents of a job: the small ones as a block with history and snapshots, the large ones as files in the
/// attempt's folder. Documents that cannot be made are logged and missing.
///
/// # Errors
/// [`StoreError::Prepare`] if a file cannot be written.
pub(super) async fn make_documents(
    folder: PathBuf,
    job: Uuid,
    spec: Spec,
    summary: Option<&Summary>,
    computed: Arc<Computed>,
) -> Result<Documents, StoreError> {
    let summary = summary.cloned();
    let made = tokio::task::spawn_blocking(move || {
        let documents = documents::all(&Results {
            spec: &spec,
            summary: summary.as_ref(),
            rows: &computed.rows,
            snapshots: &computed.snapshots,
            // Users of the service have a browser, which draws SVG.
        })?;
        let mut block = Block::default();
        block
            .push_history(&computed.rows, &computed.snapshots)
            .map_err(DocumentError::from)?;
        let mut files = Vec::new();
        for document in documents {
            files.extend(write(&folder, document, &mut block)?);
        }
        let block = block.encode().map_err(DocumentError::from)?;
        Ok((files, Some(block)))
    })
    .await;
    match made {
        Ok(Ok(files)) => return Ok(files),
        Ok(Err(FilesError::Write { path, cause })) => {
            return Err(StoreError::Prepare { path, cause });
        }
        // A retry would fail again; rows and snapshots remain readable on their own routes.
        Ok(Err(FilesError::Document(error))) => {
            tracing::error!(%job, %error, "documents are missing from a manifest");
        }
        Err(error) => {
            tracing::error!(%job, %error, "documents are missing from a manifest");
        }
    }
    Ok((Vec::new(), None))
}

/// Adds a document to the block, or writes its file.
fn write(
    folder: &Path,
    document: Document,
    block: &mut Block,
) -> Result<Option<NewFile>, FilesError> {
    let Document { name, bytes, .. } = document;
    let file = files::manifest_entry(&name, document.cycle, document.media_type, &bytes);
    if bytes.len() <= INLINE_LIMIT && block.push_document(&file, &bytes) {
        return Ok(None);
    }
    files::write_atomically(folder, &name, &bytes)?;
    Ok(Some(NewFile {
        file,
        content: NewContent::Folder,
    }))
}
