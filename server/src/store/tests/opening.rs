//! One process a database.

use super::*;

#[tokio::test]
async fn a_database_is_served_by_one_process_and_survives_it() {
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
        fixture.store.rescue_all(5).await.expect("the store").queued,
        1
    );
    assert_eq!(fixture.claimed(10).await.id, id);
    assert_eq!(fixture.job(id).await.attempts, 2);
}

#[tokio::test]
async fn addresses_that_are_no_files_are_refused() {
    for url in [
        "postgres://x",
        "sqlite::memory:",
        "sqlite://x.db?mode=memory",
    ] {
        assert!(Store::open(url).await.is_err(), "{url}");
    }
}

#[tokio::test]
async fn a_transaction_that_the_database_ended_by_itself_does_not_end_all_writing() {
    let fixture = Fixture::new().await;
    let store = &fixture.store;
    let mut transaction = store
        .writer
        .begin_with(crate::store::sqlite::queries::BEGIN)
        .await;
    // As SQLite does when the disk is full.
    let ended = sqlx::query("ROLLBACK").execute(transaction.as_deref_mut().expect("begun"));
    ended.await.expect("ended");
    drop(transaction);
    let id = fixture.queued().await;
    assert_eq!(fixture.claimed(10).await.id, id);
}
