//! Result files that are checked before they are sent.

use api::results::ResultFile;
use uuid::Uuid;

use crate::http::app::App;
use crate::http::problem::{ProblemResponse, ProblemType, RouteError};
use crate::store::{Content, IntegrityError, integrity};

/// Largest file that is checked as a whole before the first byte is sent, bytes. The length of every file is checked; the
/// checksum of a larger one while it is sent, unless it was found to be damaged before.
const CHECKED_FIRST: u64 = 8 << 20;

/// A file whose content differs from its entry in the manifest.
#[derive(Debug, thiserror::Error)]
#[error("{name} of job {id} is damaged: {cause}")]
pub(super) struct DamagedFile {
    id: Uuid,
    name: String,
    cause: IntegrityError,
}

impl RouteError for DamagedFile {
    const TYPE: ProblemType = ProblemType::RESULT_DAMAGED;
}

/// A file that has been checked.
#[derive(Debug)]
pub(super) struct VerifiedFile {
    /// Its entry.
    pub(super) entry: ResultFile,
    /// Its content.
    pub(super) content: Content,
    /// Whether its checksum was compared too, not only its length.
    pub(super) is_complete: bool,
}

impl App {
    /// Returns a file of a manifest after its check; `None` if there is no such file.
    pub(super) async fn verified_file(
        &self,
        id: Uuid,
        name: &str,
    ) -> Result<Option<VerifiedFile>, ProblemResponse> {
        let Some((entry, content)) = self.store.result_file(id, name).await? else {
            return Ok(None);
        };
        let is_complete = entry.bytes <= CHECKED_FIRST || entry.damaged.is_some();
        let check = move || {
            let checked = if is_complete {
                integrity::check(&entry, &content)
            } else {
                integrity::check_length(&entry, &content)
            };
            (entry, content, checked)
        };
        let (entry, content, checked) = tokio::task::spawn_blocking(check).await?;
        if let Err(cause) = checked {
            return Err(self.damaged(id, &entry.name, cause).await.into());
        }
        if entry.damaged.is_some() {
            self.store.mark_damaged(id, &entry.name, None).await?;
        }
        Ok(Some(VerifiedFile {
            entry,
            content,
            is_complete,
        }))
    }

    /// Marks a file in its manifest as damaged and returns the error that says so.
    pub(super) async fn damaged(&self, id: Uuid, name: &str, cause: IntegrityError) -> DamagedFile {
        let error = DamagedFile {
            id,
            name: name.to_owned(),
            cause,
        };
        tracing::error!(%error, "a result cannot be sent");
        let how = error.cause.to_string();
        if let Err(error) = self.store.mark_damaged(id, name, Some(&how)).await {
            tracing::warn!(%error, "a damaged file was not marked");
        }
        error
    }
}
