//! Verification of what a database names, in it, in its folder and in a store of objects.

use std::path::Path;

use sqlx::{Connection, PgConnection};

use super::checkpoint_objects::large;
use super::objects::WithObjects;
use super::*;
use crate::objects::Objects;

on_both_engines! { WithObjects:
    a_missing_or_damaged_object_is_found,
    a_missing_or_damaged_checkpoint_is_found,
    a_missing_or_damaged_file_of_a_failed_job_is_found,
    all_jobs_are_verified,
}

impl WithObjects {
    async fn verified(&self, objects: Option<&Objects>) -> Result<CopySummary, BackupError> {
        verify(&self.place.url, &self.place.files(), objects).await
    }

    /// What is damaged.
    async fn damaged(&self) -> Vec<String> {
        let address = self.place.folder.path().join("objects");
        let objects = Objects::open(&format!("file://{}", address.display()));
        let objects = objects.expect("opened");
        let verified = self.verified(Some(&objects)).await;
        verified.expect("verified").damaged
    }
}

/// Changes the last byte of a file.
fn damage(path: &Path) {
    let mut bytes = std::fs::read(path).expect("read");
    *bytes.last_mut().expect("a byte") ^= 1;
    std::fs::write(path, &bytes).expect("written");
}

/// Checks that one thing is damaged, and how.
fn assert_one(damaged: &[String], begins: &str, contains: &str) {
    let [one] = damaged else {
        panic!("{damaged:?}");
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
    let manifest = database.store.manifest(id).await.expect("the store");
    assert!(manifest[0].damaged.is_some(), "{manifest:?}");
    damage(object);
    assert_eq!(database.damaged().await, Vec::<String>::new());
    let manifest = database.store.manifest(id).await.expect("the store");
    assert!(manifest[0].damaged.is_none(), "{manifest:?}");
    let length = std::fs::metadata(object).expect("a file").len();
    let file = std::fs::OpenOptions::new().write(true).open(object);
    file.expect("opened").set_len(length - 1).expect("cut");
    assert_one(&database.damaged().await, "a.vtu of job", "bytes");
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
    let manifest = database.store.manifest(id).await.expect("the store");
    assert!(manifest[0].damaged.is_some(), "{manifest:?}");
    std::fs::remove_file(&file).expect("removed");
    assert_one(&database.damaged().await, "a.vtu of job", "does not exist");
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
    let address = database.place.folder.path().join("objects");
    let opened = Objects::open(&format!("file://{}", address.display())).expect("opened");
    let all = database.verified(Some(&opened)).await.expect("verified");
    // Of a job whose results were moved, its events are verified, too.
    assert_eq!((all.jobs, all.files), (40, 100), "{all:?}");
    for object in &objects {
        damage(object);
    }
    assert_eq!(database.damaged().await.len(), 20);
}

#[tokio::test]
#[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
async fn files_in_the_folder_of_another_machine_are_not_called_damaged() {
    let place = Place::postgres();
    let store = super::objects::opened(&place, None).await.expect("a store");
    let store = Arc::new(store);
    let database = WithObjects { place, store };
    database.ended(Transition::Fail).await;
    let verified = database.verified(None).await.expect("verified");
    assert_eq!((verified.files, verified.damaged.len()), (2, 0));
    let elsewhere = verify(&database.place.url, Path::new("elsewhere"), None).await;
    assert!(
        matches!(
            elsewhere,
            Err(BackupError::Store(StoreError::NoFolder { .. }))
        ),
        "{elsewhere:?}"
    );
}

#[tokio::test]
#[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
async fn a_database_of_another_version_is_not_verified() {
    let place = Place::postgres();
    let verified = async || verify(&place.url, &place.files(), None).await;
    let new = verified().await;
    assert!(matches!(new, Err(BackupError::NoDatabase(_))), "{new:?}");
    let store = super::objects::opened(&place, None).await.expect("a store");
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
