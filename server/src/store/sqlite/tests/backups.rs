//! Backups of a database in use.

use std::path::Path;
use std::time::Duration;

use crate::export::documents::VTU;
use crate::export::files;
use crate::store::sqlite::backup::{copy_database, copy_named_files};
use crate::store::tests::{Fixture, numbered, update, with_checkpoint};
use crate::store::{
    BackupError, Claim, JobUpdate, Lease, LeaseState, NewContent, NewFile, Store, backup, restore,
    verify,
};

/// Writes a file of an attempt; returns the update that names it.
fn with_file(store: &Store, claim: &Claim) -> JobUpdate {
    files::write_atomically(&store.attempt_folder(claim), "a.vtu", b"fields").expect("written");
    JobUpdate {
        files: vec![NewFile {
            file: files::manifest_entry("a.vtu", Some(1), VTU, b"fields"),
            content: NewContent::Folder,
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
    store.record_next(&claim, &with_file(store, &claim)).await;

    let source = Path::new(fixture.url.trim_start_matches("sqlite://"));
    let target = fixture.folder.path().join("copy.db");
    copy_database(source, &target).await.expect("a copy");
    store.delete(deleted).await.expect("the store");
    store.restart(&claim, i64::MAX).await.expect("the store");
    store
        .remove_unnamed_files(Some((&claim).into()))
        .await
        .expect("the store");
    let copied = copy_named_files(source, &target).await.expect("a backup");
    assert_eq!((copied.jobs, copied.files), (1, 0));

    let copy = Store::open(&format!("sqlite://{}", target.display())).await;
    let copy = copy.expect("a store");
    assert!(copy.job(deleted).await.expect("the store").is_none());
    let lease = Duration::from_secs(1);
    let reclaimed = copy.reclaim_at_start(lease, lease).await;
    assert_eq!(reclaimed.expect("the store").queued, 1);
    let claim = copy.claim_next(i64::MAX).await.expect("a job");
    assert_eq!((claim.id, claim.checkpoint), (running, None));
    assert_eq!(copy.manifest(running).await.expect("the store"), []);
}

/// The worker of the job continues, and its service is that of the copy from some time on.
#[tokio::test]
async fn the_leases_of_a_restored_database_have_ended_for_the_workers_of_its_original() {
    let fixture = Fixture::new().await;
    let store = &fixture.store;
    let running = fixture.queued().await;
    let claim = fixture.claimed(i64::MAX).await;
    let first = numbered(&claim, with_file(store, &claim));
    let length = Duration::from_hours(1);
    store
        .record(&claim, &first, length)
        .await
        .expect("recorded");
    let into = fixture.folder.path().join("backup");
    backup(&fixture.url, &into).await.expect("a backup");
    store.record_next(&claim, &update(5)).await;

    let served = [
        into.join("fretwear.db"),
        fixture.folder.path().join("restored.db"),
    ];
    let url = |path: &Path| format!("sqlite://{}", path.display());
    restore(&into, &url(&served[1])).await.expect("restored");
    for path in served {
        let copy = Store::open(&url(&path)).await.expect("a store");
        for number in [2, 3] {
            let late = JobUpdate {
                number,
                ..update(7)
            };
            let recorded = copy.record(&claim, &late, length).await;
            assert_eq!(recorded.expect("the store"), LeaseState::Lost);
        }
        let reclaimed = copy.reclaim_at_start(length, length).await;
        assert_eq!(reclaimed.expect("the store").queued, 1);
        let next = copy.claim_next(i64::MAX).await.expect("a job");
        assert_eq!((next.id, next.attempt), (running, 1));
        assert_eq!(next.checkpoint.map(|found| found.cycle()), Some(3));
        assert_ne!(next.lease, claim.lease);
        let recorded = copy.record(&claim, &first, length).await;
        assert_eq!(recorded.expect("the store"), LeaseState::Lost);
        let missing = copy.missing_files(Lease::from(&claim)).await;
        assert_eq!(missing.expect("the store"), [""; 0]);
        copy.close().await;
    }
}

#[tokio::test]
async fn damaged_files_do_not_prevent_a_backup_and_are_marked_in_it() {
    let fixture = Fixture::new().await;
    let store = &fixture.store;
    let mut jobs = Vec::new();
    for _ in 0..3 {
        jobs.push(fixture.queued().await);
        let claim = fixture.claimed(10).await;
        fixture.ended_with(&claim, &with_file(store, &claim)).await;
        let path = store.attempt_folder(&claim).join("a.vtu");
        match jobs.len() {
            1 => std::fs::write(path, b"FIELDS").expect("damage"),
            2 => std::fs::remove_file(path).expect("damage"),
            _ => {}
        }
    }
    let into = fixture.folder.path().join("backup");
    let copied = backup(&fixture.url, &into).await.expect("a backup");
    assert_eq!((copied.jobs, copied.files, copied.damaged.len()), (3, 1, 2));

    let verified = verify(&fixture.url, Path::new("none"), None)
        .await
        .expect("verified");
    assert_eq!((verified.jobs, verified.files), (3, 3));
    assert_eq!(verified.damaged.len(), 2, "{verified:?}");
    let url = format!(
        "sqlite://{}",
        fixture.folder.path().join("other.db").display()
    );
    let restored = restore(&into, &url).await.expect("restored");
    assert_eq!((restored.files, &restored.damaged), (1, &copied.damaged));
    let other = Store::open(&url).await.expect("a store");
    for (job, how) in jobs.into_iter().zip(["SHA-256", "does not exist", ""]) {
        for manifest in [store.manifest(job).await, other.manifest(job).await] {
            let damaged = manifest.expect("the store")[0].damaged.clone();
            assert_eq!(damaged.is_some(), !how.is_empty(), "{damaged:?}");
            assert!(damaged.is_none_or(|found| found.contains(how)));
        }
    }
}

#[tokio::test]
async fn a_backup_that_was_damaged_later_leaves_nothing_when_it_is_restored() {
    let fixture = Fixture::new().await;
    let store = &fixture.store;
    fixture.queued().await;
    let claim = fixture.claimed(10).await;
    fixture.ended_with(&claim, &with_file(store, &claim)).await;
    let into = fixture.folder.path().join("backup");
    backup(&fixture.url, &into).await.expect("a backup");
    let again = backup(&fixture.url, &into).await;
    assert!(matches!(again, Err(BackupError::NotEmpty(_))), "{again:?}");
    let place = format!("fretwear.db.results/{}/{}/a.vtu", claim.id, claim.lease);
    std::fs::write(into.join(place), b"FIELDS").expect("damage");
    let target = fixture.folder.path().join("target");
    std::fs::create_dir(&target).expect("a folder");
    let url = format!("sqlite://{}", target.join("other.db").display());
    let restored = restore(&into, &url).await;
    assert!(
        matches!(restored, Err(BackupError::Content { .. })),
        "{restored:?}"
    );
    let left: Vec<_> = std::fs::read_dir(&target)
        .expect("a folder")
        .flatten()
        .collect();
    let names: Vec<_> = left.iter().map(std::fs::DirEntry::file_name).collect();
    assert!(names.is_empty(), "{names:?}");
}
