//! Fixture: a service on a database in a temporary folder, without workers. Tests of the router.

mod concurrent_requests;

use std::path::PathBuf;
use std::sync::Arc;

use api::plan::MachineFigures;
use api::results::{
    Loop, Pressure, PressurePosition, Profile, SideProfile, SlidePosition, Snapshot,
};
use axum::body::Body;
use axum::http::{HeaderMap, Request, StatusCode};
use http_body_util::BodyExt;
use serde_json::Value;
use solver::record::CycleReport;
use tempfile::TempDir;
use tokio_util::sync::CancellationToken;
use tower::ServiceExt;

use crate::estimate::machine::CalibrationCache;
use crate::export::documents::{CSV, JSON, VTU};
use crate::export::files;
use crate::http::{Access, App, openapi, router};
use crate::queue::Transition;
use crate::store;
use crate::store::{End, JobUpdate, NewContent, NewFile, Store};

/// All routes over a new store.
pub(crate) struct Service {
    pub(crate) app: App,
    folder: TempDir,
}

impl Service {
    pub(crate) async fn new() -> Self {
        let folder = TempDir::new().expect("a temporary folder");
        let url = format!("sqlite://{}", folder.path().join("test.db").display());
        let store = Arc::new(Store::open(&url).await.expect("a store"));
        let mut app = App::new(
            store,
            Access::default(),
            CancellationToken::new(),
            Arc::default(),
            openapi::document(),
        );
        // Fixed figures: a measurement takes a second or two.
        app.machine = CalibrationCache::of(MachineFigures {
            program: "test".to_owned(),
            increment_s: 2e-4,
            increment_power: 1.7,
            condensation_dof_s: 4e-7,
            condensation_surface_s: 7e-10,
        });
        Self { app, folder }
    }

    /// The folder of large results beside the database.
    pub(crate) fn results_folder(&self) -> PathBuf {
        self.folder.path().join("test.db.results")
    }

    pub(crate) async fn text(
        &self,
        method: &str,
        path: &str,
        headers: &[(&str, &str)],
        body: &str,
    ) -> (StatusCode, HeaderMap, String) {
        let (status, headers, bytes) = self.bytes(method, path, headers, body).await;
        (status, headers, String::from_utf8(bytes).expect("text"))
    }

    pub(crate) async fn bytes(
        &self,
        method: &str,
        path: &str,
        headers: &[(&str, &str)],
        body: &str,
    ) -> (StatusCode, HeaderMap, Vec<u8>) {
        let mut request = Request::builder()
            .method(method)
            .uri(path)
            .header("host", "127.0.0.1");
        for (name, value) in headers {
            request = request.header(*name, *value);
        }
        let request = request
            .body(Body::from(body.to_owned()))
            .expect("a request");
        let response = router(self.app.clone())
            .oneshot(request)
            .await
            .expect("an answer");
        let (parts, body) = response.into_parts();
        let bytes = body.collect().await.expect("a body").to_bytes();
        if let Ok(problem) = serde_json::from_slice::<Value>(&bytes)
            && problem["type"]
                .as_str()
                .is_some_and(|kind| kind.starts_with("/problems/"))
        {
            let listed = openapi::problems::is_listed(openapi::document(), method, path, &problem);
            assert_ne!(listed, Some(false), "{method} {path}: {problem}");
        }
        (parts.status, parts.headers, bytes.to_vec())
    }

    pub(crate) async fn send(
        &self,
        method: &str,
        path: &str,
        headers: &[(&str, &str)],
        body: &str,
    ) -> (StatusCode, HeaderMap, Value) {
        let (status, headers, text) = self.text(method, path, headers, body).await;
        (
            status,
            headers,
            serde_json::from_str(&text).unwrap_or(Value::Null),
        )
    }

    pub(crate) async fn get(&self, path: &str) -> (StatusCode, HeaderMap, Value) {
        self.send("GET", path, &[], "").await
    }

    pub(crate) async fn post(&self, path: &str, body: &str) -> (StatusCode, HeaderMap, Value) {
        self.send("POST", path, &[("content-type", "application/json")], body)
            .await
    }

    pub(crate) async fn put(&self, path: &str, body: &str) -> StatusCode {
        self.send("PUT", path, &[], body).await.0
    }

    /// Sends a request with a token, or without one.
    pub(crate) async fn with_token(
        &self,
        method: &str,
        path: &str,
        token: Option<&str>,
        body: &str,
    ) -> (u16, Value) {
        let bearer = token.map(|token| format!("Bearer {token}"));
        let mut headers = vec![("content-type", "application/json")];
        headers.extend(bearer.iter().map(|value| ("authorization", value.as_str())));
        let (status, _, answer) = self.send(method, path, &headers, body).await;
        (status.as_u16(), answer)
    }

    /// Queues a job and returns its id.
    pub(crate) async fn queued(&self, spec: &str) -> String {
        let (status, _, job) = self.post("/v1/jobs", spec).await;
        assert_eq!(status, 202, "{job}");
        job["id"].as_str().expect("an id").to_owned()
    }

    /// Adds an ended job with a file beside the database and one in it; returns its id.
    pub(crate) async fn with_files(&self) -> String {
        self.with_fields(FIELDS.as_bytes()).await
    }

