//! Results in a store of objects.

use std::path::{Path, PathBuf};

use super::*;
use crate::export::documents::{CSV, VTU};
use crate::export::files;
use crate::http::tests::snapshot;
use crate::objects::Objects;
use crate::store::block::Block;
use crate::store::sqlite::backup::{copy_database, copy_named_files};

on_both_engines! { WithObjects:
    results_of_a_succeeded_job_are_one_object_and_read_as_before,
    an_object_is_removed_with_its_job,
    results_of_a_failed_job_are_not_moved,
    results_stay_while_the_store_of_objects_fails,
    objects_without_a_name_are_removed,
    a_job_with_a_damaged_file_keeps_its_results_and_others_are_moved,
    a_database_whose_results_are_elsewhere_is_not_opened_without_them,
    an_object_that_cannot_be_removed_stops_nothing,
    results_that_are_moved_leave_what_was_sent,
}

/// A database whose results are moved into a folder of objects.
pub(super) struct WithObjects {
    pub(super) place: Place,
    pub(super) store: Arc<Store>,
}

impl WithObjects {
    pub(super) async fn at(place: Place) -> Self {
        let store = opened(&place, Some("objects")).await;
        let store = Arc::new(store.expect("a store"));
        Self { place, store }
    }

    /// Paths of all objects but those of files of attempts.
    pub(super) fn objects(&self) -> Vec<PathBuf> {
        let files = files_below(&self.place.folder.path().join("objects"));
        let is_other = |path: &PathBuf| path.ends_with("fretwear-objects") || is_of_attempt(path);
        files.into_iter().filter(|path| !is_other(path)).collect()
    }

    /// Paths of the files of attempts: objects of several services, in the folder of one.
    pub(super) fn files(&self) -> Vec<PathBuf> {
        let folder = self.place.folder.path();
        if !self.store.is_shared() {
            return files_below(&folder.join("test.db.results"));
        }
        let objects = files_below(&folder.join("objects"));
        objects
            .into_iter()
            .filter(|path| is_of_attempt(path))
            .collect()
    }

