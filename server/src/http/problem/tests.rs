//! Problems as clients see them, compared with `snapshots/`; after an intended change, run the tests with
//! `INSTA_UPDATE=always`.

use std::path::PathBuf;

use axum::response::IntoResponse;
use http_body_util::BodyExt;
use serde_json::Value;

use crate::http::access::Access;
use crate::http::app::App;
use crate::http::problem::{ProblemResponse, ProblemType};
use crate::http::tests::Service;
use crate::store::StoreError;

const UNKNOWN_ID: &str = "00000000-0000-7000-8000-000000000000";
const JSON: (&str, &str) = ("content-type", "application/json");

type Case<'a> = (&'a str, String, Vec<(&'a str, &'a str)>, String);

/// Sends requests and returns each with its problem, as text.
async fn problems(service: &Service, id: &str, cases: Vec<Case<'_>>) -> String {
    let mut text = String::new();
    for (method, path, headers, body) in cases {
        let (status, headers_back, problem) = service.send(method, &path, &headers, &body).await;
        assert_eq!(
            headers_back["content-type"], "application/problem+json",
            "{path}"
        );
        assert_eq!(problem["status"], status.as_u16(), "{path}");
        let shown: String = body.chars().take(80).collect();
        let problem = serde_json::to_string_pretty(&problem).expect("JSON");
        text += &format!("{method} {path} {shown}\n{problem}\n\n").replace(id, "ID");
    }
    text
}

#[tokio::test]
async fn problems_of_submissions_match_the_snapshot() {
    let service = Service::new().await;
    let post = |path: &str, more: &[(&'static str, &'static str)], body: &str| -> Case<'static> {
        let headers = [&[JSON], more].concat();
        ("POST", path.to_owned(), headers, body.to_owned())
    };
    let dimm = r#"{"system":{"kind":"dimm"}}"#;
    let key = ("idempotency-key", "a");
    let first = [JSON, key];
    assert_eq!(service.send("POST", "/v1/jobs", &first, dimm).await.0, 202);
    let large = format!(r#"{{"name":"{}"}}"#, "x".repeat(2 << 20));
    let cases = vec![
        post("/v1/jobs", &[], "{"),
        post(
            "/v1/jobs",
            &[],
            r#"{"system":{"kind":"dimm"},"cycles":"many"}"#,
        ),
        post(
            "/v1/jobs",
            &[],
            r#"{"system":{"kind":"dimm"},"labels":{"a":"1","a":"2"}}"#,
        ),
        post(
            "/v1/jobs",
            &[],
            r#"{"system":{"kind":"toaster"},"frobnicate":1,"load":{"kind":"pressure","mpa":-1}}"#,
        ),
        post("/v1/jobs", &[], &large),
        post("/v1/jobs?validate=true", &[], dimm),
        post("/v1/jobs", &[("idempotency-key", "")], dimm),
        post("/v1/jobs", &[key], r#"{"system":{"kind":"zif"}}"#),
        (
            "POST",
            "/v1/jobs".to_owned(),
            vec![("content-type", "text/plain")],
            "x".to_owned(),
        ),
        post("/v1/sweeps", &[], r#"{"base":{},"grid":{},"list":[]}"#),
        post(
            "/v1/sweeps",
            &[],
            r#"{"base":{"system":{"kind":"dimm"}},"list":[{"/cycles":0},{"cycles":1}]}"#,
        ),
        post(
            "/v1/plans",
            &[],
            r#"{"system":{"kind":"dimm"},"stop":[{}]}"#,
        ),
    ];
    insta::assert_snapshot!(problems(&service, "no id", cases).await);
}

#[tokio::test]
async fn problems_of_queries_match_the_snapshot() {
    let service = Service::new().await;
    let id = service.with_files().await;
    let active = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
    let get = |path: &str| -> Case<'static> { ("GET", path.to_owned(), vec![], String::new()) };
    let own = format!("/v1/jobs/{id}");
    let mut cases: Vec<Case<'_>> = [
        "/v1/nothing",
        "/v1/jobs?stauts=queued",
        "/v1/jobs?status=done",
        "/v1/jobs?limit=0",
        "/v1/jobs?page_token=1",
        "/v1/jobs?created_from=today",
        "/v1/jobs/1",
        "/v1/systems/toaster",
        "/v1/sweeps/1",
        "/assets/x.js",
    ]
    .into_iter()
    .map(get)
    .collect();
    for kind in ["jobs", "sweeps"] {
        cases.push(get(&format!("/v1/{kind}/{UNKNOWN_ID}")));
    }
    for rest in [
        "?wait=61s",
        "/results/profile",
        "/results/profile?cycle=-1",
        "/results/wear-history?max_points=1",
        "/results/files/x",
    ] {
        cases.push(get(&format!("{own}{rest}")));
    }
    let range = vec![("range", "bytes=999999-")];
    cases.push((
        "GET",
        format!("{own}/results/files/summary.json"),
        range,
        String::new(),
    ));
    let event = vec![("last-event-id", "x")];
    cases.push(("GET", format!("{own}/events"), event, String::new()));
    cases.push(("PUT", "/v1/jobs".to_owned(), vec![], String::new()));
    let text = problems(&service, &id, cases).await;
    let waiting = vec![
        (
            "DELETE",
            format!("/v1/jobs/{active}"),
            vec![],
            String::new(),
        ),
        (
            "GET",
            format!("/v1/jobs/{active}/results/archive"),
            vec![],
            String::new(),
        ),
    ];
    insta::assert_snapshot!(text + &problems(&service, &active, waiting).await);
}

#[tokio::test]
async fn problems_of_access_and_of_the_service_match_the_snapshot() {
    let mut service = Service::new().await;
    let foreign: Case<'_> = (
        "GET",
        "/v1/jobs".to_owned(),
        vec![("origin", "http://attacker.test")],
        String::new(),
    );
    let mut text = problems(&service, "no id", vec![foreign]).await;
    let id = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
    let permits = service.app.stream_permits.available_permits();
    let all = u32::try_from(permits).expect("small");
    let held = service
        .app
        .stream_permits
        .clone()
        .acquire_many_owned(all)
        .await;
    let full = vec![(
        "GET",
        format!("/v1/jobs/{id}/events"),
        vec![],
        String::new(),
    )];
    text += &problems(&service, &id, full).await;
    drop(held);
    let access = Access::new(Some("0123456789abcdef"), &[]).expect("access");
    let App {
        store,
        stopping,
        supervisor,
        ..
    } = service.app.clone();
    service.app = App::new(store, access, stopping, supervisor, service.app.document);
    let closed = vec![("GET", "/v1/jobs".to_owned(), vec![], String::new())];
    text += &problems(&service, "no id", closed).await;
    let hidden = std::io::Error::other("a secret path");
    let full = StoreError::Prepare {
        path: PathBuf::from("a secret path"),
        cause: std::io::ErrorKind::StorageFull.into(),
    };
    for response in [
        ProblemType::REQUEST_TIMEOUT.with_detail("the body did not arrive within 30 s"),
        ProblemResponse::from(full),
        ProblemResponse::internal(&hidden),
    ] {
        let body = response.into_response().into_body().collect().await;
        let problem: Value =
            serde_json::from_slice(&body.expect("a body").to_bytes()).expect("JSON");
        text += &serde_json::to_string_pretty(&problem).expect("JSON");
        text += "\n\n";
    }
    insta::assert_snapshot!(text);
}
