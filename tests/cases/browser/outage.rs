//! Pages while the service cannot be reached: they say so, and continue by themselves when it is back.

use tests::Browser;

use super::study::type_into;
use super::{done, is_sound, service_and_browser, short};

/// Checks that the page has complained of nothing but failed requests.
async fn only_requests_failed(browser: &Browser) {
    let complaints = browser.complaints().await;
    let of_requests = |line: &String| line.contains("Failed to load resource");
    assert!(complaints.iter().all(of_requests), "{complaints:#?}");
    is_sound(browser).await;
}

const IS_AWAY: &str = "document.getElementById('connection').innerText.includes('cannot be reached') && document.getElementById('message').innerText === ''";
const IS_BACK: &str = "document.getElementById('connection').innerText === '' && document.getElementById('message').innerText === ''";

#[tokio::test]
#[cfg_attr(
    not(has_chromium),
    ignore = "needs the programs chromium and chromedriver"
)]
async fn what_is_typed_during_an_outage_is_planned_after_it() {
    let (_folder, _server, browser) = service_and_browser().await;
    browser.open("/#/study?system=cylinder_on_flat").await;
    browser
        .shows("[aria-label=Expected]", "processor time")
        .await;
    browser.cut_off(true).await;
    type_into(&browser, "/cycles", "25").await;
    browser.wait_for(IS_AWAY).await;
    let outdated = "document.querySelectorAll('.outdated').length === 2 && document.querySelector('button.primary').disabled";
    browser.wait_for(outdated).await;
    browser.cut_off(false).await;
    browser.wait_for("document.querySelectorAll('.outdated').length === 0 && !document.querySelector('button.primary').disabled").await;
    browser.wait_for(IS_BACK).await;
    browser
        .wait_for("document.getElementById('field-cycles').value === '25'")
        .await;
    only_requests_failed(&browser).await;
    browser.close().await;
}

#[tokio::test]
#[cfg_attr(
    not(has_chromium),
    ignore = "needs the programs chromium and chromedriver"
)]
async fn a_page_that_is_opened_during_an_outage_appears_after_it() {
    let (_folder, server, browser) = service_and_browser().await;
    let id = done(&server, &short("opened late")).await;
    browser.open("/#/jobs").await;
    browser
        .wait_for("document.querySelector('tr[data-job]')")
        .await;
    browser.cut_off(true).await;
    browser.run(&format!("location.hash = '#/job/{id}'")).await;
    browser.wait_for(IS_AWAY).await;
    browser.cut_off(false).await;
    browser.shows(".status", "succeeded").await;
    browser.close().await;
}
