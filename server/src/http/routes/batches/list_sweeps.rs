//! `GET /v1/sweeps`: sweeps, newest first.

use api::problem::Problem;
use api::sweep::SweepList;
use axum::Json;
use axum::extract::State;
use serde::Deserialize;
use utoipa::IntoParams;

use crate::http::App;
use crate::http::extract::Params;
use crate::http::paging::Page;
use crate::http::problem::ProblemResponse;

/// Which page.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub(in crate::http) struct ListSweepsQuery {
    /// Sweeps of a page, 1 to 500.
    #[param(value_type = Option<u32>, minimum = 1, maximum = 500)]
    limit: Option<String>,
    /// Where the page starts: `next_page_token` of the page before.
    page_token: Option<String>,
}

/// Sweeps, newest first, without their jobs.
#[utoipa::path(
    get,
    path = "/v1/sweeps",
    tag = "sweeps",
    params(ListSweepsQuery),
    responses(
        (status = 200, description = "A page of sweeps", body = SweepList),
        (status = 400, description = "A query parameter cannot be read", body = Problem),
    )
)]
pub(in crate::http) async fn list_sweeps(
    State(app): State<App>,
    Params(query): Params<ListSweepsQuery>,
) -> Result<Json<SweepList>, ProblemResponse> {
    let page = Page::parse(
        "sweeps",
        query.limit.as_deref(),
        query.page_token.as_deref(),
    )?;
    let mut sweeps = app.store.sweeps(page.before, page.query_limit()).await?;
    let next_page_token = page.truncate(&mut sweeps, |sweep| sweep.id);
    Ok(Json(SweepList {
        sweeps,
        next_page_token,
    }))
}

#[cfg(test)]
mod tests {
    use crate::http::tests::{SWEEP, Service};

    #[tokio::test]
    async fn sweeps_come_newest_first_in_pages() {
        let service = Service::new().await;
        let mut ids = Vec::new();
        for _ in 0..3 {
            let (_, _, sweep) = service.post("/v1/sweeps", SWEEP).await;
            ids.push(sweep["id"].clone());
        }
        ids.reverse();
        let (status, _, first) = service.get("/v1/sweeps?limit=2").await;
        assert_eq!(status, 200);
        let token = first["next_page_token"].as_str().expect("a token");
        let (_, _, second) = service
            .get(&format!("/v1/sweeps?limit=2&page_token={token}"))
            .await;
        assert!(second["next_page_token"].is_null());
        let pages = [&first["sweeps"], &second["sweeps"]];
        let found = pages
            .into_iter()
            .flat_map(|page| page.as_array().expect("sweeps"));
        let found: Vec<_> = found.map(|sweep| sweep["id"].clone()).collect();
        assert_eq!(found, ids);
        let overview = &first["sweeps"][0];
        assert_eq!(
            (&overview["name"], &overview["counts"]["queued"]),
            (&"loads".into(), &4.into())
        );
        assert_eq!(overview["counts"]["failed"], 0);
        assert!(overview["links"]["outcomes"].is_string());
    }

    #[tokio::test]
    async fn unreadable_pages_are_problems() {
        let service = Service::new().await;
        service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let (_, _, jobs) = service.get("/v1/jobs?limit=1").await;
        let foreign = jobs["next_page_token"].as_str().expect("a token");
        for query in [
            "limit=0",
            "limit=501",
            "limit=many",
            "status=queued",
            &format!("page_token={foreign}"),
        ] {
            let (status, _, problem) = service.get(&format!("/v1/sweeps?{query}")).await;
            assert_eq!(
                (status.as_u16(), problem["type"].as_str()),
                (400, Some("/problems/invalid-query")),
                "{query}"
            );
        }
    }
}
