//! Files of attempts in a store of objects: of services that share no folder.

use sqlx::{Connection, PgConnection};

use super::objects::{WithObjects, opened};
use super::*;
use crate::export::documents::VTU;
use crate::export::files;
use crate::objects::{ObjectFile, ObjectsError, Source};

/// Lets a case run on PostgreSQL.
macro_rules! of_several_services {
    ($($name:ident,)+) => {
        mod postgres {
            $(
                #[tokio::test(flavor = "multi_thread", worker_threads = 4)]
                #[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
                async fn $name() {
                    let place = crate::store::tests::Place::postgres();
                    super::$name(super::WithObjects::at(place).await).await;
                }
            )+
        }
    };
}
of_several_services! {
    a_file_is_read_where_there_is_none_in_the_folder,
    a_file_that_no_update_has_named_in_time_is_sent_again,
    an_object_of_another_job_or_attempt_is_no_file,
    a_file_is_in_the_database_while_the_store_of_objects_fails,
    a_damaged_file_is_none_of_the_store_of_objects,
    a_file_is_removed_with_its_job_or_by_the_next_one_of_its_name,
    files_of_attempts_that_do_not_run_are_removed_at_the_start,
}

const LENGTH: Duration = Duration::from_hours(1);
/// Time after which an object without a name is removed, ms.
const LATER_MS: i64 = 25 * 3_600_000;

impl WithObjects {
    /// An update with a file that the attempt has written.
    fn with_file(&self, claim: &Claim, number: i64, content: &[u8]) -> JobUpdate {
        let folder = self.store.attempt_folder(claim);
        files::write_atomically(&folder, "a.vtu", content).expect("written");
        JobUpdate {
            number,
            files: vec![NewFile {
                file: files::manifest_entry("a.vtu", Some(1), VTU, content),
                content: NewContent::Folder,
            }],
            ..update(1)
        }
    }

    /// Writes a file as it comes from a remote worker; its key.
    async fn sent(&self, claim: &Claim, content: &[u8]) -> String {
        let path = self.place.folder.path().join("received");
        std::fs::write(&path, content).expect("written");
        let file = ObjectFile {
            source: Source::File(path),
            bytes: content.len() as u64,
            sha256: files::sha256(content),
        };
        let key = self.store.put_file(claim.into(), &file).await;
        key.expect("the store")
    }

    /// Lets time pass for the objects that no job names.
    async fn later(&self) {
        let mut database = PgConnection::connect(&self.place.url)
            .await
            .expect("a server");
        sqlx::query("UPDATE unnamed_objects SET noted_at = noted_at - $1")
            .bind(LATER_MS)
            .execute(&mut database)
            .await
            .expect("updated");
    }
}

/// An update that says of a file that it is in an object.
fn in_object(update: &JobUpdate, key: &str) -> JobUpdate {
    let mut update = update.clone();
    update.files[0].content = NewContent::Object(key.to_owned());
    update
}

async fn a_file_is_read_where_there_is_none_in_the_folder(database: WithObjects) {
    let id = database.ended(Transition::Succeed).await;
    let results = database.place.folder.path().join("test.db.results");
    std::fs::remove_dir_all(&results).expect("removed");
    assert_eq!(database.read(id, "a.vtu").await.expect("read"), b"fields");
    assert_eq!(database.files().len(), 1);
    assert_eq!(database.moved().await, [id]);
    assert_eq!(database.read(id, "a.vtu").await.expect("read"), b"fields");
    // Requests that are about to read it have had its key.
    database.moved().await;
    assert_eq!((database.files().len(), database.objects().len()), (1, 1));
    database.later().await;
    database.moved().await;
    assert_eq!((database.files().len(), database.objects().len()), (0, 1));
}

