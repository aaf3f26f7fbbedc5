//! Lists of jobs, and ids that are written in short, as the pages show them.

use std::str::FromStr;

use api::job::JobOverview;
use api::worker::WorkerTokens;
use serde::Deserialize;
use uuid::Uuid;

use crate::client::{Client, ClientError};

/// Largest number of jobs of one answer.
const PAGE: usize = 500;
/// Least number of characters of an id in short.
const LEAST: usize = 4;

/// An id as it is written: the whole, or in short.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) enum WrittenId {
    Whole(Uuid),
    Short(ShortId),
}

/// The beginning or the end of an id.
#[derive(Debug, Clone, PartialEq, Eq)]
pub(crate) struct ShortId(String);

/// The text is no id.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
#[error(
    "expected an id, or {LEAST} or more of its first or last characters (0 to 9, a to f and -)"
)]
pub(crate) struct NoId;

impl FromStr for WrittenId {
    type Err = NoId;

    fn from_str(text: &str) -> Result<Self, NoId> {
        if let Ok(id) = Uuid::parse_str(text) {
            return Ok(Self::Whole(id));
        }
        let part = text.to_ascii_lowercase();
        let is_part = part.bytes().all(|b| b.is_ascii_hexdigit() || b == b'-');
        if is_part && part.len() >= LEAST {
            Ok(Self::Short(ShortId(part)))
        } else {
            Err(NoId)
        }
    }
}

impl ShortId {
    /// The one of some ids, with their names, that begins or ends with this.
    fn only_one(
        &self,
        kind: &'static str,
        ids: impl Iterator<Item = (Uuid, String)>,
    ) -> Result<Uuid, ClientError> {
        let part = &self.0;
        let matching = ids.filter(|(id, _)| {
            let id = id.to_string();
            id.starts_with(part) || id.ends_with(part)
        });
        let matching: Vec<_> = matching.collect();
        match &matching[..] {
            [(id, _)] => Ok(*id),
            [] => Err(ClientError::NoSuchId {
                kind,
                part: part.clone(),
            }),
            several => Err(ClientError::AmbiguousId {
                kind,
                part: part.clone(),
                candidates: several
                    .iter()
                    .map(|(id, name)| format!("{id} {name}"))
                    .collect(),
            }),
        }
    }
}

/// A page of a list.
#[derive(Deserialize)]
struct Page {
    jobs: Vec<JobOverview>,
    next_page_token: Option<String>,
}

impl Client {
    /// Returns the newest jobs that pass some filters, `limit` at most.
    ///
    /// # Errors
    /// [`ClientError`].
    pub async fn jobs(
        &self,
        filters: &[(&'static str, String)],
        limit: usize,
    ) -> Result<Vec<JobOverview>, ClientError> {
        let (mut jobs, mut token): (Vec<JobOverview>, Option<String>) = (Vec::new(), None);
        loop {
            let left = limit.saturating_sub(jobs.len());
            if left == 0 {
                return Ok(jobs);
            }
            let mut query = filters.to_vec();
            query.push(("view", "short".to_owned()));
            query.push(("limit", left.min(PAGE).to_string()));
            query.extend(token.map(|token| ("page_token", token)));
            let page: Page = self.get("/v1/jobs", &query).await?;
            jobs.extend(page.jobs);
            token = page.next_page_token;
            if token.is_none() {
                return Ok(jobs);
            }
        }
    }

    /// Returns the id of a job that may be written in short.
    ///
    /// # Errors
    /// [`ClientError::NoSuchId`] and [`ClientError::AmbiguousId`] of a short one.
    pub(crate) async fn job_id(&self, written: &WrittenId) -> Result<Uuid, ClientError> {
        match written {
            WrittenId::Whole(id) => Ok(*id),
            WrittenId::Short(short) => {
                // Names and labels with this text are among them.
                let filter = [("text", short.0.clone())];
                let jobs = self.jobs(&filter, usize::MAX).await?.into_iter();
                short.only_one(
                    "job",
                    jobs.map(|job| (job.id, job.name.unwrap_or_default())),
                )
            }
        }
    }

    /// Returns the id of a token of workers that may be written in short.
    ///
    /// # Errors
    /// As [`Self::job_id`].
    pub(crate) async fn worker_token_id(&self, written: &WrittenId) -> Result<Uuid, ClientError> {
        match written {
            WrittenId::Whole(id) => Ok(*id),
            WrittenId::Short(short) => {
                let WorkerTokens { tokens, .. } = self.worker_tokens().await?;
                let tokens = tokens.into_iter().map(|token| (token.id, token.name));
                short.only_one("token", tokens)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const IDS: [&str; 3] = [
        "01890a5d-ac96-774b-bcce-b302099a8057",
        "01890a5d-ac96-774b-bcce-b302099a9057",
        "01890a5e-0000-7000-8000-5d0000009057",
    ];

    fn found(written: &str) -> Result<String, ClientError> {
        let ids = IDS.map(|id| (Uuid::parse_str(id).expect("an id"), "name".to_owned()));
        match written.parse().expect("an id") {
            WrittenId::Whole(id) => Ok(id.to_string()),
            WrittenId::Short(short) => {
                let found = short.only_one("job", ids.into_iter());
                found.map(|id| id.to_string())
            }
        }
    }

    #[test]
    fn an_id_is_found_by_its_beginning_or_end() {
        for (written, index) in [
            (IDS[1], 1),
            ("b302099a8057", 0),
            ("8057", 0),
            ("B302099A9057", 1),
            ("01890a5e", 2),
            ("01890a5e-0000-7", 2),
        ] {
            assert_eq!(found(written).expect("one"), IDS[index], "{written}");
        }
        for (written, words) in [
            ("9057", "2 ids of a job begin or end with `9057`"),
            ("01890a5d", "01890a5d-ac96-774b-bcce-b302099a9057 name"),
            // In the middle, as only a search finds it.
            ("ac96", "no job has an id that begins or ends with `ac96`"),
        ] {
            let error = found(written).expect_err("not one").to_string();
            assert!(error.contains(words), "{error}");
        }
    }

    #[test]
    fn other_texts_are_no_ids() {
        for text in ["", "057", "job-1", "01890a5d_ac96", "%61%62"] {
            assert_eq!(text.parse::<WrittenId>(), Err(NoId), "{text}");
        }
    }
}
