//! One job: live while it runs, complete after a reload, its stored cycles and axes in the address.

use serde_json::Value;
use tests::{Browser, Server};

use super::{done, fits_a_phone, is_sound, long, short, submitted};

#[tokio::test]
#[cfg_attr(
    not(has_chromium),
    ignore = "needs the programs chromium and chromedriver"
)]
async fn a_running_job_is_watched_reloaded_and_cancelled() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let id = submitted(&server, &long("watched")).await;
    let browser = Browser::start(&server.base, folder.path()).await;
    browser.open(&format!("/#/job/{id}")).await;
    browser.shows("h1", "watched").await;
    browser.shows(".status", "of 1,000,000").await;
    // Curves grow while it runs.
    let rows = "document.querySelector('[data-chart=wear] .plot').data[0].x.length";
    browser.wait_for(&format!("{rows} > 2")).await;
    let before = browser.wait_for(rows).await.as_u64().expect("a number");
    browser.wait_for(&format!("{rows} > {before}")).await;
    browser.client.refresh().await.expect("it reloads");
    browser.shows(".status", "of 1,000,000").await;
    browser.wait_for(&format!("{rows} > 2")).await;
    browser.click(".actions button").await;
    browser.shows(".status", "cancelled").await;
    browser.shows(".actions", "Run again").await;
    is_sound(&browser).await;
    browser.close().await;
}

#[tokio::test]
#[cfg_attr(
    not(has_chromium),
    ignore = "needs the programs chromium and chromedriver"
)]
async fn a_job_that_has_ended_shows_all_that_it_has() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let id = done(&server, &short("complete")).await;
    let browser = Browser::start(&server.base, folder.path()).await;
    browser.open(&format!("/#/job/{id}")).await;
    for (part, text) in [
        ("[aria-label=Result]", "peak pressure"),
        ("[aria-label='Estimated errors']", "worn depth"),
        ("[aria-label=Checks]", "force balance"),
        ("[aria-label=Cost]", "processor time"),
        ("[aria-label=Specification]", "/system/kind"),
        (
            "[aria-label='Effects: what is simulated and why']",
            "elasticity",
        ),
        ("[aria-label=Files]", "files"),
        ("[data-chart=profile]", "Worn profiles at cycle 20"),
        ("[data-chart=loop]", "Friction loop"),
    ] {
        browser.shows(part, text).await;
    }
    fits_a_phone(&browser, "job").await;
    // The slider goes to the first stored cycle, where Hertz' pressure is drawn as well.
    let slide = "const slider = document.querySelector('input[type=range]'); slider.value = 0; slider.dispatchEvent(new Event('input'))";
    browser
        .client
        .execute(slide, Vec::new())
        .await
        .expect("it can be moved");
    browser
        .shows("[data-chart=pressure]", "Contact pressure at cycle 0")
        .await;
    browser.wait_for("location.hash.includes('cycle=0')").await;
    browser.wait_for("document.querySelector('[data-chart=pressure] .plot').data.some((curve) => curve.name === 'Hertz')").await;
    browser
        .click("[data-chart=wear] input[type=checkbox]")
        .await;
    browser
        .wait_for("document.querySelector('[data-chart=wear] .plot').layout.xaxis.type === 'log'")
        .await;
    browser.client.refresh().await.expect("it reloads");
    browser
        .shows("[data-chart=pressure]", "Contact pressure at cycle 0")
        .await;
    browser
        .wait_for("document.querySelector('[data-chart=wear] .plot').layout.xaxis.type === 'log'")
        .await;
    is_sound(&browser).await;
    browser.close().await;
}

#[tokio::test]
#[cfg_attr(
    not(has_chromium),
    ignore = "needs the programs chromium and chromedriver"
)]
async fn a_page_survives_a_restart_of_the_service() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let port = server.base.rsplit(':').next().expect("a port").to_owned();
    let id = submitted(&server, &long("survives")).await;
    let browser = Browser::start(&server.base, folder.path()).await;
    browser.open(&format!("/#/job/{id}")).await;
    browser.shows(".status", "of 1,000,000").await;
    drop(server);
    let listen = format!("127.0.0.1:{port}");
    let server = Server::start_with(folder.path(), &["--listen", &listen]);
    let goes_on = |job: &Value| job["status"] == "running" && job["attempts"].as_u64() > Some(1);
    server.job_when(&id, goes_on).await;
    server.post(&format!("/v1/jobs/{id}/cancel")).await;
    browser.shows(".status", "cancelled").await;
    assert_eq!(browser.other_hosts().await, Vec::<String>::new());
    browser.close().await;
}
