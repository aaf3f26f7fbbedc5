//! `PUT /v1/worker/files/{job}/{lease}/{name}`: a file of an attempt, which counts once an update names it.

use std::path::Path;

use axum::extract::{Path as Parameters, Query, State};
use axum::{Extension, Json};
use serde::Deserialize;
use tokio::io::AsyncWriteExt;
use uuid::Uuid;

use crate::export::files::{create_folder, is_full, is_plain_name};
use crate::http::app::App;
use crate::http::bodies::{ArrivingBody, BodyError};
use crate::http::problem::{ProblemResponse, ProblemType, RouteError};
use crate::http::worker_access::WorkerToken;
use crate::objects::{ObjectFile, Source};
use crate::store::checksum::Checksum;
use crate::store::{Lease, LeaseState, NewContent};
use crate::worker::protocol::Taken;

/// Why a file is not taken.
#[derive(Debug, thiserror::Error)]
pub(crate) enum FileError {
    /// Not the name of a file.
    #[error("`{0}` is no plain file name")]
    Name(String),
    /// Another worker holds the job.
    #[error("lease {} of job {} has ended", .0.number, .0.job)]
    LeaseLost(Lease),
    /// The file has not arrived.
    #[error("the file did not arrive: {0}")]
    Body(#[from] BodyError),
    /// The content is another one.
    #[error("{name} has the SHA-256 {found}, {named} was announced")]
    Differs {
        name: String,
        found: String,
        named: String,
    },
    /// The file cannot be written.
    #[error("a file cannot be written: {0}")]
    Write(#[from] std::io::Error),
}

impl RouteError for FileError {
    fn problem_type(&self) -> ProblemType {
        match self {
            Self::Name(_) => ProblemType::INVALID_QUERY,
            Self::LeaseLost(_) => ProblemType::LEASE_LOST,
            Self::Body(cause) => cause.problem_type(),
            Self::Differs { .. } => ProblemType::FILE_DIFFERS,
            Self::Write(cause) if is_full(cause) => ProblemType::DISK_FULL,
            Self::Write(_) => ProblemType::INTERNAL,
        }
    }
}

#[derive(Debug, Deserialize)]
pub(crate) struct Announced {
    sha256: String,
}

/// Takes a file into the folder of the attempt, or into an object.
pub(crate) async fn put_file(
    State(app): State<App>,
    Extension(token): Extension<WorkerToken>,
    Parameters((job, number, name)): Parameters<(Uuid, i64, String)>,
    Query(announced): Query<Announced>,
    body: ArrivingBody,
) -> Result<Json<Taken>, ProblemResponse> {
    if !is_plain_name(&name) {
        return Err(FileError::Name(name).into());
    }
    let lease = Lease { job, number };
    let is_own = token.owns(&app.store, lease).await?;
    if !is_own || app.store.lease_state(lease).await? == LeaseState::Lost {
        return Err(FileError::LeaseLost(lease).into());
    }
    let sent = Sent {
        lease,
        name,
        sha256: announced.sha256,
    };
    let content = if app.store.has_files_as_objects() {
        into_object(&app, body, sent).await?
    } else {
        into_folder(&app, body, sent).await?
    };
    Ok(Json(Taken { content }))
}

/// A file that is sent.
struct Sent {
    lease: Lease,
    name: String,
    /// As it was announced.
    sha256: String,
}

/// Receives a file and writes it to an object.
async fn into_object(
    app: &App,
    body: ArrivingBody,
    sent: Sent,
) -> Result<NewContent, ProblemResponse> {
    let path = app.store.received_file().map_err(FileError::Write)?;
    let bytes = receive(body, &path, &sent).await?;
    // From now on it is one of the concurrent requests. The semaphore is never closed.
    let _permit = app.request_permits.acquire().await.ok();
    let file = ObjectFile {
        source: Source::File(path.to_path_buf()),
        bytes,
        sha256: sent.sha256,
    };
    let key = app.store.put_file(sent.lease, &file).await?;
    Ok(NewContent::Object(key))
}

/// Receives a file into the folder of its attempt, under its name once it is complete.
async fn into_folder(app: &App, body: ArrivingBody, sent: Sent) -> Result<NewContent, FileError> {
    let folder = app.store.attempt_folder(sent.lease);
    create_folder(&folder)?;
    let unfinished = folder.join(format!("{}.{}.unfinished", sent.name, Uuid::now_v7()));
    let renamed = match receive(body, &unfinished, &sent).await {
        Ok(_) => rename(&unfinished, &folder, &sent.name)
            .await
            .map_err(FileError::Write),
        Err(error) => Err(error),
    };
    if renamed.is_err() {
        // There may be none.
        let _ = tokio::fs::remove_file(&unfinished).await;
    }
    renamed.map(|()| NewContent::Folder)
}

/// Renames a file in a folder to its final name, durably.
async fn rename(unfinished: &Path, folder: &Path, name: &str) -> std::io::Result<()> {
    tokio::fs::rename(unfinished, folder.join(name)).await?;
    tokio::fs::File::open(folder).await?.sync_all().await
}

/// Writes a body as a file and compares its checksum; its length.
async fn receive(mut body: ArrivingBody, path: &Path, sent: &Sent) -> Result<u64, FileError> {
    let mut file = tokio::fs::File::create(path).await?;
    let mut checksum = Checksum::default();
    while let Some(chunk) = body.chunk().await? {
        checksum.update(&chunk);
        file.write_all(&chunk).await?;
    }
    file.sync_all().await?;
    let found = checksum.sha256();
    if found == sent.sha256 {
        return Ok(body.bytes());
    }
    Err(FileError::Differs {
        name: sent.name.clone(),
        found,
        named: sent.sha256.clone(),
    })
}

#[cfg(test)]
mod tests {
    use crate::export::files::sha256;
    use crate::http::body_limits::MAX_BODY_BYTES;
    use crate::http::tests::Service;
    use crate::store::Lease;

    #[tokio::test]
    async fn a_file_is_taken_whole_or_not_at_all() {
        let service = Service::new().await;
        service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let claim = service.app.store.claim_next(i64::MAX).await.expect("a job");
        let folder = service.app.store.attempt_folder(Lease::from(&claim));
        let put_content = async |lease: i64, name: &str, sha256: &str, content: &str| {
            let path = format!(
                "/v1/worker/files/{}/{lease}/{name}?sha256={sha256}",
                claim.id
            );
            service.put(&path, content).await.as_u16()
        };
        let put = async |lease, name, sha256| put_content(lease, name, sha256, "fields").await;
        let right = sha256(b"fields");
        assert_eq!(put(claim.lease, "a.vtu", &right).await, 200);
        assert_eq!(
            std::fs::read(folder.join("a.vtu")).expect("a file"),
            b"fields"
        );
        assert_eq!(put(claim.lease, "b.vtu", "00").await, 422);
        assert_eq!(put(claim.lease + 1, "c.vtu", &right).await, 409);
        assert_eq!(put(claim.lease, "..%2Fd.vtu", &right).await, 400);
        let left = std::fs::read_dir(&folder).expect("a folder").count();
        assert_eq!(left, 1, "nothing else");
        // A file is larger than the body of a user's request may be.
        let large = "f".repeat(MAX_BODY_BYTES + 1);
        let digest = sha256(large.as_bytes());
        let answer = put_content(claim.lease, "large.vtu", &digest, &large).await;
        assert_eq!(answer, 200);
    }
}
