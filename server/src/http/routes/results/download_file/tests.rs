//! Files and parts of files, of present and of damaged ones.

use axum::http::Request;
use http_body_util::BodyExt;
use serde_json::json;
use tower::ServiceExt;

use super::*;
use crate::http::router;
use crate::http::tests::{FIELDS, Service};

/// The large file is stored beside the database, the small one in it.
const NAMES: [(&str, &str); 2] = [("fields-20.vtu", FIELDS), ("summary.json", "{}")];

#[tokio::test]
async fn a_file_is_sent_with_its_digest() {
    let service = Service::new().await;
    let id = service.with_files().await;
    for (name, content) in NAMES {
        let path = format!("/v1/jobs/{id}/results/files/{name}");
        let (status, headers, text) = service.text("GET", &path, &[], "").await;
        assert_eq!((status.as_u16(), text.as_str()), (200, content));
        assert_eq!(headers["accept-ranges"], "bytes");
        let attached = format!("attachment; filename=\"{name}\"");
        assert_eq!(headers["content-disposition"], attached.as_str());
        let known = [("if-none-match", headers["etag"].to_str().expect("text"))];
        let again = service.text("GET", &path, &known, "").await;
        assert_eq!((again.0.as_u16(), again.2.as_str()), (304, ""));
    }
}

#[tokio::test]
async fn a_range_is_sent_with_its_position() {
    let service = Service::new().await;
    let id = service.with_files().await;
    for (name, content) in NAMES {
        let path = format!("/v1/jobs/{id}/results/files/{name}");
        let last = content.len() - 1;
        for (range, from, to) in [
            ("bytes=0-0", 0, 0),
            ("bytes=1-", 1, last),
            ("bytes=-1", last, last),
            ("bytes=-99", 0, last),
            ("bytes=0-999999", 0, last),
        ] {
            let (status, headers, text) = service.text("GET", &path, &[("range", range)], "").await;
            assert_eq!((status.as_u16(), text.as_str()), (206, &content[from..=to]));
            let expected = format!("bytes {from}-{to}/{}", content.len());
            assert_eq!(headers["content-range"], expected.as_str(), "{range}");
        }
        for (headers, expected) in [
            (vec![("range", "bytes=99999-")], 416),
            (vec![("range", "bytes=-0")], 200),
            (vec![("range", "lines=1-2")], 200),
            (vec![("range", "bytes=0-0,1-1")], 200),
            (vec![("range", "bytes=0-0"), ("if-range", "\"older\"")], 200),
        ] {
            let (status, _, _) = service.text("GET", &path, &headers, "").await;
            assert_eq!(status, expected, "{headers:?}");
        }
    }
}

#[tokio::test]
async fn names_that_are_not_in_the_manifest_are_404() {
    let service = Service::new().await;
    let id = service.with_files().await;
    for name in [
        "other.vtu",
        "..%2F..%2Ftest.db",
        "%2Fetc%2Fpasswd",
        "summary.json%00",
    ] {
        let path = format!("/v1/jobs/{id}/results/files/{name}");
        let (status, _, problem) = service.get(&path).await;
        let found = (status.as_u16(), problem["type"].as_str());
        assert_eq!(found, (404, Some("/problems/no-such-result")), "{name}");
    }
    let not_utf8 = format!("/v1/jobs/{id}/results/files/%FF");
    assert_eq!(service.get(&not_utf8).await.0, 404);
    let unknown = "/v1/jobs/00000000-0000-7000-8000-000000000000/results/files/summary.json";
    assert_eq!(
        service.get(unknown).await.2["type"],
        "/problems/no-such-job"
    );
}

#[tokio::test]
async fn a_damaged_file_is_a_problem_and_is_marked_until_it_is_restored() {
    let service = Service::new().await;
    let id = service.with_files().await;
    let own = format!("/v1/jobs/{id}/results");
    let path = format!("{own}/files/fields-20.vtu");
    let stored = service.large_result(&id, "fields-20.vtu");
    let overwritten = FIELDS.to_uppercase();
    for (damage, words) in [
        (Some(overwritten.as_str()), "it has the SHA-256 "),
        (Some("<VTK"), "it has 4 bytes, its manifest names 26"),
        (None, "it does not exist"),
    ] {
        match damage {
            Some(content) => std::fs::write(&stored, content).expect("written"),
            None => std::fs::remove_file(&stored).expect("removed"),
        }
        for (path, headers) in [
            (&path, vec![]),
            (&path, vec![("range", "bytes=0-1")]),
            (&format!("{own}/archive"), vec![]),
        ] {
            let (status, _, text) = service.text("GET", path, &headers, "").await;
            assert_eq!(status, 500, "{path}: {text}");
            assert!(text.contains("/problems/result-damaged"), "{text}");
            assert!(
                text.contains("fields-20.vtu") && text.contains(words),
                "{text}"
            );
        }
        let (_, _, manifest) = service.get(&own).await;
        let mark = manifest["files"][0]["damaged"].as_str().expect("a mark");
        assert!(mark.starts_with(words), "{mark}");
    }
    std::fs::write(&stored, FIELDS).expect("written");
    assert_eq!(service.text("GET", &path, &[], "").await.2, FIELDS);
    let (_, _, manifest) = service.get(&own).await;
    assert_eq!(manifest["files"][0].get("damaged"), None);
}

#[tokio::test]
async fn the_last_chunk_of_a_large_file_is_sent_only_if_all_of_it_is_right() {
    let service = Service::new().await;
    let mut content = vec![b'0'; 9 << 20];
    let id = service.with_fields(&content).await;
    let own = format!("/v1/jobs/{id}/results");
    let path = format!("{own}/files/fields-20.vtu");
    assert!(service.bytes("GET", &path, &[], "").await.2 == content);
    content[5] = b'1';
    let stored = service.large_result(&id, "fields-20.vtu");
    std::fs::write(&stored, &content).expect("written");
    for path in [&path, &format!("{own}/archive")] {
        let request = Request::get(path).header("host", "127.0.0.1");
        let request = request.body(Body::empty()).expect("a request");
        let response = router(service.app.clone()).oneshot(request).await;
        let response = response.expect("an answer");
        if response.status() == 200 {
            let error = response.into_body().collect().await.expect_err("damage");
            assert!(error.to_string().contains("fields-20.vtu"), "{error}");
        } else {
            // The file is marked as damaged by now.
            assert_eq!(
                (path.ends_with("archive"), response.status().as_u16()),
                (true, 500)
            );
        }
    }
    let (status, _, problem) = service.get(&path).await;
    assert_eq!(
        (status.as_u16(), &problem["type"]),
        (500, &json!("/problems/result-damaged"))
    );
}

#[tokio::test]
async fn deleting_a_job_deletes_its_files() {
    let service = Service::new().await;
    let id = service.with_files().await;
    let folder = service.results_folder();
    assert_eq!(std::fs::read_dir(&folder).expect("a folder").count(), 1);
    let (status, _, _) = service
        .send("DELETE", &format!("/v1/jobs/{id}"), &[], "")
        .await;
    assert_eq!(status, 204);
    assert_eq!(std::fs::read_dir(&folder).expect("a folder").count(), 0);
}

#[test]
fn names_of_downloads_are_sanitized() {
    let value = attachment("a\"b\r\nx: y/../ü.csv");
    assert_eq!(value, "attachment; filename=\"a_b__x__y_..__.csv\"");
}
