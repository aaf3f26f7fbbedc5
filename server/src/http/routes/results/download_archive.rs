//! `GET /v1/jobs/{id}/results/archive`: all files of a job as a zip, which is written while it is sent.

use std::collections::HashMap;
use std::io::{self, Write};
use std::time::Duration;

use api::problem::Problem;
use api::results::ResultFile;
use axum::body::{Body, Bytes};
use axum::extract::State;
use axum::http::header;
use axum::response::{IntoResponse, Response};
use futures_util::{TryStreamExt, stream};
use tokio::runtime::Handle;
use tokio::sync::{OwnedSemaphorePermit, mpsc};
use uuid::Uuid;
use zip::write::SimpleFileOptions;
use zip::{CompressionMethod, ZipWriter};

use crate::export::files::is_plain_name;
use crate::http::app::{App, MAX_ARCHIVES};
use crate::http::extract::JobId;
use crate::http::job_error::JobError;
use crate::http::problem::{ProblemResponse, ProblemType, RouteError};
use crate::http::routes::results::download_file::attachment;
use crate::store::checksum::Checksum;
use crate::store::{Content, checksum};

/// Size of the chunks of the body, bytes.
const CHUNK_BYTES: usize = 64 << 10;
/// Chunks that are buffered for a client.
const BUFFERED_CHUNKS: usize = 4;
/// Timeout of the wait for a permit; slow clients would otherwise block waiting requests, and these all others.
const PERMIT_TIMEOUT: Duration = Duration::from_secs(10);
/// Timeout of a client that does not read a chunk.
const CHUNK_TIMEOUT: Duration = Duration::from_mins(1);

/// Error of a request while too many archives are being written.
#[derive(Debug, thiserror::Error)]
#[error("{MAX_ARCHIVES} archives are being written, which is the limit")]
struct TooManyArchivesError;

impl RouteError for TooManyArchivesError {
    const TYPE: ProblemType = ProblemType::BUSY;
}

