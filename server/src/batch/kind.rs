//! Kinds of batches: names, paths and plans.

use std::collections::BTreeMap;
use std::fmt;

use uuid::Uuid;

use crate::store::StoredBatch;

/// Kinds of batches.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Kind {
    /// Variations of one specification. Every batch can be read as a sweep.
    Sweep,
    /// One scene at many accuracies, compared with the converged solution.
    AccuracyStudy,
}

impl fmt::Display for Kind {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str(match self {
            Self::Sweep => "sweep",
            Self::AccuracyStudy => "study",
        })
    }
}

impl Kind {
    /// Name of the collection below `/v1`.
    pub fn collection(self) -> &'static str {
        match self {
            Self::Sweep => "sweeps",
            Self::AccuracyStudy => "studies",
        }
    }

    /// Checks whether batches of this kind have an evaluation plan.
    pub fn has_plan(self) -> bool {
        self == Self::AccuracyStudy
    }

    /// Checks whether a batch is of this kind.
    pub fn includes(self, batch: &StoredBatch) -> bool {
        !self.has_plan() || batch.plan.is_some()
    }

    /// Links of a batch: relation to path.
    pub fn links(self, id: Uuid) -> BTreeMap<String, String> {
        let own = format!("/v1/{}/{id}", self.collection());
        let relations: &[&str] = match self {
            Self::Sweep => &["base", "cancel", "outcomes"],
            Self::AccuracyStudy => &["base", "cancel", "picture", "table"],
        };
        let link = |relation: &&str| ((*relation).to_owned(), format!("{own}/{relation}"));
        let mut links: BTreeMap<_, _> = relations.iter().map(link).collect();
        links.insert("jobs".to_owned(), format!("/v1/jobs?sweep={id}"));
        links.insert("self".to_owned(), own);
        links
    }
}