async fn a_file_that_no_update_has_named_in_time_is_sent_again(database: WithObjects) {
    let (store, claim) = (&database.store, database.running().await);
    let update = database.with_file(&claim, 1, b"fields");
    let key = database.sent(&claim, b"fields").await;
    database.moved().await;
    assert_eq!(database.files().len(), 1, "it may still be named");
    database.later().await;
    database.moved().await;
    assert_eq!(database.files().len(), 0);
    let refused = store
        .record(&claim, &in_object(&update, &key), LENGTH)
        .await;
    assert!(
        matches!(refused, Err(StoreError::LostFile(_))),
        "{refused:?}"
    );
    assert_eq!(store.manifest(claim.id).await.expect("the store"), []);
    let key = database.sent(&claim, b"fields").await;
    for _ in 0..2 {
        let recorded = store
            .record(&claim, &in_object(&update, &key), LENGTH)
            .await;
        assert!(
            matches!(recorded, Ok(LeaseState::Held { .. })),
            "{recorded:?}"
        );
    }
    database.later().await;
    database.moved().await;
    let read = database.read(claim.id, "a.vtu").await;
    assert_eq!(read.expect("read"), b"fields");
}

async fn an_object_of_another_job_or_attempt_is_no_file(database: WithObjects) {
    let (store, other) = (&database.store, database.running().await);
    let foreign = database.sent(&other, b"of another job").await;
    let claim = database.running().await;
    let update = database.with_file(&claim, 1, b"fields");
    for key in [&foreign[..], "jobs/1/a", "files/", ""] {
        let refused = store.record(&claim, &in_object(&update, key), LENGTH).await;
        assert!(
            matches!(refused, Err(StoreError::LostFile(_))),
            "{key}: {refused:?}"
        );
    }
    // Files that a lost attempt has sent have no effect.
    let key = database.sent(&claim, b"fields").await;
    let fresh = database.released(&claim).await;
    let late = store
        .record(&claim, &in_object(&update, &key), LENGTH)
        .await;
    assert!(matches!(late, Ok(LeaseState::Lost)), "{late:?}");
    let repeated = store.record(&claim, &update, LENGTH).await;
    assert!(matches!(repeated, Ok(LeaseState::Lost)), "{repeated:?}");
    assert_eq!(store.manifest(fresh.id).await.expect("the store"), []);
}

async fn a_file_is_in_the_database_while_the_store_of_objects_fails(database: WithObjects) {
    // The store of objects is known by its mark.
    let other = database.running().await;
    database.sent(&other, b"of another job").await;
    let objects = database.place.folder.path().join("objects");
    let away = database.place.folder.path().join("away");
    std::fs::rename(&objects, &away).expect("renamed");
    std::fs::create_dir(&objects).expect("a folder that is not mounted");
    let id = database.ended(Transition::Succeed).await;
    assert_eq!(database.read(id, "a.vtu").await.expect("read"), b"fields");
    let key = database.sent(&other, b"fields").await;
    let update = in_object(&database.with_file(&other, 1, b"fields"), &key);
    for _ in 0..2 {
        let recorded = database.store.record(&other, &update, LENGTH).await;
        let is_held = matches!(recorded, Ok(LeaseState::Held { .. }));
        assert!(is_held, "{recorded:?}");
    }
    let read = database.read(other.id, "a.vtu").await;
    assert_eq!(read.expect("read"), b"fields");
    std::fs::remove_dir(&objects).expect("nothing is in it");
    std::fs::rename(&away, &objects).expect("renamed");
    assert_eq!(database.moved().await, [id]);
    assert_eq!(database.read(id, "a.vtu").await.expect("read"), b"fields");
    let manifest = database.store.manifest(id).await.expect("the store");
    assert_eq!(manifest.len(), 2, "{manifest:?}");
    // Objects that should have got them are none.
    database.later().await;
    database.moved().await;
    let mut server = PgConnection::connect(&database.place.url)
        .await
        .expect("a server");
    let noted: i64 = sqlx::query_scalar("SELECT count(*) FROM unnamed_objects")
        .fetch_one(&mut server)
        .await
        .expect("read");
    assert_eq!((noted, database.objects().len()), (0, 1));
    let read = database.read(other.id, "a.vtu").await;
    assert_eq!(read.expect("read"), b"fields");
}

