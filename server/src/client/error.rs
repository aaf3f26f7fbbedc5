//! Errors of the client.

use std::path::PathBuf;
use std::time::Duration;

use api::problem::Problem;

use crate::store::IntegrityError;

/// Largest number of ids that the message of an ambiguous one lists.
const CANDIDATES_SHOWN: usize = 10;

/// Why a request failed.
#[derive(Debug, thiserror::Error)]
pub enum ClientError {
    /// The address of the service is invalid.
    #[error("`{0}` is not the address of a service such as http://127.0.0.1:8080")]
    Address(String),
    /// The access token cannot be sent.
    #[error("the access token has characters that a header cannot contain")]
    Token,
    /// The certificates of authorities cannot be read.
    #[error("{}: {cause}", .path.display())]
    Authorities {
        /// The file.
        path: PathBuf,
        /// Why.
        cause: String,
    },
    /// The service cannot be reached, or the connection broke.
    #[error("{url} cannot be reached: {cause}")]
    Unreachable {
        /// The service.
        url: String,
        /// The error and its causes.
        cause: String,
    },
    /// The service answered with a problem.
    #[error("{}", words(.problem))]
    Problem {
        /// The problem.
        problem: Box<Problem>,
        /// When to send the request again.
        retry_after: Option<Duration>,
    },
    /// The service is at another address.
    #[error("{url} is redirected to {location}; give the address of the service itself")]
    Redirected {
        /// The address that was given.
        url: String,
        /// Where it is redirected to.
        location: String,
    },
    /// An answer is not what this version expects.
    #[error("the answer of {url} cannot be read: {cause}")]
    Answer {
        /// The address.
        url: String,
        /// Why.
        cause: serde_json::Error,
    },
    /// An answer is no stream of events.
    #[error("the answer of {url} is no event stream; is it the address of the service?")]
    NoStream {
        /// The address.
        url: String,
    },
    /// Another program answers.
    #[error("{0} is no service of fretwear")]
    OtherService(String),
    /// No id has this beginning or end.
    #[error("no {kind} has an id that begins or ends with `{part}`")]
    NoSuchId {
        /// Kind of the thing with the id.
        kind: &'static str,
        /// The beginning or end.
        part: String,
    },
    /// Several ids have this beginning or end.
    #[error("{} ids of a {kind} begin or end with `{part}`; write more of it:{}", .candidates.len(), lines(.candidates))]
    AmbiguousId {
        /// Kind of the things with the ids.
        kind: &'static str,
        /// The beginning or end.
        part: String,
        /// The ids with their names.
        candidates: Vec<String>,
    },
    /// Several files could not be received.
    #[error("{} files could not be received, the first of them: {first}", .number)]
    Files {
        /// How many.
        number: usize,
        /// Why the first could not.
        first: Box<ClientError>,
    },
    /// A file cannot be written.
    #[error("{}: {cause}", .path.display())]
    File {
        /// The file or folder.
        path: PathBuf,
        /// The system's error.
        cause: std::io::Error,
    },
    /// A received file differs from its entry in the manifest.
    #[error("{name} was not received as it is stored: {cause}")]
    Received {
        /// The file.
        name: String,
        /// The difference.
        cause: IntegrityError,
    },
    /// The manifest names a path instead of a file.
    #[error("the service names `{0}`, which is no plain file name")]
    Name(String),
    /// The manifest has no such file.
    #[error("the job has no file `{name}`; it has {others}")]
    NoFile {
        /// The file.
        name: String,
        /// The files of the manifest.
        others: String,
    },
}

impl ClientError {
    /// A problem within an answer.
    pub(crate) fn of(problem: Problem) -> Self {
        Self::Problem {
            problem: Box::new(problem),
            retry_after: None,
        }
    }

    /// The connection failed; with the causes, which the library does not show.
    pub(super) fn unreachable(url: &str, error: reqwest::Error) -> Self {
        let mut cause = error.to_string();
        let error = error.without_url();
        let mut source = std::error::Error::source(&error);
        while let Some(inner) = source {
            cause = inner.to_string();
            source = inner.source();
        }
        Self::Unreachable {
            url: url.to_owned(),
            cause,
        }
    }

    /// Returns `true` if the same request may succeed later.
    pub fn is_temporary(&self) -> bool {
        match self {
            Self::Unreachable { .. } => true,
            Self::Problem { problem, .. } => [429, 502, 503, 504].contains(&problem.status),
            _ => false,
        }
    }

    /// Returns `true` if the service could not be reached.
    pub fn is_unreachable(&self) -> bool {
        matches!(self, Self::Unreachable { .. })
    }

    /// Returns `true` if the service refused what was sent, which the user can correct.
    pub fn is_refused(&self) -> bool {
        matches!(self, Self::AmbiguousId { .. })
            || matches!(self, Self::Problem { problem, .. } if [400, 413, 415, 422].contains(&problem.status))
    }

    /// Returns `true` if the service does not accept this client at all.
    pub fn is_rejected(&self) -> bool {
        matches!(self, Self::Redirected { .. } | Self::Answer { .. })
            || matches!(self, Self::Problem { problem, .. } if [401, 403, 404, 409].contains(&problem.status))
    }

    /// Returns `true` if the service answered with a problem of this type.
    pub(crate) fn is_of_type(&self, kind: &str) -> bool {
        matches!(self, Self::Problem { problem, .. } if problem.kind == kind)
    }

    /// Returns `true` if it concerns one file of several.
    pub(super) fn is_of_file(&self) -> bool {
        matches!(self, Self::Received { .. }) || self.is_of_type("/problems/result-damaged")
    }

    pub(super) fn retry_after(&self) -> Option<Duration> {
        match self {
            Self::Problem { retry_after, .. } => *retry_after,
            _ => None,
        }
    }
}

/// Lines below a message, the first of many.
fn lines(candidates: &[String]) -> String {
    let shown = candidates.iter().take(CANDIDATES_SHOWN);
    let lines = shown.map(|candidate| format!("\n  {candidate}"));
    let more = (candidates.len() > CANDIDATES_SHOWN).then(|| "\n  ..".to_owned());
    lines.chain(more).collect()
}

/// A problem in words, with all faults.
fn words(problem: &Problem) -> String {
    let detail = problem.detail.iter();
    let detail = detail.map(|detail| format!(": {detail}"));
    let faults = problem.faults.iter();
    let faults = faults.map(|fault| format!("\n  {}: {}", fault.pointer, fault.detail));
    std::iter::once(problem.title.clone())
        .chain(detail)
        .chain(faults)
        .collect()
}
