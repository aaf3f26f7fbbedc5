//! Cost of the pages in a browser, printed; no time or size is asserted.

use std::time::Duration;

use serde_json::{Value, json};
use tests::{Browser, Server};

use super::{done, long, service_and_browser, short, submitted};

/// Jobs of the long list, and running ones whose changes are shown.
const LISTED: usize = 1000;
const RUNNING: usize = 50;
/// Time over which requests are counted, and between two looks at the memory.
const IDLE: Duration = Duration::from_secs(12);
const BETWEEN: Duration = Duration::from_secs(30);
const LOOKS: u64 = 7;

/// Time since the page was opened, ms.
const SINCE: &str = "performance.now()";
/// A page that has loaded what it shows.
const COMPLETE: &str = "!document.getElementById('content').hasAttribute('aria-busy')";

/// Opens a page again and returns the time until a condition holds, ms; a look every 50 ms.
async fn time_until(browser: &Browser, path: &str, condition: &str) -> f64 {
    browser.open("/docs").await;
    browser.open(path).await;
    let time = browser
        .wait_for(&format!("{COMPLETE} && {condition} && {SINCE}"))
        .await;
    time.as_f64().expect("a number")
}

/// Number and bytes of the requests that end while nobody touches the page.
async fn idle_requests(browser: &Browser) -> Value {
    let clear = browser
        .client
        .execute("performance.clearResourceTimings()", Vec::new());
    clear.await.expect("the page answers");
    tokio::time::sleep(IDLE).await;
    let count = "const all = performance.getEntriesByType('resource'); \
         return {requests: all.length, bytes: all.reduce((sum, one) => sum + one.transferSize, 0)}";
    let found = browser.client.execute(count, Vec::new()).await;
    found.expect("the page answers")
}

mod night {
    use super::*;

    #[tokio::test]
    #[ignore = "night: takes minutes"]
    async fn pages_cost_of_many_jobs_and_of_long_ones() {
        let (_folder, server, browser) = service_and_browser().await;
        let mut history = short("2 000 cycles, seven stations");
        history["cycles"] = json!(2000);
        history["accuracy"]["overrides"] = json!({"cycle_jump": 1});
        history["output"] = json!({"stations_mm": [-0.03, -0.02, -0.01, 0, 0.01, 0.02, 0.03]});
        let id = done(&server, &history).await;
        for number in 1..LISTED {
            submitted(&server, &short(&format!("job {number}"))).await;
        }
        let rows = "document.querySelectorAll('tr[data-job]').length === 100";
        for _ in 0..3 {
            let time = time_until(&browser, "/#/jobs", rows).await;
            println!("list of {LISTED} jobs: {time:.0} ms until its first 100 rows can be used");
        }
        // The charts that every job has.
        let drawn = "['wear', 'half-width', 'peak-pressure', 'worn-area', 'energy', 'profile', 'pressure', 'shear', 'loop']\
             .every((name) => document.querySelector(`[data-chart=${name}] .plot .main-svg`))";
        let in_view = "(() => { const seen = [...document.querySelectorAll('.chart .plot')].filter((plot) => plot.clientWidth > 0 && plot.getBoundingClientRect().top < innerHeight); \
             return seen.length > 0 && seen.every((plot) => plot.querySelector('.main-svg')); })()";
        for _ in 0..3 {
            let path = format!("/#/job/{id}");
            let seen = time_until(&browser, &path, in_view).await;
            let all = time_until(&browser, &path, drawn).await;
            println!(
                "job of 2 000 cycles with seven stations: {seen:.0} ms until its charts in view are drawn, {all:.0} ms until all are"
            );
        }
        println!(
            "idle page of an ended job, {IDLE:?}: {}",
            idle_requests(&browser).await
        );
        browser.close().await;
    }

    #[tokio::test]
    #[ignore = "night: takes minutes"]
    async fn pages_cost_of_running_jobs() {
        let folder = tempfile::tempdir().expect("a folder can be made");
        let workers = RUNNING.to_string();
        let server = Server::start_with(
            folder.path(),
            &["--workers", &workers, "--memory-mb", "100000"],
        );
        let browser = Browser::start(&server.base, folder.path()).await;
        browser.open("/#/jobs").await;
        browser.wait_for(COMPLETE).await;
        println!(
            "idle list without jobs, {IDLE:?}: {}",
            idle_requests(&browser).await
        );
        for number in 0..RUNNING {
            submitted(&server, &long(&format!("running {number}"))).await;
        }
        let running = format!("document.querySelectorAll('tr.running').length === {RUNNING}");
        browser.wait_for(&running).await;
        for look in 0..LOOKS {
            let bytes = browser.heap_bytes().await;
            println!(
                "{RUNNING} running jobs, {} s: {:.2} MB in use",
                look * BETWEEN.as_secs(),
                bytes / 1e6
            );
            tokio::time::sleep(BETWEEN).await;
        }
        println!(
            "list of {RUNNING} running jobs, {IDLE:?}: {}",
            idle_requests(&browser).await
        );
        browser.close().await;
    }
}
