//! One job: live while it runs, complete after a reload, its stored cycles and axes in the address.

use serde_json::Value;
use tests::{Browser, Server};

use super::{
    done, failed, fits_a_phone, is_sound, long, service_and_browser, short, submitted, with_fields,
};

#[tokio::test]
#[cfg_attr(
    not(has_chromium),
    ignore = "needs the programs chromium and chromedriver"
)]
async fn a_running_job_is_watched_reloaded_and_cancelled() {
    let (_folder, server, browser) = service_and_browser().await;
    let id = submitted(&server, &long("watched")).await;
    browser.open(&format!("/#/job/{id}")).await;
    browser.shows("h1", "watched").await;
    browser.shows(".status", "of 1,000,000").await;
    // Curves grow while it runs.
    let cycle = "Array.from(document.querySelector('[data-chart=wear] .plot').data[0].x).at(-1)";
    browser.wait_for(&format!("{cycle} > 2")).await;
    let before = browser.wait_for(cycle).await.as_f64().expect("a number");
    browser.wait_for(&format!("{cycle} > {before}")).await;
    browser.client.refresh().await.expect("it reloads");
    browser.shows(".status", "of 1,000,000").await;
    browser.wait_for(&format!("{cycle} > {before}")).await;
    browser.click(".actions button").await;
    browser.shows(".status", "cancelled").await;
    browser.shows(".actions", "Run again").await;
    is_sound(&browser).await;
    browser.close().await;
}

/// Asserts that the results show every quantity of the interface that the summary has; those of accuracy and cost have cards of their own.
async fn shows_quantities(server: &Server, browser: &Browser, id: &str) {
    let (_, job) = server.get(&format!("/v1/jobs/{id}")).await;
    let (_, list) = server.get("/v1/quantities").await;
    let mut shown = 0;
    for quantity in list["quantities"].as_array().expect("a list") {
        let pointer = quantity["pointer"].as_str().unwrap_or_default();
        let value = job["summary"].pointer(pointer);
        let is_elsewhere = pointer.starts_with("/accuracy") || pointer.starts_with("/cost");
        if value.is_some_and(Value::is_number) && !is_elsewhere {
            let title = quantity["title"].as_str().expect("a title");
            browser.shows("[aria-label=Result]", title).await;
            shown += 1;
        }
    }
    assert!(shown > 8, "{shown} quantities");
}

#[tokio::test]
#[cfg_attr(
    not(has_chromium),
    ignore = "needs the programs chromium and chromedriver"
)]
async fn a_job_that_has_ended_shows_all_that_it_has() {
    let (_folder, server, browser) = service_and_browser().await;
    let id = done(&server, &short("complete")).await;
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
    shows_quantities(&server, &browser, &id).await;
    fits_a_phone(&browser, "job").await;
    // The slider goes to the first stored cycle, where Hertz' pressure is drawn as well.
    browser.scroll_to("section.snapshots").await;
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

#[tokio::test]
#[cfg_attr(
    not(has_chromium),
    ignore = "needs the programs chromium and chromedriver"
)]
async fn stresses_are_drawn_at_each_position_and_profiles_to_scale() {
    let (_folder, server, browser) = service_and_browser().await;
    let id = done(&server, &with_fields("stressed")).await;
    browser
        .open(&format!(
            "/#/job/{id}?position=rightmost&field=1&scale=equal"
        ))
        .await;
    let stress = "[data-chart=stress]";
    browser
        .shows(stress, "Von Mises stress at cycle 1, rightmost position")
        .await;
    let plot = "document.querySelector('[data-chart=stress] .plot')";
    // The picture is as fine as the screen, empty outside of the bodies, and its colours are those of stresses.
    let values = format!("{plot}.data[0].z.flat()");
    browser
        .wait_for(&format!(
            "{values}.length > 10000 && {values}.includes(null)"
        ))
        .await;
    browser
        .wait_for(&format!("{plot}.data[0].zmax > 10 && {values}.every((value) => value === null || value <= {plot}.data[0].zmax)"))
        .await;
    browser
        .wait_for(&format!(
            "{plot}.innerHTML.includes('von Mises stress, MPa')"
        ))
        .await;
    // Zoomed, it is computed for what is shown.
    browser.scroll_to("section.stresses").await;
    let zoom = "const plot = document.querySelector('[data-chart=stress] .plot'); Plotly.relayout(plot, {'xaxis.range': [0, 10]})";
    let zoomed = browser.client.execute(zoom, Vec::new()).await;
    zoomed.expect("it can be zoomed");
    browser
        .wait_for(&format!("{plot}.data[0].x0 === 0 && Math.abs({plot}.data[0].dx * ({plot}.data[0].z[0].length - 1) - 10) < 1e-6"))
        .await;
    let choose = "const choice = [...document.querySelectorAll('.stresses select')][1]; choice.value = 'leftmost'; choice.dispatchEvent(new Event('change'))";
    let chosen = browser.client.execute(choose, Vec::new()).await;
    chosen.expect("it can be chosen");
    browser.shows(stress, "leftmost position").await;
    browser
        .wait_for("location.hash.includes('position=leftmost')")
        .await;
    let to_scale =
        "document.querySelector('[data-chart=profile] .plot').layout.yaxis.scaleanchor === 'x'";
    browser.wait_for(to_scale).await;
    browser.shows("[data-chart=loop]", "gross slip").await;
    fits_a_phone(&browser, "stresses").await;
    is_sound(&browser).await;
    browser.close().await;
}

#[tokio::test]
#[cfg_attr(
    not(has_chromium),
    ignore = "needs the programs chromium and chromedriver"
)]
async fn a_failed_job_says_why_and_what_to_do() {
    let (_folder, server, browser) = service_and_browser().await;
    let id = failed(&server, "late").await;
    browser.open(&format!("/#/job/{id}")).await;
    let failure = "[aria-label=Failure]";
    browser.shows(failure, "Failed: deadline exceeded").await;
    browser.shows(failure, "Run it again").await;
    browser.shows(failure, "Clone and change").await;
    browser.shows(".actions", "Run again").await;
    fits_a_phone(&browser, "failed").await;
    is_sound(&browser).await;
    browser.close().await;
}
