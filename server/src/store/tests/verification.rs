//! Verification of what a database names, in it, in its folder and in a store of objects.

use std::path::Path;

use sqlx::{Connection, PgConnection};

use super::checkpoint_objects::{copied, large};
use super::objects::{WithObjects, files_below, opened};
use super::*;
use crate::objects::Objects;

on_both_engines! { WithObjects:
    a_missing_or_damaged_object_is_found,
    a_missing_or_damaged_checkpoint_is_found,
    a_missing_or_damaged_file_of_a_failed_job_is_found,
    a_short_object_is_damaged,
    what_cannot_be_read_is_not_called_damaged,
    another_store_of_objects_is_refused,
    files_of_a_folder_that_is_not_mounted_are_not_called_damaged,
    all_jobs_are_verified,
}

impl WithObjects {
    async fn verified(&self, objects: Option<&Objects>) -> Result<CopySummary, BackupError> {
        verify(&self.place.url, &self.place.files(), objects).await
    }

    /// Verifies the database with its store of objects.
    async fn found(&self) -> CopySummary {
        let verified = self.verified(Some(&self.objects_at("objects"))).await;
        verified.expect("verified")
    }

    /// Damaged results, after a check that all could be read.
    async fn damaged(&self) -> Vec<String> {
        let found = self.found().await;
        assert_eq!(found.unread, Vec::<String>::new());
        found.damaged
    }

    fn objects_at(&self, folder: &str) -> Objects {
        let folder = self.place.folder.path().join(folder);
        Objects::open(&format!("file://{}", folder.display())).expect("opened")
    }

    /// Returns `true` if the first file of a job is marked as damaged.
    async fn is_marked(&self, id: Uuid) -> bool {
        let manifest = self.store.manifest(id).await.expect("the store");
        manifest[0].damaged.is_some()
    }
}

/// Changes the last byte of a file.
fn damage(path: &Path) {
    let mut bytes = std::fs::read(path).expect("read");
    *bytes.last_mut().expect("a byte") ^= 1;
    std::fs::write(path, &bytes).expect("written");
}

/// Leaves some bytes of a file.
fn cut(path: &Path, length: u64) {
    let file = std::fs::OpenOptions::new().write(true).open(path);
    file.expect("opened").set_len(length).expect("cut");
}

/// Checks that one thing is said, and of what.
fn assert_one(said: &[String], begins: &str, contains: &str) {
    let [one] = said else {
        panic!("{said:?}");
    };
    assert!(one.starts_with(begins) && one.contains(contains), "{one}");
}

async fn a_missing_or_damaged_object_is_found(database: WithObjects) {
    let id = database.ended(Transition::Succeed).await;
    database.moved().await;
    assert_eq!(database.damaged().await, Vec::<String>::new());
    let without = database.verified(None).await;
    assert!(without.is_err(), "they are not there: {without:?}");
    let object = &database.objects()[0];
    damage(object);
    assert_one(&database.damaged().await, "a.vtu of job", "SHA-256");
    assert!(database.is_marked(id).await);
    damage(object);
    assert_eq!(database.damaged().await, Vec::<String>::new());
    assert!(!database.is_marked(id).await);
    std::fs::remove_file(object).expect("removed");
    assert_one(
        &database.damaged().await,
        "results of job",
        "does not exist",
    );
    let unread = database.read(id, "b.csv").await;
    assert!(matches!(unread, Err(StoreError::Objects(_))), "{unread:?}");
}

async fn a_missing_or_damaged_checkpoint_is_found(database: WithObjects) {
    let claim = database.resumed(large(7)).await;
    assert_eq!(database.damaged().await, Vec::<String>::new());
    let without = database.verified(None).await;
    assert!(without.is_err(), "it is not there: {without:?}");
    let object = database.objects().pop().expect("an object");
    std::fs::write(&object, "damaged").expect("written");
    let said = format!("checkpoint of job {}: ", claim.id);
    assert_one(&database.damaged().await, &said, "it has the SHA-256");
    std::fs::remove_file(&object).expect("removed");
    assert_one(&database.damaged().await, &said, "does not exist");
}

