//! Backups of a database in use.

use std::path::Path;

use crate::export::documents::VTU;
use crate::export::files;
use crate::store::sqlite::backup::{copy_database, copy_named_files};
use crate::store::tests::{Fixture, with_checkpoint};
use crate::store::{BackupError, Claim, JobUpdate, NewFile, Store};

/// Writes a file of an attempt; returns the update that names it.
fn with_file(store: &Store, claim: &Claim) -> JobUpdate {
    files::write_atomically(&store.attempt_folder(claim), "a.vtu", b"fields").expect("written");
    JobUpdate {
        files: vec![NewFile {
            file: files::manifest_entry("a.vtu", Some(1), VTU, b"fields"),
            content: None,
        }],
        ..with_checkpoint(3)
    }
}

#[tokio::test]
async fn a_backup_is_consistent_although_jobs_are_deleted_and_restarted_meanwhile() {
    let fixture = Fixture::new().await;
    let store = &fixture.store;
    let deleted = fixture.queued().await;
    let claim = fixture.claimed(10).await;
    fixture.ended_with(&claim, &with_file(store, &claim)).await;
    let running = fixture.queued().await;
    let claim = fixture.claimed(10).await;
    let held = store.record(&claim, &with_file(store, &claim), 10).await;
    held.expect("the store");

    let source = Path::new(fixture.url.trim_start_matches("sqlite://"));
    let target = fixture.folder.path().join("copy.db");
    copy_database(source, &target).await.expect("a copy");
    store.delete(deleted).await.expect("the store");
    store.restart(&claim).await.expect("the store");
    store
        .remove_unnamed_files(Some(&claim))
        .await
        .expect("the store");
    let copied = copy_named_files(source, &target).await.expect("a backup");
    assert_eq!((copied.jobs, copied.files), (1, 0));

    let copy = Store::open(&format!("sqlite://{}", target.display())).await;
    let copy = copy.expect("a store");
    assert!(copy.job(deleted).await.expect("the store").is_none());
    assert_eq!(copy.reclaim_all(50).await.expect("the store").queued, 1);
    let claim = copy.claim(1, 60).await.expect("the store").expect("a job");
    assert_eq!((claim.id, claim.checkpoint), (running, None));
    assert_eq!(copy.manifest(running).await.expect("the store"), []);
}

#[tokio::test]
async fn a_missing_file_that_is_still_named_is_an_error() {
    let fixture = Fixture::new().await;
    let store = &fixture.store;
    fixture.queued().await;
    let claim = fixture.claimed(10).await;
    fixture.ended_with(&claim, &with_file(store, &claim)).await;
    let source = Path::new(fixture.url.trim_start_matches("sqlite://"));
    let target = fixture.folder.path().join("copy.db");
    copy_database(source, &target).await.expect("a copy");
    std::fs::remove_dir_all(store.attempt_folder(&claim)).expect("damage");
    let copied = copy_named_files(source, &target).await;
    assert!(matches!(copied, Err(BackupError::Missing(_))), "{copied:?}");
}
