//! Sweeps: submitted from the form, watched to their end, drawn as a map whose cells lead to jobs; the list of all of them.

use serde_json::json;
use tests::Browser;

use super::{batch, fits_a_phone, is_sound, long, service_and_browser, short};

/// Types into the input or select of a swept field, which are numbered from 0.
async fn set(browser: &Browser, field: usize, part: &str, value: &str) {
    let script = format!(
        "const node = document.querySelectorAll('.swept')[{field}].querySelector('{part}'); node.value = '{value}'; \
         for (const name of ['input', 'change']) node.dispatchEvent(new Event(name))"
    );
    browser.run(&script).await;
}

#[tokio::test]
#[cfg_attr(
    not(has_chromium),
    ignore = "needs the programs chromium and chromedriver"
)]
async fn a_sweep_from_the_form_is_watched_to_its_end_and_its_map_opens_jobs() {
    let (_folder, server, browser) = service_and_browser().await;
    browser
        .open("/#/study?as=sweep&system=cylinder_on_flat")
        .await;
    let base = json!(short("swept").to_string());
    let type_base = format!(
        "const text = document.querySelector('textarea'); text.value = {base}; text.dispatchEvent(new Event('input'))"
    );
    browser
        .shows("[aria-label=Expected]", "processor time")
        .await;
    let expected = "document.querySelector('[aria-label=Expected]').innerText";
    browser.run(&format!("window.preset = {expected}")).await;
    browser.run(&type_base).await;
    browser
        .wait_for(&format!("{expected} !== window.preset"))
        .await;

    // A value that is refused is said to be so at its field, before it is submitted and then.
    set(&browser, 0, "select", "/load/n_per_mm").await;
    set(&browser, 0, "input.values", "-100, 200, 300").await;
    browser.shows("button.primary", "Submit 3 jobs").await;
    browser.shows(".swept .fault", "-100 is outside").await;
    // The same sweep is not asked for again with each plan of its base.
    let count = |end: &str| {
        format!(
            "performance.getEntriesByType('resource').filter(({{ name }}) => name.endsWith('{end}')).length"
        )
    };
    let (plans, plans_of_sweeps) = (count("/v1/plans"), count("/v1/sweeps/plans"));
    let before = format!("[window.plans, window.of_sweeps] = [{plans}, {plans_of_sweeps}]");
    browser.run(&before).await;
    browser.run(&type_base).await;
    browser.wait_for(&format!("{plans} > window.plans")).await;
    browser.shows(".swept .fault", "-100 is outside").await;
    browser
        .wait_for(&format!("{plans_of_sweeps} === window.of_sweeps"))
        .await;
    browser.click("button.primary").await;
    browser
        .wait_for("document.querySelector('p.line [role=status]').innerText !== ''")
        .await;
    browser.shows(".swept .fault", "-100 is outside").await;
    let refused = browser.complaints().await;
    let expected = |line: &String| line.contains("/v1/sweeps") && line.contains("422");
    assert!(refused.iter().all(expected), "{refused:#?}");

    set(&browser, 0, "input.values", "100, 200, 300").await;
    browser.click(".submission button:not(.quiet)").await;
    set(&browser, 1, "select", "/motion/amplitude_mm").await;
    set(&browser, 1, "select:nth-of-type(2)", "linear").await;
    for (part, value) in [("from", "0.02"), ("to", "0.04"), ("count", "3")] {
        set(&browser, 1, &format!("input.{part}"), value).await;
    }
    browser
        .shows(".swept:nth-of-type(2) output", "0.02, 0.03, 0.04")
        .await;
    browser.shows("button.primary", "Submit 9 jobs").await;
    browser
        .shows(".submission [role=status]", "of processor time together")
        .await;
    fits_a_phone(&browser, "sweep-form").await;
    browser.click("button.primary").await;
    browser
        .wait_for("location.hash.startsWith('#/sweep/')")
        .await;
    browser.run("window.was_not_reloaded = true").await;
    browser.shows(".status", "all 9 succeeded").await;
    let cells = "document.querySelector('[data-chart=sweep-map] .plot').data[0].z.flat().filter((depth) => depth > 0).length === 9";
    browser.wait_for(cells).await;
    browser.wait_for("window.was_not_reloaded").await;
    fits_a_phone(&browser, "sweep").await;

    browser.client.refresh().await.expect("it reloads");
    browser.wait_for(cells).await;
    browser
        .wait_for("document.querySelectorAll('.points tbody tr').length === 9")
        .await;
    // Titles and units are those of the interface.
    for title in ["deepest wear, µm", "worn area, receptacle, µm²"] {
        browser.shows(".points thead", title).await;
    }
    // The quantity and the kind of chart are in the address; the back button undoes them.
    browser.run("const choice = document.getElementById('choice-view'); choice.value = 'curves'; choice.dispatchEvent(new Event('change'))").await;
    let curves = "document.querySelector('[data-chart=sweep] .plot').data.length === 3 && location.hash.includes('view=curves')";
    browser.wait_for(curves).await;
    browser.client.back().await.expect("there is a step back");
    browser.wait_for(cells).await;
    browser
        .wait_for("document.querySelector('[data-chart=sweep]').hidden")
        .await;
    // The middle of the map is the middle of both fields.
    browser.click("[data-chart=sweep-map] .nsewdrag").await;
    let id = browser
        .wait_for("location.hash.startsWith('#/job/') && location.hash.slice(6)")
        .await;
    let path = format!("/v1/jobs/{}", id.as_str().expect("an id"));
    let (_, job) = server.get(&path).await;
    assert_eq!(job["spec"]["load"]["n_per_mm"], 200.0);
    assert_eq!(job["spec"]["motion"]["amplitude_mm"], 0.03);
    browser.shows(".status", "succeeded").await;
    is_sound(&browser).await;
    browser.close().await;
}