async fn a_missing_or_damaged_file_of_a_failed_job_is_found(database: WithObjects) {
    let id = database.ended(Transition::Fail).await;
    assert_eq!(database.damaged().await, Vec::<String>::new());
    let file = database.files().pop().expect("a file");
    damage(&file);
    assert_one(&database.damaged().await, "a.vtu of job", "SHA-256");
    assert!(database.is_marked(id).await);
    damage(&file);
    assert_eq!(database.damaged().await, Vec::<String>::new());
    assert!(!database.is_marked(id).await);
    cut(&file, 2);
    assert_one(&database.damaged().await, "a.vtu of job", "2 bytes");
    cut(&file, 0);
    assert_one(&database.damaged().await, "a.vtu of job", "0 bytes");
    std::fs::remove_file(&file).expect("removed");
    assert_one(&database.damaged().await, "a.vtu of job", "does not exist");
    assert!(database.is_marked(id).await);
}

async fn a_short_object_is_damaged(database: WithObjects) {
    let id = database.ended(Transition::Succeed).await;
    let whole = database.ended(Transition::Succeed).await;
    database.moved().await;
    let of_job = format!("jobs/{id}");
    let objects = database.objects();
    let is_of_job = |object: &&PathBuf| object.display().to_string().contains(&of_job);
    let object = objects.iter().find(is_of_job).expect("an object");
    let length = std::fs::metadata(object).expect("a file").len();
    // The last file of the object is its shortest part, and the content of the block its first.
    let file = b"fields".len() as u64;
    for (left, of) in [
        (length - 1, "a.vtu of job"),
        (length - file, "a.vtu of job"),
        (0, "results of job"),
    ] {
        cut(object, left);
        assert_one(&database.damaged().await, of, "bytes");
    }
    assert_eq!(database.read(whole, "b.csv").await.expect("read"), b"cycle");
}

async fn what_cannot_be_read_is_not_called_damaged(database: WithObjects) {
    let id = database.ended(Transition::Succeed).await;
    for _ in 0..102 {
        database.ended(Transition::Succeed).await;
    }
    database.moved().await;
    let objects = database.objects_at("objects");
    let folder = database.place.folder.path().join("objects");
    let away = folder.with_file_name("away");
    std::fs::rename(&folder, &away).expect("moved");
    std::fs::write(&folder, "").expect("a file in its place");
    let found = database.verified(Some(&objects)).await.expect("verified");
    // Of so many in succession, the last ones are not tried.
    assert_eq!((found.jobs, found.unread.len()), (101, 101));
    assert!(found.has_ended_early && found.damaged.is_empty());
    assert_one(&found.unread[..1], "results of job", "objects");
    std::fs::remove_file(&folder).expect("removed");
    std::fs::rename(&away, &folder).expect("moved back");
    assert!(!database.is_marked(id).await);
    assert_eq!(database.damaged().await, Vec::<String>::new());
}

async fn files_of_a_folder_that_is_not_mounted_are_not_called_damaged(database: WithObjects) {
    let mut ids = Vec::new();
    for _ in 0..102 {
        ids.push(database.ended(Transition::Fail).await);
    }
    let of_service = if database.store.is_shared() {
        "objects"
    } else {
        "test.db.results"
    };
    let folder = database.place.folder.path().join(of_service);
    let objects = database.objects_at("objects");
    let away = folder.with_file_name("away");
    std::fs::rename(&folder, &away).expect("moved");
    let found = database.verified(Some(&objects)).await.expect("verified");
    let missing = found.unread.len() + found.elsewhere.len();
    assert!(missing > 100 && found.damaged.is_empty(), "{found:?}");
    std::fs::rename(&away, &folder).expect("moved back");
    for id in ids {
        assert!(!database.is_marked(id).await);
    }
}

async fn another_store_of_objects_is_refused(database: WithObjects) {
    let id = database.ended(Transition::Fail).await;
    let other = database.objects_at("other");
    other.mark().await.expect("marked");
    let refused = database.verified(Some(&other)).await;
    assert!(
        matches!(
            refused,
            Err(BackupError::Store(StoreError::OtherObjects { .. }))
        ),
        "{refused:?}"
    );
    assert!(!database.is_marked(id).await);
}

