//! Opening: one process serves a database, and a file of another program or version is refused.

use std::path::Path;
use std::sync::Arc;
use std::time::Duration;

use sqlx::sqlite::SqliteConnectOptions;
use sqlx::{ConnectOptions, Connection};

use crate::store::tests::{Fixture, new_job};
use crate::store::{Store, StoreError, SubmitOptions, backup, verify};

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
    let lease = Duration::from_secs(1);
    let reclaimed = fixture.store.reclaim_at_start(lease, lease).await;
    assert_eq!(reclaimed.expect("the store").queued, 1);
    assert_eq!(fixture.claimed(i64::MAX).await.id, id);
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

#[tokio::test]
async fn files_of_other_programs_are_refused_and_not_changed() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("other.db");
    let url = format!("sqlite://{}", path.display());
    for (statements, words) in [
        (
            &["CREATE TABLE songs (name TEXT)"][..],
            "it has the tables songs",
        ),
        (
            &["PRAGMA application_id = 252006675"][..],
            "its application id is 252006675",
        ),
        (&[][..], "it is no SQLite database"),
    ] {
        let _ = std::fs::remove_file(&path);
        if statements.is_empty() {
            std::fs::write(&path, "text of more than one page\n".repeat(1000)).expect("written");
        }
        for statement in statements {
            let options = SqliteConnectOptions::new().filename(&path);
            let mut other = options
                .create_if_missing(true)
                .connect()
                .await
                .expect("opened");
            sqlx::query(*statement)
                .execute(&mut other)
                .await
                .expect("executed");
            other.close().await.expect("closed");
        }
        let before = std::fs::read(&path).expect("a file");
        let refused = Store::open(&url).await.expect_err("refused");
        assert!(matches!(refused, StoreError::Foreign { .. }), "{refused}");
        assert!(refused.to_string().contains(words), "{refused}");
        assert!(refused.to_string().contains("other.db"), "{refused}");
        let into = folder.path().join("backup");
        for refused in [
            backup(&url, &into).await.expect_err("refused"),
            verify(&url, Path::new("none"), None)
                .await
                .expect_err("refused"),
        ] {
            assert!(refused.to_string().contains(words), "{refused}");
        }
        assert!(!into.exists());
        assert!(std::fs::read(&path).expect("a file") == before);
    }
}

#[tokio::test]
async fn a_database_of_a_later_version_is_refused_in_words() {
    let Fixture { store, url, folder } = Fixture::new().await;
    let later = "INSERT INTO _sqlx_migrations (version, description, success, checksum, execution_time) \
                 VALUES (9999, 'later', 1, x'00', 0)";
    sqlx::query(later)
        .execute(&store.sqlite().writer)
        .await
        .expect("executed");
    store.close().await;
    drop(store);
    let path = folder.path().join("test.db");
    let before = std::fs::read(&path).expect("a file");
    let refused = Store::open(&url).await.expect_err("refused");
    let words = "was written by a later version of fretwear: its schema is 9999";
    assert!(refused.to_string().contains(words), "{refused}");
    assert!(std::fs::read(&path).expect("a file") == before);
}

#[tokio::test]
async fn a_missing_folder_is_refused_and_not_created() {
    let folder = tempfile::tempdir().expect("a folder");
    let missing = folder.path().join("data");
    let url = format!("sqlite://{}/fretwear.db", missing.display());
    let refused = Store::open(&url).await.expect_err("refused").to_string();
    assert_eq!(
        refused,
        format!("the folder {} does not exist", missing.display())
    );
    assert!(verify(&url, Path::new("none"), None).await.is_err());
    assert!(!missing.exists());
}

#[tokio::test]
async fn a_database_with_two_names_is_refused() {
    let Fixture { store, url, folder } = Fixture::new().await;
    let link = folder.path().join("link.db");
    std::fs::hard_link(folder.path().join("test.db"), &link).expect("a link");
    let linked = format!("sqlite://{}", link.display());
    for url in [&linked, &url] {
        let refused = Store::open(url).await.expect_err("refused");
        let is_served = matches!(refused, StoreError::Locked { .. });
        assert_eq!(is_served, url != &linked, "{refused}");
    }
    store.close().await;
    drop(store);
    let refused = Store::open(&url).await.expect_err("refused").to_string();
    assert!(
        refused.ends_with(
            "test.db has 2 names (hard links), each of which would have a log of its own"
        ),
        "{refused}"
    );
    std::fs::remove_file(link).expect("removed");
    assert!(Store::open(&url).await.is_ok());
}

#[tokio::test]
async fn a_first_start_that_was_interrupted_is_continued() {
    let folder = tempfile::tempdir().expect("a folder");
    let path = folder.path().join("test.db");
    let url = format!("sqlite://{}", path.display());
    let options = SqliteConnectOptions::new().filename(&path);
    let mut begun = options
        .create_if_missing(true)
        .connect()
        .await
        .expect("opened");
    sqlx::query("PRAGMA application_id = 0x66727477")
        .execute(&mut begun)
        .await
        .expect("marked");
    begun.close().await.expect("closed");
    // Of a process that was killed while it held the reserved space.
    let reserve = folder.path().join("test.db.reserve");
    std::fs::write(&reserve, "rest").expect("written");
    let store = Store::open(&url).await.expect("a store");
    assert!(!store.disk().is_full());
    assert!(std::fs::metadata(&reserve).expect("a file").len() > 1 << 20);
}

#[tokio::test]
async fn a_database_whose_file_was_removed_accepts_nothing_more() {
    let fixture = Fixture::new().await;
    let store = &fixture.store;
    store.beat().await.expect("it is there");
    fixture.queued().await;
    let path = fixture.folder.path().join("test.db");
    std::fs::remove_file(&path).expect("removed");
    // Another file at its path is not it.
    std::fs::write(&path, "").expect("written");
    store.beat().await.expect("its row is there");
    let refused = store.ready().await;
    assert!(matches!(refused, Err(StoreError::Removed)), "{refused:?}");
    let job = new_job(SubmitOptions::default());
    let refused = store.submit(&job, None).await;
    assert!(matches!(refused, Err(StoreError::Removed)), "{refused:?}");
}
