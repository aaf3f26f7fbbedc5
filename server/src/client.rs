//! A client of the service: its requests, the event stream of a job, and the files of a job.
//!
//! Idempotent requests are sent again for a while if the service cannot be reached or is busy, so that a restart
//! of the service fails no script.

mod download;
mod error;
mod events;
mod jobs;
mod readiness;
mod specification;
mod upload;
mod worker_tokens;

use std::net::IpAddr;
use std::path::Path;
use std::time::Duration;

use api::job::Job;
use api::problem::Problem;
use api::service::Demand;
use reqwest::header::{AUTHORIZATION, HeaderMap, HeaderValue, LOCATION, RETRY_AFTER};
use reqwest::redirect::Policy;
use reqwest::{Certificate, ClientBuilder, RequestBuilder, Response, StatusCode, Url};
use serde::Serialize;
use serde::de::DeserializeOwned;
use uuid::Uuid;

pub use download::Fetched;
pub use error::ClientError;
pub use events::Followed;
pub(crate) use jobs::WrittenId;
pub use specification::SentSpec;

/// Longest time without a byte of an answer: the service sends a comment into idle streams more often.
const READ_TIMEOUT: Duration = Duration::from_mins(1);
const CONNECT_TIMEOUT: Duration = Duration::from_secs(10);
/// Number of times a request is sent, and the pause before the second one; each later pause is twice as long.
const TRIES: u32 = 5;
const FIRST_PAUSE: Duration = Duration::from_millis(500);
/// Longest pause that `Retry-After` is followed for.
const LONGEST_PAUSE: Duration = Duration::from_secs(30);

/// A client of one service.
#[derive(Debug, Clone)]
pub struct Client {
    /// Address of the service, without a slash at its end.
    base: String,
    http: reqwest::Client,
}

impl Client {
    /// A client of the service at an address such as `http://127.0.0.1:8080`, with the access token that it requires, and with the
    /// authorities in a PEM file to trust instead of those of the system.
    ///
    /// # Errors
    /// [`ClientError::Address`], [`ClientError::Token`] and [`ClientError::Authorities`].
    pub fn new(server: &str, token: Option<&str>, ca: Option<&Path>) -> Result<Self, ClientError> {
        Self::with_trust(server, token, |http, url| match ca {
            Some(path) => Ok(http.tls_certs_only(authorities(path)?)),
            // Plain HTTP needs no authorities, and a system without any would be an error.
            None if url.scheme() == "http" => Ok(http.tls_certs_only([])),
            None => Ok(http),
        })
    }

    /// A client that does not verify whose certificate it is: for the health of a service on this machine, to which nothing is sent.
    ///
    /// # Errors
    /// [`ClientError::Address`].
    pub fn unverified(server: &str) -> Result<Self, ClientError> {
        let trust = |http: ClientBuilder, _: &Url| {
            Ok(http
                .tls_certs_only([])
                .tls_danger_accept_invalid_certs(true))
        };
        Self::with_trust(server, None, trust)
    }

    fn with_trust(
        server: &str,
        token: Option<&str>,
        trust: impl FnOnce(ClientBuilder, &Url) -> Result<ClientBuilder, ClientError>,
    ) -> Result<Self, ClientError> {
        let base = server.trim_end_matches('/');
        let url = Url::parse(base).ok().filter(is_address);
        let url = url.ok_or_else(|| ClientError::Address(server.to_owned()))?;
        let mut headers = HeaderMap::new();
        if let Some(token) = token {
            let value = HeaderValue::try_from(format!("Bearer {token}"));
            let mut value = value.map_err(|_| ClientError::Token)?;
            value.set_sensitive(true);
            if url.scheme() == "http" && !is_loopback(&url) {
                tracing::warn!(
                    server,
                    "the access token is sent unencrypted; use an address with https"
                );
            }
            headers.insert(AUTHORIZATION, value);
        }
        let http = reqwest::Client::builder()
            .default_headers(headers)
            .connect_timeout(CONNECT_TIMEOUT)
            .read_timeout(READ_TIMEOUT)
            // A submission that is redirected would become a GET.
            .redirect(Policy::none());
        let mut http = trust(http, &url)?;
        if is_loopback(&url) {
            http = http.no_proxy();
        }
        let http = http.build();
        let http = http.map_err(|cause| ClientError::unreachable(base, cause))?;
        Ok(Self {
            base: base.to_owned(),
            http,
        })
    }

