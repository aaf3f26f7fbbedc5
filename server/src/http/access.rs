//! Access control: the `Host` of a request must be allowed, a browser's `Origin` must be the same host, and if a token
//! is configured, the request must have it.
//!
//! On loopback the host must be a loopback name or address, which protects from DNS rebinding. Listening elsewhere
//! needs a token; then the host may also be any IP address, which cannot be rebound, or a configured name. Remote workers have tokens
//! of their own, which reach their paths only and can be revoked.

use std::net::IpAddr;
use std::sync::Arc;

use axum::extract::{Request, State};
use axum::http::{HeaderMap, HeaderValue, Version, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use sha2::{Digest, Sha256};
use subtle::ConstantTimeEq;

use crate::http::problem::ProblemType;

/// Paths of remote workers, which have tokens of their own.
pub(super) const WORKER_FOLDER: &str = "/v1/worker/";
/// Minimum length of a token, characters: 16 random ones are some 90 bits.
const MIN_TOKEN_LENGTH: usize = 16;
/// Maximum length of a token, characters; it must fit into a header.
const MAX_TOKEN_LENGTH: usize = 512;
/// Paths that need no token, besides the assets of the pages: health checks, and pages, which contain no data.
const PUBLIC_PATHS: [&str; 5] = ["/", "/book", "/docs", "/healthz", "/readyz"];
/// The assets are the scripts and style sheets of the pages, without data too; so are the book and the explanations of problems.
const PUBLIC_FOLDERS: [&str; 3] = ["/assets/", "/book/", "/problems/"];

/// Error of a configured token.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum TokenError {
    /// Too short to be safe, or too long for a header.
    #[error(
        "the access token has {0} characters; it must have {MIN_TOKEN_LENGTH} to {MAX_TOKEN_LENGTH}"
    )]
    Length(usize),
    /// Not valid in a header.
    #[error("the access token must be printable ASCII characters without spaces")]
    Text,
}

/// Rules of access.
#[derive(Debug, Clone, Default)]
pub struct Access {
    /// Digest of the token; the token itself is not stored.
    token_sha256: Option<[u8; 32]>,
    /// Allowed host names, besides loopback ones.
    hosts: Arc<[String]>,
}

impl Access {
    /// Rules with a token, and with these host names besides loopback ones.
    ///
    /// # Errors
    /// [`TokenError`] for a token that is not safe.
    pub fn new(token: Option<&str>, hosts: &[String]) -> Result<Self, TokenError> {
        let token_sha256 = token.map(token_digest).transpose()?;
        Ok(Self {
            token_sha256,
            hosts: hosts.iter().map(|host| host.to_ascii_lowercase()).collect(),
        })
    }

    /// Returns `true` if a token is required.
    pub fn requires_token(&self) -> bool {
        self.token_sha256.is_some()
    }

    /// Returns the response to a request that has no access.
    fn rejection(&self, request: &Request) -> Option<Response> {
        let (path, headers) = (request.uri().path(), request.headers());
        let version = request.version();
        let hosts = headers.get_all(header::HOST).iter().count();
        if hosts > 1 || (hosts == 0 && version == Version::HTTP_11) {
            let detail =
                format!("a request has one Host header (RFC 9112, 3.2), this one has {hosts}");
            return Some(
                ProblemType::INVALID_HOST
                    .with_detail(detail)
                    .into_response(),
            );
        }
        if let Some(detail) = self.foreign_host(headers) {
            return Some(
                ProblemType::FOREIGN_HOST
                    .with_detail(detail)
                    .into_response(),
            );
        }
        let digest = self.token_sha256.as_ref()?;
        let public = PUBLIC_PATHS.contains(&path)
            || PUBLIC_FOLDERS.iter().any(|folder| path.starts_with(folder));
        if public || is_for_workers(request) || has_token(headers, digest) {
            return None;
        }
        Some(token_required(
            "send `Authorization: Bearer TOKEN` with this service's token",
        ))
    }

    fn foreign_host(&self, headers: &HeaderMap) -> Option<&'static str> {
        let text = |name| {
            headers
                .get(name)
                .map(|value| value.to_str().unwrap_or_default())
        };
        let host = text(header::HOST);
        if host.is_some_and(|host| !self.allows_host(host)) {
            return Some("the host header does not name this service");
        }
        let origin = text(header::ORIGIN)?;
        let same = origin.split_once("://").map(|(_, authority)| authority) == host;
        (!same).then_some("the origin is another host")
    }

    fn allows_host(&self, authority: &str) -> bool {
        let name = match authority.strip_prefix('[') {
            Some(rest) => rest.split(']').next().unwrap_or_default(),
            None => authority.split(':').next().unwrap_or_default(),
        };
        let name = name.to_ascii_lowercase();
        let address = name.parse::<IpAddr>();
        name == "localhost"
            || address.is_ok_and(|address| address.is_loopback() || self.requires_token())
            || self.hosts.contains(&name)
    }
}

fn token_digest(token: &str) -> Result<[u8; 32], TokenError> {
    let length = token.chars().count();
    if !(MIN_TOKEN_LENGTH..=MAX_TOKEN_LENGTH).contains(&length) {
        return Err(TokenError::Length(length));
    }
    if !token.chars().all(|c| c.is_ascii_graphic()) {
        return Err(TokenError::Text);
    }
    Ok(Sha256::digest(token).into())
}

