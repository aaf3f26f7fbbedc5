//! Roles of PostgreSQL: the one that serves need not be the one that owns the tables.

use sqlx::{Connection, Executor, PgConnection};

use super::*;

#[tokio::test]
#[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
async fn a_role_that_may_not_change_the_schema_serves_a_migrated_database() {
    let place = Place::postgres();
    let served = place.url.replace("fretwear@", "serving@");
    let mut owner = PgConnection::connect(&place.url).await.expect("a server");
    owner
        .execute(
            "DO $$ BEGIN CREATE ROLE serving LOGIN; EXCEPTION WHEN duplicate_object THEN NULL; END $$",
        )
        .await
        .expect("a role");
    let opened = async |url: &str| Store::open_with(url, &place.files(), Limits::default()).await;
    let early = opened(&served).await;
    assert!(matches!(early, Err(StoreError::Migrate(_))), "{early:?}");
    opened(&place.url).await.expect("a store").close().await;
    owner
        .execute("GRANT SELECT, INSERT, UPDATE, DELETE ON ALL TABLES IN SCHEMA public TO serving")
        .await
        .expect("its rights");
    let store = opened(&served).await.expect("a store");
    let fixture = Fixture {
        store: Arc::new(store),
        url: served.clone(),
        folder: place.folder,
    };
    let id = fixture.queued().await;
    let claim = fixture.claimed(i64::MAX).await;
    assert_eq!(claim.id, id);
    let ended = fixture
        .store
        .end_next(&claim, &update(1), &end(Transition::Succeed))
        .await;
    assert_eq!(ended, Some(Status::Succeeded));
    assert_eq!(
        fixture.store.delete(id).await.expect("the store"),
        Deleted::Done
    );
}
