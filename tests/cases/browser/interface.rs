//! The documentation of the interface, pages of what is not there, and pages that are left before they are complete.

use std::time::Duration;

use serde_json::json;

use super::{batch, done, is_sound, service_and_browser, short, with_fields};

/// Delay of the answers to a page that is left.
const LATENCY_MS: u32 = 200;
/// Times after which a page is left: during its first request, during the next ones, and after most of them.
const LEFT_AFTER_MS: [u64; 3] = [50, 300, 700];

#[tokio::test]
#[cfg_attr(
    not(has_chromium),
    ignore = "needs the programs chromium and chromedriver"
)]
async fn the_interface_is_explained_and_unknown_jobs_are_said_to_be_so() {
    let (_folder, _server, browser) = service_and_browser().await;
    browser.open("/docs").await;
    browser.shows("main", "/v1/jobs/{id}/events").await;
    browser
        .wait_for("document.getElementById('schema-Job') !== null")
        .await;
    is_sound(&browser).await;
    browser
        .open("/#/job/00000000-0000-7000-8000-000000000000")
        .await;
    browser.shows("#message", "there is no job").await;
    let complaints = browser.complaints().await;
    let missing = |line: &String| line.contains("404");
    assert!(complaints.iter().all(missing), "{complaints:#?}");
    browser.close().await;
}

#[tokio::test]
#[cfg_attr(
    not(has_chromium),
    ignore = "needs the programs chromium and chromedriver"
)]
async fn pages_that_are_left_while_they_load_complain_of_nothing() {
    let (_folder, server, browser) = service_and_browser().await;
    let one = done(&server, &with_fields("one")).await;
    let other = done(&server, &short("other")).await;
    let base = short("of many");
    let grid = json!({"/load/n_per_mm": [100, 200], "/motion/amplitude_mm": [0.02, 0.03]});
    let sweep = batch(&server, "sweeps", &json!({"base": base, "grid": grid})).await;
    let accuracy = batch(&server, "studies", &json!({"base": base, "budget_s": 5})).await;
    browser.open("/#/workers").await;
    browser.shows("main", "busy").await;
    browser.delay_answers(LATENCY_MS).await;
    for page in [
        "jobs",
        "sweeps",
        "study?system=sd_card",
        &format!("job/{one}"),
        &format!("compare?jobs={one},{other}"),
        &format!("sweep/{sweep}"),
        &format!("accuracy/{accuracy}"),
    ] {
        for left_after in LEFT_AFTER_MS {
            browser.run(&format!("location.hash = '#/{page}'")).await;
            tokio::time::sleep(Duration::from_millis(left_after)).await;
            browser.run("location.hash = '#/workers'").await;
        }
    }
    browser.shows("main", "busy").await;
    is_sound(&browser).await;
    browser.close().await;
}
