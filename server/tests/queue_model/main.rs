//! The queue against a simple model: random submissions, claims, writes, heartbeats, expiries, cancels, deadlines and ends,
//! with a clock that the test moves.

mod both;
mod model;
mod step;

use proptest::prelude::*;
use proptest::test_runner::TestCaseResult;
use tempfile::TempDir;

use both::Both;
use step::step;

proptest! {
    #![proptest_config(ProptestConfig { cases: 24, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn the_queue_does_what_its_model_does(steps in prop::collection::vec(step(), 1..80)) {
        let runtime = tokio::runtime::Builder::new_current_thread()
            .enable_all()
            .build()
            .expect("a runtime");
        runtime.block_on(async {
            let folder = TempDir::new().expect("a temporary folder");
            let mut both = Both::new(&folder).await;
            for step in &steps {
                both.apply(step).await?;
            }
            both.store.close().await;
            TestCaseResult::Ok(())
        })?;
    }
}
