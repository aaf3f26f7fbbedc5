//! No page contradicts the success criteria A and AA of WCAG that axe-core can check, light and dark.

use serde_json::{Value, json};

use super::{batch, done, failed, service_and_browser, short, with_fields};

/// All criteria.
const ALL: &str =
    "const only = {type: 'tag', values: ['wcag2a', 'wcag2aa', 'wcag21a', 'wcag21aa', 'wcag22aa']}";

/// Criteria that depend on the colours.
const OF_COLOURS: &str =
    "const only = {type: 'rule', values: ['color-contrast', 'link-in-text-block']}";

/// Runs axe-core on the page and stores each violation in words. Most of its time would be taken by selectors of nodes without a violation.
const CHECK: &str = r"
    window.violations = null;
    axe.run(document, {runOnly: only, resultTypes: ['violations'], selectors: false}).then(
        (found) => (window.violations = {
            passed: found.passes.length,
            list: found.violations.flatMap(({id, nodes}) => nodes.map(({html, failureSummary}) => `${id}: ${html.slice(0, 200)}: ${failureSummary}`)),
        }),
        (error) => (window.violations = {passed: 0, list: [String(error)]}));
";

/// Opens all that can be opened, so that it is checked as well. A page of more than 50 parts draws them by few functions: of these, one
/// part of each shape, which is its elements and classes without repeated neighbours.
const OPEN: &str = "const shape = (node) => `${node.tagName}.${node.className}(${[...new Set([...node.children].map(shape))]})`; \
    const parts = [...document.querySelectorAll('details')], shapes = new Set(); \
    for (const part of parts) { \
        const of_part = parts.length > 50 ? shape(part) : ''; \
        part.open = parts.length <= 50 || !shapes.has(of_part); \
        shapes.add(of_part); \
    }";

#[tokio::test]
#[cfg_attr(
    not(all(has_chromium, has_axe)),
    ignore = "needs the programs chromium and chromedriver, and axe-core in target/ci-node"
)]
async fn no_page_contradicts_wcag_a_and_aa() {
    let (_folder, server, browser) = service_and_browser().await;
    let one = done(&server, &with_fields("one")).await;
    let other = done(&server, &short("other")).await;
    let late = failed(&server, "late").await;
    let base = short("of many");
    let grid = json!({"/load/n_per_mm": [100, 200], "/motion/amplitude_mm": [0.02, 0.03]});
    let sweep = batch(&server, "sweeps", &json!({"base": base, "grid": grid})).await;
    let accuracy = batch(&server, "studies", &json!({"base": base, "budget_s": 10})).await;
    let drawn = |chart: &str| format!("document.querySelector('[data-chart={chart}] .plot').data");
    let refuse = "(document.getElementById('field-cycles').value = '0', document.getElementById('field-cycles').dispatchEvent(new Event('change')))";
    let study = "/#/study?system=sd_card";
    // Each page with what is done on it first, and with what shows that it is complete.
    let pages = [
        ("/", "true", "document.querySelector('tr[data-job]')"),
        (&format!("/#/job/{one}"), "true", &drawn("stress")),
        (
            &format!("/#/job/{late}"),
            "true",
            "document.querySelector('[aria-label=Failure]')",
        ),
        (
            &format!("/#/compare?jobs={one},{other}"),
            "true",
            &drawn("half-width"),
        ),
        (
            study,
            "true",
            "document.querySelector('[aria-label=Expected]')",
        ),
        (study, refuse, "document.querySelector('[aria-invalid]')"),
        (
            "/#/study?as=sweep",
            "true",
            "document.querySelector('.swept')",
        ),
        (
            "/#/study?as=accuracy",
            "true",
            "document.getElementById('budget')",
        ),
        (
            "/#/sweeps",
            "true",
            "document.querySelectorAll('.batches tbody tr').length === 2",
        ),
        (&format!("/#/sweep/{sweep}"), "true", &drawn("sweep-map")),
        (
            &format!("/#/accuracy/{accuracy}"),
            "true",
            "document.querySelector('.points tbody tr')",
        ),
        ("/#/workers", "true", "document.querySelector('main dl')"),
        ("/docs", "true", "document.getElementById('schema-Job')"),
        (
            "/book/guide/accuracy.html",
            "true",
            "document.querySelector('main table')",
        ),
    ];
    let library = std::fs::read_to_string(env!("FRETWEAR_AXE")).expect("axe-core can be read");
    let mut violations = Vec::new();
    for (path, first, complete) in pages {
        browser.emulate(1400, "light").await;
        // Routes of one page differ in the fragment, which loads nothing.
        browser.open("/healthz").await;
        browser.open(path).await;
        browser.wait_for(first).await;
        browser.wait_for(&format!("Boolean({complete})")).await;
        for (colours, only) in [("light", ALL), ("dark", OF_COLOURS)] {
            browser.emulate(1400, colours).await;
            let script = format!("{library}; {OPEN}; {only}; {CHECK}");
            let started = browser.client.execute(&script, Vec::new()).await;
            started.expect("axe-core starts");
            let found = browser.wait_for("window.violations").await;
            assert!(found["passed"].as_u64() > Some(0), "{path}: {found}");
            let list = found["list"].as_array().cloned().unwrap_or_default();
            let texts = list.iter().filter_map(Value::as_str);
            violations.extend(texts.map(|text| format!("{colours} {path}: {text}")));
        }
    }
    assert_eq!(json!(violations), json!([]));
    browser.close().await;
}
