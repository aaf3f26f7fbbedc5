//! `GET /v1/jobs`: jobs, newest first.

use api::job::{JobList, Status};
use api::problem::Problem;
use axum::Json;
use axum::extract::State;
use axum::response::{IntoResponse, Response};
use serde::Deserialize;
use utoipa::IntoParams;
use uuid::Uuid;

use super::App;
use super::extract::Params;
use super::problem::{Kind, Refusal};
use crate::store::{Filter, StoreError};

/// Jobs of a page unless asked otherwise, and at most.
const PAGE: u32 = 50;
const PAGE_LIMIT: u32 = 500;

/// Why there is no list.
#[derive(Debug, thiserror::Error)]
pub(super) enum ListError {
    /// Not a status.
    #[error("`{0}` is not a status")]
    Status(String),
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

/// Which jobs.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
pub(super) struct ListQuery {
    /// Any of these statuses, separated by commas.
    status: Option<String>,
    /// This kind of system.
    system: Option<String>,
    /// This label, as `key:value`.
    label: Option<String>,
    /// Jobs of a page, 1 to 500.
    limit: Option<u32>,
    /// Where the page starts: `next_page_token` of the page before.
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
    Params(query): Params<ListQuery>,
) -> Result<Json<JobList>, ListError> {
    let mut filter = filter(&query)?;
    // One more tells whether there is a next page.
    let limit = filter.limit;
    filter.limit = limit + 1;
    let mut jobs = app.store.list(&filter).await?;
    let page = usize::try_from(limit).unwrap_or(usize::MAX);
    let more = jobs.len() > page;
    jobs.truncate(page);
    let next_page_token = jobs.last().filter(|_| more).map(|job| job.id.to_string());
    Ok(Json(JobList {
        jobs,
        next_page_token,
    }))
}

fn filter(query: &ListQuery) -> Result<Filter, ListError> {
    let statuses = query
        .status
        .iter()
        .flat_map(|list| list.split(','))
        .map(|name| Status::from_name(name).ok_or_else(|| ListError::Status(name.to_owned())))
        .collect::<Result<_, _>>()?;
    let label = query.label.as_deref().map(label).transpose()?;
    let before = query
        .page_token
        .as_deref()
        .map(Uuid::parse_str)
        .transpose()
        .map_err(|_| ListError::Token)?;
    let limit = query.limit.unwrap_or(PAGE);
    if !(1..=PAGE_LIMIT).contains(&limit) {
        return Err(ListError::Limit(limit));
    }
    Ok(Filter {
        statuses,
        system: query.system.clone(),
        label,
        before,
        limit,
    })
}

fn label(text: &str) -> Result<(String, String), ListError> {
    let (key, value) = text
        .split_once(':')
        .ok_or_else(|| ListError::Label(text.to_owned()))?;
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
            .queued(r#"{"system":{"kind":"dimm"},"labels":{"lot":"7:a"}}"#)
            .await;
        let zif = service.queued(r#"{"system":{"kind":"zif"}}"#).await;
        service.post(&format!("/v1/jobs/{zif}/cancel"), "").await;
        for (query, expected) in [
            ("system=dimm", vec![&dimm]),
            ("label=lot:7:a", vec![&dimm]),
            ("label=lot:8", vec![]),
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
    async fn unreadable_filters_are_problems() {
        let service = Service::new().await;
        for query in [
            "status=done",
            "label=x",
            "limit=0",
            "limit=501",
            "limit=many",
            "page_token=1",
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
