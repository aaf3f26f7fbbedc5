//! Files beside the database.

use super::*;
use crate::export::documents::VTU;
use crate::export::files;

/// A file that an attempt has written, on its way to the manifest.
fn kept(store: &Store, claim: &Claim, name: &str) -> NewFile {
    files::write_atomically(&store.attempt_folder(claim), name, b"fields").expect("kept");
    NewFile {
        file: files::manifest_entry(name, Some(1), VTU, b"fields"),
        content: None,
    }
}

#[tokio::test]
async fn sweeping_after_an_attempt_leaves_what_the_next_one_is_about_to_name() {
    let fixture = Fixture::new().await;
    let (id, store) = (fixture.queued().await, &fixture.store);
    let lost = fixture.claimed(10).await;
    kept(store, &lost, "lost.vtu");
    fixture.rescued(10).await;
    let fresh = fixture.claimed(20).await;
    let file = kept(store, &fresh, "fresh.vtu");
    // The worker of the lost attempt is late with what it does last.
    store.sweep_files(Some(&lost)).await.expect("the store");
    let batch = Batch {
        files: vec![file],
        ..Batch::default()
    };
    let ended = store
        .end(&fresh, &batch, &end(Transition::Succeed), 30)
        .await;
    assert_eq!(ended.expect("the store"), Some(Status::Succeeded));
    store.sweep_files(Some(&fresh)).await.expect("the store");
    let (_, content) = store
        .result_file(id, "fresh.vtu")
        .await
        .expect("the store")
        .expect("a file");
    let Content::File(path) = content else {
        panic!("it lies beside the database");
    };
    assert_eq!(std::fs::read(path).expect("it is there"), b"fields");
    assert!(!store.attempt_folder(&lost).exists());
}
