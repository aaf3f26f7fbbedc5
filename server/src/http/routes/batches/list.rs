//! `GET /v1/sweeps` and `GET /v1/studies`: batches, newest first.

use api::batch::BatchOverview;
use api::study::StudyList;
use api::sweep::SweepList;
use axum::Json;
use axum::extract::State;
use serde::Deserialize;
use utoipa::IntoParams;
use uuid::Uuid;

use crate::batch::Kind;
use crate::http::app::App;
use crate::http::extract::Params;
use crate::http::paging::Page;
use crate::http::problem::ProblemResponse;
use crate::store::BatchFilter;

/// Page of the list.
#[derive(Debug, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub(crate) struct ListBatchesQuery {
    /// Entries of a page, 1 to 500.
    #[param(value_type = Option<u32>, minimum = 1, maximum = 500)]
    limit: Option<String>,
    /// Start of the page: `next_page_token` of the page before.
    page_token: Option<String>,
}

/// Sweeps, newest first, without their jobs.
#[utoipa::path(
    get,
    path = "/v1/sweeps",
    tag = "sweeps",
    params(ListBatchesQuery),
    responses(
        (status = 200, description = "A page of sweeps", body = SweepList),
    )
)]
pub(crate) async fn list_sweeps(
    State(app): State<App>,
    Params(query): Params<ListBatchesQuery>,
) -> Result<Json<SweepList>, ProblemResponse> {
    let (sweeps, next_page_token) = page(&app, Kind::Sweep, &query).await?;
    Ok(Json(SweepList {
        sweeps,
        next_page_token,
    }))
}

/// Studies of accuracy, newest first, without their jobs and results.
#[utoipa::path(
    get,
    path = "/v1/studies",
    tag = "studies",
    params(ListBatchesQuery),
    responses(
        (status = 200, description = "A page of studies", body = StudyList),
    )
)]
pub(crate) async fn list_studies(
    State(app): State<App>,
    Params(query): Params<ListBatchesQuery>,
) -> Result<Json<StudyList>, ProblemResponse> {
    let (studies, next_page_token) = page(&app, Kind::AccuracyStudy, &query).await?;
    Ok(Json(StudyList {
        studies,
        next_page_token,
    }))
}

/// Returns a page, and the token of the next one.
async fn page(
    app: &App,
    kind: Kind,
    query: &ListBatchesQuery,
) -> Result<(Vec<BatchOverview>, Option<String>), ProblemResponse> {
    let (limit, token) = (query.limit.as_deref(), query.page_token.as_deref());
    let page = Page::<Uuid>::parse(kind.collection(), limit, token)?;
    let filter = BatchFilter {
        with_plan: kind.has_plan(),
        before: page.after().copied(),
        limit: page.query_limit(),
    };
    let mut batches = app.store.batches(filter).await?;
    let next_page_token = page.truncate(&mut batches, |batch| batch.id)?;
    let batches = batches.into_iter().map(|batch| BatchOverview {
        id: batch.id,
        name: batch.name,
        created_at: batch.created_at,
        counts: batch.counts,
        to_come: batch.to_come,
        links: kind.links(batch.id),
    });
    Ok((batches.collect(), next_page_token))
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use crate::http::tests::{STUDY, SWEEP, Service};

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

    #[tokio::test]
    async fn only_studies_are_listed_as_studies_and_every_batch_as_a_sweep() {
        let service = Service::new().await;
        service.post("/v1/sweeps", SWEEP).await;
        let (_, _, study) = service.post("/v1/studies", STUDY).await;
        let (status, _, studies) = service.get("/v1/studies").await;
        assert_eq!(status, 200);
        assert_eq!(studies["studies"].as_array().map(Vec::len), Some(1));
        let overview = &studies["studies"][0];
        for field in ["id", "name", "created_at", "counts", "links"] {
            assert_eq!(overview[field], study[field], "{field}");
        }
        assert_eq!(studies["next_page_token"], json!(null));
        let (_, _, sweeps) = service.get("/v1/sweeps").await;
        assert_eq!(sweeps["sweeps"].as_array().map(Vec::len), Some(2));
        assert_eq!(sweeps["sweeps"][0]["id"], study["id"]);
    }
}