/// All files of an ended job, as a zip.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/results/archive",
    tag = "results",
    responses(
        (status = 200, description = "The archive", content_type = "application/zip", body = Vec<u8>),
        (status = 500, description = "A stored file is damaged", body = Problem),
        (status = 409, description = "The job has not ended", body = Problem),
    )
)]
pub(crate) async fn archive(
    State(app): State<App>,
    JobId(id): JobId,
) -> Result<Response, ProblemResponse> {
    if !app.job(id).await?.document.status.is_terminal() {
        return Err(JobError::Active(id).into());
    }
    let mut files = app.store.manifest(id).await?;
    // Earlier versions stored the names that workers sent unchecked.
    files.retain(|file| is_plain_name(&file.name));
    let permit = tokio::time::timeout(PERMIT_TIMEOUT, app.archive_slots.take()).await;
    let permit = permit.ok().flatten().ok_or(TooManyArchivesError)?;
    let documents = app.store.block_documents(id).await?;
    for file in &files {
        // Whatever can be known to be damaged is a problem instead of an archive that breaks off.
        let checked = documents.get(&file.name);
        match checked.map(|bytes| checksum::check_bytes(file, bytes)) {
            Some(Ok(())) => {}
            Some(Err(_)) | None => drop(app.verified_file(id, &file.name).await?),
        }
    }
    let content = Archived {
        id,
        files,
        documents,
    };
    let (chunks, received) = mpsc::channel(BUFFERED_CHUNKS);
    tokio::task::spawn_blocking(move || send(&app, &content, &chunks, permit));
    let body = stream::unfold(received, |mut received| async move {
        received.recv().await.map(|chunk| (chunk, received))
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

/// Contents of an archive.
struct Archived {
    id: Uuid,
    files: Vec<ResultFile>,
    /// The documents of the block, by name; other files are read one by one.
    documents: HashMap<String, Vec<u8>>,
}

/// Writes an archive into the channel; an error ends the body early.
fn send(
    app: &App,
    archived: &Archived,
    chunks: &mpsc::Sender<io::Result<Bytes>>,
    permit: OwnedSemaphorePermit,
) {
    let writer = ChunkWriter {
        chunks: chunks.clone(),
        runtime: Handle::current(),
        buffer: Vec::with_capacity(CHUNK_BYTES),
    };
    if let Err(error) = write_archive(app, archived, writer) {
        tracing::warn!(job = %archived.id, %error, "an archive was aborted");
        // The client sees an incomplete body; it may have disconnected.
        let _ = chunks.try_send(Err(error));
    }
    drop(permit);
}

fn write_archive(app: &App, archived: &Archived, writer: ChunkWriter) -> io::Result<()> {
    let runtime = writer.runtime.clone();
    let mut archive = ZipWriter::new_stream(writer);
    for file in &archived.files {
        let options = SimpleFileOptions::default()
            .compression_method(CompressionMethod::Deflated)
            .large_file(file.bytes > u64::from(u32::MAX));
        archive.start_file(file.name.as_str(), options)?;
        let content = if let Some(document) = archived.documents.get(&file.name) {
            Content::Inline(document.clone())
        } else {
            let stored = runtime.block_on(app.store.result_file(archived.id, &file.name));
            let stored = stored.map_err(io::Error::other)?;
            let (_, content) = stored.ok_or_else(|| io::Error::other("the job was deleted"))?;
            content
        };
        match content {
            Content::Inline(bytes) => archive.write_all(&bytes)?,
            content => copy(app, archived.id, file, content, &mut archive)?,
        }
    }
    archive.finish()?.into_inner().flush()
}

/// Copies a content into an archive, and checks it meanwhile.
fn copy(
    app: &App,
    id: Uuid,
    entry: &ResultFile,
    content: Content,
    archive: &mut impl Write,
) -> io::Result<()> {
    let runtime = Handle::current();
    let chunks = runtime.block_on(content.chunks(0..entry.bytes));
    let mut chunks = chunks.map_err(io::Error::other)?;
    let mut checksum = Checksum::default();
    while let Some(chunk) = runtime.block_on(chunks.try_next())? {
        checksum.update(&chunk);
        archive.write_all(&chunk)?;
    }
    checksum.compare(entry).map_err(|cause| {
        let damaged = app.damaged(id, &entry.name, cause);
        io::Error::other(runtime.block_on(damaged))
    })
}

/// Sends what is written to the client, in chunks.
struct ChunkWriter {
    chunks: mpsc::Sender<io::Result<Bytes>>,
    runtime: Handle,
    buffer: Vec<u8>,
}

impl Write for ChunkWriter {
    fn write(&mut self, bytes: &[u8]) -> io::Result<usize> {
        self.buffer.extend_from_slice(bytes);
        if self.buffer.len() >= CHUNK_BYTES {
            self.flush()?;
        }
        Ok(bytes.len())
    }

    fn flush(&mut self) -> io::Result<()> {
        if self.buffer.is_empty() {
            return Ok(());
        }
        let chunk = Bytes::from(std::mem::take(&mut self.buffer));
        let sent = self
            .runtime
            .block_on(self.chunks.send_timeout(Ok(chunk), CHUNK_TIMEOUT));
        sent.map_err(|_| io::Error::other("the client does not read the archive"))
    }
}

#[cfg(test)]
mod tests {
    use std::io::{Cursor, Read};

    use zip::ZipArchive;

    use crate::export::documents::CSV;
    use crate::export::files::manifest_entry;
    use crate::http::tests::{FIELDS, Service};
    use crate::queue::Transition;
    use crate::store::{End, JobUpdate, NewContent, NewFile};

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
        assert_eq!(names, ["fields-20.vtu", "profile-20.csv", "summary.json"]);
        let mut content = String::new();
        let mut fields = archive.by_name("fields-20.vtu").expect("a file");
        fields.read_to_string(&mut content).expect("text");
        assert_eq!(content, FIELDS);
    }

    #[tokio::test]
    async fn a_stored_name_that_leads_out_of_its_folder_is_not_in_the_archive() {
        let service = Service::new().await;
        let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let store = &service.app.store;
        let claim = store.claim_next(i64::MAX).await.expect("a job");
        let table = |name| NewFile {
            file: manifest_entry(name, None, CSV, b"1"),
            content: NewContent::Inline(b"1".to_vec()),
        };
        let update = JobUpdate {
            files: vec![table("../../outside.csv"), table("inside.csv")],
            ..JobUpdate::default()
        };
        let end = End::without_result(Transition::Succeed, "as the test asked for");
        store.end_next(&claim, &update, &end).await;
        let path = format!("/v1/jobs/{id}/results/archive");
        let (status, _, bytes) = service.bytes("GET", &path, &[], "").await;
        assert_eq!(status, 200);
        let archive = ZipArchive::new(Cursor::new(bytes)).expect("an archive");
        let names: Vec<_> = archive
            .file_names()
            .map(|name| name.expect("a name"))
            .collect();
        assert_eq!(names, ["inside.csv"]);
    }

    #[tokio::test]
    async fn a_request_does_not_wait_for_ever_for_slow_clients() {
        let service = Service::new().await;
        let id = service.with_files().await;
        let taken = service
            .app
            .archive_slots
            .free
            .clone()
            .acquire_many_owned(4)
            .await;
        let path = format!("/v1/jobs/{id}/results/archive");
        let (status, headers, problem) = service.get(&path).await;
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
        let unknown = "/v1/jobs/00000000-0000-7000-8000-000000000000/results/archive";
        assert_eq!(service.get(unknown).await.0, 404);
    }
}
