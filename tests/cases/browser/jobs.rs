//! The list: live rows, filters, selection, keyboard.

use serde_json::json;

use super::{done, fits_a_phone, is_sound, long, service_and_browser, short, submitted};

#[tokio::test]
#[cfg_attr(
    not(has_chromium),
    ignore = "needs the programs chromium and chromedriver"
)]
async fn a_list_follows_its_jobs_without_a_reload() {
    let (_folder, server, browser) = service_and_browser().await;
    browser.open("/").await;
    browser.shows("main", "No jobs yet").await;
    // Names are text, not markup.
    let id = submitted(&server, &short("short <b>job</b>")).await;
    let row = format!("tr[data-job='{id}']");
    browser.shows(&row, "short <b>job</b>").await;
    browser.shows(&row, "succeeded").await;
    browser.shows(&row, "20 cycles").await;
    browser.shows("main [role=status]", "1 succeeded").await;
    let running = submitted(&server, &long("long job")).await;
    let row = format!("tr[data-job='{running}']");
    browser.shows(&row, "cycle").await;
    browser.shows(&row, "of 1,000,000").await;
    fits_a_phone(&browser, "jobs").await;
    browser.click(&format!("{row} input")).await;
    browser.shows(".selection", "1 selected").await;
    browser.click(".selection button:nth-of-type(2)").await;
    browser.shows(&row, "cancelled").await;
    is_sound(&browser).await;
    browser.close().await;
}

#[tokio::test]
#[cfg_attr(
    not(has_chromium),
    ignore = "needs the programs chromium and chromedriver"
)]
async fn filters_are_in_the_address_and_the_back_button_undoes_them() {
    let (_folder, server, browser) = service_and_browser().await;
    let first = done(&server, &short("first")).await;
    let second = done(&server, &short("second")).await;
    browser.open("/#/jobs?text=first").await;
    let shown = |id: &str| format!("document.querySelector(\"tr[data-job='{id}']\") !== null");
    browser.wait_for(&shown(&first)).await;
    browser.wait_for(&format!("!({})", shown(&second))).await;
    browser.click("input[value=failed]").await;
    browser.shows("main", "No job passes these filters").await;
    browser
        .wait_for("location.hash.includes('status=failed')")
        .await;
    browser.client.back().await.expect("there is a step back");
    browser.wait_for(&shown(&first)).await;
    browser
        .wait_for("!document.querySelector('input[value=failed]').checked")
        .await;
    browser.open("/#/jobs").await;
    browser.wait_for(&shown(&second)).await;
    is_sound(&browser).await;
    browser.close().await;
}

#[tokio::test]
#[cfg_attr(
    not(has_chromium),
    ignore = "needs the programs chromium and chromedriver"
)]
async fn the_list_is_ordered_by_its_head_and_narrowed_by_labels() {
    let (_folder, server, browser) = service_and_browser().await;
    let labelled = |name: &str, cycles: u32, lot: &str| {
        let mut spec = short(name);
        (spec["cycles"], spec["labels"]) = (json!(cycles), json!({"lot": lot}));
        spec["output"] = json!({});
        spec
    };
    let deep = done(&server, &labelled("deep", 60, "7")).await;
    let flat = done(&server, &labelled("flat", 20, "8")).await;
    browser.open("/").await;
    let first = |id: &str| format!("document.querySelector('tbody tr')?.dataset.job === '{id}'");
    browser.wait_for(&first(&flat)).await;
    // Each job has the curve of its wear.
    browser
        .wait_for("document.querySelectorAll('.sparkline polyline').length === 2")
        .await;
    let by_wear = "th a[title='order by deepest wear']";
    browser.click(by_wear).await;
    browser.wait_for(&first(&deep)).await;
    browser
        .wait_for("document.querySelector('th[aria-sort=descending]').textContent.includes('deepest wear')")
        .await;
    browser.click(by_wear).await;
    browser.wait_for(&first(&flat)).await;
    browser
        .click("select[aria-label=label] option[value='lot:7']")
        .await;
    browser.wait_for(&first(&deep)).await;
    browser
        .wait_for("document.querySelectorAll('tbody tr').length === 1")
        .await;
    browser
        .wait_for("location.hash.includes('label=lot%3A7')")
        .await;
    browser.click(".chosen button").await;
    browser
        .wait_for("document.querySelectorAll('tbody tr').length === 2")
        .await;
    // A new job is listed where its order puts it.
    let deepest = done(&server, &labelled("deepest", 100, "7")).await;
    browser
        .wait_for(&format!(
            "[...document.querySelectorAll('tbody tr')].at(-1).dataset.job === '{deepest}'"
        ))
        .await;
    is_sound(&browser).await;
    browser.close().await;
}

#[tokio::test]
#[cfg_attr(
    not(has_chromium),
    ignore = "needs the programs chromium and chromedriver"
)]
async fn a_job_is_reached_by_the_keyboard_alone() {
    let (_folder, server, browser) = service_and_browser().await;
    let id = done(&server, &short("by keyboard")).await;
    browser.open("/").await;
    browser
        .shows(&format!("tr[data-job='{id}']"), "by keyboard")
        .await;
    let target = format!("document.activeElement.getAttribute('href') === '#/job/{id}'");
    let mut steps = 0;
    while browser
        .client
        .execute(&format!("return {target}"), Vec::new())
        .await
        .expect("an answer")
        != true
    {
        let body = browser.client.active_element().await.expect("an element");
        body.send_keys("\u{E004}").await.expect("the tabulator");
        steps += 1;
        assert!(steps < 40, "no way to the job by the tabulator");
    }
    let link = browser.client.active_element().await.expect("an element");
    link.send_keys("\u{E007}").await.expect("the enter key");
    browser.shows("h1", "by keyboard").await;
    is_sound(&browser).await;
    browser.close().await;
}
