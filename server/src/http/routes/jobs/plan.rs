//! `POST /v1/plans`: plans a specification; nothing is queued.

use api::plan::PlanDocument;
use api::spec::Spec;
use axum::Json;
use axum::extract::State;

use crate::http::app::App;
use crate::http::extract::JsonBody;
use crate::http::problem::ProblemResponse;
use crate::http::routes::jobs::submit::resolve;

/// Plan of a specification; nothing is queued. The first request measures the speed of the machine, which takes a
/// second or two.
#[utoipa::path(
    post,
    path = "/v1/plans",
    tag = "plans",
    request_body = Spec,
    responses(
        (status = 200, description = "The resolved specification and its plan", body = PlanDocument),
    )
)]
pub(crate) async fn make_plan(
    State(app): State<App>,
    JsonBody(body): JsonBody,
) -> Result<Json<PlanDocument>, ProblemResponse> {
    let (resolved, estimate) = resolve(body).await?;
    let machine = app.machine.get_or_measure_async().await;
    let plan = estimate.plan(&resolved, machine.as_ref());
    Ok(Json(PlanDocument {
        spec: resolved.spec,
        plan,
        machine,
    }))
}

#[cfg(test)]
mod tests {
    use crate::http::tests::Service;

    #[tokio::test]
    async fn a_plan_queues_nothing() {
        let service = Service::new().await;
        let (status, _, document) = service
            .post("/v1/plans", r#"{"system":{"kind":"fuzz_button"}}"#)
            .await;
        assert_eq!(status, 200);
        let load = document["plan"]["estimates"]["line_load_n_per_mm"]
            .as_f64()
            .expect("a number");
        assert!((load - 0.508).abs() < 1e-12);
        assert!(document["plan"]["estimates"]["cpu_s"].as_f64() > Some(0.0));
        assert!(document["machine"]["increment_s"].as_f64() > Some(0.0));
        assert_eq!(
            service.get("/v1/jobs").await.2["jobs"],
            serde_json::json!([])
        );
        assert_eq!(
            service
                .post("/v1/plans", r#"{"system":{"kind":"x"}}"#)
                .await
                .0,
            422
        );
    }
}
