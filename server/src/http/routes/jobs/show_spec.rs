//! `GET /v1/jobs/{id}/spec`: the specification of a job as it was sent.

use api::spec::Spec;
use axum::extract::State;
use axum::http::{HeaderName, header};
use axum::response::{IntoResponse, Response};
use uuid::Uuid;

use crate::export::documents::JSON;
use crate::http::app::App;
use crate::http::extract::JobId;
use crate::http::problem::ProblemResponse;

/// The header of [`Form`].
const FORM: HeaderName = HeaderName::from_static("fretwear-specification");

/// A specification as it was sent, or the resolved one of a job that an earlier version has queued, in which every value counts as given.
#[derive(Debug)]
pub(crate) struct SentSpec {
    form: &'static str,
    json: String,
}

impl SentSpec {
    /// As it was sent, JSON.
    pub(crate) fn sent(json: String) -> Self {
        Self { form: "sent", json }
    }

    /// Resolved, without the provenance that is no longer that of its values when it is sent again.
    fn resolved(mut spec: Spec) -> Result<Self, ProblemResponse> {
        spec.provenance.clear();
        let json =
            serde_json::to_string(&spec).map_err(|error| ProblemResponse::internal(&error))?;
        Ok(Self {
            form: "resolved",
            json,
        })
    }
}

impl IntoResponse for SentSpec {
    fn into_response(self) -> Response {
        ([(header::CONTENT_TYPE, JSON), (FORM, self.form)], self.json).into_response()
    }
}

impl App {
    /// Returns the specification of a job as it was sent.
    pub(in crate::http) async fn sent_spec(&self, id: Uuid) -> Result<SentSpec, ProblemResponse> {
        if let Some(sent) = self.store.sent_spec(id).await? {
            return Ok(SentSpec::sent(sent));
        }
        SentSpec::resolved(self.job(id).await?.document.spec)
    }
}

/// The specification as it was sent, without the defaults that the service filled in: what is changed and submitted again. Of a job of a
/// sweep, the base with the changes of this job.
#[utoipa::path(
    get,
    path = "/v1/jobs/{id}/spec",
    tag = "jobs",
    responses(
        (status = 200, description = "The specification", body = Spec, headers(
            ("Fretwear-Specification" = String, description = "`sent`, or `resolved` of a job that was queued before specifications were stored as they were sent"),
        )),
    )
)]
pub(crate) async fn show_spec(
    State(app): State<App>,
    JobId(id): JobId,
) -> Result<SentSpec, ProblemResponse> {
    app.sent_spec(id).await
}

#[cfg(test)]
mod tests {
    use serde_json::{Value, json};
    use uuid::Uuid;

    use crate::http::tests::{STUDY, SWEEP, Service};
    use crate::queue::Transition;
    use crate::store::tests::sent_specifications::forget_sent_specifications;
    use crate::store::{End, JobUpdate};

    /// Specification and form of a job.
    async fn sent(service: &Service, id: &str) -> (String, Value) {
        let path = format!("/v1/jobs/{id}/spec");
        let (status, headers, text) = service.text("GET", &path, &[], "").await;
        assert_eq!(status, 200, "{text}");
        assert_eq!(headers["content-type"], "application/json");
        let form = headers["fretwear-specification"].to_str().expect("text");
        (form.to_owned(), serde_json::from_str(&text).expect("JSON"))
    }

    #[tokio::test]
    async fn a_job_has_the_text_that_was_sent_also_after_a_retry() {
        let service = Service::new().await;
        let text = "{ \"cycles\": 1e1,\n \"system\": {\"kind\":\"dimm\"} }";
        let id = service.queued(&format!("\u{feff}{text}")).await;
        let (_, _, job) = service.get(&format!("/v1/jobs/{id}")).await;
        let path = job["links"]["spec"].as_str().expect("a link").to_owned();
        assert_eq!(service.text("GET", &path, &[], "").await.2, text);
        let store = &service.app.store;
        let claim = store.claim_next(i64::MAX).await.expect("a job");
        let end = End::without_result(Transition::Fail, "as the test asked for");
        store.end_next(&claim, &JobUpdate::default(), &end).await;
        service.post(&format!("/v1/jobs/{id}/retry"), "").await;
        assert_eq!(service.text("GET", &path, &[], "").await.2, text);
    }

