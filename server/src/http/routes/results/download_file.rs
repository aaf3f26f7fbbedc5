//! `GET /v1/jobs/{id}/results/files/{name}`: a file of a job, or a byte range of it.
//!
//! The name is looked up in the manifest; the path is the manifest's, never the client's.

use std::ops::RangeInclusive;

use api::problem::Problem;
use api::results::ResultFile;
use axum::body::{Body, Bytes};
use axum::extract::State;
use axum::http::{HeaderMap, StatusCode, header};
use axum::response::{IntoResponse, Response};
use futures_util::{TryStreamExt, stream};
use http_range_header::{RangeUnsatisfiableError, StartPosition, SyntacticallyCorrectRange};
use uuid::Uuid;

use crate::http::app::App;
use crate::http::extract::{JobId, Name};
use crate::http::problem::{ProblemResponse, ProblemType, RouteError};
use crate::http::verified_file::VerifiedFile;
use crate::store::Chunks;
use crate::store::checksum::Checksum;

/// Error of a file that the manifest does not list.
#[derive(Debug, thiserror::Error)]
#[error("the manifest of job {0} lists no such file")]
struct NoFileError(Uuid);

impl RouteError for NoFileError {
    const TYPE: ProblemType = ProblemType::NO_SUCH_RESULT;
}

/// A file of a job.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/results/files/{name}",
    tag = "results",
    params(
        ("name" = String, Path, description = "Name of the file in the manifest"),
        ("Range" = Option<String>, Header, description = "One byte range, for instance `bytes=0-99`"),
    ),
    responses(
        (status = 200, description = "The file", content_type = "*/*", body = serde_json::Value,
            headers(("ETag" = String, description = "SHA-256 of the file"))),
        (status = 206, description = "The requested bytes", content_type = "*/*", body = serde_json::Value),
        (status = 304, description = "Not changed: `If-None-Match` has its digest"),
        (status = 404, description = "No such job, or no such file", body = Problem),
        (status = 500, description = "The stored file is damaged", body = Problem),
        (status = 416, description = "The range lies outside the file", body = Problem),
    )
)]
pub(crate) async fn file(
    State(app): State<App>,
    JobId(id): JobId,
    Name(name): Name,
    headers: HeaderMap,
) -> Result<Response, ProblemResponse> {
    let Some(verified) = app.verified_file(id, &name).await? else {
        app.job(id).await?;
        return Err(NoFileError(id).into());
    };
    let file = verified.entry.clone();
    let etag = format!("\"{}\"", file.sha256);
    let response = if text(&headers, header::IF_NONE_MATCH).contains(&etag) {
        StatusCode::NOT_MODIFIED.into_response()
    } else {
        let Ok(range) = requested_range(&headers, &file, &etag) else {
            return Ok(range_not_satisfiable(file.bytes));
        };
        respond(&app, id, verified, range).await?
    };
    let own = [
        (header::ETAG, etag),
        (header::ACCEPT_RANGES, "bytes".to_owned()),
        // A stored file never changes; the client revalidates with its digest.
        (header::CACHE_CONTROL, "private, no-cache".to_owned()),
        (header::CONTENT_DISPOSITION, attachment(&file.name)),
    ];
    Ok((own, response).into_response())
}

/// `Content-Disposition` of a download; characters of the name other than letters, digits, `.`, `-` and `_` are
/// replaced.
pub(crate) fn attachment(name: &str) -> String {
    let safe = |c: char| c.is_ascii_alphanumeric() || matches!(c, '.' | '-' | '_');
    let name: String = name
        .chars()
        .map(|c| if safe(c) { c } else { '_' })
        .collect();
    format!("attachment; filename=\"{name}\"")
}

fn text(headers: &HeaderMap, name: header::HeaderName) -> &str {
    headers
        .get(name)
        .and_then(|value| value.to_str().ok())
        .unwrap_or_default()
}

/// The problem of a range that begins after the end of the file.
fn range_not_satisfiable(bytes: u64) -> Response {
    let detail = format!("the file has {bytes} bytes, and the range begins after them");
    let content_range = [(header::CONTENT_RANGE, format!("bytes */{bytes}"))];
    (content_range, ProblemType::RANGE.with_detail(detail)).into_response()
}

