//! A client of the service: its requests, the event stream of a job, and the files of a job.
//!
//! Requests that change nothing twice are sent again for a while if the service cannot be reached or is busy, so that a restart
//! of the service fails no script.

mod download;
mod error;
mod events;

use std::time::Duration;

use api::job::Job;
use api::problem::Problem;
use reqwest::header::{AUTHORIZATION, HeaderMap, HeaderValue, RETRY_AFTER};
use reqwest::{RequestBuilder, Response, StatusCode};
use serde::de::DeserializeOwned;
use uuid::Uuid;

pub use download::Fetched;
pub use error::ClientError;
pub use events::Followed;

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
    /// A client of the service at an address such as `http://127.0.0.1:8080`, with the access token that it requires.
    ///
    /// # Errors
    /// [`ClientError::Address`] and [`ClientError::Token`].
    pub fn new(server: &str, token: Option<&str>) -> Result<Self, ClientError> {
        let base = server.trim_end_matches('/');
        let is_address = reqwest::Url::parse(base).is_ok_and(|url| {
            ["http", "https"].contains(&url.scheme()) && url.has_host() && url.query().is_none()
        });
        if !is_address {
            return Err(ClientError::Address(server.to_owned()));
        }
        let mut headers = HeaderMap::new();
        if let Some(token) = token {
            let value = HeaderValue::try_from(format!("Bearer {token}"));
            let mut value = value.map_err(|_| ClientError::Token)?;
            value.set_sensitive(true);
            headers.insert(AUTHORIZATION, value);
        }
        let http = reqwest::Client::builder()
            .default_headers(headers)
            .connect_timeout(CONNECT_TIMEOUT)
            .read_timeout(READ_TIMEOUT)
            .build();
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
    pub async fn get<T: DeserializeOwned>(&self, path: &str) -> Result<T, ClientError> {
        let response = self.send(self.http.get(self.url(path))).await?;
        self.document(path, response).await
    }

    /// Posts to a path that does nothing the second time.
    ///
    /// # Errors
    /// [`ClientError`].
    pub async fn post(&self, path: &str) -> Result<Job, ClientError> {
        let response = self.send(self.http.post(self.url(path))).await?;
        self.document(path, response).await
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
        let request = self.http.post(self.url("/v1/jobs"));
        let request = request
            .query(options)
            .header("content-type", "application/json")
            .header("idempotency-key", key)
            .body(specification);
        let response = self.send(request).await?;
        self.document("/v1/jobs", response).await
    }

    /// Returns a job.
    ///
    /// # Errors
    /// [`ClientError`].
    pub async fn job(&self, id: Uuid) -> Result<Job, ClientError> {
        self.get(&format!("/v1/jobs/{id}")).await
    }

    fn url(&self, path: &str) -> String {
        format!("{}{path}", self.base)
    }

    /// Sends a request, again if the service cannot be reached or is busy; an error status is an error.
    async fn send(&self, request: RequestBuilder) -> Result<Response, ClientError> {
        let mut pause = FIRST_PAUSE;
        for _ in 1..TRIES {
            let again = request.try_clone().ok_or(ClientError::Body)?;
            match self.send_once(again).await {
                Err(error) if error.is_temporary() => {
                    let pause_now = error.retry_after().unwrap_or(pause).min(LONGEST_PAUSE);
                    tokio::time::sleep(pause_now).await;
                    pause *= 2;
                }
                answer => return answer,
            }
        }
        self.send_once(request).await
    }

    async fn send_once(&self, request: RequestBuilder) -> Result<Response, ClientError> {
        let sent = request.send().await;
        let response = sent.map_err(|cause| ClientError::unreachable(&self.base, cause))?;
        let status = response.status();
        if status.is_success() {
            return Ok(response);
        }
        Err(problem(status, response).await)
    }

    async fn document<T: DeserializeOwned>(
        &self,
        path: &str,
        response: Response,
    ) -> Result<T, ClientError> {
        let bytes = response.bytes().await;
        let bytes = bytes.map_err(|cause| ClientError::unreachable(&self.base, cause))?;
        serde_json::from_slice(&bytes).map_err(|cause| ClientError::Answer {
            url: self.url(path),
            cause,
        })
    }
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
            assert!(Client::new(address, None).is_ok(), "{address}");
        }
        for address in [
            "127.0.0.1:8080",
            "",
            "ftp://wear.test",
            "http://",
            "http://a/?b",
        ] {
            assert!(Client::new(address, None).is_err(), "{address}");
        }
        assert!(Client::new("http://a", Some("a\nb")).is_err());
    }
}
