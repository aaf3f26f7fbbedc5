//! Checkpoints in a store of objects.

use sqlx::{Connection, PgConnection};

use super::objects::{WithObjects, opened};
use super::*;
use crate::objects::Objects;
use crate::store::checkpoint_object::CheckpointObject;

on_both_engines! { WithObjects:
    a_large_checkpoint_is_an_object_which_the_next_attempt_asks_for,
    the_object_of_a_checkpoint_is_removed_once_nothing_names_it,
    a_checkpoint_is_in_the_database_while_the_store_of_objects_fails,
    a_damaged_or_missing_checkpoint_is_none,
    an_object_that_is_being_written_is_not_removed,
    a_checkpoint_whose_object_may_be_removed_is_in_the_database,
    nothing_is_written_to_a_store_of_objects_that_has_lost_its_mark,
    a_database_with_a_checkpoint_elsewhere_is_not_opened_without_it,
    an_address_where_nothing_was_written_is_replaced,
}

/// A checkpoint large enough for an object.
pub(super) fn large(cycle: u64) -> EncodedCheckpoint {
    EncodedCheckpoint {
        cycle,
        state: (0..100_000_u64).map(|n| (n % 251) as u8).collect(),
    }
}

fn update_with(checkpoint: EncodedCheckpoint) -> JobUpdate {
    JobUpdate {
        checkpoint: Some(checkpoint),
        ..update(1)
    }
}

impl WithObjects {
    /// A claimed job.
    pub(super) async fn running(&self) -> Claim {
        self.queued().await;
        self.store.claim_next(i64::MAX).await.expect("a job")
    }

