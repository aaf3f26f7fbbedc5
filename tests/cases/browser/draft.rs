//! The draft of a new study stays in its form: over a reload, the back button and a change of the system.

use super::study::{WRITTEN, type_into};
use super::{is_sound, service_and_browser};

#[tokio::test]
#[cfg_attr(
    not(has_chromium),
    ignore = "needs the programs chromium and chromedriver"
)]
async fn what_was_typed_stays_over_a_reload_the_back_button_and_a_change_of_the_system() {
    let (_folder, _server, browser) = service_and_browser().await;
    browser.open("/#/study?system=cylinder_on_flat").await;
    let has = |kind: &str, cycles: u32| {
        format!("{WRITTEN}.system.kind === '{kind}' && {WRITTEN}.cycles === {cycles}")
    };
    type_into(&browser, "/cycles", "33").await;
    browser.wait_for(&has("cylinder_on_flat", 33)).await;
    browser.client.refresh().await.expect("it reloads");
    browser.wait_for(&has("cylinder_on_flat", 33)).await;
    let choose = |kind: &str| {
        format!(
            "const system = document.getElementById('system'); system.value = '{kind}'; system.dispatchEvent(new Event('change'))"
        )
    };
    browser
        .wait_for("document.getElementById('field-cycles').value === '33'")
        .await;
    browser.run(&choose("dimm")).await;
    browser.wait_for(&has("dimm", 33)).await;
    browser
        .shows("main", "Taken over from cylinder on flat: cycles.")
        .await;
    browser
        .wait_for("document.getElementById('field-system-kind')?.value !== 'cylinder_on_flat'")
        .await;
    type_into(&browser, "/cycles", "44").await;
    browser.wait_for(&has("dimm", 44)).await;
    browser.run(&choose("cylinder_on_flat")).await;
    browser.wait_for(&has("cylinder_on_flat", 33)).await;
    browser.run(&choose("dimm")).await;
    browser.wait_for(&has("dimm", 44)).await;
    // A value that is still being typed counts when the page is left.
    browser
        .run("const field = document.getElementById('field-cycles'); field.focus(); field.value = '55'; location.hash = '#/workers'")
        .await;
    browser.shows("h1", "Workers").await;
    browser.client.back().await.expect("there is a step back");
    browser.wait_for(&has("dimm", 55)).await;
    // Another step of the history has a form of its own.
    browser.run("location.hash = '#/study'").await;
    browser
        .wait_for(&format!("{WRITTEN}.cycles === undefined"))
        .await;
    is_sound(&browser).await;
    browser.close().await;
}

#[tokio::test]
#[cfg_attr(
    not(has_chromium),
    ignore = "needs the programs chromium and chromedriver"
)]
async fn the_fields_of_a_sweep_stay_over_a_reload() {
    let (_folder, _server, browser) = service_and_browser().await;
    browser
        .open("/#/study?as=sweep&system=cylinder_on_flat")
        .await;
    let offered = "[...document.querySelectorAll('.swept option')].some((option) => option.value === '/cycles')";
    browser.wait_for(offered).await;
    for (part, value) in [("select", "/cycles"), ("input.values", "10, 20, 30")] {
        browser
            .run(&format!(
                "const node = document.querySelector('.swept {part}'); node.value = '{value}'; \
                 for (const name of ['input', 'change']) node.dispatchEvent(new Event(name))"
            ))
            .await;
    }
    browser.shows("button.primary", "Submit 3 jobs").await;
    browser.client.refresh().await.expect("it reloads");
    browser.shows("button.primary", "Submit 3 jobs").await;
    browser
        .wait_for("document.querySelector('.swept input.values').value === '10, 20, 30'")
        .await;
    is_sound(&browser).await;
    browser.close().await;
}
