//! An accuracy study: submitted from the form, live while runs are missing, its diagram, front and what it leads to.

use serde_json::json;

use super::{fits_a_phone, is_sound, service_and_browser};

/// Clicks on the first point of a level, where it is drawn, and tells whether that has opened its job. Costs are measured, so that
/// another point may lie on it: then either is right. The axes get their ranges after the curves, so that an early click may miss
/// the point, and the page may follow a click only after this has looked: what was clicked is kept for the next look.
const CLICK_FIRST_POINT: &str = "(() => {
    if (window.clicked?.includes(location.hash)) return true;
    const plot = document.querySelector('[data-chart=work-precision] .plot');
    plot.scrollIntoView();
    const { xaxis, yaxis } = plot._fullLayout;
    const points = plot.data.filter((curve) => curve.customdata).flatMap((curve) => [...curve.customdata].map((job, index) => (
        { job, level: curve.mode === 'markers', x: xaxis.d2p(curve.x[index]), y: yaxis.d2p(curve.y[index]) })));
    const first = points.find((point) => point.level);
    window.clicked = points.filter((point) => Math.hypot(point.x - first.x, point.y - first.y) < 20).map((point) => point.job);
    const drag = plot.querySelector('.nsewdrag');
    const place = plot.getBoundingClientRect();
    const at = { clientX: place.left + xaxis._offset + first.x, clientY: place.top + yaxis._offset + first.y, bubbles: true };
    for (const name of ['mousemove', 'mousedown', 'mouseup']) drag.dispatchEvent(new MouseEvent(name, at));
    return first.job.startsWith('#/job/') && window.clicked.includes(location.hash);
})()";

#[tokio::test]
#[cfg_attr(
    not(has_chromium),
    ignore = "needs the programs chromium and chromedriver"
)]
async fn an_accuracy_study_is_shown_while_it_runs_and_its_points_open_jobs() {
    let (_folder, server, browser) = service_and_browser().await;
    browser
        .open("/#/study?as=accuracy&system=cylinder_on_flat")
        .await;
    let base = json!({
        "system": {"kind": "cylinder_on_flat", "radius_mm": 6.0, "flat_length_mm": 12.0, "flat_height_mm": 6.0},
        "load": {"kind": "line_force", "n_per_mm": 18.5}, "cycles": 100, "accuracy": {"preset": "draft"}
    });
    let base = json!(base.to_string());
    browser
        .shows("[aria-label=Expected]", "processor time")
        .await;
    let fill = format!(
        "for (const [selector, value] of [['textarea', {base}], ['#budget', '2'], ['#batch-name', 'short fretting test']]) {{
            const node = document.querySelector(selector); node.value = value; node.dispatchEvent(new Event('input')); }}"
    );
    let filled = browser.client.execute(&fill, Vec::new()).await;
    filled.expect("the form can be filled");
    browser
        .wait_for("document.getElementById('field-cycles').value === '100'")
        .await;
    browser.click("button.primary").await;
    browser.shows("h1", "short fretting test").await;
    let id = browser
        .wait_for("location.hash.startsWith('#/accuracy/') && location.hash.slice(11)")
        .await;
    let path = format!("/v1/studies/{}", id.as_str().expect("an id"));
    let jobs = server.get(&path).await.1["jobs"]
        .as_array()
        .expect("jobs")
        .len();
    let rows = format!("document.querySelectorAll('.points tbody tr').length === {jobs}");
    browser.wait_for(&rows).await;
    browser
        .shows(".status", &format!("all {jobs} succeeded"))
        .await;

    // Every run has an error and a cost; the front is that of the service.
    let (_, document) = server.get(&path).await;
    let runs = document["study"]["runs"].as_array().expect("runs");
    let on_front = runs.iter().filter(|run| run["on_front"] == true).count();
    let curve = |name: &str| {
        format!(
            "document.querySelector('[data-chart=work-precision] .plot').data.find((curve) => curve.name === '{name}')"
        )
    };
    let front = format!("{}.x.length === {on_front}", curve("Pareto front"));
    browser.wait_for(&front).await;
    let drawn = format!(
        "document.querySelector('[data-chart=work-precision] .plot').data.filter((curve) => curve.mode === 'markers').flatMap((curve) => [...curve.x]).length === {jobs}"
    );
    browser.wait_for(&drawn).await;
    let log =
        "document.querySelector('[data-chart=work-precision] .plot').layout.xaxis.type === 'log'";
    browser.wait_for(log).await;
    browser
        .shows("[aria-label=Reference]", "deepest wear")
        .await;
    browser
        .shows("[aria-label='What to choose']", "cheapest run")
        .await;
    browser
        .shows(
            "[aria-label='Observed orders of convergence']",
            "element of the contact",
        )
        .await;
    fits_a_phone(&browser, "accuracy").await;

    browser.client.refresh().await.expect("it reloads");
    browser.wait_for(&front).await;
    browser.wait_for(CLICK_FIRST_POINT).await;
    browser.shows(".status", "succeeded").await;
    is_sound(&browser).await;
    browser.close().await;
}
