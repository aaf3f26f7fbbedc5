//! Several jobs beside each other.

use serde_json::json;

use super::{done, fits_a_phone, is_sound, service_and_browser, short};

#[tokio::test]
#[cfg_attr(
    not(has_chromium),
    ignore = "needs the programs chromium and chromedriver"
)]
async fn selected_jobs_are_compared_by_what_differs() {
    let (_folder, server, browser) = service_and_browser().await;
    let one = done(&server, &short("one")).await;
    let mut other = short("other");
    other["motion"] = json!({"kind": "reciprocating", "amplitude_mm": 0.03});
    let other = done(&server, &other).await;
    browser.open("/").await;
    for id in [&one, &other] {
        browser.click(&format!("tr[data-job='{id}'] input")).await;
    }
    browser.shows(".selection", "2 selected").await;
    browser.click(".selection button").await;
    browser.shows("[aria-label=Results]", "other").await;
    browser
        .shows("[aria-label='What differs']", "/motion/amplitude_mm")
        .await;
    let curves = "document.querySelector('[data-chart=receptacle] .plot').data.length === 2";
    browser.wait_for(curves).await;
    fits_a_phone(&browser, "compare").await;
    is_sound(&browser).await;
    browser.close().await;
}
