//! `PUT /v1/worker/files/{job}/{lease}/{name}`: a file of an attempt, which counts once an update names it.

use std::path::Path;

use axum::body::Body;
use axum::extract::{Path as Parameters, Query, State};
use axum::http::StatusCode;
use futures_util::StreamExt;
use serde::Deserialize;
use tokio::io::AsyncWriteExt;
use uuid::Uuid;

use crate::export::files::{create_folder, is_full, is_plain_name};
use crate::http::app::App;
use crate::http::problem::{ProblemResponse, ProblemType, RouteError};
use crate::store::integrity::Checksum;
use crate::store::{Lease, LeaseState};

/// Why a file is not taken.
#[derive(Debug, thiserror::Error)]
pub(crate) enum FileError {
    /// Not the name of a file.
    #[error("`{0}` is no plain file name")]
    Name(String),
    /// Another worker holds the job.
    #[error("lease {} of job {} has ended", .0.number, .0.job)]
    LeaseLost(Lease),
    /// The connection broke off.
    #[error("the file did not arrive: {0}")]
    Broken(axum::Error),
    /// The content is another one.
    #[error("{name} has the SHA-256 {found}, {named} was announced")]
    Differs {
        name: String,
        found: String,
        named: String,
    },
    /// It cannot be written.
    #[error("a file cannot be written: {0}")]
    Write(#[from] std::io::Error),
}

impl RouteError for FileError {
    fn problem_type(&self) -> ProblemType {
        match self {
            Self::Name(_) => ProblemType::INVALID_QUERY,
            Self::LeaseLost(_) => ProblemType::LEASE_LOST,
            Self::Broken(_) => ProblemType::REQUEST_TIMEOUT,
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

/// Writes a file into the folder of the attempt, under its name once it is complete.
pub(crate) async fn put_file(
    State(app): State<App>,
    Parameters((job, number, name)): Parameters<(Uuid, i64, String)>,
    Query(announced): Query<Announced>,
    body: Body,
) -> Result<StatusCode, ProblemResponse> {
    if !is_plain_name(&name) {
        return Err(FileError::Name(name).into());
    }
    let lease = Lease { job, number };
    if app.store.lease_state(lease).await? == LeaseState::Lost {
        return Err(FileError::LeaseLost(lease).into());
    }
    let folder = app.store.attempt_folder(lease);
    create_folder(&folder).map_err(FileError::Write)?;
    let unfinished = folder.join(format!("{name}.{}.unfinished", Uuid::now_v7()));
    let written = receive(body, &unfinished, (&name, announced.sha256)).await;
    let renamed = match written {
        Ok(()) => tokio::fs::rename(&unfinished, folder.join(&name))
            .await
            .map_err(FileError::Write),
        Err(error) => Err(error),
    };
    if renamed.is_err() {
        // There may be none.
        let _ = tokio::fs::remove_file(&unfinished).await;
    }
    Ok(renamed.map(|()| StatusCode::NO_CONTENT)?)
}

/// Writes a body as a file and compares its checksum.
async fn receive(body: Body, path: &Path, (name, named): (&str, String)) -> Result<(), FileError> {
    let mut file = tokio::fs::File::create(path).await?;
    let (mut chunks, mut checksum) = (body.into_data_stream(), Checksum::default());
    while let Some(chunk) = chunks.next().await {
        let chunk = chunk.map_err(FileError::Broken)?;
        checksum.update(&chunk);
        file.write_all(&chunk).await?;
    }
    file.sync_all().await?;
    let found = checksum.sha256();
    if found == named {
        return Ok(());
    }
    Err(FileError::Differs {
        name: name.to_owned(),
        found,
        named,
    })
}

#[cfg(test)]
mod tests {
    use crate::export::files::sha256;
    use crate::http::tests::Service;
    use crate::store::Lease;

    #[tokio::test]
    async fn a_file_is_taken_whole_or_not_at_all() {
        let service = Service::new().await;
        service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let claim = service.app.store.claim_next(i64::MAX).await.expect("a job");
        let folder = service.app.store.attempt_folder(Lease::from(&claim));
        let put = async |lease: i64, name: &str, sha256: &str| {
            let path = format!(
                "/v1/worker/files/{}/{lease}/{name}?sha256={sha256}",
                claim.id
            );
            service.put(&path, "fields").await.as_u16()
        };
        let right = sha256(b"fields");
        assert_eq!(put(claim.lease, "a.vtu", &right).await, 204);
        assert_eq!(
            std::fs::read(folder.join("a.vtu")).expect("a file"),
            b"fields"
        );
        assert_eq!(put(claim.lease, "b.vtu", "00").await, 422);
        assert_eq!(put(claim.lease + 1, "c.vtu", &right).await, 409);
        assert_eq!(put(claim.lease, "..%2Fd.vtu", &right).await, 400);
        let left = std::fs::read_dir(&folder).expect("a folder").count();
        assert_eq!(left, 1, "nothing else");
    }
}
