//! Who may ask: requests must name a host that this service answers to, a browser's `Origin` must be that host, and
//! where a token is set it must be shown.
//!
//! On loopback a request must name a loopback host, so that a foreign page cannot reach the service by a name of its
//! own that leads here. Listening elsewhere needs a token; then a host may also be any address, which no name can lead
//! to, or a name that was allowed.

use std::net::IpAddr;
use std::sync::Arc;

use axum::extract::{Request, State};
use axum::http::{HeaderMap, HeaderValue, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};
use sha2::{Digest, Sha256};
use subtle::ConstantTimeEq;

use crate::http::problem::Kind;

/// Shortest token: 16 random characters are some 90 bits.
const TOKEN_LEAST: usize = 16;
/// Longest token; a header holds it.
const TOKEN_MOST: usize = 512;
/// What may be read without a token: whether the service lives and can work, and pages and scripts, which hold no data.
const OPEN: [&str; 10] = [
    "/",
    "/docs",
    "/healthz",
    "/readyz",
    "/assets/dashboard.js",
    "/assets/job.js",
    "/assets/chart.js",
    "/assets/docs.js",
    "/assets/page.js",
    "/assets/page.css",
];

/// Why a token cannot be used.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum TokenError {
    /// Too short to be safe, or too long for a header.
    #[error("the access token has {0} characters; it must have {TOKEN_LEAST} to {TOKEN_MOST}")]
    Length(usize),
    /// Cannot be sent in a header.
    #[error("the access token must be printable ASCII characters without spaces")]
    Text,
}

/// Who may ask.
#[derive(Debug, Clone, Default)]
pub struct Access {
    /// Digest of the token; the token itself is not kept.
    token_sha256: Option<[u8; 32]>,
    /// Names that the service answers to, besides loopback ones.
    hosts: Arc<[String]>,
}

impl Access {
    /// Access with a token, under these host names too.
    ///
    /// # Errors
    /// [`TokenError`] for a token that is not safe.
    pub fn new(token: Option<&str>, hosts: &[String]) -> Result<Self, TokenError> {
        let token_sha256 = token.map(checked).transpose()?;
        Ok(Self {
            token_sha256,
            hosts: hosts.iter().map(|host| host.to_ascii_lowercase()).collect(),
        })
    }

    /// Whether a token is asked for.
    pub fn asks_for_token(&self) -> bool {
        self.token_sha256.is_some()
    }

    fn refusal(&self, path: &str, headers: &HeaderMap) -> Option<Response> {
        if let Some(what) = self.foreign(headers) {
            return Some(Kind::Host.because(what).into_response());
        }
        let digest = self.token_sha256.as_ref()?;
        if OPEN.contains(&path) || shows(headers, digest) {
            return None;
        }
        let mut response = Kind::Token
            .because("send `Authorization: Bearer TOKEN` with this service's token")
            .into_response();
        let challenge = HeaderValue::from_static("Bearer realm=\"fretwear\"");
        response
            .headers_mut()
            .insert(header::WWW_AUTHENTICATE, challenge);
        Some(response)
    }

    fn foreign(&self, headers: &HeaderMap) -> Option<&'static str> {
        let text = |name| {
            headers
                .get(name)
                .map(|value| value.to_str().unwrap_or_default())
        };
        let host = text(header::HOST);
        if host.is_some_and(|host| !self.answers_to(host)) {
            return Some("the host header does not name this service");
        }
        let origin = text(header::ORIGIN)?;
        let same = origin.split_once("://").map(|(_, authority)| authority) == host;
        (!same).then_some("the origin is another host")
    }

    fn answers_to(&self, authority: &str) -> bool {
        let name = match authority.strip_prefix('[') {
            Some(rest) => rest.split(']').next().unwrap_or_default(),
            None => authority.split(':').next().unwrap_or_default(),
        };
        let name = name.to_ascii_lowercase();
        let address = name.parse::<IpAddr>();
        name == "localhost"
            || address.is_ok_and(|address| address.is_loopback() || self.asks_for_token())
            || self.hosts.contains(&name)
    }
}

