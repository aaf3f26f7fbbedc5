//! The slip of a vibration in the form and on the page of a job, and the page of a run that is refined.

use serde_json::{Value, json};
use tests::spec;

use super::{done, is_sound, service_and_browser, short};

#[tokio::test]
#[cfg_attr(
    not(has_chromium),
    ignore = "needs the programs chromium and chromedriver"
)]
async fn the_slip_of_a_vibration_is_drawn_and_derived_in_the_form_and_on_the_page_of_a_job() {
    let (_folder, server, browser) = service_and_browser().await;
    let text = std::fs::read(spec("sd_card_vibration.json")).expect("the specification is there");
    let mut vibrated: Value = serde_json::from_slice(&text).expect("JSON");
    vibrated["accuracy"] = json!({"preset": "draft", "estimate_errors": false});
    vibrated["motion"]["duration_s"] = json!(1);
    browser.open("/#/study").await;
    browser
        .shows("[aria-label=Expected]", "processor time")
        .await;
    let typed = json!(vibrated.to_string());
    browser
        .run(&format!("const text = document.querySelector('textarea'); text.value = {typed}; text.dispatchEvent(new Event('input'))"))
        .await;
    browser
        .shows("[aria-label=Slip]", "the parts move by")
        .await;
    let drawn = "/slip ±(?!0 )/.test(document.querySelector('.drawing').textContent)";
    browser.wait_for(drawn).await;
    let wide = "Number(document.querySelector('.drawing path.stroke').getAttribute('d').split('h ')[1]) > 0";
    browser.wait_for(wide).await;
    let id = done(&server, &vibrated).await;
    browser.open(&format!("/#/job/{id}")).await;
    browser
        .shows("[aria-label=Slip]", "taken up without slip")
        .await;
    is_sound(&browser).await;
    browser.close().await;
}

#[tokio::test]
#[cfg_attr(
    not(has_chromium),
    ignore = "needs the programs chromium and chromedriver"
)]
async fn a_run_that_is_refined_has_a_bar_for_each_part_and_its_reason() {
    let (_folder, server, browser) = service_and_browser().await;
    let id = done(&server, &short("refined")).await;
    browser.open(&format!("/#/job/{id}")).await;
    browser.shows(".status", "succeeded").await;
    // The head of the page with the progress of a finer run.
    let script = format!(
        "Promise.all([import('/assets/job/head.js'), fetch('/v1/jobs/{id}').then((answer) => answer.json())]).then(([{{ Head }}, job]) => {{ \
         const progress = {{ stage: 'refined', reason: 'the depth is 8 % off', cycle: 1, cycles: 100, fraction: 0.01 }}; \
         document.querySelector('main').replaceChildren(new Head({{ ...job, status: 'running', progress }}).node); }})"
    );
    browser.run(&script).await;
    browser.shows(".again", "finer: the depth is 8 % off").await;
    let bars = "[...document.querySelectorAll('.status progress')].map((bar) => bar.value).join() === '1,0.01'";
    browser.wait_for(bars).await;
    browser.shows(".status", "refined · 1 %").await;
    is_sound(&browser).await;
    browser.close().await;
}

/// Shows the history of a job as that of a run that continues.
fn charts(id: &str, then: &str) -> String {
    format!(
        "Promise.all([import('/assets/job/history.js'), import('/assets/parts/address.js'), fetch('/v1/jobs/{id}').then((answer) => answer.json())]).then(async ([{{ HistoryCharts }}, {{ choices }}, job]) => {{ \
         const charts = new HistoryCharts(job.id, choices, new AbortController().signal); \
         document.querySelector('main').replaceChildren(...charts.nodes); \
         const load = () => charts.load({{ ...job, status: 'running' }}, new AbortController().signal); \
         {then} }})"
    )
}

#[tokio::test]
#[cfg_attr(
    not(has_chromium),
    ignore = "needs the programs chromium and chromedriver"
)]
async fn curves_of_the_first_run_stay_beside_those_of_a_finer_one_over_a_reload() {
    let (_folder, server, browser) = service_and_browser().await;
    let id = done(&server, &short("refined")).await;
    let names = "document.querySelector('[data-chart=wear] .plot')?.data?.map(({ name }) => name).join('; ') ?? ''";
    browser.open("/#/workers").await;
    browser.shows("main", "busy").await;
    let both = "await load(); charts.first_run_ends(); await load();";
    browser.run(&charts(&id, both)).await;
    browser
        .wait_for(&format!("({names}).includes('deepest, first run')"))
        .await;
    browser.client.refresh().await.expect("it reloads");
    browser.shows("main", "busy").await;
    browser
        .run(&charts(&id, "charts.first_run_ends(); await load();"))
        .await;
    browser
        .wait_for(&format!("({names}).includes('deepest, first run')"))
        .await;
    is_sound(&browser).await;
    browser.close().await;
}
