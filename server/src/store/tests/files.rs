//! Result files.

use super::*;
use crate::export::documents::VTU;
use crate::export::files;

/// Writes a file of an attempt; returns its entry.
fn written(store: &Store, claim: &Claim, name: &str) -> NewFile {
    files::write_atomically(&store.attempt_folder(claim), name, b"fields").expect("written");
    NewFile {
        file: files::manifest_entry(name, Some(1), VTU, b"fields"),
        content: None,
    }
}

#[tokio::test]
async fn removing_files_of_a_lost_attempt_leaves_those_of_the_next_one() {
    let fixture = Fixture::new().await;
    let (id, store) = (fixture.queued().await, &fixture.store);
    let lost = fixture.claimed(10).await;
    written(store, &lost, "lost.vtu");
    fixture.reclaimed(10).await;
    let fresh = fixture.claimed(20).await;
    let file = written(store, &fresh, "fresh.vtu");
    // The worker of the lost attempt cleans up late.
    store
        .remove_unnamed_files(Some(&lost))
        .await
        .expect("the store");
    let update = JobUpdate {
        files: vec![file],
        ..JobUpdate::default()
    };
    let ended = store
        .end(&fresh, &update, &end(Transition::Succeed), 30)
        .await;
    assert_eq!(ended.expect("the store"), Some(Status::Succeeded));
    store
        .remove_unnamed_files(Some(&fresh))
        .await
        .expect("the store");
    let (_, content) = store
        .result_file(id, "fresh.vtu")
        .await
        .expect("the store")
        .expect("a file");
    let Content::File(path) = content else {
        panic!("its content is a file");
    };
    assert_eq!(std::fs::read(path).expect("it exists"), b"fields");
    assert!(!store.attempt_folder(&lost).exists());
}
