//! Refuses requests that a foreign page made a browser send: the service answers on loopback only, so a request must
//! name a loopback host, and a browser's `Origin` must be that host.

use axum::extract::Request;
use axum::http::{HeaderMap, header};
use axum::middleware::Next;
use axum::response::{IntoResponse, Response};

use super::problem::Kind;

pub(super) async fn check(request: Request, next: Next) -> Response {
    match foreign(request.headers()) {
        None => next.run(request).await,
        Some(what) => Kind::Host.because(what).into_response(),
    }
}

fn foreign(headers: &HeaderMap) -> Option<&'static str> {
    let text = |name| {
        headers
            .get(name)
            .map(|value| value.to_str().unwrap_or_default())
    };
    let host = text(header::HOST);
    if host.is_some_and(|host| !is_loopback(host)) {
        return Some("the host header does not name a loopback address");
    }
    let origin = text(header::ORIGIN)?;
    let same = origin.split_once("://").map(|(_, authority)| authority) == host;
    (!same).then_some("the origin is another host")
}

fn is_loopback(authority: &str) -> bool {
    let name = match authority.strip_prefix('[') {
        Some(rest) => rest.split(']').next().unwrap_or_default(),
        None => authority.split(':').next().unwrap_or_default(),
    };
    name.eq_ignore_ascii_case("localhost")
        || name
            .parse::<std::net::IpAddr>()
            .is_ok_and(|address| address.is_loopback())
}

#[cfg(test)]
mod tests {
    use super::*;

    fn headers(host: &str, origin: Option<&str>) -> HeaderMap {
        let mut headers = HeaderMap::new();
        headers.insert(header::HOST, host.parse().expect("a header"));
        if let Some(origin) = origin {
            headers.insert(header::ORIGIN, origin.parse().expect("a header"));
        }
        headers
    }

    #[test]
    fn loopback_hosts_pass_and_others_do_not() {
        for host in [
            "localhost:8080",
            "127.0.0.1",
            "127.0.0.1:1",
            "[::1]:8080",
            "LOCALHOST",
        ] {
            assert_eq!(foreign(&headers(host, None)), None, "{host}");
        }
        for host in [
            "attacker.test",
            "127.0.0.1.attacker.test",
            "10.0.0.1:8080",
            "",
        ] {
            assert!(foreign(&headers(host, None)).is_some(), "{host}");
        }
    }

    #[test]
    fn a_foreign_origin_does_not_pass() {
        assert_eq!(
            foreign(&headers("127.0.0.1:9", Some("http://127.0.0.1:9"))),
            None
        );
        assert!(foreign(&headers("127.0.0.1:9", Some("http://attacker.test"))).is_some());
        assert!(foreign(&headers("127.0.0.1:9", Some("null"))).is_some());
    }
}