async fn a_damaged_file_is_none_of_the_store_of_objects(database: WithObjects) {
    let claim = database.running().await;
    let update = database.with_file(&claim, 1, b"fields");
    let file = database.store.attempt_folder(&claim).join("a.vtu");
    for damage in [Some("field"), None] {
        match damage {
            Some(content) => std::fs::write(&file, content).expect("written"),
            None => std::fs::remove_file(&file).expect("removed"),
        }
        let failed = database.store.record(&claim, &update, LENGTH).await;
        let is_damaged = matches!(
            failed,
            Err(StoreError::Objects(ObjectsError::Damaged { .. }))
        );
        assert!(is_damaged, "{failed:?}");
    }
}

async fn a_file_is_removed_with_its_job_or_by_the_next_one_of_its_name(database: WithObjects) {
    let (store, claim) = (&database.store, database.running().await);
    for (number, content) in [(1, b"fields"), (2, b"others")] {
        let update = database.with_file(&claim, number, content);
        store
            .record(&claim, &update, LENGTH)
            .await
            .expect("written");
    }
    assert_eq!(database.files().len(), 2);
    database.later().await;
    database.moved().await;
    assert_eq!(database.files().len(), 1);
    let read = database.read(claim.id, "a.vtu").await;
    assert_eq!(read.expect("read"), b"others");
    let last = JobUpdate {
        number: 3,
        ..JobUpdate::default()
    };
    let ended = store.end(&claim, &last, &end(Transition::Fail)).await;
    assert_eq!(ended.expect("the store"), Some(Status::Failed));
    assert_eq!(
        store.delete(claim.id).await.expect("the store"),
        Deleted::Done
    );
    database.later().await;
    database.moved().await;
    assert_eq!(database.files().len(), 0);
}

/// A killed service has left them.
async fn files_of_attempts_that_do_not_run_are_removed_at_the_start(database: WithObjects) {
    let (store, running) = (&database.store, database.running().await);
    let ended = database.running().await;
    for claim in [&running, &ended] {
        let update = database.with_file(claim, 1, b"fields");
        store.record(claim, &update, LENGTH).await.expect("written");
    }
    let last = JobUpdate {
        number: 2,
        ..JobUpdate::default()
    };
    let status = store.end(&ended, &last, &end(Transition::Fail)).await;
    assert_eq!(status.expect("the store"), Some(Status::Failed));
    let next = store.attempt_folder(Lease {
        number: ended.lease + 1,
        ..Lease::from(&ended)
    });
    std::fs::create_dir_all(&next).expect("a folder");
    std::fs::write(next.join("a.vtu"), "of the next attempt").expect("written");
    store.remove_unnamed_files(None).await.expect("the store");
    assert!(store.attempt_folder(&running).join("a.vtu").exists());
    assert!(!store.attempt_folder(&ended).exists());
    assert!(next.join("a.vtu").exists());
    assert_eq!(
        database.read(ended.id, "a.vtu").await.expect("read"),
        b"fields"
    );
}

#[tokio::test]
#[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
async fn files_on_another_machine_keep_no_other_results_from_being_moved() {
    let place = Place::postgres();
    let store = opened(&place, None).await.expect("a store");
    let store = Arc::new(store);
    let before = WithObjects { place, store };
    for _ in 0..3 {
        before.ended(Transition::Succeed).await;
    }
    before.store.close().await;
    let WithObjects { place, .. } = before;
    let results = place.folder.path().join("test.db.results");
    std::fs::remove_dir_all(&results).expect("removed");
    let database = WithObjects::at(place).await;
    let id = database.ended(Transition::Succeed).await;
    let objects = database.store.process().objects.as_ref().expect("given");
    let mut written = Vec::new();
    // Two jobs a round, of which three cannot be moved here.
    for _ in 0..2 {
        let round = database.store.write_objects(objects, 2).await;
        for moved in round.expect("the store of objects answers") {
            written.extend(moved.expect("written").map(|moved| moved.id));
        }
    }
    assert_eq!(written, [id]);
}
