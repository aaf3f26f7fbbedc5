//! `GET /v1/labels`: labels that jobs have.

use api::service::Labels;
use axum::Json;
use axum::extract::State;

use crate::http::app::App;
use crate::http::problem::ProblemResponse;

/// Most labels of an answer.
const MOST: u32 = 1000;

/// Labels of the stored jobs, with the number of jobs that have each.
#[utoipa::path(
    get,
    path = "/v1/labels",
    tag = "jobs",
    responses((status = 200, description = "The labels", body = Labels))
)]
pub(crate) async fn labels(State(app): State<App>) -> Result<Json<Labels>, ProblemResponse> {
    let mut labels = app.store.labels(MOST + 1).await?;
    let more = labels.len() > MOST as usize;
    labels.truncate(MOST as usize);
    Ok(Json(Labels { labels, more }))
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use crate::http::tests::Service;

    #[tokio::test]
    async fn labels_are_counted_by_key_and_value() {
        let service = Service::new().await;
        for lot in ["7", "8", "8"] {
            let spec = json!({"system": {"kind": "dimm"}, "labels": {"lot": lot, "by": "me"}});
            service.queued(&spec.to_string()).await;
        }
        let (status, _, found) = service.get("/v1/labels").await;
        assert_eq!(status, 200);
        assert_eq!(
            found,
            json!({"more": false, "labels": [
                {"key": "by", "value": "me", "jobs": 3},
                {"key": "lot", "value": "8", "jobs": 2},
                {"key": "lot", "value": "7", "jobs": 1},
            ]})
        );
    }
}
