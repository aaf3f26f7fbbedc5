//! Result files.

use super::*;
use crate::export::documents::{CSV, VTU};
use crate::export::files;
use crate::store::block::Block;

on_both_engines! { Fixture:
    removing_files_of_a_lost_attempt_leaves_those_of_the_next_one,
    a_document_in_a_block_replaces_the_file_that_an_earlier_end_has_left,
}

/// Writes a file of an attempt; returns its entry.
fn written(store: &Store, claim: &Claim, name: &str) -> NewFile {
    files::write_atomically(&store.attempt_folder(claim), name, b"fields").expect("written");
    NewFile {
        file: files::manifest_entry(name, Some(1), VTU, b"fields"),
        content: NewContent::Folder,
    }
}

async fn removing_files_of_a_lost_attempt_leaves_those_of_the_next_one(fixture: Fixture) {
    let (id, store) = (fixture.queued().await, &fixture.store);
    let lost = fixture.claimed(10).await;
    written(store, &lost, "lost.vtu");
    fixture.reclaimed(10).await;
    let fresh = fixture.claimed(20).await;
    let file = written(store, &fresh, "fresh.vtu");
    // The worker of the lost attempt cleans up late.
    store
        .remove_unnamed_files(Some((&lost).into()))
        .await
        .expect("the store");
    let update = JobUpdate {
        files: vec![file],
        ..JobUpdate::default()
    };
    let ended = fixture
        .ended(&fresh, &update, Transition::Succeed, 30)
        .await;
    assert_eq!(ended, Some(Status::Succeeded));
    store
        .remove_unnamed_files(Some((&fresh).into()))
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

async fn a_document_in_a_block_replaces_the_file_that_an_earlier_end_has_left(fixture: Fixture) {
    let (id, store) = (fixture.queued().await, &fixture.store);
    let first = fixture.claimed(10).await;
    fixture.recorded(&first, &with_checkpoint(5), 10).await;
    // As an earlier version stored it.
    let old = JobUpdate {
        files: vec![NewFile {
            file: files::manifest_entry("wear-history.csv", None, CSV, b"old"),
            content: NewContent::Inline(b"old".to_vec()),
        }],
        ..JobUpdate::default()
    };
    let ended = fixture.ended(&first, &old, Transition::Fail, 20).await;
    assert_eq!(ended, Some(Status::Failed));
    store.retry(id).await.expect("the store");
    let second = fixture.claimed(40).await;
    let mut block = Block::default();
    let file = files::manifest_entry("wear-history.csv", None, CSV, b"new");
    assert!(block.push_document(&file, b"new"));
    let new = JobUpdate {
        block: Some(block.encode().expect("JSON")),
        ..JobUpdate::default()
    };
    let ended = fixture.ended(&second, &new, Transition::Succeed, 50).await;
    assert_eq!(ended, Some(Status::Succeeded));
    let manifest = store.manifest(id).await.expect("the store");
    assert_eq!(manifest, std::slice::from_ref(&file));
    let found = store.result_file(id, "wear-history.csv").await;
    let (entry, content) = found.expect("the store").expect("a file");
    assert!(entry == file && matches!(content, Content::Inline(bytes) if bytes == b"new"));
}
