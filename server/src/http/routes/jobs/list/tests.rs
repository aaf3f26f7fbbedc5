//! Filters, views and pages of the list.

use serde_json::json;

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
        .queued(r#"{"system":{"kind":"dimm"},"labels":{"lot":"7:a","by":"me"}}"#)
        .await;
    let zif = service.queued(r#"{"system":{"kind":"zif"}}"#).await;
    service.post(&format!("/v1/jobs/{zif}/cancel"), "").await;
    for (query, expected) in [
        ("system=dimm", vec![&dimm]),
        ("label=lot:7:a", vec![&dimm]),
        ("label=lot:8", vec![]),
        ("label=lot:7:a&label=by:me", vec![&dimm]),
        ("label=lot:7:a&label=by:you", vec![]),
        ("created_from=2020-01-01T00:00:00Z", vec![&zif, &dimm]),
        ("created_before=2020-01-01T00:00:00Z", vec![]),
        ("sweep=00000000-0000-7000-8000-000000000000", vec![]),
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
async fn a_short_document_contains_what_the_full_one_says() {
    let service = Service::new().await;
    let spec = r#"{"name":"a \"b\" ü","system":{"kind":"dimm"},"labels":{"lot":"7"}}"#;
    let named = service.queued(spec).await;
    let other = service.queued(r#"{"system":{"kind":"zif"}}"#).await;
    let (_, _, short) = service.get("/v1/jobs").await;
    let (_, _, full) = service.get("/v1/jobs?view=full").await;
    assert_eq!(
        full["jobs"][1],
        service.get(&format!("/v1/jobs/{named}")).await.2
    );
    for (short, id) in [(&short["jobs"][1], &named), (&short["jobs"][0], &other)] {
        let (_, _, job) = service.get(&format!("/v1/jobs/{id}")).await;
        assert_eq!(short["name"], job["spec"]["name"]);
        assert_eq!(short["system"], job["spec"]["system"]["kind"]);
        let labels = job["spec"].get("labels").cloned();
        assert_eq!(short["labels"], labels.unwrap_or_else(|| json!({})));
        assert_eq!(short["links"]["self"], job["links"]["self"]);
        for field in [
            "id",
            "status",
            "status_reason",
            "outcome",
            "priority",
            "deadline_at",
            "created_at",
            "started_at",
            "finished_at",
            "progress",
            "attempts",
        ] {
            assert_eq!(short[field], job[field], "{field}");
        }
    }
}

#[tokio::test]
async fn a_page_token_belongs_to_its_filters() {
    let service = Service::new().await;
    for _ in 0..2 {
        service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
    }
    let (_, _, page) = service.get("/v1/jobs?limit=1&status=queued").await;
    let token = page["next_page_token"].as_str().expect("a token");
    let next = format!("/v1/jobs?limit=2&page_token={token}");
    assert_eq!(service.get(&format!("{next}&status=queued")).await.0, 200);
    assert_eq!(service.get(&next).await.0, 400);
}

#[tokio::test]
async fn unknown_names_list_the_known_ones() {
    let service = Service::new().await;
    for (query, detail) in [
        (
            "status=done",
            "`done` is not a status; statuses are queued, running, succeeded, failed, cancelled",
        ),
        (
            "status=queued,canceled",
            "`canceled` is not a status; statuses are queued, running, succeeded, failed, cancelled; did you mean `cancelled`?",
        ),
        (
            "system=fuzzbutton",
            "`fuzzbutton` is not a kind of system; kinds are fuzz_button, sd_card, dimm, zif, cylinder_on_flat; did you mean `fuzz_button`?",
        ),
    ] {
        let (_, _, problem) = service.get(&format!("/v1/jobs?{query}")).await;
        assert_eq!(problem["detail"], detail, "{query}");
    }
}

#[tokio::test]
async fn invalid_filters_are_problems() {
    let service = Service::new().await;
    for query in [
        "status=done",
        "label=x",
        "limit=0",
        "view=long",
        "system=fuzzbutton",
        "limit=501",
        "limit=many",
        "page_token=1",
        "page_token=%F0%9F%98%80",
        "stauts=queued",
        "status=queued&status=failed",
        "created_from=yesterday",
        "sweep=7",
        &"label=a:b&".repeat(17),
    ] {
        let (status, _, problem) = service.get(&format!("/v1/jobs?{query}")).await;
        assert_eq!(
            (status.as_u16(), problem["type"].as_str()),
            (400, Some("/problems/invalid-query")),
            "{query}"
        );
    }
}

async fn names(service: &Service, query: &str) -> Vec<String> {
    let (status, _, page) = service.get(&format!("/v1/jobs?{query}")).await;
    assert_eq!(status, 200, "{query}: {page}");
    let jobs = page["jobs"].as_array().expect("jobs").iter();
    jobs.map(|job| job["name"].as_str().unwrap_or("-").to_owned())
        .collect()
}

#[tokio::test]
async fn lists_have_the_order_that_is_asked_for() {
    let service = Service::new().await;
    service.with_results().await;
    for (name, kind) in [("beta", "zif"), ("Alpha", "dimm"), ("gamma", "sd_card")] {
        let spec = json!({"name": name, "system": {"kind": kind}});
        service.queued(&spec.to_string()).await;
    }
    let of = async |query: &str| names(&service, query).await.join(" ");
    assert_eq!(of("").await, "gamma Alpha beta -");
    assert_eq!(of("sort=-created").await, "gamma Alpha beta -");
    assert_eq!(of("sort=created").await, "- beta Alpha gamma");
    // Those without a name come last in either direction.
    assert_eq!(of("sort=name").await, "Alpha beta gamma -");
    assert_eq!(of("sort=-name").await, "gamma beta Alpha -");
    assert_eq!(of("sort=system").await, "Alpha - gamma beta");
    assert_eq!(of("sort=-status").await, "- gamma Alpha beta");
    assert_eq!(of("sort=-duration").await, "- gamma Alpha beta");
    assert_eq!(of("sort=wear&system=zif").await, "beta");
    for query in ["sort=depth", "sort=", "sort=name&sort=name", "total=1"] {
        let (status, ..) = service.get(&format!("/v1/jobs?{query}")).await;
        assert_eq!(status, 400, "{query}");
    }
}

#[tokio::test]
async fn all_pages_of_any_order_hold_every_job_once_and_their_number_is_counted() {
    let service = Service::new().await;
    for name in ["e", "b", "d", "a", "c"] {
        let spec = json!({"name": name, "system": {"kind": "dimm"}, "labels": {"lot": name}});
        service.queued(&spec.to_string()).await;
    }
    for (sort, expected) in [("name", "a b c d e"), ("-created", "c a d b e")] {
        let mut seen = Vec::new();
        let mut query = format!("sort={sort}&limit=2&total=true");
        loop {
            let (_, _, page) = service.get(&format!("/v1/jobs?{query}")).await;
            assert_eq!(page["total"], 5);
            let jobs = page["jobs"].as_array().expect("jobs").iter();
            seen.extend(jobs.filter_map(|job| job["name"].as_str().map(str::to_owned)));
            let Some(token) = page["next_page_token"].as_str() else {
                break;
            };
            query = format!("sort={sort}&limit=2&total=true&page_token={token}");
        }
        assert_eq!(seen.join(" "), expected);
    }
    let (_, _, page) = service.get("/v1/jobs?label=lot:b&total=true&limit=1").await;
    assert_eq!(page["total"], 1);
    let (_, _, page) = service.get("/v1/jobs?limit=1").await;
    assert!(page.get("total").is_none());
    // A token belongs to its order.
    let token = page["next_page_token"].as_str().expect("a token");
    let (status, ..) = service
        .get(&format!("/v1/jobs?limit=1&sort=name&page_token={token}"))
        .await;
    assert_eq!(status, 400);
}
