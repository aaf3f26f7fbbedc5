//! A new job from the form: refused with its faults at their fields, planned as one types, submitted, cloned and changed.

use tests::{Browser, Server};

use super::{fits_a_phone, is_sound};

/// Types a value into a field in place of what it has.
async fn type_into(browser: &Browser, pointer: &str, value: &str) {
    let id = format!("field{}", pointer.replace('/', "-"));
    let script = format!(
        "const field = document.getElementById('{id}'); field.value = '{value}'; field.dispatchEvent(new Event('change'))"
    );
    browser
        .wait_for(&format!("document.getElementById('{id}') !== null"))
        .await;
    browser
        .client
        .execute(&script, Vec::new())
        .await
        .expect("it can be typed into");
}

#[tokio::test]
#[cfg_attr(
    not(has_chromium),
    ignore = "needs the programs chromium and chromedriver"
)]
async fn a_study_is_made_refused_mended_submitted_and_cloned() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let browser = Browser::start(&server.base, folder.path()).await;
    browser.open("/#/study?system=cylinder_on_flat").await;
    browser
        .shows("[aria-label=Expected]", "processor time")
        .await;
    browser
        .wait_for("document.querySelector('.drawing svg') !== null")
        .await;
    type_into(&browser, "/accuracy/preset", "draft").await;
    type_into(&browser, "/cycles", "0").await;
    let marked = "document.getElementById('field-cycles').getAttribute('aria-invalid') === 'true'";
    browser.wait_for(marked).await;
    browser.shows(".faults", "/cycles").await;
    browser
        .wait_for("document.querySelector('button.primary').disabled")
        .await;
    type_into(&browser, "/cycles", "25").await;
    browser.wait_for("document.querySelector('.faults').innerText === '' && !document.querySelector('button.primary').disabled").await;
    let cycles = "JSON.parse(document.querySelector('textarea').value).cycles === 25";
    browser.wait_for(cycles).await;
    fits_a_phone(&browser, "study").await;
    // Refused requests are messages of the console.
    let refused = browser.complaints().await;
    assert!(
        refused.iter().all(|line| line.contains("/v1/plans")),
        "{refused:#?}"
    );
    browser.click("button.primary").await;
    browser.shows(".status", "succeeded").await;
    browser.shows("[aria-label=Result]", "25, ").await;
    let clone = browser.client.execute("[...document.querySelectorAll('.actions a')].find((link) => link.innerText.startsWith('Clone')).click()", Vec::new());
    clone.await.expect("it can be clicked");
    browser.shows("h1", "New study").await;
    browser.wait_for(cycles).await;
    browser
        .shows("[aria-label=Expected]", "processor time")
        .await;
    is_sound(&browser).await;
    browser.close().await;
}
