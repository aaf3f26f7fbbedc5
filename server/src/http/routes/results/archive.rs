//! `GET /v1/jobs/{id}/results/archive`: everything that a job produced, as a zip that is made while it is sent.

use std::io::{self, Write};
use std::time::Duration;

use api::problem::Problem;
use api::results::ResultFile;
use axum::body::{Body, Bytes};
use axum::extract::State;
use axum::http::header;
use axum::response::{IntoResponse, Response};
use futures_util::stream;
use tokio::runtime::Handle;
use tokio::sync::{OwnedSemaphorePermit, mpsc};
use uuid::Uuid;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use crate::http::App;
use crate::http::extract::JobId;
use crate::http::job_error::JobError;
use crate::http::problem::{Kind, Refusal};
use crate::http::routes::results::download::attachment;
use crate::store::Content;

/// Archives made at once: each occupies a thread as long as its client takes to read it.
pub(in crate::http) const AT_ONCE: usize = 4;
/// Pieces of this size are sent, bytes.
const PIECE: usize = 64 << 10;
/// Pieces on their way.
const PIECES: usize = 4;
/// How long a request waits for its turn. Not for ever: whoever reads slowly would hold up those who wait, and with them
/// all other requests.
const PLACE_WAIT: Duration = Duration::from_secs(10);
/// How long a client may leave a piece lying.
const PATIENCE: Duration = Duration::from_mins(1);

/// Why there is no archive.
#[derive(Debug, thiserror::Error)]
pub(in crate::http) enum ArchiveError {
    /// There is no such job, or it has not ended.
    #[error(transparent)]
    Job(#[from] JobError),
    /// Too many are being made.
    #[error("{AT_ONCE} archives are being made, which is the limit")]
    Full,
}

impl IntoResponse for ArchiveError {
    fn into_response(self) -> Response {
        match &self {
            Self::Job(error) => Refusal::from(error),
            Self::Full => Kind::Busy.because(self.to_string()),
        }
        .into_response()
    }
}

/// Everything that an ended job produced, as a zip.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/results/archive",
    tag = "results",
    params(("id" = Uuid, Path, description = "The job")),
    responses(
        (status = 200, description = "The archive", content_type = "application/zip", body = Vec<u8>),
        (status = 404, description = "No such job", body = Problem),
        (status = 409, description = "The job has not ended", body = Problem),
    )
)]
pub(in crate::http) async fn archive(
    State(app): State<App>,
    JobId(id): JobId,
) -> Result<Response, ArchiveError> {
    if !app.job(id).await?.document.status.is_terminal() {
        return Err(JobError::Active(id).into());
    }
    let files = app.store.manifest(id).await.map_err(JobError::from)?;
    let place = app.archives.clone().acquire_owned();
    let place = tokio::time::timeout(PLACE_WAIT, place).await;
    let permit = place.ok().and_then(Result::ok).ok_or(ArchiveError::Full)?;
    let (pieces, received) = mpsc::channel(PIECES);
    tokio::task::spawn_blocking(move || make(&app, id, &files, &pieces, permit));
    let body = stream::unfold(received, |mut received| async move {
        received.recv().await.map(|piece| (piece, received))
    });
    let headers = [
        (header::CONTENT_TYPE, "application/zip".to_owned()),
        (
            header::CONTENT_DISPOSITION,
            attachment(&format!("fretwear-{id}.zip")),
        ),
    ];
    Ok((headers, Body::from_stream(body)).into_response())
}

fn make(
    app: &App,
    id: Uuid,
    files: &[ResultFile],
    pieces: &mpsc::Sender<io::Result<Bytes>>,
    permit: OwnedSemaphorePermit,
) {
    let wire = Wire {
        pieces: pieces.clone(),
        runtime: Handle::current(),
        gathered: Vec::with_capacity(PIECE),
    };
    if let Err(error) = written(app, id, files, wire) {
        tracing::warn!(job = %id, %error, "an archive was broken off");
        // The client learns it from a body that ends before its end; one that has gone learns nothing.
        let _ = pieces.try_send(Err(error));
    }
    drop(permit);
}