    #[tokio::test]
    async fn a_job_of_a_sweep_has_the_base_with_its_changes() {
        let service = Service::new().await;
        let (_, _, sweep) = service.post("/v1/sweeps", SWEEP).await;
        let request: Value = serde_json::from_str(SWEEP).expect("JSON");
        for job in sweep["jobs"].as_array().expect("jobs") {
            let (form, spec) = sent(&service, job["id"].as_str().expect("an id")).await;
            assert_eq!(form, "sent");
            for (pointer, value) in job["overrides"].as_object().expect("changes") {
                assert_eq!(spec.pointer(pointer), Some(value), "{spec}");
            }
            assert_eq!(spec["system"], request["base"]["system"]);
            assert!(
                spec.get("materials").is_none(),
                "a default is left out: {spec}"
            );
        }
        let base = sweep["links"]["base"].as_str().expect("a link");
        let (_, headers, shown) = service.get(base).await;
        assert_eq!(headers["fretwear-specification"], "sent");
        assert_eq!(shown, request["base"]);
    }

    #[tokio::test]
    async fn a_job_of_a_study_has_the_base_with_its_accuracy() {
        let service = Service::new().await;
        let (_, _, study) = service.post("/v1/studies", STUDY).await;
        let request: Value = serde_json::from_str(STUDY).expect("JSON");
        let first = study["jobs"][0]["id"].as_str().expect("an id");
        let (form, spec) = sent(&service, first).await;
        assert_eq!(form, "sent");
        let tolerance = &study["jobs"][0]["tolerance"];
        assert_eq!(&spec["accuracy"]["tolerance"], tolerance, "{spec}");
        assert!(
            spec.get("materials").is_none(),
            "a default is left out: {spec}"
        );
        let (_, _, job) = service.get(&format!("/v1/jobs/{first}")).await;
        let provenance = &job["spec"]["provenance"];
        assert_ne!(provenance["/materials/slider/youngs_modulus_mpa"], "given");
        let base = study["links"]["base"].as_str().expect("a link");
        assert_eq!(service.get(base).await.2, request["base"]);
    }

    #[tokio::test]
    async fn jobs_of_earlier_versions_have_their_resolved_specification() {
        let service = Service::new().await;
        let (_, _, sweep) = service.post("/v1/sweeps", SWEEP).await;
        let database = service.results_folder().with_extension("");
        forget_sent_specifications(&format!("sqlite://{}", database.display())).await;
        let first = sweep["jobs"][0]["id"].as_str().expect("an id");
        let (form, spec) = sent(&service, first).await;
        assert_eq!(form, "resolved");
        let (_, _, job) = service.get(&format!("/v1/jobs/{first}")).await;
        let mut resolved = job["spec"].clone();
        resolved
            .as_object_mut()
            .expect("fields")
            .remove("provenance");
        assert_eq!(spec, resolved);
        let base = sweep["links"]["base"].as_str().expect("a link");
        let (_, headers, shown) = service.get(base).await;
        assert_eq!(headers["fretwear-specification"], "resolved");
        assert_eq!(shown, resolved, "of the first job");
        service
            .post(
                &format!("/v1/sweeps/{}/cancel", sweep["id"].as_str().expect("an id")),
                "",
            )
            .await;
        for job in sweep["jobs"].as_array().expect("jobs") {
            let path = format!("/v1/jobs/{}", job["id"].as_str().expect("an id"));
            service.send("DELETE", &path, &[], "").await;
        }
        let (status, _, problem) = service.get(base).await;
        let found = (status.as_u16(), &problem["type"]);
        assert_eq!(found, (404, &json!("/problems/no-such-result")));
    }

    #[tokio::test]
    async fn an_unknown_job_is_a_404() {
        let service = Service::new().await;
        let path = format!("/v1/jobs/{}/spec", Uuid::nil());
        let (status, _, problem) = service.get(&path).await;
        let found = (status.as_u16(), problem["type"].as_str());
        assert_eq!(found, (404, Some("/problems/no-such-job")));
        for collection in ["sweeps", "studies"] {
            let path = format!("/v1/{collection}/{}/base", Uuid::nil());
            assert_eq!(service.get(&path).await.0, 404);
        }
    }
}
