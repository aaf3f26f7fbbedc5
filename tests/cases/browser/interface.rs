//! The documentation of the interface, and pages of what is not there.

use super::{is_sound, service_and_browser};

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
