//! `GET /v1/jobs`: jobs, newest first.

use api::job::{JobList, Status};
use api::problem::Problem;
use axum::Json;
use axum::extract::State;
use axum::response::{IntoResponse, Response};
use jiff::Timestamp;
use sha2::{Digest, Sha256};
use utoipa::IntoParams;
use uuid::Uuid;

use super::App;
use super::extract::Params;
use super::problem::{Kind, Refusal, shortened};
use crate::store::{Filter, StoreError};

/// Jobs of a page unless asked otherwise, and at most.
const PAGE: u32 = 50;
const PAGE_LIMIT: u32 = 500;
/// Most labels of a filter.
const LABEL_LIMIT: usize = 16;

/// Why there is no list.
#[derive(Debug, thiserror::Error)]
pub(super) enum ListError {
    /// Not a status.
    #[error("`{0}` is not a status")]
    Status(String),
    /// Not a parameter of this list.
    #[error("`{0}` is no parameter; parameters are {PARAMETERS}")]
    Unknown(String),
    /// Given twice.
    #[error("`{0}` is given twice")]
    Twice(String),
    /// Not a number.
    #[error("the limit `{0}` is not a number of jobs, 1 to {PAGE_LIMIT}")]
    Number(String),
    /// Not a time.
    #[error("`{0}` is not a time such as 2026-01-31T12:00:00Z")]
    Time(String),
    /// Not the id of a sweep.
    #[error("`{0}` is not the id of a sweep")]
    Sweep(String),
    /// Too many labels.
    #[error("{0} labels, a filter takes {LABEL_LIMIT}")]
    Labels(usize),
    /// Not a label.
    #[error("`{0}` is not a label such as key:value")]
    Label(String),
    /// Not a token of this list.
    #[error("the page token is not one of this list")]
    Token,
    /// Too many, or none.
    #[error("a page holds 1 to {PAGE_LIMIT} jobs, not {0}")]
    Limit(u32),
    /// The store failed.
    #[error(transparent)]
    Store(#[from] StoreError),
}

impl IntoResponse for ListError {
    fn into_response(self) -> Response {
        match &self {
            Self::Store(error) => Refusal::from(error),
            _ => Kind::InvalidQuery.because(self.to_string()),
        }
        .into_response()
    }
}

/// Names of the parameters below.
const PARAMETERS: &str =
    "status, system, label, created_from, created_before, sweep, limit and page_token";

/// Which jobs: all that every given filter lets through.
#[derive(Debug, Default, IntoParams)]
#[into_params(parameter_in = Query)]
#[expect(
    dead_code,
    reason = "describes the parameters, which are read one by one, some of them several times"
)]
pub(super) struct ListQuery {
    /// Any of these statuses, separated by commas.
    status: Option<String>,
    /// This kind of system.
    system: Option<String>,
    /// This label, as `key:value`; may be given several times, for jobs that have all of them.
    label: Option<Vec<String>>,
    /// Accepted at this time (RFC 3339) or later.
    created_from: Option<String>,
    /// Accepted before this time (RFC 3339).
    created_before: Option<String>,
    /// Jobs of this sweep.
    sweep: Option<Uuid>,
    /// Jobs of a page, 1 to 500.
    #[param(minimum = 1, maximum = 500)]
    limit: Option<u32>,
    /// Where the page starts: `next_page_token` of the page before, with the same filters.
    page_token: Option<String>,
}

/// Jobs, newest first.
#[utoipa::path(
    get,
    path = "/v1/jobs",
    tag = "jobs",
    params(ListQuery),
    responses(
        (status = 200, description = "A page of jobs", body = JobList),
        (status = 400, description = "A query parameter cannot be read", body = Problem),
    )
)]
pub(super) async fn list(
    State(app): State<App>,
    Params(pairs): Params<Vec<(String, String)>>,
) -> Result<Json<JobList>, ListError> {
    let (mut filter, limit) = read(&pairs)?;
    // One more tells whether there is a next page.
    filter.limit = limit + 1;
    let digest = digest(&filter);
    let mut jobs = app.store.list(&filter).await?;
    let page = usize::try_from(limit).unwrap_or(usize::MAX);
    let more = jobs.len() > page;
    jobs.truncate(page);
    let last = jobs.last().filter(|_| more);
    let next_page_token = last.map(|job| format!("{digest}{}", job.id.simple()));
    Ok(Json(JobList {
        jobs,
        next_page_token,
    }))
}

/// The filter that the parameters describe, and the number of jobs of a page.
fn read(pairs: &[(String, String)]) -> Result<(Filter, u32), ListError> {
    let (mut filter, mut limit, mut token) = (Filter::default(), None, None);
    for (index, (name, value)) in pairs.iter().enumerate() {
        let twice = pairs[..index].iter().any(|(earlier, _)| earlier == name);
        if twice && name != "label" {
            return Err(ListError::Twice(shortened(name)));
        }
        match name.as_str() {
            "status" => filter.statuses = statuses(value)?,
            "system" => filter.system = Some(value.clone()),
            "label" => filter.labels.push(label(value)?),
            "created_from" => filter.created_from = Some(time(value)?),
            "created_before" => filter.created_before = Some(time(value)?),
            "sweep" => {
                let id = Uuid::parse_str(value);
                filter.sweep = Some(id.map_err(|_| ListError::Sweep(shortened(value)))?);
            }
            "limit" => {
                let number = value.parse::<u32>();
                limit = Some(number.map_err(|_| ListError::Number(shortened(value)))?);
            }
            "page_token" => token = Some(value.as_str()),
            _ => return Err(ListError::Unknown(shortened(name))),
        }
    }
    let limit = limit.unwrap_or(PAGE);
    if !(1..=PAGE_LIMIT).contains(&limit) {
        return Err(ListError::Limit(limit));
    }
    if filter.labels.len() > LABEL_LIMIT {
        return Err(ListError::Labels(filter.labels.len()));
    }
    filter.before = token.map(|token| position(token, &filter)).transpose()?;
    Ok((filter, limit))
}

