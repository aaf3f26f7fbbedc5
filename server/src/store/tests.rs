//! The queue over a real database: fencing, contention, rescue, restarts.

mod backups;
mod checkpoints;
mod files;
mod leases;
mod opening;
mod order;

use std::path::Path;
use std::sync::Arc;

use api::job::{Outcome, Status};
use solver::record::CycleReport;
use sqlx::ConnectOptions;
use sqlx::sqlite::{SqliteConnectOptions, SqliteConnection};
use tempfile::TempDir;
use tokio::sync::Barrier;
use uuid::Uuid;

use super::*;
use crate::http::tests::row;
use crate::queue::{ATTEMPT_LIMIT, Transition};
use crate::spec;

struct Fixture {
    store: Arc<Store>,
    url: String,
    folder: TempDir,
}

impl Fixture {
    async fn new() -> Self {
        let folder = TempDir::new().expect("a temporary folder");
        let url = format!(
            "sqlite://{}",
            folder.path().join("deep/er/test.db").display()
        );
        let store = Arc::new(Store::open(&url).await.expect("a store"));
        Self { store, url, folder }
    }

    async fn queued(&self) -> Uuid {
        self.wished(SubmitOptions::default()).await
    }

    async fn wished(&self, wishes: SubmitOptions) -> Uuid {
        let resolved = spec::read(br#"{"system":{"kind":"fuzz_button"}}"#).expect("accepted");
        let plan = crate::estimate::Estimate::of(&resolved).plan(&resolved, None);
        self.store
            .submit(
                &NewJob {
                    spec: resolved.spec,
                    plan,
                    wishes,
                },
                0,
            )
            .await
            .expect("queued")
    }

    async fn claimed(&self, expires_at: i64) -> Claim {
        self.store
            .claim(1, expires_at)
            .await
            .expect("the store")
            .expect("a job")
    }

    async fn job(&self, id: Uuid) -> api::job::Job {
        self.store
            .job(id)
            .await
            .expect("the store")
            .expect("a job")
            .document
    }

    /// Takes jobs back whose lease has ended by this time, and ends those that are not tried again; how many.
    async fn rescued(&self, by: i64) -> usize {
        let rescued = self.store.rescue_expired(by, by + 1).await;
        let rescued = rescued.expect("the store");
        for claim in &rescued.ending {
            let (nothing, end) = (Batch::default(), end(Transition::Lose));
            let ended = self.store.end(claim, &nothing, &end, by).await;
            ended.expect("the store").expect("it is held");
        }
        rescued.queued + rescued.ending.len()
    }

    async fn ended_with(&self, claim: &Claim, batch: &Batch) {
        let ended = self
            .store
            .end(claim, batch, &end(Transition::Succeed), 2)
            .await;
        ended.expect("the store").expect("it is held");
    }

    async fn cycles(&self, id: Uuid) -> Vec<u64> {
        self.store
            .history(id)
            .await
            .expect("the store")
            .iter()
            .map(|row: &CycleReport| row.cycle)
            .collect()
    }
}

fn batch(cycle: u64) -> Batch {
    Batch {
        rows: vec![row(cycle)],
        events: vec![("cycle", "{}".to_owned())],
        ..Batch::default()
    }
}

/// Another process that is about to write, and keeps everyone else from it as long as it lives.
pub(crate) async fn written_by_another(database: &Path) -> SqliteConnection {
    let options = SqliteConnectOptions::new().filename(database);
    let mut other = options.connect().await.expect("another process");
    sqlx::query("BEGIN IMMEDIATE")
        .execute(&mut other)
        .await
        .expect("the lock");
    other
}

fn end(step: Transition) -> End {
    End {
        step,
        reason: Some("because".to_owned()),
        outcome: Some(Outcome::Completed),
        summary: None,
    }
}
