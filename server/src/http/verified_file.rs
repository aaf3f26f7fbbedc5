//! Result files that are checked before they are sent.

use api::results::ResultFile;
use uuid::Uuid;

use crate::http::app::App;
use crate::http::problem::{ProblemResponse, ProblemType, RouteError};
use crate::objects::{ObjectPart, ObjectsError};
use crate::store::{Content, IntegrityError, StoreError, checksum};

/// Largest file that is checked as a whole before the first byte is sent, bytes. The length of every file is checked; the
/// checksum of a larger one while it is sent, unless it is a file on this machine that was found to be damaged before.
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
    fn problem_type(&self) -> ProblemType {
        if self.cause.is_damage() {
            ProblemType::RESULT_DAMAGED
        } else {
            ProblemType::INTERNAL
        }
    }
}

/// A file that has been checked.
#[derive(Debug)]
pub(super) struct VerifiedFile {
    /// Entry.
    pub(super) entry: ResultFile,
    /// Content.
    pub(super) content: Content,
    /// True if its checksum was compared too, not only its length.
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
        let is_small = entry.bytes <= CHECKED_FIRST;
        let (stored, content) = match content {
            Content::Object(part) if is_small => match part.read().await {
                Ok(bytes) => (Content::Object(part), Content::Inline(bytes)),
                Err(error) => return self.without_object(id, name, part, error).await,
            },
            content => (content.clone(), content),
        };
        let check = move || {
            let is_complete = is_small || entry.damaged.is_some();
            let (checked, is_complete) = match &content {
                Content::Inline(bytes) => (checksum::check_bytes(&entry, bytes), true),
                Content::File(path) if is_complete => (checksum::check_file(&entry, path), true),
                Content::File(path) => (checksum::check_file_length(&entry, path), false),
                Content::Object(_) => (Ok(()), false),
            };
            (entry, content, checked, is_complete)
        };
        let (entry, content, checked, is_complete) = tokio::task::spawn_blocking(check).await?;
        if let Err(cause) = checked {
            return match self.store.result_file(id, name).await? {
                // Deleted meanwhile, or replaced by the next attempt.
                None => Ok(None),
                Some((_, now)) if now != stored => Box::pin(self.verified_file(id, name)).await,
                Some(_) => Err(self.damaged(id, &entry.name, cause).await.into()),
            };
        }
        if entry.damaged.is_some() && is_complete {
            self.mark(id, &entry.name, None).await;
        }
        Ok(Some(VerifiedFile {
            entry,
            content,
            is_complete,
        }))
    }

    /// The answer where the object of a file cannot be read: the file from elsewhere, if it was moved meanwhile.
    async fn without_object(
        &self,
        id: Uuid,
        name: &str,
        part: ObjectPart,
        error: ObjectsError,
    ) -> Result<Option<VerifiedFile>, ProblemResponse> {
        match self.store.result_file(id, name).await? {
            None => Ok(None),
            Some((_, now)) if now != Content::Object(part) => {
                Box::pin(self.verified_file(id, name)).await
            }
            Some(_) => Err(StoreError::from(error).into()),
        }
    }

    /// Returns the error that says how a file is damaged; marks it in its manifest, unless it only could not be read.
    pub(super) async fn damaged(&self, id: Uuid, name: &str, cause: IntegrityError) -> DamagedFile {
        let error = DamagedFile {
            id,
            name: name.to_owned(),
            cause,
        };
        tracing::error!(%error, "a result cannot be sent");
        if error.cause.is_damage() {
            self.mark(id, name, Some(&error.cause.to_string())).await;
        }
        error
    }

    /// Marks a file in its manifest; the mark may be stale.
    async fn mark(&self, id: Uuid, name: &str, how: Option<&str>) {
        if let Err(error) = self.store.mark_damaged(id, name, how).await {
            tracing::warn!(%error, "a file was not marked in its manifest");
        }
    }
}
