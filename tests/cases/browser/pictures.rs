//! The pictures of docs/tutorial/demo.md: charts of its demonstration, drawn as the page draws them.

use tests::{Browser, spec};

use super::{done, service_and_browser};

/// Charts of the page, and their files.
const PICTURES: [(&str, &str); 3] = [
    ("wear", "worn-depth"),
    ("profile", "worn-profiles"),
    ("peak-pressure", "peak-pressure"),
];

#[tokio::test]
#[ignore = "writes the pictures of docs/tutorial/demo.md to target/screenshots; run it by name"]
async fn pictures_of_the_readme() {
    let (_folder, server, browser) = service_and_browser().await;
    let text = std::fs::read_to_string(spec("fuzz_button.json")).expect("it is there");
    let id = done(&server, &text.parse().expect("JSON")).await;
    browser.open(&format!("/#/job/{id}?overlay=1")).await;
    for (chart, file) in PICTURES {
        let plot = format!("document.querySelector('[data-chart={chart}] .plot')");
        browser
            .wait_for(&format!("{plot}._fullLayout !== undefined"))
            .await;
        let script = format!(
            "const done = arguments[arguments.length - 1]; const {{data, layout}} = {plot}; \
             Plotly.toImage({{data, layout: {{...layout, paper_bgcolor: 'white'}}}}, {{format: 'svg', width: 720, height: 400}}).then((url) => done(decodeURIComponent(url.slice(url.indexOf(',') + 1))))"
        );
        let drawn = browser.client.execute_async(&script, Vec::new()).await;
        let drawn = drawn.expect("it can be drawn");
        let text = drawn.as_str().expect("it is text");
        Browser::keep(&format!("{file}.svg"), text.as_bytes());
    }
    browser.close().await;
}