#[tokio::test]
#[cfg_attr(
    not(has_chromium),
    ignore = "needs the programs chromium and chromedriver"
)]
async fn a_listed_sweep_is_followed_cancelled_cloned_and_deleted() {
    let (_folder, server, browser) = service_and_browser().await;
    browser.open("/#/sweeps").await;
    browser.shows("main", "None here yet").await;
    let request = json!({"name": "long ones", "base": long("long"), "grid": {"/interface/friction/coefficient": [0.3, 0.4, 0.5]}});
    let id = batch(&server, "sweeps", &request).await;
    let row = format!("tr[data-batch='{id}']");
    browser.shows(&row, "long ones").await;
    browser.shows(&row, "running").await;
    browser.shows(&row, "0 of 3").await;
    fits_a_phone(&browser, "sweeps").await;
    browser.click(&format!("{row} button")).await;
    browser.shows(&row, "all 3 cancelled").await;
    browser.open(&format!("/#/sweep/{id}")).await;
    browser.shows(".status", "all 3 cancelled").await;
    // The head of the page of a sweep so large that most of its jobs were still to be queued.
    let script = format!(
        "Promise.all([import('/assets/batches/head.js'), fetch('/v1/sweeps/{id}').then((answer) => answer.json())]).then(([{{ Head }}, sweep]) => \
         document.querySelector('main').replaceChildren(new Head({{ ...sweep, never_queued: 98214 }}, 'sweep', () => {{}}).node))"
    );
    browser.run(&script).await;
    browser
        .shows(".status", "98,214 jobs: the sweep was cancelled before")
        .await;

    browser.open(&format!("/#/study?as=sweep&batch={id}")).await;
    browser.shows("button.primary", "Submit 3 jobs").await;
    let values = "document.querySelector('.swept input.values').value === '0.3, 0.4, 0.5'";
    browser.wait_for(values).await;
    browser.open("/#/sweeps").await;
    browser.shows(&row, "Delete").await;
    browser.run("window.confirm = () => true").await;
    browser.click(&format!("{row} button")).await;
    browser.shows("main", "None here yet").await;
    let (status, _) = server.get(&format!("/v1/sweeps/{id}")).await;
    assert_eq!(status, 404);
    is_sound(&browser).await;
    browser.close().await;
}
