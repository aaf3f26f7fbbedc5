//! `POST /v1/sweeps/plans`: expected cost of a sweep; nothing is queued.

use api::sweep::{SweepPlan, SweepRequest};
use axum::Json;
use axum::extract::State;

use crate::batch::plan_sweep;
use crate::http::app::App;
use crate::http::extract::JsonBody;
use crate::http::problem::ProblemResponse;

/// Expected cost of a sweep; nothing is queued. The first request measures the speed of the machine, which takes a second or two.
#[utoipa::path(
    post,
    path = "/v1/sweeps/plans",
    tag = "sweeps",
    request_body = SweepRequest,
    responses(
        (status = 200, description = "Number of jobs, and their processor time", body = SweepPlan),
    )
)]
pub(crate) async fn make_sweep_plan(
    State(app): State<App>,
    JsonBody(body): JsonBody,
) -> Result<Json<SweepPlan>, ProblemResponse> {
    let machine = app.machine.get_or_measure_async().await;
    let plan = move || plan_sweep(&body, machine.as_ref());
    Ok(Json(tokio::task::spawn_blocking(plan).await??))
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};

    use crate::http::tests::Service;

    fn sum(plan: &Value, name: &str) -> f64 {
        plan["estimates"][name].as_f64().expect("seconds")
    }

    #[tokio::test]
    async fn a_sweep_takes_what_its_jobs_take_and_not_what_its_base_takes() {
        let service = Service::new().await;
        let base = json!({"system": {"kind": "dimm"}, "cycles": 100});
        let sweep = json!({"base": base, "grid": {"/cycles": [100, 1_000_000]}});
        let (status, _, plan) = service.post("/v1/sweeps/plans", &sweep.to_string()).await;
        assert_eq!((status.as_u16(), &plan["jobs"]), (200, &json!(2)), "{plan}");
        let (_, _, alone) = service.post("/v1/plans", &base.to_string()).await;
        let of_base = alone["plan"]["estimates"]["cpu_s"]
            .as_f64()
            .expect("seconds");
        assert!(sum(&plan, "cpu_s") > 3.0 * of_base, "{plan} {of_base}");
        let range = sum(&plan, "cpu_s_most") / sum(&plan, "cpu_s");
        assert!((1.0..=4.0 + 1e-9).contains(&range), "{range}");
        let (_, _, queued) = service.get("/v1/sweeps").await;
        assert_eq!(queued["sweeps"], json!([]));
    }

    #[tokio::test]
    async fn a_plan_refuses_what_the_sweep_would_be_refused_for() {
        let service = Service::new().await;
        let base = json!({"system": {"kind": "dimm"}, "cycles": 100});
        for grid in [
            json!({"/cycles": [0]}),
            json!({"/cycles": [10, 0]}),
            json!({"cycles": [10]}),
            json!({"/none": [1]}),
            json!({}),
        ] {
            let sweep = json!({"base": base, "grid": grid}).to_string();
            let (status, _, planned) = service.post("/v1/sweeps/plans", &sweep).await;
            let (_, _, submitted) = service.post("/v1/sweeps", &sweep).await;
            assert_eq!(status, 422, "{planned}");
            assert_eq!(planned["faults"], submitted["faults"]);
        }
    }
}
