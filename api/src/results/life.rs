//! Life by each criterion of a specification.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use crate::enum_value::string_enum;
use crate::spec::Criterion;

string_enum! {
    /// Status of a criterion at the end of a run.
    LifeStatus {
        /// The criterion was reached.
        Reached = "reached",
        /// The criterion was not reached within the cycles of the run.
        NotReached = "not_reached",
        /// The quantity of the criterion is not simulated.
        NotModelled = "not_modelled",
    }
}

string_enum! {
    /// Verdict on the target of a specification.
    Verdict {
        /// Connectors last the target in every share of the reliability.
        Pass = "pass",
        /// In at least one share they do not.
        Fail = "fail",
        /// The error of the life, the end of the run or a life without a band leaves it open.
        Undecided = "undecided",
        /// The quantity of the criterion is not simulated.
        NotModelled = "not_modelled",
    }
}

/// Life by one criterion.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct LifeEntry {
    /// The criterion, with its side.
    pub criterion: Criterion,
    /// The side, `slider` or `receptacle`; null for the contact as a whole.
    pub side: Option<String>,
    /// Status of the criterion.
    pub status: LifeStatus,
    /// Cycles after which it was reached, interpolated between computed ones; null for a continuous motion.
    pub cycles: Option<f64>,
    /// Repetitions of a mission until then; absent without a mission.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub repetitions: Option<f64>,
    /// Imposed sliding distance until then, mm.
    pub sliding_distance_mm: Option<f64>,
    /// Duration until then, h; null for a continuous motion.
    pub duration_h: Option<f64>,
    /// Estimated relative error of the computation in these cycles, which is no part of `band`; null where errors are not estimated, or a
    /// coarse companion has not reached the criterion.
    #[serde(default)]
    pub estimated_relative_error: Option<f64>,
    /// Scatter of these cycles, of a continuous motion that of the distance in mm; null where it was not reached, and where `reason`
    /// says that none is known.
    pub band: Option<LifeBand>,
    /// Lives at the shares of `life.reliability`; none where there is no band.
    #[serde(default)]
    pub at_reliability: Vec<LifeAtReliability>,
    /// Part of all contacts that fails before `life.target_cycles`; null without a target or a band.
    #[serde(default)]
    pub share_failed_at_target: Option<f64>,
    /// The same of all connectors, of which each fails with the first of its contacts.
    #[serde(default)]
    pub connectors_failed_at_target: Option<f64>,
    /// Verdict on the target; null without one.
    #[serde(default)]
    pub verdict: Option<Verdict>,
    /// Quantity of the criterion at the end of the run: a worn depth in mm, a part of the scar or a resistance in mOhm.
    pub value: Option<f64>,
    /// Limit, in the same unit.
    pub limit: Option<f64>,
    /// Reason for the status, or for a missing band, in words.
    pub reason: Option<String>,
}

/// Cycles, of a continuous motion mm, that a part of all contacts does not survive, for wear coefficients of a lognormal distribution.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct LifeBand {
    /// Of a hundredth; null in results of versions without it.
    #[serde(default)]
    pub b1: Option<f64>,
    /// Of a tenth.
    pub b10: f64,
    /// Of a half.
    pub b50: f64,
    /// Of nine tenths.
    pub b90: f64,
    /// Cycles or mm that the first of `contacts` independent contacts does not survive in a tenth of all connectors.
    pub first_of_contacts_b10: f64,
}

/// Life that a share of all contacts or connectors lasts, in the unit of the band.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct LifeAtReliability {
    /// Share that lasts.
    pub share: f64,
    /// Cycles or mm that it lasts, of all contacts.
    pub cycles: f64,
    /// The same of all connectors: the first of their contacts.
    pub of_contacts: f64,
    /// `of_contacts` over the target; null without one.
    #[serde(default)]
    pub margin: Option<f64>,
}