async fn all_jobs_are_verified(database: WithObjects) {
    for number in 0..40 {
        let transition = if number % 2 == 0 {
            Transition::Succeed
        } else {
            Transition::Fail
        };
        database.ended(transition).await;
    }
    database.moved().await;
    let objects = database.objects();
    assert_eq!(objects.len(), 20);
    let all = database.found().await;
    // A file, a document, history and snapshots; the events where the results were moved.
    assert_eq!((all.jobs, all.files), (40, 180), "{all:?}");
    for object in &objects {
        damage(object);
    }
    assert_eq!(database.damaged().await.len(), 20);
}

#[tokio::test]
#[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
async fn files_in_the_folder_of_another_machine_are_not_called_damaged() {
    let place = Place::postgres();
    let store = Arc::new(opened(&place, None).await.expect("a store"));
    let database = WithObjects { place, store };
    let id = database.ended(Transition::Fail).await;
    let verified = database.verified(None).await.expect("verified");
    assert_eq!((verified.files, verified.damaged.len()), (4, 0));
    // A folder of the same name that has files of other jobs.
    let elsewhere = tempfile::tempdir().expect("a folder");
    std::fs::create_dir(elsewhere.path().join("test.db.results")).expect("made");
    let files = elsewhere.path().join("test.db");
    let verified = verify(&database.place.url, &files, None).await;
    let verified = verified.expect("verified");
    assert_one(&verified.elsewhere, "a.vtu of job", "is not here");
    assert_eq!((verified.files, verified.damaged.len()), (3, 0));
    assert!(!database.is_marked(id).await);
    let file = database.place.folder.path().join("test.db.results");
    damage(&files_below(&file)[0]);
    let verified = database.verified(None).await.expect("verified");
    assert_one(&verified.damaged, "a.vtu of job", "SHA-256");
    assert!(database.is_marked(id).await);
}

/// Files of its unfinished jobs are those of its original, which may have removed them.
#[tokio::test]
#[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
async fn objects_that_the_original_of_a_copy_has_removed_are_not_called_damaged() {
    let database = WithObjects::at(Place::postgres()).await;
    database.ended(Transition::Fail).await;
    database.resumed(large(7)).await;
    database.store.close().await;
    let WithObjects { place, store } = database;
    drop(store);
    let place = copied(place).await;
    // No service of the copy has started so far.
    let url = place.url.clone();
    let objects = place.folder.path().join("objects");
    let removed: Vec<_> = ["files", "checkpoints"]
        .map(|of| files_below(&objects.join(of)))
        .concat();
    assert_eq!(removed.len(), 2);
    for object in removed {
        std::fs::remove_file(object).expect("removed");
    }
    let objects = Objects::open(&format!("file://{}", objects.display()));
    let verified = verify(&url, &place.files(), objects.as_ref().ok()).await;
    let verified = verified.expect("verified");
    assert_one(&verified.elsewhere, "a.vtu of job", "original");
    assert_eq!((verified.damaged, verified.unread), (vec![], vec![]));
}

#[tokio::test]
#[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
async fn a_database_of_another_version_is_not_verified() {
    let place = Place::postgres();
    let verified = async || verify(&place.url, &place.files(), None).await;
    let new = verified().await;
    assert!(matches!(new, Err(BackupError::NoDatabase(_))), "{new:?}");
    let store = opened(&place, None).await.expect("a store");
    store.close().await;
    assert_eq!(verified().await.expect("verified").jobs, 0);
    let mut connection = PgConnection::connect(&place.url).await.expect("a server");
    sqlx::query("UPDATE _sqlx_migrations SET version = 9999 WHERE version = (SELECT max(version) FROM _sqlx_migrations)")
        .execute(&mut connection)
        .await
        .expect("written");
    let newer = verified().await;
    assert!(
        matches!(
            newer,
            Err(BackupError::Store(StoreError::Newer { found: 9999, .. }))
        ),
        "{newer:?}"
    );
    sqlx::query("DELETE FROM _sqlx_migrations WHERE version = 9999")
        .execute(&mut connection)
        .await
        .expect("written");
    let older = verified().await;
    assert!(matches!(older, Err(BackupError::Older { .. })), "{older:?}");
}