/// Returns the requested byte range; `None` for the whole file. An invalid range, several ranges and a range of another
/// version are ignored (RFC 9110, 14.2).
///
/// # Errors
/// If the range begins after the end of the file.
fn requested_range(
    headers: &HeaderMap,
    file: &ResultFile,
    etag: &str,
) -> Result<Option<RangeInclusive<u64>>, RangeUnsatisfiableError> {
    let range = text(headers, header::RANGE);
    let version = text(headers, header::IF_RANGE);
    if range.is_empty() || !(version.is_empty() || version == etag) {
        return Ok(None);
    }
    let Ok(parsed) = http_range_header::parse_range_header(range) else {
        return Ok(None);
    };
    if parsed.ranges.len() != 1 {
        return Ok(None);
    }
    if let [
        SyntacticallyCorrectRange {
            start: StartPosition::FromLast(length),
            ..
        },
    ] = parsed.ranges[..]
        && length >= file.bytes
        && file.bytes > 0
    {
        // A longer suffix is the whole file (RFC 9110, 14.1.2).
        return Ok(Some(0..=file.bytes - 1));
    }
    Ok(parsed.validate(file.bytes)?.pop())
}

/// Responds with the file, or with a range of it.
async fn respond(
    app: &App,
    id: Uuid,
    verified: VerifiedFile,
    range: Option<RangeInclusive<u64>>,
) -> Result<Response, ProblemResponse> {
    let VerifiedFile {
        entry,
        content,
        is_complete,
    } = verified;
    let (from, length) = match &range {
        None => (0, entry.bytes),
        Some(range) => (*range.start(), range.end() - range.start() + 1),
    };
    let headers = [
        (header::CONTENT_TYPE, entry.media_type.clone()),
        (header::CONTENT_LENGTH, length.to_string()),
    ];
    let bytes = entry.bytes;
    let chunks = content.chunks(from..from + length).await?;
    let whole = !is_complete && range.is_none();
    let body = checked_stream(chunks, whole.then(|| Unchecked::new(app, id, entry)));
    let Some(range) = range else {
        return Ok((headers, body).into_response());
    };
    let range = format!("bytes {}-{}/{bytes}", range.start(), range.end());
    let range = [(header::CONTENT_RANGE, range)];
    Ok((StatusCode::PARTIAL_CONTENT, headers, range, body).into_response())
}

/// A file whose checksum is compared while it is sent.
struct Unchecked {
    app: App,
    id: Uuid,
    entry: ResultFile,
    checksum: Checksum,
    left: u64,
}

impl Unchecked {
    fn new(app: &App, id: Uuid, entry: ResultFile) -> Self {
        Self {
            app: app.clone(),
            id,
            left: entry.bytes,
            entry,
            checksum: Checksum::default(),
        }
    }

    /// Adds a chunk. After the last one the whole is compared, so that the client of a damaged file does not get it.
    async fn check(&mut self, chunk: &Bytes) -> std::io::Result<()> {
        self.checksum.update(chunk);
        let length = u64::try_from(chunk.len()).unwrap_or(u64::MAX);
        self.left = self.left.saturating_sub(length);
        if self.left > 0 {
            return Ok(());
        }
        let checksum = std::mem::take(&mut self.checksum);
        match checksum.compare(&self.entry) {
            Ok(()) => Ok(()),
            Err(cause) => {
                let damaged = self.app.damaged(self.id, &self.entry.name, cause).await;
                Err(std::io::Error::other(damaged))
            }
        }
    }
}

/// Streams the rest of a file, checked if it has not been.
fn checked_stream(chunks: Chunks, unchecked: Option<Unchecked>) -> Body {
    Body::from_stream(stream::try_unfold(
        (chunks, unchecked),
        |(mut chunks, mut unchecked)| async move {
            let Some(chunk) = chunks.try_next().await? else {
                return Ok(None);
            };
            if let Some(unchecked) = &mut unchecked {
                unchecked.check(&chunk).await?;
            }
            Ok::<_, std::io::Error>(Some((chunk, (chunks, unchecked))))
        },
    ))
}

#[cfg(test)]
mod tests;
