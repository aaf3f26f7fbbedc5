//! Names of objects, and the mark of their store.

use super::objects::{WithObjects, opened};
use super::*;

on_both_engines! { WithObjects:
    objects_that_are_named_twice_stay,
    an_earlier_store_is_marked_if_it_has_the_objects,
}

/// As after a transaction that was committed and whose answer was lost.
async fn objects_that_are_named_twice_stay(database: WithObjects) {
    let store = &database.store;
    let ids = [
        database.ended(Transition::Succeed).await,
        database.ended(Transition::Succeed).await,
    ];
    let objects = store.process().objects.as_ref().expect("objects");
    let written = store.write_objects(objects, 512).await.expect("written");
    let written = written.into_iter().map(|moved| moved.expect("written"));
    let moved: Vec<_> = written.flatten().collect();
    let mut named = store.name_objects(&moved).await.expect("named");
    named.sort_unstable();
    assert_eq!(named, ids);
    let again = store.name_objects(&moved).await.expect("known");
    assert_eq!(again, Vec::<Uuid>::new());
    database.moved().await;
    assert_eq!(database.objects().len(), 2);
    for id in ids {
        assert_eq!(database.read(id, "b.csv").await.expect("read"), b"cycle");
    }
}

/// One that was filled before there were marks, and a folder that is not mounted then.
async fn an_earlier_store_is_marked_if_it_has_the_objects(database: WithObjects) {
    let id = database.ended(Transition::Succeed).await;
    database.moved().await;
    database.ended(Transition::Succeed).await;
    let folder = database.place.folder.path().join("objects");
    let address = format!("file://{}", folder.display());
    // A change of the address discards the note of the mark.
    for address in ["file:///other", &address] {
        let noted = database.store.note_address_of_objects(address).await;
        noted.expect("the store");
    }
    database.store.close().await;
    let WithObjects { place, store } = database;
    drop(store);
    std::fs::remove_file(folder.join("fretwear-objects")).expect("removed");
    let unmounted = place.folder.path().join("unmounted");
    std::fs::rename(&folder, &unmounted).expect("renamed");
    let store = Arc::new(opened(&place, Some("objects")).await.expect("a store"));
    let database = WithObjects { place, store };
    let (moved, ended) = database.store.move_results().await;
    assert!(moved.is_empty() && matches!(ended, Err(StoreError::Objects(_))));
    std::fs::remove_dir(&folder).expect("nothing is in it");
    std::fs::rename(&unmounted, &folder).expect("renamed");
    assert_eq!(database.moved().await.len(), 1);
    assert!(folder.join("fretwear-objects").exists());
    assert_eq!(database.read(id, "b.csv").await.expect("read"), b"cycle");
}
