//! Copies of a database that is served meanwhile.

use super::*;
use crate::export::documents::VTU;
use crate::export::files;
use crate::store::sqlite::backup::{BackupError, copy_database, copy_what_it_names};

/// A file that an attempt has written, on its way to the manifest.
fn kept(store: &Store, claim: &Claim) -> Batch {
    files::write_atomically(&store.attempt_folder(claim), "a.vtu", b"fields").expect("kept");
    Batch {
        files: vec![NewFile {
            file: files::manifest_entry("a.vtu", Some(1), VTU, b"fields"),
            content: None,
        }],
        ..saved(3)
    }
}

fn saved(cycle: u64) -> Batch {
    Batch {
        checkpoint: Some(NewCheckpoint {
            cycle,
            state: b"a state".to_vec(),
        }),
        ..batch(cycle)
    }
}

#[tokio::test]
async fn a_backup_holds_although_jobs_are_deleted_and_begun_anew_meanwhile() {
    let fixture = Fixture::new().await;
    let store = &fixture.store;
    let deleted = fixture.queued().await;
    let claim = fixture.claimed(10).await;
    fixture.ended_with(&claim, &kept(store, &claim)).await;
    let running = fixture.queued().await;
    let claim = fixture.claimed(10).await;
    let held = store.record(&claim, &kept(store, &claim), 10).await;
    held.expect("the store");

    let source = Path::new(fixture.url.trim_start_matches("sqlite://"));
    let target = fixture.folder.path().join("copy.db");
    copy_database(source, &target).await.expect("a copy");
    store.delete(deleted).await.expect("the store");
    store.begin_anew(&claim).await.expect("the store");
    store.sweep_files(Some(&claim)).await.expect("the store");
    let copied = copy_what_it_names(source, &target).await.expect("a backup");
    assert_eq!((copied.jobs, copied.files), (1, 0));

    let copy = Store::open(&format!("sqlite://{}", target.display())).await;
    let copy = copy.expect("a store");
    assert!(copy.job(deleted).await.expect("the store").is_none());
    assert_eq!(copy.rescue_all(50).await.expect("the store").queued, 1);
    let claim = copy.claim(1, 60).await.expect("the store").expect("a job");
    assert_eq!((claim.id, claim.checkpoint), (running, None));
    assert_eq!(copy.manifest(running).await.expect("the store"), []);
}

#[tokio::test]
async fn a_file_that_is_gone_although_it_is_named_is_damage() {
    let fixture = Fixture::new().await;
    let store = &fixture.store;
    fixture.queued().await;
    let claim = fixture.claimed(10).await;
    fixture.ended_with(&claim, &kept(store, &claim)).await;
    let source = Path::new(fixture.url.trim_start_matches("sqlite://"));
    let target = fixture.folder.path().join("copy.db");
    copy_database(source, &target).await.expect("a copy");
    std::fs::remove_dir_all(store.attempt_folder(&claim)).expect("damage");
    let copied = copy_what_it_names(source, &target).await;
    assert!(matches!(copied, Err(BackupError::Missing(_))), "{copied:?}");
}
