//! Requirement: in a real browser the pages show jobs with their progress and a cancel button, a job in full with
//! figures, pictures and files, and the interface; the content security policy blocks nothing and no script fails.

use std::path::Path;
use std::process::Command;

use serde_json::{Value, json};
use tests::Server;

/// Virtual time for a page to load and draw, ms.
const PAGE_TIME_MS: u32 = 8_000;

/// The final document of the page at a path; its console must be empty.
fn seen(server: &Server, folder: &Path, path: &str) -> String {
    let (page, complaints) = seen_with_complaints(server, folder, path);
    assert_eq!(complaints, Vec::<String>::new(), "{path}");
    page
}

fn seen_with_complaints(server: &Server, folder: &Path, path: &str) -> (String, Vec<String>) {
    let output = Command::new("chromium")
        .args(["--headless", "--no-sandbox", "--disable-gpu", "--dump-dom"])
        .args(["--enable-logging=stderr", "--lang=en-US"])
        .arg(format!("--virtual-time-budget={PAGE_TIME_MS}"))
        .arg(format!(
            "--user-data-dir={}",
            folder.join("browser").display()
        ))
        .arg(format!("{}{path}", server.base))
        .output()
        .expect("chromium can be started");
    let log = String::from_utf8_lossy(&output.stderr);
    let complaints = log.lines().filter(|line| line.contains(":CONSOLE"));
    let complaints = complaints.map(str::to_owned).collect();
    let page = String::from_utf8_lossy(&output.stdout).into_owned();
    (page, complaints)
}

/// Text between a start and the next end.
fn part<'a>(page: &'a str, from: &str, to: &str) -> &'a str {
    let (_, rest) = page
        .split_once(from)
        .unwrap_or_else(|| panic!("no {from} in\n{page}"));
    rest.split(to).next().unwrap_or_default()
}

async fn submitted(server: &Server, spec: &Value) -> String {
    let (status, job) = server.submit(spec.to_string()).await;
    assert_eq!(status, 202, "{job}");
    job["id"].as_str().expect("a job has an id").to_owned()
}

#[tokio::test]
#[cfg_attr(not(has_chromium), ignore = "needs the program chromium")]
async fn a_browser_shows_jobs_and_their_results() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let done = json!({
        "name": "short <b>job</b>", "system": {"kind": "cylinder_on_flat"}, "cycles": 20,
        "accuracy": {"preset": "draft"}, "output": {"snapshots_at_cycles": [1, 20]}
    });
    let long = json!({
        "name": "long job", "system": {"kind": "cylinder_on_flat"}, "cycles": 1_000_000,
        "accuracy": {"preset": "draft", "overrides": {"cycle_jump": 1}}
    });
    let done = submitted(&server, &done).await;
    let ended = |job: &Value| job["finished_at"].is_string();
    server.job_when(&done, ended).await;
    let long = submitted(&server, &long).await;
    let computing = |job: &Value| job["progress"]["cycle"].as_u64() > Some(0);
    server.job_when(&long, computing).await;

    let page = seen(&server, folder.path(), "/");
    let row = part(&page, &format!("id=\"row-{done}\""), "</tr>");
    // Names are escaped.
    for shown in [
        "short &lt;b&gt;job",
        "succeeded (completed)",
        "20 / 20",
        "/results/archive",
    ] {
        assert!(row.contains(shown), "{shown} in {row}");
    }
    assert!(row.contains("width: 100%"), "{row}");
    let row = part(&page, &format!("id=\"row-{long}\""), "</tr>");
    for shown in ["long job", "running", " / 1000000", ">cancel</button>"] {
        assert!(row.contains(shown), "{shown} in {row}");
    }
    assert_eq!(part(&page, "<p id=\"error\" role=\"alert\">", "</p>"), "");

    let page = seen(&server, folder.path(), &format!("/#{done}"));
    let job = part(&page, "<section id=\"job\">", "</section>");
    for shown in [
        "peak pressure",
        "estimated error",
        "polyline",
        "wear-history.csv",
    ] {
        assert!(job.contains(shown), "{shown} in {job}");
    }
    assert_eq!(job.matches("<img src=\"blob:").count(), 4, "{job}");

    let nobody = "/#00000000-0000-7000-8000-000000000000";
    let (page, complaints) = seen_with_complaints(&server, folder.path(), nobody);
    let only_missing = |line: &String| line.contains("the server responded with a status of 404");
    assert!(complaints.iter().all(only_missing), "{complaints:#?}");
    let error = part(&page, "<p id=\"error\" role=\"alert\">", "</p>");
    assert!(error.contains("there is no job"), "{error}");

    let page = seen(&server, folder.path(), "/docs");
    for shown in [
        "/v1/jobs/{id}/events",
        "id=\"schema-Job\"",
        "Idempotency-Key",
    ] {
        assert!(page.contains(shown), "{shown} in {page}");
    }
    server.post(&format!("/v1/jobs/{long}/cancel")).await;
}
