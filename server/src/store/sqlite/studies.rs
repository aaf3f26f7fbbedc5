//! Studies of accuracy: sweeps with what their results are compared by.

use api::spec::Spec;
use api::sweep::Sweep;
use serde::{Deserialize, Serialize};
use sqlx::{Sqlite, Transaction};
use uuid::Uuid;

use crate::batch::accuracy::Grid;
use crate::store::sqlite::sweeps::SweepOutcome;
use crate::store::{SnapshotPart, Store, StoreError};

/// What the results of a study are compared by.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct StudyPlan {
    /// The form of this document; only `FORMAT` can be compared.
    pub format: u32,
    /// The resolved specification whose accuracy is varied.
    pub spec: Spec,
    /// The grid among its runs.
    pub grid: Grid,
    /// What did not fit into the budget, in words.
    pub left_out: Vec<String>,
}

impl StudyPlan {
    /// The form that this program writes and reads: raised when the grid changes its meaning.
    pub const FORMAT: u32 = 1;
}

/// The form alone, of a document of any.
#[derive(Deserialize)]
struct Form {
    format: u32,
}

/// A study as it stands.
#[derive(Debug, Clone, PartialEq)]
pub struct StoredStudy {
    /// Its jobs.
    pub sweep: Sweep,
    /// What their results are compared by.
    pub plan: StudyPlan,
    /// The jobs with their results, and the last profile of each that has one, as a document that is not read yet.
    pub outcomes: Vec<(SweepOutcome, Option<String>)>,
}

pub(in crate::store) async fn insert_study(
    transaction: &mut Transaction<'_, Sqlite>,
    sweep: Uuid,
    plan: &StudyPlan,
) -> Result<(), StoreError> {
    sqlx::query("INSERT INTO studies (sweep_id, plan) VALUES (?, ?)")
        .bind(sweep.to_string())
        .bind(serde_json::to_string(plan)?)
        .execute(&mut **transaction)
        .await?;
    Ok(())
}

impl Store {
    /// Whether there is a study of that id.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn is_study(&self, id: Uuid) -> Result<bool, StoreError> {
        let found: Option<i64> = sqlx::query_scalar("SELECT 1 FROM studies WHERE sweep_id = ?")
            .bind(id.to_string())
            .fetch_optional(&self.readers)
            .await?;
        Ok(found.is_some())
    }

    /// A study with the results so far; nothing if there is none of that id.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails or a document in it cannot be read.
    pub async fn study(&self, id: Uuid) -> Result<Option<StoredStudy>, StoreError> {
        let plan: Option<String> =
            sqlx::query_scalar("SELECT plan FROM studies WHERE sweep_id = ?")
                .bind(id.to_string())
                .fetch_optional(&self.readers)
                .await?;
        let (Some(plan), Some(sweep)) = (plan, self.sweep(id).await?) else {
            return Ok(None);
        };
        let corrupt = |what, cause: serde_json::Error| StoreError::Corrupt {
            id,
            what,
            cause: cause.to_string(),
        };
        let Form { format } =
            serde_json::from_str(&plan).map_err(|cause| corrupt("study", cause))?;
        if format != StudyPlan::FORMAT {
            return Err(StoreError::StudyFormat {
                id,
                found: format,
                wanted: StudyPlan::FORMAT,
            });
        }
        let plan = serde_json::from_str(&plan).map_err(|cause| corrupt("study", cause))?;
        let mut outcomes = Vec::new();
        for outcome in self.sweep_outcomes(id).await?.unwrap_or_default() {
            let mut profile = None;
            if outcome.summary.is_some() {
                let job = outcome.job.id;
                profile = self.snapshot(job, SnapshotPart::Profile, None).await?;
            }
            outcomes.push((outcome, profile));
        }
        Ok(Some(StoredStudy {
            sweep,
            plan,
            outcomes,
        }))
    }
}