    /// A job that has ended with a document, a file, rows and snapshots.
    pub(super) async fn ended(&self, transition: Transition) -> Uuid {
        let spec = spec::read(br#"{"system":{"kind":"fuzz_button"}}"#).expect("accepted");
        let plan = crate::estimate::Estimate::of(&spec).plan(&spec, None);
        let job = NewJob {
            sent: SENT.to_owned(),
            spec: spec.spec,
            plan,
            options: SubmitOptions::default(),
        };
        let id = self.store.queue(&job).await;
        let claim = self.store.claim_next(i64::MAX).await.expect("a job");
        let folder = self.store.attempt_folder(&claim);
        files::write_atomically(&folder, "a.vtu", b"fields").expect("written");
        let update = JobUpdate {
            files: vec![NewFile {
                file: files::manifest_entry("a.vtu", Some(1), VTU, b"fields"),
                content: NewContent::Folder,
            }],
            snapshots: vec![snapshot(2)],
            events: vec![(EventName::Cycle, "{}".to_owned()); 2],
            ..with_checkpoint(3)
        };
        self.store.record_next(&claim, &update).await;
        let mut block = Block::default();
        let rows: Vec<CycleReport> = (1..=4).map(row).collect();
        assert!(block.push_history(&rows, &[snapshot(2)]).expect("written"));
        let document = files::manifest_entry("b.csv", None, CSV, b"cycle");
        assert!(block.push_document(&document, b"cycle"));
        let last = JobUpdate {
            block: Some(block.encode().expect("encoded")),
            ..JobUpdate::default()
        };
        self.store.end_next(&claim, &last, &end(transition)).await;
        id
    }

    /// Moves what can be moved; returns the jobs.
    pub(super) async fn moved(&self) -> Vec<Uuid> {
        let (moved, ended) = self.store.move_results().await;
        ended.expect("the store of objects answers");
        self.store.remove_moved(&moved).await;
        moved
    }

    pub(super) async fn read(&self, id: Uuid, name: &str) -> Result<Vec<u8>, StoreError> {
        let found = self.store.result_file(id, name).await?;
        let (_, content) = found.expect("a file");
        Ok(content.read().await.expect("it can be read"))
    }
}

pub(super) async fn opened(place: &Place, objects: Option<&str>) -> Result<Store, StoreError> {
    let address = |name| format!("file://{}", place.folder.path().join(name).display());
    let objects = objects.map(|name| Objects::open(&address(name)).expect("opened"));
    let store = Store::open_with(&place.url, &place.files(), Limits::default()).await?;
    store.with_objects(objects).await
}

fn is_of_attempt(object: &Path) -> bool {
    let mut folders = object.components();
    folders.any(|folder| folder.as_os_str() == "files")
}

/// Paths of all files below a folder.
pub(super) fn files_below(folder: &Path) -> Vec<PathBuf> {
    let entries = std::fs::read_dir(folder).expect("a folder");
    let paths = entries.map(|entry| entry.expect("an entry").path());
    paths
        .flat_map(|path| {
            if path.is_dir() {
                files_below(&path)
            } else {
                vec![path]
            }
        })
        .collect()
}

async fn results_of_a_succeeded_job_are_one_object_and_read_as_before(database: WithObjects) {
    let store = &database.store;
    let id = database.ended(Transition::Succeed).await;
    let all = async || {
        (
            store.manifest(id).await.expect("the store"),
            store.history(id).await.expect("the store"),
            store.snapshots(id).await.expect("the store"),
            store.events(id, 0).await.expect("the store"),
            store.events(id, 2).await.expect("the store"),
            store.job(id).await.expect("the store"),
        )
    };
    let before = all().await;
    assert_eq!((before.0.len(), before.3.len(), before.4.len()), (2, 5, 3));
    assert_eq!(database.moved().await, [id]);
    assert_eq!(before, all().await);
    assert_eq!(database.objects().len(), 1);
    assert_eq!(database.read(id, "a.vtu").await.expect("read"), b"fields");
    assert_eq!(database.read(id, "b.csv").await.expect("read"), b"cycle");
    assert!(
        store
            .result_file(id, "c.csv")
            .await
            .expect("read")
            .is_none()
    );
    let results = database.place.folder.path().join("test.db.results");
    assert_eq!(files_below(&results), Vec::<PathBuf>::new());
    assert_eq!(database.moved().await, [] as [Uuid; 0]);
    let gauges = store.gauges().await.expect("the store");
    assert_eq!(gauges.results_to_move, 0);
}

async fn an_object_is_removed_with_its_job(database: WithObjects) {
    let id = database.ended(Transition::Succeed).await;
    database.moved().await;
    let deleted = database.store.delete(id).await.expect("the store");
    assert_eq!(deleted, Deleted::Done);
    database.moved().await;
    assert_eq!(database.objects(), Vec::<PathBuf>::new());
}

/// The results of a job that may be tried again stay: the next attempt continues them.
async fn results_of_a_failed_job_are_not_moved(database: WithObjects) {
    let id = database.ended(Transition::Fail).await;
    assert_eq!(database.moved().await, [] as [Uuid; 0]);
    assert_eq!(database.read(id, "a.vtu").await.expect("read"), b"fields");
}

async fn results_stay_while_the_store_of_objects_fails(database: WithObjects) {
    let objects = database.place.folder.path().join("objects");
    let id = database.ended(Transition::Succeed).await;
    let away = database.place.folder.path().join("away");
    std::fs::rename(&objects, &away).expect("renamed");
    std::fs::write(&objects, "").expect("a file in its place");
    let (moved, ended) = database.store.move_results().await;
    assert!(moved.is_empty() && matches!(ended, Err(StoreError::Objects(_))));
    assert_eq!(database.read(id, "b.csv").await.expect("read"), b"cycle");
    std::fs::remove_file(&objects).expect("removed");
    std::fs::rename(&away, &objects).expect("renamed");
    assert_eq!(database.moved().await, [id]);
    assert_eq!(database.objects().len(), 1);
}

/// Noted keys whose objects no job names belong to moves that a crash has interrupted.
async fn objects_without_a_name_are_removed(database: WithObjects) {
    let id = database.ended(Transition::Succeed).await;
    let objects = database.place.folder.path().join("objects");
    std::fs::create_dir_all(objects.join("jobs")).expect("a folder");
    std::fs::write(objects.join("jobs/left"), "").expect("written");
    database
        .store
        .note_unnamed(&["jobs/left".to_owned()])
        .await
        .expect("noted");
    database.moved().await;
    let [object] = &database.objects()[..] else {
        panic!("one object");
    };
    assert!(object.to_string_lossy().contains(&id.to_string()));
}

async fn a_job_with_a_damaged_file_keeps_its_results_and_others_are_moved(database: WithObjects) {
    let damaged = database.ended(Transition::Succeed).await;
    let [file] = &database.files()[..] else {
        panic!("one file");
    };
    std::fs::write(file, "field").expect("shortened");
    let whole = database.ended(Transition::Succeed).await;
    assert_eq!(database.moved().await, [whole]);
    assert_eq!(database.moved().await, [] as [Uuid; 0]);
    assert_eq!(
        database.read(damaged, "b.csv").await.expect("read"),
        b"cycle"
    );
}

async fn a_database_whose_results_are_elsewhere_is_not_opened_without_them(database: WithObjects) {
    database.ended(Transition::Succeed).await;
    database.store.close().await;
    let WithObjects { place, store } = database;
    // Nothing was moved so far, but several services have files there.
    let before = [None, Some("other"), Some("objects")];
    let usable = if store.is_shared() {
        &before[2..]
    } else {
        &before
    };
    drop(store);
    for &objects in usable {
        let store = opened(&place, objects).await.expect("a store");
        store.close().await;
    }
    let store = opened(&place, Some("objects")).await.expect("a store");
    store.move_results().await.1.expect("moved");
    store.close().await;
    drop(store);
    let without = opened(&place, None).await;
    assert!(matches!(without, Err(StoreError::NoObjects)), "{without:?}");
    let other = opened(&place, Some("other")).await;
    assert!(
        matches!(other, Err(StoreError::OtherObjects { .. })),
        "{other:?}"
    );
    opened(&place, Some("objects")).await.expect("a store");
}

/// Objects that the store does not let remove keep no others from being written.
async fn an_object_that_cannot_be_removed_stops_nothing(database: WithObjects) {
    let id = database.ended(Transition::Succeed).await;
    let objects = database.place.folder.path().join("objects");
    // A folder is no object, and cannot be removed as one.
    std::fs::create_dir_all(objects.join("jobs/left/inside")).expect("a folder");
    let left = ["jobs/left".to_owned()];
    database.store.note_unnamed(&left).await.expect("noted");
    let (moved, ended) = database.store.move_results().await;
    assert_eq!(moved, [id]);
    assert!(matches!(ended, Err(StoreError::Objects(_))), "{ended:?}");
}

/// The backup's copy of the database has files that are moved before they are copied.
#[tokio::test]
async fn a_backup_has_results_that_are_moved_meanwhile() {
    let database = WithObjects::at(Place::sqlite()).await;
    let id = database.ended(Transition::Succeed).await;
    let before = database.store.job(id).await.expect("the store");
    let folder = database.place.folder.path();
    let (source, target) = (folder.join("test.db"), folder.join("copy/test.db"));
    std::fs::create_dir(folder.join("copy")).expect("a folder");
    copy_database(&source, &target).await.expect("a copy");
    database.moved().await;
    let copied = copy_named_files(&source, &target).await.expect("a backup");
    assert_eq!((copied.jobs, copied.files, copied.damaged.len()), (1, 0, 0));
    let url = format!("sqlite://{}", target.display());
    let objects = Objects::open(&format!("file://{}", folder.join("objects").display()));
    let copy = Store::open(&url).await.expect("a store");
    let copy = copy
        .with_objects(Some(objects.expect("opened")))
        .await
        .expect("a store");
    assert_eq!(copy.job(id).await.expect("the store"), before);
    assert_eq!(copy.events(id, 0).await.expect("the store").len(), 5);
    let found = copy.result_file(id, "a.vtu").await.expect("the store");
    let (_, content) = found.expect("a file");
    assert_eq!(content.read().await.expect("read"), b"fields");
    // The original's objects stay.
    copy.delete(id).await.expect("the store");
    copy.move_results().await.1.expect("nothing to do");
    assert_eq!(database.objects().len(), 1);
}

async fn results_that_are_moved_leave_what_was_sent(database: WithObjects) {
    let id = database.ended(Transition::Succeed).await;
    database.moved().await;
    let sent = database.store.sent_spec(id).await.expect("the store");
    assert_eq!(sent.as_deref(), Some(SENT));
}