fn statuses(list: &str) -> Result<Vec<Status>, ListError> {
    list.split(',')
        .map(|name| Status::from_name(name).ok_or_else(|| ListError::Status(shortened(name))))
        .collect()
}

fn time(text: &str) -> Result<i64, ListError> {
    text.parse::<Timestamp>()
        .map(Timestamp::as_millisecond)
        .map_err(|_| ListError::Time(shortened(text)))
}

/// A short digest of what a list is filtered by; part of its page tokens, so that a token of another list is refused.
fn digest(filter: &Filter) -> String {
    let list = Filter {
        before: None,
        limit: 0,
        ..filter.clone()
    };
    let digest = Sha256::digest(format!("{list:?}"));
    let first = u32::from_be_bytes([digest[0], digest[1], digest[2], digest[3]]);
    format!("{first:08x}")
}

/// Where a page token says that the page starts.
fn position(token: &str, filter: &Filter) -> Result<Uuid, ListError> {
    token
        .strip_prefix(&digest(filter))
        .filter(|id| id.len() == 32)
        .and_then(|id| Uuid::parse_str(id).ok())
        .ok_or(ListError::Token)
}

fn label(text: &str) -> Result<(String, String), ListError> {
    let (key, value) = text
        .split_once(':')
        .ok_or_else(|| ListError::Label(shortened(text)))?;
    Ok((key.to_owned(), value.to_owned()))
}

#[cfg(test)]
mod tests {
    use crate::http::tests::Service;

    #[tokio::test]
    async fn jobs_come_newest_first_in_pages() {
        let service = Service::new().await;
        let mut ids = Vec::new();
        for _ in 0..5 {
            ids.push(service.queued(r#"{"system":{"kind":"dimm"}}"#).await);
        }
        ids.reverse();
        let mut seen = Vec::new();
        let mut path = "/v1/jobs?limit=2".to_owned();
        loop {
            let (status, _, page) = service.get(&path).await;
            assert_eq!(status, 200);
            for job in page["jobs"].as_array().expect("jobs") {
                seen.push(job["id"].as_str().expect("an id").to_owned());
            }
            let Some(token) = page["next_page_token"].as_str() else {
                break;
            };
            path = format!("/v1/jobs?limit=2&page_token={token}");
        }
        assert_eq!(seen, ids);
    }

    #[tokio::test]
    async fn filters_narrow_the_list() {
        let service = Service::new().await;
        let dimm = service
            .queued(r#"{"system":{"kind":"dimm"},"labels":{"lot":"7:a","by":"me"}}"#)
            .await;
        let zif = service.queued(r#"{"system":{"kind":"zif"}}"#).await;
        service.post(&format!("/v1/jobs/{zif}/cancel"), "").await;
        for (query, expected) in [
            ("system=dimm", vec![&dimm]),
            ("label=lot:7:a", vec![&dimm]),
            ("label=lot:8", vec![]),
            ("label=lot:7:a&label=by:me", vec![&dimm]),
            ("label=lot:7:a&label=by:you", vec![]),
            ("created_from=2020-01-01T00:00:00Z", vec![&zif, &dimm]),
            ("created_before=2020-01-01T00:00:00Z", vec![]),
            ("sweep=00000000-0000-7000-8000-000000000000", vec![]),
            ("status=cancelled", vec![&zif]),
            ("status=queued,cancelled", vec![&zif, &dimm]),
        ] {
            let (_, _, page) = service.get(&format!("/v1/jobs?{query}")).await;
            let found: Vec<_> = page["jobs"]
                .as_array()
                .expect("jobs")
                .iter()
                .map(|job| job["id"].as_str())
                .collect();
            let expected: Vec<_> = expected.into_iter().map(|id| Some(id.as_str())).collect();
            assert_eq!(found, expected, "{query}");
        }
    }

    #[tokio::test]
    async fn a_page_token_belongs_to_its_filters() {
        let service = Service::new().await;
        for _ in 0..2 {
            service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        }
        let (_, _, page) = service.get("/v1/jobs?limit=1&status=queued").await;
        let token = page["next_page_token"].as_str().expect("a token");
        let next = format!("/v1/jobs?limit=2&page_token={token}");
        assert_eq!(service.get(&format!("{next}&status=queued")).await.0, 200);
        assert_eq!(service.get(&next).await.0, 400);
    }

    #[tokio::test]
    async fn unreadable_filters_are_problems() {
        let service = Service::new().await;
        for query in [
            "status=done",
            "label=x",
            "limit=0",
            "limit=501",
            "limit=many",
            "page_token=1",
            "page_token=%F0%9F%98%80",
            "stauts=queued",
            "status=queued&status=failed",
            "created_from=yesterday",
            "sweep=7",
            &"label=a:b&".repeat(17),
        ] {
            let (status, _, problem) = service.get(&format!("/v1/jobs?{query}")).await;
            assert_eq!(
                (status.as_u16(), problem["type"].as_str()),
                (400, Some("/problems/invalid-query")),
                "{query}"
            );
        }
    }
}
