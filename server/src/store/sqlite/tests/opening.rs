//! Opening: one process serves a database.

use std::sync::Arc;

use crate::store::tests::Fixture;
use crate::store::{Store, StoreError};

#[tokio::test]
async fn a_database_is_served_by_one_process_and_its_jobs_survive_it() {
    let Fixture { store, url, folder } = Fixture::new().await;
    assert!(matches!(
        Store::open(&url).await,
        Err(StoreError::Locked { .. })
    ));
    // Another name of the same file is the same database.
    let path = url.trim_start_matches("sqlite://");
    let link = format!("{path}.link");
    std::os::unix::fs::symlink(path, &link).expect("a link can be made");
    assert!(matches!(
        Store::open(&format!("sqlite://{link}")).await,
        Err(StoreError::Locked { .. })
    ));
    let fixture = Fixture { store, url, folder };
    let id = fixture.queued().await;
    fixture.claimed(i64::MAX).await;
    let Fixture { store, url, folder } = fixture;
    store.close().await;
    drop(store);
    let store = Arc::new(Store::open(&url).await.expect("free again"));
    let fixture = Fixture { store, url, folder };
    assert_eq!(
        fixture
            .store
            .reclaim_all(5)
            .await
            .expect("the store")
            .queued,
        1
    );
    assert_eq!(fixture.claimed(10).await.id, id);
    assert_eq!(fixture.job(id).await.attempts, 2);
}

#[tokio::test]
async fn addresses_other_than_files_are_rejected() {
    for url in [
        "postgres://x",
        "sqlite::memory:",
        "sqlite://x.db?mode=memory",
    ] {
        assert!(Store::open(url).await.is_err(), "{url}");
    }
}
