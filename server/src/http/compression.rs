//! Compression of answers, if the client accepts it: documents, tables, pages and drawings.

use axum::extract::Request;
use axum::http::{Extensions, HeaderMap, HeaderValue, StatusCode, Version, header};
use axum::response::Response;
use tower_http::CompressionLevel;
use tower_http::compression::CompressionLayer;
use tower_http::compression::predicate::{And, Predicate, SizeAbove};

/// Length below which an answer is not compressed, bytes: it fits into one packet.
const LEAST_BYTES: u64 = 1024;
/// Level of gzip and Brotli: higher ones take several times as long for some per cent.
const LEVEL: CompressionLevel = CompressionLevel::Precise(4);
/// Media types that are compressed. Streams of events are sent as they come; archives and Parquet are
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

/// Middleware that removes an `Accept-Encoding` without an encoding of the layer: it would answer with 406 after the request was
/// carried out; uncompressed answers are allowed to all (RFC 9110, 12.5.3).
pub(super) async fn accept_identity(mut request: Request) -> Request {
    let headers = request.headers_mut();
    let values = headers.get_all(header::ACCEPT_ENCODING).iter();
    let mut values = values.filter_map(|value| value.to_str().ok());
    if !values.any(accepts_compression) {
        headers.remove(header::ACCEPT_ENCODING);
    }
    request
}

fn accepts_compression(value: &str) -> bool {
    value.split(',').any(|choice| {
        let (coding, weight) = choice.split_once(';').unwrap_or((choice, "q=1"));
        let weight = weight.trim().strip_prefix("q=").map(str::parse::<f32>);
        let is_accepted = weight.is_some_and(|weight| weight.is_ok_and(|weight| weight > 0.0));
        is_accepted && ["gzip", "br"].contains(&coding.trim().to_ascii_lowercase().as_str())
    })
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
        let path = format!("/v1/jobs/{id}/results/files/profile-20.csv");
        let range = [("accept-encoding", "gzip"), ("range", "bytes=0-1999")];
        let (status, headers, bytes) = service.bytes("GET", &path, &range, "").await;
        assert_eq!((status.as_u16(), bytes.len()), (206, 2_000));
        assert!(!headers.contains_key("content-encoding"));
        // An answer that is not acceptable is better than a request that was carried out and is called unacceptable.
        for refused in ["identity;q=0", "*;q=0", "gzip;q=0", "zstd"] {
            let accepts = [("accept-encoding", refused)];
            let (status, headers, _) = service.bytes("GET", "/v1/systems", &accepts, "").await;
            assert_eq!(status, 200, "{refused}");
            assert!(!headers.contains_key("content-encoding"), "{refused}");
        }
    }
}
