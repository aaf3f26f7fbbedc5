//! The documents of a job that ends, for its manifest.

use api::results::Summary;

use crate::export::documents;
use crate::export::documents::{Document, DocumentError, Results};
use crate::export::files;
use crate::export::files::FilesError;
use crate::store::{Claim, NewFile, Store, StoreError};

/// Documents up to this size are kept in the database, where they cost no file of their own; bytes. Below some 100 kB a
/// row is read faster than a file (sqlite.org/intern-v-extern-blob.html).
const INLINE_LIMIT: usize = 64 << 10;

/// Makes all documents; the large ones are written into the attempt's folder.
pub(super) async fn gather(
    store: &Store,
    claim: &Claim,
    summary: Option<&Summary>,
) -> Result<Vec<NewFile>, StoreError> {
    let rows = store.history(claim.id).await?;
    let snapshots = store.snapshots(claim.id).await?;
    let folder = store.attempt_folder(claim);
    let (spec, summary) = (claim.spec.clone(), summary.cloned());
    let made = tokio::task::spawn_blocking(move || {
        let spec = serde_json::from_str(&spec).map_err(DocumentError::from)?;
        let documents = documents::all(&Results {
            spec: &spec,
            summary: summary.as_ref(),
            rows: &rows,
            snapshots: &snapshots,
            // Whoever looks at a job has a browser, which draws the other form itself.
            pixels: false,
        })?;
        documents
            .into_iter()
            .map(|document| kept(&folder, document))
            .collect::<Result<Vec<_>, FilesError>>()
    })
    .await;
    match made {
        Ok(Ok(files)) => Ok(files),
        Ok(Err(FilesError::Write { path, cause })) => Err(StoreError::Prepare { path, cause }),
        // Rows and snapshots stay readable on their own routes; the same documents would fail again.
        Ok(Err(FilesError::Document(error))) => {
            tracing::error!(job = %claim.id, %error, "documents were left out of a manifest");
            Ok(Vec::new())
        }
        Err(error) => {
            tracing::error!(job = %claim.id, %error, "documents were left out of a manifest");
            Ok(Vec::new())
        }
    }
}

fn kept(folder: &std::path::Path, document: Document) -> Result<NewFile, FilesError> {
    let Document {
        name,
        cycle,
        media_type,
        bytes,
    } = document;
    let file = files::manifest_entry(&name, cycle, media_type, &bytes);
    let content = if bytes.len() <= INLINE_LIMIT {
        Some(bytes)
    } else {
        files::write_atomically(folder, &name, &bytes)?;
        None
    };
    Ok(NewFile { file, content })
}
