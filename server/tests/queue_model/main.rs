//! The queue against a simple model: random submissions, claims, writes, heartbeats, expiries, cancels, deadlines and ends,
//! with a manual clock.

mod model;
mod pair;
mod step;

use proptest::prelude::*;
use proptest::test_runner::TestCaseResult;
use tempfile::TempDir;

use pair::Pair;
use step::step;

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_queue_behaves_as_its_model(steps in prop::collection::vec(step(), 1..80)) {
        let runtime = tokio::runtime::Builder::new_current_thread()
            .enable_all()
            .build()
            .expect("a runtime");
        runtime.block_on(async {
            let folder = TempDir::new().expect("a temporary folder");
            let mut pair = Pair::new(&folder).await;
            for step in &steps {
                pair.apply(step).await?;
            }
            pair.store.close().await;
            TestCaseResult::Ok(())
        })?;
    }
}