fn checked(token: &str) -> Result<[u8; 32], TokenError> {
    let length = token.chars().count();
    if !(TOKEN_LEAST..=TOKEN_MOST).contains(&length) {
        return Err(TokenError::Length(length));
    }
    if !token.chars().all(|c| c.is_ascii_graphic()) {
        return Err(TokenError::Text);
    }
    Ok(Sha256::digest(token).into())
}

/// Whether the request shows the token. Digests of equal length are compared in constant time, so that neither the time
/// taken nor the length tells anything about it.
fn shows(headers: &HeaderMap, digest: &[u8; 32]) -> bool {
    let shown = headers
        .get(header::AUTHORIZATION)
        .and_then(|value| value.to_str().ok())
        .and_then(|value| value.split_once(' '))
        .filter(|(scheme, _)| scheme.eq_ignore_ascii_case("bearer"))
        .map(|(_, token)| token.trim())
        .unwrap_or_default();
    let shown: [u8; 32] = Sha256::digest(shown).into();
    shown.ct_eq(digest).into()
}

pub(super) async fn check(State(access): State<Access>, request: Request, next: Next) -> Response {
    match access.refusal(request.uri().path(), request.headers()) {
        Some(refusal) => refusal,
        None => next.run(request).await,
    }
}

#[cfg(test)]
mod tests {
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
    fn without_a_token_loopback_hosts_pass_and_others_do_not() {
        let access = Access::default();
        for host in [
            "localhost:8080",
            "127.0.0.1",
            "127.0.0.1:1",
            "[::1]:8080",
            "LOCALHOST",
        ] {
            assert_eq!(access.foreign(&headers(host, &[])), None, "{host}");
        }
        for host in [
            "attacker.test",
            "127.0.0.1.attacker.test",
            "10.0.0.1:8080",
            "",
        ] {
            assert!(access.foreign(&headers(host, &[])).is_some(), "{host}");
        }
    }

    #[test]
    fn with_a_token_addresses_and_allowed_names_pass_too() {
        let access = Access::new(Some(TOKEN), &["Wear.Lab".to_owned()]).expect("access");
        for host in [
            "10.0.0.1:8080",
            "wear.lab:80",
            "[2001:db8::1]:8080",
            "localhost",
        ] {
            assert_eq!(access.foreign(&headers(host, &[])), None, "{host}");
        }
        assert!(access.foreign(&headers("attacker.test", &[])).is_some());
    }

    #[test]
    fn a_foreign_origin_does_not_pass() {
        let access = Access::default();
        let from = |origin| headers("127.0.0.1:9", &[(header::ORIGIN, origin)]);
        assert_eq!(access.foreign(&from("http://127.0.0.1:9")), None);
        assert!(access.foreign(&from("http://attacker.test")).is_some());
        assert!(access.foreign(&from("null")).is_some());
    }

    #[test]
    fn only_the_token_opens_and_pages_are_open() {
        let access = Access::new(Some(TOKEN), &[]).expect("access");
        let with = |value: &str| headers("127.0.0.1", &[(header::AUTHORIZATION, value)]);
        let passes = |path: &str, headers: &HeaderMap| access.refusal(path, headers).is_none();
        for shown in [
            "",
            "Bearer",
            "Bearer ",
            "Bearer correct-horse-batterx",
            "Bearer correct-horse-battery2",
            "Basic correct-horse-battery",
            TOKEN,
        ] {
            assert!(!passes("/v1/jobs", &with(shown)), "{shown}");
        }
        for scheme in ["Bearer", "bearer"] {
            assert!(passes("/v1/jobs", &with(&format!("{scheme} {TOKEN}"))));
        }
        assert!(OPEN.iter().all(|path| passes(path, &with(""))));
        assert!(!passes("/openapi.json", &with("")));
    }

    #[test]
    fn weak_tokens_are_refused() {
        let new = |token: &str| Access::new(Some(token), &[]).map(|_| ());
        assert_eq!(new("short"), Err(TokenError::Length(5)));
        assert_eq!(new(&"x".repeat(513)), Err(TokenError::Length(513)));
        assert_eq!(new("with spaces in it, long"), Err(TokenError::Text));
        assert_eq!(new("0123456789abcdef"), Ok(()));
    }
}