/// Returns `true` if the request has the token. Digests of equal length are compared in constant time, against timing attacks.
fn has_token(headers: &HeaderMap, digest: &[u8; 32]) -> bool {
    sent_digest(headers).ct_eq(digest).into()
}

/// Digest of the token that a request has; of nothing without one.
pub(super) fn sent_digest(headers: &HeaderMap) -> [u8; 32] {
    let sent = headers
        .get(header::AUTHORIZATION)
        .and_then(|value| value.to_str().ok())
        .and_then(|value| value.split_once(' '))
        .filter(|(scheme, _)| scheme.eq_ignore_ascii_case("bearer"))
        .map(|(_, token)| token.trim())
        .unwrap_or_default();
    Sha256::digest(sent).into()
}

/// Middleware that rejects requests without access.
pub(super) async fn check(State(access): State<Access>, request: Request, next: Next) -> Response {
    match access.rejection(&request) {
        Some(rejection) => rejection,
        None => next.run(request).await,
    }
}

/// Returns `true` if a request needs a token for workers instead of that of users.
pub(super) fn is_for_workers(request: &Request) -> bool {
    request.uri().path().starts_with(WORKER_FOLDER)
}

/// The response to a request without a token, or with a wrong one.
pub(super) fn token_required(detail: &str) -> Response {
    let mut response = ProblemType::TOKEN_REQUIRED
        .with_detail(detail)
        .into_response();
    let challenge = HeaderValue::from_static("Bearer realm=\"fretwear\"");
    response
        .headers_mut()
        .insert(header::WWW_AUTHENTICATE, challenge);
    response
}

#[cfg(test)]
mod tests {
    use axum::body::Body;

    use super::*;

    const TOKEN: &str = "correct-horse-battery";

    fn headers(host: &str, more: &[(header::HeaderName, &str)]) -> HeaderMap {
        let mut headers = HeaderMap::new();
        headers.insert(header::HOST, host.parse().expect("a header"));
        for (name, value) in more {
            headers.insert(name, value.parse().expect("a header"));
        }
        headers
    }

    #[test]
    fn without_a_token_only_loopback_hosts_are_allowed() {
        let access = Access::default();
        for host in [
            "localhost:8080",
            "127.0.0.1",
            "127.0.0.1:1",
            "[::1]:8080",
            "LOCALHOST",
        ] {
            assert_eq!(access.foreign_host(&headers(host, &[])), None, "{host}");
        }
        for host in [
            "attacker.test",
            "127.0.0.1.attacker.test",
            "10.0.0.1:8080",
            "",
        ] {
            assert!(access.foreign_host(&headers(host, &[])).is_some(), "{host}");
        }
    }

    #[test]
    fn with_a_token_addresses_and_configured_names_are_allowed_too() {
        let access = Access::new(Some(TOKEN), &["Wear.Lab".to_owned()]).expect("access");
        for host in [
            "10.0.0.1:8080",
            "wear.lab:80",
            "[2001:db8::1]:8080",
            "localhost",
        ] {
            assert_eq!(access.foreign_host(&headers(host, &[])), None, "{host}");
        }
        assert!(
            access
                .foreign_host(&headers("attacker.test", &[]))
                .is_some()
        );
    }

    #[test]
    fn a_foreign_origin_is_rejected() {
        let access = Access::default();
        let from = |origin| headers("127.0.0.1:9", &[(header::ORIGIN, origin)]);
        assert_eq!(access.foreign_host(&from("http://127.0.0.1:9")), None);
        assert!(access.foreign_host(&from("http://attacker.test")).is_some());
        assert!(access.foreign_host(&from("null")).is_some());
    }

    #[test]
    fn only_the_token_gives_access_and_pages_need_none() {
        let access = Access::new(Some(TOKEN), &[]).expect("access");
        let with = |value: &str| headers("127.0.0.1", &[(header::AUTHORIZATION, value)]);
        let passes = |path: &str, headers: &HeaderMap| {
            let mut request = Request::get(path).body(Body::empty()).expect("a request");
            request.headers_mut().clone_from(headers);
            access.rejection(&request).is_none()
        };
        for sent in [
            "",
            "Bearer",
            "Bearer ",
            "Bearer correct-horse-batterx",
            "Bearer correct-horse-battery2",
            "Basic correct-horse-battery",
            TOKEN,
        ] {
            assert!(!passes("/v1/jobs", &with(sent)), "{sent}");
        }
        for scheme in ["Bearer", "bearer"] {
            assert!(passes("/v1/jobs", &with(&format!("{scheme} {TOKEN}"))));
        }
        assert!(PUBLIC_PATHS.iter().all(|path| passes(path, &with(""))));
        assert!(!passes("/openapi.json", &with("")));
    }

    #[test]
    fn weak_tokens_are_rejected() {
        let new = |token: &str| Access::new(Some(token), &[]).map(|_| ());
        assert_eq!(new("short"), Err(TokenError::Length(5)));
        assert_eq!(new(&"x".repeat(513)), Err(TokenError::Length(513)));
        assert_eq!(new("with spaces in it, long"), Err(TokenError::Text));
        assert_eq!(new("0123456789abcdef"), Ok(()));
    }
}
