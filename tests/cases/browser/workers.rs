//! The page of the workers.

use tests::{Browser, RemoteWorker, Server};

use super::{is_sound, long, submitted};

#[tokio::test]
#[cfg_attr(
    not(has_chromium),
    ignore = "needs the programs chromium and chromedriver"
)]
async fn remote_workers_are_shown_with_their_jobs_while_they_come() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::without_workers(folder.path(), &[]);
    let browser = Browser::start(&server.base, folder.path()).await;
    browser.open("/").await;
    browser.shows("main", "0 of 0 workers busy").await;
    browser.click("a[href='#/workers']").await;
    browser.shows("main", "No remote worker").await;
    let _worker = RemoteWorker::start(folder.path(), &server.base, &["--memory-mb", "4000"]);
    submitted(&server, &long("far away")).await;
    browser.shows("tbody", "4.0 GB").await;
    browser
        .wait_for("document.querySelector('tbody td:nth-child(2)').textContent === '1'")
        .await;
    browser.shows("main", "1 job in 1 slot of 1 process").await;
    is_sound(&browser).await;
    browser.click("tbody button").await;
    browser.shows("tbody", "takes no more jobs").await;
    browser.close().await;
}
