//! Compression of answers, if the client accepts it: documents, tables, pages and drawings.

use axum::http::{Extensions, HeaderMap, HeaderValue, StatusCode, Version, header};
use axum::response::Response;
use tower_http::CompressionLevel;
use tower_http::compression::CompressionLayer;
use tower_http::compression::predicate::{And, Predicate, SizeAbove};

/// Length below which an answer is not compressed, bytes: it fits into one packet.
const LEAST_BYTES: u64 = 1024;
/// Level of gzip and Brotli: higher ones take several times as long for some per cent.
const LEVEL: CompressionLevel = CompressionLevel::Precise(4);
/// Media types that are compressed. Streams of events are sent as they come; archives, Parquet and raster pictures are
/// compressed already; fields inside the bodies are long.
const MEDIA_TYPES: [&str; 9] = [
    "application/json",
    "application/problem+json",
    "application/openmetrics-text",
    "image/svg+xml",
    "text/css",
    "text/csv",
    "text/html",
    "text/javascript",
    "text/plain",
];

/// Tells from an answer's head whether it is compressed.
type ByHead = fn(StatusCode, Version, &HeaderMap, &Extensions) -> bool;

/// The layer that compresses.
pub(super) fn layer() -> CompressionLayer<And<SizeAbove, ByHead>> {
    let is_text: ByHead = |_, _, headers, _| is_text(headers);
    CompressionLayer::new()
        .quality(LEVEL)
        .compress_when(SizeAbove::new(LEAST_BYTES).and(is_text))
}

fn is_text(headers: &HeaderMap) -> bool {
    let media_type = headers.get(header::CONTENT_TYPE);
    let media_type = media_type.and_then(|value| value.to_str().ok());
    let essence = media_type.and_then(|value| value.split(';').next());
    essence.is_some_and(|essence| MEDIA_TYPES.contains(&essence.trim()))
}

/// Middleware that marks the ETag of a compressed answer as weak: it names the uncompressed bytes (RFC 9110, 8.8.1).
pub(super) async fn weaken_etag(mut response: Response) -> Response {
    let headers = response.headers_mut();
    if !headers.contains_key(header::CONTENT_ENCODING) {
        return response;
    }
    let etag = headers.get(header::ETAG).map(HeaderValue::as_bytes);
    let weak = etag
        .filter(|etag| !etag.starts_with(b"W/"))
        .and_then(|etag| HeaderValue::from_bytes(&[b"W/", etag].concat()).ok());
    if let Some(weak) = weak {
        headers.insert(header::ETAG, weak);
    }
    response
}

#[cfg(test)]
mod tests {
    use crate::http::tests::Service;

    #[tokio::test]
    async fn documents_are_compressed_as_the_client_accepts_it() {
        let service = Service::new().await;
        let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let path = format!("/v1/jobs/{id}");
        let (_, plain_headers, plain) = service.bytes("GET", &path, &[], "").await;
        assert!(!plain_headers.contains_key("content-encoding"));
        for (accepted, encoding) in [("gzip", "gzip"), ("gzip;q=0.5, br", "br")] {
            let accepts = [("accept-encoding", accepted)];
            let (status, headers, bytes) = service.bytes("GET", &path, &accepts, "").await;
            assert_eq!(
                (status.as_u16(), &headers["content-encoding"]),
                (200, &encoding.parse().expect("a value"))
            );
            assert!(
                2 * bytes.len() < plain.len(),
                "{} of {}",
                bytes.len(),
                plain.len()
            );
            assert_eq!(headers["vary"], "accept-encoding");
            let weak = format!("W/{}", plain_headers["etag"].to_str().expect("text"));
            assert_eq!(headers["etag"], weak);
            let known = [
                ("accept-encoding", accepted),
                ("if-none-match", weak.as_str()),
            ];
            let (status, headers, _) = service.bytes("GET", &path, &known, "").await;
            assert_eq!(status, 304);
            assert!(!headers.contains_key("content-encoding"));
        }
        let refused = [("accept-encoding", "identity")];
        assert_eq!(service.bytes("GET", &path, &refused, "").await.2, plain);
    }

    #[tokio::test]
    async fn short_answers_streams_and_archives_are_sent_as_they_are() {
        let service = Service::new().await;
        let id = service.with_files().await;
        for path in [
            "/healthz".to_owned(),
            format!("/v1/jobs/{id}/results/archive"),
            format!("/v1/jobs/{id}/events"),
        ] {
            let accepts = [("accept-encoding", "gzip, br")];
            let (status, headers, _) = service.bytes("GET", &path, &accepts, "").await;
            assert_eq!(status, 200, "{path}");
            assert!(!headers.contains_key("content-encoding"), "{path}");
        }
        // A range is one of the stored bytes.
        let path = format!("/v1/jobs/{id}/results/files/summary.json");
        let range = [("accept-encoding", "gzip"), ("range", "bytes=0-0")];
        let (status, headers, bytes) = service.bytes("GET", &path, &range, "").await;
        assert_eq!((status.as_u16(), bytes.as_slice()), (206, &b"{"[..]));
        assert!(!headers.contains_key("content-encoding"));
    }
}