    async fn queued(&self) -> Uuid {
        let spec = spec::read(br#"{"system":{"kind":"dimm"}}"#).expect("accepted");
        let plan = crate::estimate::Estimate::of(&spec).plan(&spec, None);
        let job = NewJob {
            sent: "{}".to_owned(),
            spec: spec.spec,
            plan,
            options: SubmitOptions::default(),
        };
        self.store.queue(&job).await
    }

    /// A job whose worker has written a checkpoint and released it, under its next lease.
    pub(super) async fn resumed(&self, checkpoint: EncodedCheckpoint) -> Claim {
        let claim = self.running().await;
        let update = update_with(checkpoint);
        self.store.record_next(&claim, &update).await;
        self.released(&claim).await
    }

    /// A job that was released, under its next lease.
    pub(super) async fn released(&self, claim: &Claim) -> Claim {
        let release = end(Transition::Release);
        let last = JobUpdate::default();
        let status = self.store.end_next(claim, &last, &release).await;
        assert_eq!(status, Some(Status::Queued));
        self.store.claim_next(i64::MAX).await.expect("a job")
    }

    fn folder(&self) -> std::path::PathBuf {
        self.place.folder.path().join("objects")
    }
}

async fn a_large_checkpoint_is_an_object_which_the_next_attempt_asks_for(database: WithObjects) {
    let store = &database.store;
    let claim = database.resumed(large(7)).await;
    let stored = ClaimedCheckpoint::Stored { cycle: 7 };
    assert_eq!(claim.checkpoint, Some(stored));
    assert_eq!(database.objects().len(), 1);
    let found = store.checkpoint(&claim).await.expect("the store");
    assert_eq!(found, Some(large(7)));
    let lost = Lease {
        number: claim.lease - 1,
        ..Lease::from(&claim)
    };
    assert_eq!(store.checkpoint(lost).await.expect("the store"), None);
    // The next one is in its place, and small.
    let small = EncodedCheckpoint {
        cycle: 9,
        state: vec![1, 2, 3],
    };
    store.record_next(&claim, &update_with(small.clone())).await;
    assert_eq!(store.checkpoint(&claim).await.expect("the store"), None);
    let claim = database.released(&claim).await;
    assert_eq!(claim.checkpoint, Some(ClaimedCheckpoint::Given(small)));
}

async fn the_object_of_a_checkpoint_is_removed_once_nothing_names_it(database: WithObjects) {
    let store = &database.store;
    let claim = database.running().await;
    for cycle in 1..=3 {
        let update = update_with(large(cycle));
        store.record_next(&claim, &update).await;
    }
    database.moved().await;
    assert_eq!(database.objects().len(), 1);
    // An update that is repeated has no effect, and neither has one of a lost lease.
    let repeated = JobUpdate {
        number: 1,
        ..update_with(large(4))
    };
    let length = Duration::from_hours(1);
    let again = store.record(&claim, &repeated, length).await;
    assert!(matches!(again, Ok(LeaseState::Held { .. })), "{again:?}");
    let found = store.checkpoint(&claim).await.expect("the store");
    assert_eq!(found, Some(large(3)));
    let ended = store
        .end_next(&claim, &update(5), &end(Transition::Fail))
        .await;
    assert_eq!(ended, Some(Status::Failed));
    let deleted = store.delete(claim.id).await.expect("the store");
    assert_eq!(deleted, Deleted::Done);
    database.moved().await;
    // The object of the repeated update may still be written.
    assert_eq!(database.objects().len(), 1);
}

async fn a_checkpoint_is_in_the_database_while_the_store_of_objects_fails(database: WithObjects) {
    std::fs::remove_dir(database.folder()).expect("removed");
    std::fs::write(database.folder(), "").expect("a file in its place");
    let claim = database.resumed(large(7)).await;
    assert_eq!(claim.checkpoint, Some(ClaimedCheckpoint::Given(large(7))));
}

async fn a_damaged_or_missing_checkpoint_is_none(database: WithObjects) {
    let store = &database.store;
    let claim = database.resumed(large(7)).await;
    let object = database.objects().pop().expect("an object");
    std::fs::write(&object, "damaged").expect("written");
    assert_eq!(store.checkpoint(&claim).await.expect("the store"), None);
    std::fs::remove_file(&object).expect("removed");
    assert_eq!(store.checkpoint(&claim).await.expect("the store"), None);
    // One that cannot be read, as in a folder that is not mounted, may be readable later.
    std::fs::remove_dir_all(database.folder()).expect("removed");
    std::fs::create_dir(database.folder()).expect("a folder");
    let unread = store.checkpoint(&claim).await;
    assert!(matches!(unread, Err(StoreError::Objects(_))), "{unread:?}");
    std::fs::remove_dir_all(database.folder()).expect("removed");
    std::fs::write(database.folder(), "").expect("a file in its place");
    let unread = store.checkpoint(&claim).await;
    assert!(matches!(unread, Err(StoreError::Objects(_))), "{unread:?}");
}

async fn an_object_that_is_being_written_is_not_removed(database: WithObjects) {
    let key = "checkpoints/new";
    database.store.note_object(key).await.expect("noted");
    let address = format!("file://{}", database.folder().display());
    let objects = Objects::open(&address).expect("opened");
    objects.mark().await.expect("marked");
    let state = b"a state".to_vec();
    objects.put_whole(key, state).await.expect("written");
    database.moved().await;
    assert_eq!(database.objects().len(), 1);
}

async fn a_checkpoint_whose_object_may_be_removed_is_in_the_database(database: WithObjects) {
    let claim = database.running().await;
    let late = JobUpdate {
        checkpoint_object: Some("checkpoints/removed".to_owned()),
        ..update_with(large(7))
    };
    let late = numbered(&claim, late);
    let length = Duration::from_hours(1);
    let written = database.store.write_update((&claim).into(), &late, length);
    written.await.expect("the store");
    let found = database.store.checkpoint_object((&claim).into()).await;
    assert_eq!(found.expect("the store"), None::<CheckpointObject>);
    let claim = database.released(&claim).await;
    assert_eq!(claim.checkpoint, Some(ClaimedCheckpoint::Given(large(7))));
}

async fn nothing_is_written_to_a_store_of_objects_that_has_lost_its_mark(database: WithObjects) {
    let claim = database.resumed(large(7)).await;
    database.store.close().await;
    let WithObjects { place, store } = database;
    drop(store);
    let folder = place.folder.path().join("objects");
    std::fs::rename(&folder, place.folder.path().join("unmounted")).expect("renamed");
    let store = Arc::new(opened(&place, Some("objects")).await.expect("a store"));
    let database = WithObjects { place, store };
    let update = numbered(&claim, update_with(large(9)));
    let length = Duration::from_hours(1);
    let written = database.store.record(&claim, &update, length).await;
    assert!(
        matches!(written, Ok(LeaseState::Held { .. })),
        "{written:?}"
    );
    assert_eq!(database.objects().len(), 0);
    // The object of the earlier one is not removed, and nothing is forgotten.
    let (_, ended) = database.store.move_results().await;
    assert!(matches!(ended, Err(StoreError::Objects(_))), "{ended:?}");
    std::fs::remove_dir(&folder).expect("nothing is in it");
    std::fs::rename(database.place.folder.path().join("unmounted"), &folder).expect("renamed");
    assert_eq!(database.objects().len(), 1);
    database.moved().await;
    assert_eq!(database.objects().len(), 0);
    let claim = database.released(&claim).await;
    assert_eq!(claim.checkpoint, Some(ClaimedCheckpoint::Given(large(9))));
}

async fn a_database_with_a_checkpoint_elsewhere_is_not_opened_without_it(database: WithObjects) {
    database.resumed(large(7)).await;
    database.store.close().await;
    let WithObjects { place, store } = database;
    drop(store);
    let without = opened(&place, None).await;
    assert!(matches!(without, Err(StoreError::NoObjects)), "{without:?}");
    opened(&place, Some("objects")).await.expect("a store");
}

/// Original names the same objects.
#[tokio::test]
#[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
async fn a_copy_of_a_database_of_a_server_removes_no_objects_and_writes_no_checkpoints() {
    let database = WithObjects::at(Place::postgres()).await;
    let claim = database.resumed(large(7)).await;
    database.store.close().await;
    let WithObjects { place, store } = database;
    drop(store);
    let url = place.url.clone();
    let copy = copied(place).await;
    // The original is opened again, and is none.
    let original = Store::open_with(&url, &copy.files(), Limits::default()).await;
    let address = format!("file://{}", copy.folder.path().join("objects").display());
    let objects = || Some(Objects::open(&address).expect("opened"));
    let original = original.expect("a store").with_objects(objects()).await;
    let original = original.expect("a store");
    assert!(original.removes_objects().await.expect("the store"));
    let copy = WithObjects {
        store: Arc::new(opened(&copy, Some("objects")).await.expect("a store")),
        place: copy,
    };
    assert!(!copy.store.removes_objects().await.expect("the store"));
    copy.store.record_next(&claim, &update_with(large(9))).await;
    copy.moved().await;
    let found = original.checkpoint(&claim).await.expect("the store");
    assert_eq!(found, Some(large(7)));
    let claim = copy.released(&claim).await;
    assert_eq!(claim.checkpoint, Some(ClaimedCheckpoint::Given(large(9))));
}

/// A copy of a database of a server that nobody is connected to, with its folder.
pub(super) async fn copied(Place { url, folder }: Place) -> Place {
    let (address, options) = url.split_once('?').expect("the folder of its socket");
    let (server, name) = address.rsplit_once('/').expect("a name");
    let maintenance = format!("{server}/postgres?{options}");
    let mut connection = PgConnection::connect(&maintenance).await.expect("a server");
    let statement = format!("CREATE DATABASE {name}_copy TEMPLATE {name}");
    sqlx::query(sqlx::AssertSqlSafe(statement))
        .execute(&mut connection)
        .await
        .expect("a copy");
    Place {
        url: format!("{server}/{name}_copy?{options}"),
        folder,
    }
}

async fn an_address_where_nothing_was_written_is_replaced(database: WithObjects) {
    let folder = database.place.folder.path().join("objects");
    std::fs::remove_dir_all(&folder).expect("removed");
    std::fs::write(&folder, "").expect("a file in its place");
    let checkpoint = database.resumed(large(7)).await.checkpoint;
    assert_eq!(checkpoint, Some(ClaimedCheckpoint::Given(large(7))));
    database.store.close().await;
    let WithObjects { place, store } = database;
    drop(store);
    opened(&place, Some("other")).await.expect("a store");
}