    /// Gets a document.
    ///
    /// # Errors
    /// [`ClientError`].
    pub async fn get<T: DeserializeOwned>(
        &self,
        path: &str,
        options: &[(&str, String)],
    ) -> Result<T, ClientError> {
        let request = || self.http.get(self.url(path)).query(options);
        repeated(async || self.document(path, request()).await).await
    }

    /// Posts a document once.
    ///
    /// # Errors
    /// [`ClientError`].
    pub async fn post<T: DeserializeOwned>(
        &self,
        path: &str,
        body: &impl Serialize,
    ) -> Result<T, ClientError> {
        self.document(path, self.http.post(self.url(path)).json(body))
            .await
    }

    /// Returns the demand for workers; sends one request, with a token for workers.
    ///
    /// # Errors
    /// [`ClientError`].
    pub async fn demand(&self) -> Result<Demand, ClientError> {
        self.get_once("/v1/worker/demand").await
    }

    /// Gets a document; sends one request.
    ///
    /// # Errors
    /// [`ClientError`].
    pub(crate) async fn get_once<T: DeserializeOwned>(&self, path: &str) -> Result<T, ClientError> {
        self.document(path, self.http.get(self.url(path))).await
    }

    /// Cancels a job.
    ///
    /// # Errors
    /// [`ClientError`].
    pub async fn cancel(&self, id: Uuid) -> Result<Job, ClientError> {
        let path = format!("/v1/jobs/{id}/cancel");
        repeated(async || self.document(&path, self.http.post(self.url(&path))).await).await
    }

    /// Queues a failed or cancelled job again.
    ///
    /// # Errors
    /// [`ClientError`].
    pub async fn retry(&self, id: Uuid) -> Result<Job, ClientError> {
        let (path, mut tries) = (format!("/v1/jobs/{id}/retry"), 0);
        let post = async || {
            tries += 1;
            self.document(&path, self.http.post(self.url(&path))).await
        };
        match repeated(post).await {
            // An earlier try whose answer was lost has queued it, and it has succeeded since.
            Err(error) if tries > 1 && error.is_of_type("/problems/job-succeeded") => {
                self.job(id).await
            }
            answer => answer,
        }
    }

    /// Submits a specification under a key, so that one job is queued however often it is sent.
    ///
    /// # Errors
    /// [`ClientError`].
    pub async fn submit(
        &self,
        specification: Vec<u8>,
        options: &[(&str, String)],
        key: &str,
    ) -> Result<Job, ClientError> {
        let request = || {
            let request = self.http.post(self.url("/v1/jobs")).query(options);
            request
                .header("content-type", "application/json")
                .header("idempotency-key", key)
                .body(specification.clone())
        };
        repeated(async || self.document("/v1/jobs", request()).await).await
    }

    /// Returns a job.
    ///
    /// # Errors
    /// [`ClientError`].
    pub async fn job(&self, id: Uuid) -> Result<Job, ClientError> {
        self.get(&format!("/v1/jobs/{id}"), &[]).await
    }

    fn url(&self, path: &str) -> String {
        format!("{}{path}", self.base)
    }

    /// Sends a request once; an error status is an error.
    async fn send(&self, request: RequestBuilder) -> Result<Response, ClientError> {
        let sent = request.send().await;
        let response = sent.map_err(|cause| ClientError::unreachable(&self.base, cause))?;
        let status = response.status();
        if status.is_success() {
            return Ok(response);
        }
        if let Some(location) = response.headers().get(LOCATION) {
            return Err(ClientError::Redirected {
                url: self.base.clone(),
                location: String::from_utf8_lossy(location.as_bytes()).into_owned(),
            });
        }
        Err(problem(status, response).await)
    }