    /// The same with fields of another content.
    pub(crate) async fn with_fields(&self, content: &[u8]) -> String {
        let id = self.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let store = &self.app.store;
        let claim = store.claim_next(i64::MAX).await.expect("a job");
        let fields = files::manifest_entry("fields-20.vtu", Some(20), VTU, content);
        files::write_atomically(&store.attempt_folder(&claim), &fields.name, content)
            .expect("kept");
        let table = "0.1,0.2\n".repeat(500).into_bytes();
        let update = JobUpdate {
            files: vec![
                NewFile {
                    file: files::manifest_entry("profile-20.csv", Some(20), CSV, &table),
                    content: NewContent::Inline(table),
                },
                NewFile {
                    file: fields,
                    content: NewContent::Folder,
                },
                NewFile {
                    file: files::manifest_entry("summary.json", None, JSON, b"{}"),
                    content: NewContent::Inline(b"{}".to_vec()),
                },
            ],
            ..JobUpdate::default()
        };
        let end = End {
            transition: Transition::Succeed,
            reason: None,
            outcome: None,
            summary: None,
        };
        store.end_next(&claim, &update, &end).await;
        id
    }

    /// Path of a large result of a job with one attempt.
    pub(crate) fn large_result(&self, id: &str, name: &str) -> PathBuf {
        let attempts = std::fs::read_dir(self.results_folder().join(id));
        let attempt = attempts.expect("a folder").next().expect("an attempt");
        attempt.expect("a folder").path().join(name)
    }

    /// Adds a running job with rows and snapshots at the cycles 10 and 20; returns its id.
    pub(crate) async fn with_results(&self) -> String {
        let id = self.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let store = &self.app.store;
        let claim = store.claim_next(i64::MAX).await.expect("a job");
        let update = JobUpdate {
            rows: [10, 20].map(row).to_vec(),
            snapshots: [10, 20].map(snapshot).to_vec(),
            ..JobUpdate::default()
        };
        store.record_next(&claim, &update).await;
        id
    }
}

/// A sweep of four jobs.
pub(crate) const SWEEP: &str = r#"{
  "name": "loads", "base": {"system": {"kind": "dimm"}},
  "grid": {"/cycles": [10, 20], "/load/n": [0.3, 0.6]}
}"#;

/// An accuracy study of a short fretting test.
pub(crate) const STUDY: &str = r#"{
  "name": "accuracy", "base": {"system": {"kind": "cylinder_on_flat"}, "cycles": 100}, "budget_s": 10
}"#;

/// Content of the file that stands for a large result.
pub(crate) const FIELDS: &str = "<VTKFile>0 1 2 3</VTKFile>";

/// A row of the history.
pub(crate) fn row(cycle: u64) -> CycleReport {
    CycleReport {
        cycle,
        jump: 1,
        sliding_distance_mm: 1.0,
        station_depth_mm: vec![0.0, 0.5, 0.0],
        load_n_per_mm: 0.5,
        peak_pressure_mpa: 3.0,
        contact_half_width_mm: 0.1,
        dissipated_energy_mj_per_mm: 2.0,
        ..CycleReport::default()
    }
}

pub(crate) fn snapshot(cycle: u64) -> Snapshot {
    let side = |values: &[f64]| SideProfile {
        x_mm: values.to_vec(),
        depth_mm: values.to_vec(),
    };
    let position = PressurePosition {
        phase: SlidePosition::Neutral,
        slider_x_mm: 0.0,
        x_mm: vec![0.0, 1.0],
        pressure_mpa: vec![1.0, 2.0],
        shear_mpa: vec![0.5, 1.0],
    };
    Snapshot {
        profile: Profile {
            cycle,
            receptacle: side(&[0.0]),
            slider: side(&[1.0]),
        },
        pressure: Pressure {
            cycle,
            positions: vec![position],
        },
        friction_loop: Loop {
            cycle,
            displacement_mm: vec![0.0, 1.0],
            tangential_force_n_per_mm: vec![1.0, -1.0],
            tangential_force_n: Vec::new(),
        },
    }
}

#[tokio::test]
async fn paths_and_methods_that_do_not_exist_are_problems() {
    let service = Service::new().await;
    let (status, headers, problem) = service.get("/v1/nothing").await;
    assert_eq!(
        (status.as_u16(), problem["type"].as_str()),
        (404, Some("/problems/no-such-path"))
    );
    assert_eq!(headers["content-type"], "application/problem+json");
    assert_eq!(headers["x-content-type-options"], "nosniff");
    let (status, _, problem) = service.send("PUT", "/v1/jobs", &[], "").await;
    assert_eq!(
        (status.as_u16(), problem["type"].as_str()),
        (405, Some("/problems/wrong-method"))
    );
}

#[tokio::test]
async fn a_foreign_host_is_rejected() {
    let service = Service::new().await;
    let request = Request::builder()
        .uri("/healthz")
        .header("host", "attacker.test")
        .body(Body::empty());
    let response = router(service.app.clone())
        .oneshot(request.expect("a request"))
        .await
        .expect("an answer");
    assert_eq!(response.status(), 403);
}

#[tokio::test]
async fn a_locked_database_is_a_503_with_retry_after() {
    let service = Service::new().await;
    service.app.store.close().await;
    let (status, _, problem) = service.get("/v1/jobs").await;
    assert_eq!(
        status, 500,
        "a closed database is an internal error: {problem}"
    );
    let service = Service::new().await;
    let path = service.results_folder().with_file_name("test.db");
    let _other = store::tests::hold_write_lock(&path).await;
    let (status, headers, problem) = service
        .post("/v1/jobs", r#"{"system":{"kind":"dimm"}}"#)
        .await;
    assert_eq!(
        (status.as_u16(), problem["type"].as_str()),
        (503, Some("/problems/busy"))
    );
    assert_eq!(headers["retry-after"], "5");
}