fn written(app: &App, id: Uuid, files: &[ResultFile], wire: Wire) -> io::Result<()> {
    let runtime = wire.runtime.clone();
    let mut archive = ZipWriter::new_stream(wire);
    for file in files {
        let stored = runtime.block_on(app.store.result_file(id, &file.name));
        let Some((_, content)) = stored.map_err(io::Error::other)? else {
            return Err(io::Error::other("the job was deleted"));
        };
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Deflated)
            .large_file(file.bytes > u64::from(u32::MAX));
        archive.start_file(file.name.as_str(), options)?;
        match content {
            Content::Inline(bytes) => archive.write_all(&bytes)?,
            Content::File(path) => {
                io::copy(&mut std::fs::File::open(path)?, &mut archive)?;
            }
        }
    }
    archive.finish()?.into_inner().flush()
}

/// What is written goes to the client, piece by piece.
struct Wire {
    pieces: mpsc::Sender<io::Result<Bytes>>,
    runtime: Handle,
    gathered: Vec<u8>,
}

impl Write for Wire {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.gathered.extend_from_slice(bytes);
        if self.gathered.len() >= PIECE {
            self.flush()?;
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        if self.gathered.is_empty() {
            return Ok(());
        }
        let piece = Bytes::from(std::mem::take(&mut self.gathered));
        let sent = self
            .runtime
            .block_on(self.pieces.send_timeout(Ok(piece), PATIENCE));
        sent.map_err(|_| io::Error::other("the client does not read it"))
    }
}

#[cfg(test)]
mod tests {
    use std::io::{Cursor, Read};

    use zip::ZipArchive;

    use crate::http::tests::{FIELDS, Service};

    #[tokio::test]
    async fn the_archive_holds_every_file_of_the_manifest() {
        let service = Service::new().await;
        let id = service.with_files().await;
        let path = format!("/v1/jobs/{id}/results/archive");
        let (status, headers, bytes) = service.bytes("GET", &path, &[], "").await;
        assert_eq!(status, 200);
        assert_eq!(headers["content-type"], "application/zip");
        let mut archive = ZipArchive::new(Cursor::new(bytes)).expect("an archive");
        let mut names: Vec<_> = archive
            .file_names()
            .map(|name| name.expect("a name").into_owned())
            .collect();
        names.sort();
        assert_eq!(names, ["fields-20.vtu", "summary.json"]);
        let mut content = String::new();
        let mut fields = archive.by_name("fields-20.vtu").expect("a file");
        fields.read_to_string(&mut content).expect("text");
        assert_eq!(content, FIELDS);
    }

    #[tokio::test]
    async fn nobody_waits_for_ever_for_those_who_read_slowly() {
        let service = Service::new().await;
        let id = service.with_files().await;
        let taken = service.app.archives.clone().acquire_many_owned(4).await;
        let path = format!("/v1/jobs/{id}/results/archive");
        let asked = service.get(&path);
        let (status, headers, problem) = asked.await;
        assert_eq!(
            (status.as_u16(), problem["type"].as_str()),
            (503, Some("/problems/busy"))
        );
        assert_eq!(headers["retry-after"], "5");
        drop(taken);
        assert_eq!(service.bytes("GET", &path, &[], "").await.0, 200);
    }

    #[tokio::test]
    async fn a_job_that_has_not_ended_has_no_archive() {
        let service = Service::new().await;
        let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let (status, _, problem) = service.get(&format!("/v1/jobs/{id}/results/archive")).await;
        assert_eq!(
            (status.as_u16(), problem["type"].as_str()),
            (409, Some("/problems/job-active"))
        );
        let nobody = "/v1/jobs/00000000-0000-7000-8000-000000000000/results/archive";
        assert_eq!(service.get(nobody).await.0, 404);
    }
}