    /// Sends a request and reads the document of its answer.
    async fn document<T: DeserializeOwned>(
        &self,
        path: &str,
        request: RequestBuilder,
    ) -> Result<T, ClientError> {
        let bytes = self.send(request).await?.bytes().await;
        let bytes = bytes.map_err(|cause| ClientError::unreachable(&self.base, cause))?;
        self.parsed(path, &bytes)
    }

    /// Parses the response of a path.
    fn parsed<T: DeserializeOwned>(&self, path: &str, json: &[u8]) -> Result<T, ClientError> {
        serde_json::from_slice(json).map_err(|cause| ClientError::Answer {
            url: self.url(path),
            cause,
        })
    }
}

/// Repeats an idempotent attempt if the service cannot be reached, breaks off or is busy.
async fn repeated<T>(
    mut attempt: impl AsyncFnMut() -> Result<T, ClientError>,
) -> Result<T, ClientError> {
    let mut pause = FIRST_PAUSE;
    for _ in 1..TRIES {
        match attempt().await {
            Err(error) if error.is_temporary() => {
                let pause_now = error.retry_after().unwrap_or(pause).min(LONGEST_PAUSE);
                tokio::time::sleep(pause_now).await;
                pause *= 2;
            }
            ended => return ended,
        }
    }
    attempt().await
}

/// The certificates in a PEM file.
fn authorities(path: &Path) -> Result<Vec<Certificate>, ClientError> {
    let failed = |cause: String| ClientError::Authorities {
        path: path.to_owned(),
        cause,
    };
    let pem = std::fs::read(path).map_err(|cause| failed(cause.to_string()))?;
    let found = Certificate::from_pem_bundle(&pem).map_err(|cause| failed(cause.to_string()))?;
    if found.is_empty() {
        return Err(failed("it has no certificate".to_owned()));
    }
    Ok(found)
}

fn is_address(url: &Url) -> bool {
    ["http", "https"].contains(&url.scheme()) && url.has_host() && url.query().is_none()
}

/// Returns `true` if a proxy cannot reach the host of an address.
fn is_loopback(url: &Url) -> bool {
    let host = url.host_str().unwrap_or_default();
    let ip = host.trim_matches(['[', ']']).parse::<IpAddr>();
    host == "localhost" || ip.is_ok_and(|ip| ip.is_loopback())
}

/// The problem of an answer; of its status alone if it is no problem document, as that of a proxy.
async fn problem(status: StatusCode, response: Response) -> ClientError {
    let seconds = response.headers().get(RETRY_AFTER);
    let seconds = seconds.and_then(|value| value.to_str().ok()?.parse().ok());
    let bytes = response.bytes().await.unwrap_or_default();
    let problem = serde_json::from_slice(&bytes).unwrap_or_else(|_| Problem {
        kind: "about:blank".to_owned(),
        title: status.to_string(),
        status: status.as_u16(),
        detail: None,
        faults: Vec::new(),
    });
    ClientError::Problem {
        problem: Box::new(problem),
        retry_after: seconds.map(Duration::from_secs),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn addresses_have_a_scheme_and_a_host() {
        for address in [
            "http://127.0.0.1:8080",
            "https://wear.test/",
            "http://[::1]:80/fretwear",
        ] {
            assert!(Client::new(address, None, None).is_ok(), "{address}");
        }
        for address in [
            "127.0.0.1:8080",
            "",
            "ftp://wear.test",
            "http://",
            "http://a/?b",
        ] {
            assert!(Client::new(address, None, None).is_err(), "{address}");
        }
        assert!(Client::new("http://a", Some("a\nb"), None).is_err());
    }
}
