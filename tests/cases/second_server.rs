//! Requirement: a second service on a database that is served refuses to start, also if the lock file was deleted.

use nix::sys::signal::Signal;
use tests::{Server, fretwear};

#[tokio::test]
async fn a_second_service_is_refused_although_the_lock_file_was_deleted() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    std::fs::remove_file(folder.path().join("fretwear.db.lock")).expect("there is a lock file");
    let second = ["serve", "--listen", "127.0.0.1:0"];
    let ran = fretwear(folder.path(), &second);
    assert_eq!(ran.code, Some(1), "{}", ran.stderr);
    assert!(
        ran.stderr.contains("another process serves"),
        "{}",
        ran.stderr
    );
    assert_eq!(server.get("/readyz").await.0, 200);
    // One that was killed does not prevent the next.
    server.signal(Signal::SIGKILL);
    assert_eq!(server.wait(), None);
    let server = Server::start(folder.path());
    assert_eq!(server.get("/readyz").await.0, 200);
}
