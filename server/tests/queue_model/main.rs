//! The queue against a simple model: random submissions, claims, writes, heartbeats, expiries, cancels, deadlines and ends,
//! with a manual clock.

mod model;
mod pair;
#[expect(
    unreachable_pub,
    reason = "the file belongs to the crate of the end-to-end cases, too"
)]
#[path = "../../../tests/src/postgres.rs"]
mod postgres;
mod step;

use proptest::prelude::*;
use proptest::test_runner::TestCaseResult;
use tempfile::TempDir;

use pair::Pair;
use postgres::PostgresServer;
use step::{Step, step};

/// Applies steps to the queue in a database and to the model.
fn behaves(url: Option<String>, steps: &[Step]) -> TestCaseResult {
    let runtime = tokio::runtime::Builder::new_current_thread()
        .enable_all()
        .build()
        .expect("a runtime");
    runtime.block_on(async {
        let folder = TempDir::new().expect("a temporary folder");
        let path = folder.path().join("test.db");
        let url = url.unwrap_or_else(|| format!("sqlite://{}", path.display()));
        let mut pair = Pair::new(&url, &path).await;
        for step in steps {
            pair.apply(step).await?;
        }
        pair.store.close().await;
        Ok(())
    })
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_queue_behaves_as_its_model(steps in prop::collection::vec(step(), 1..80)) {
        behaves(None, &steps)?;
    }

    #[test]
    #[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
    fn the_queue_in_postgresql_behaves_as_its_model(steps in prop::collection::vec(step(), 1..80)) {
        behaves(Some(PostgresServer::shared().new_database()), &steps)?;
    }
}
