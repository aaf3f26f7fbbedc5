//! Mission: blocks of different motions.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::Motion;

/// A block of a mission.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct MissionBlock {
    /// Display name.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Its motion, of any kind but `continuous`.
    pub motion: Motion,
    /// Its cycles in one repetition; `motion.duration_s` stands for them where it is given.
    #[serde(
        default,
        skip_serializing_if = "Option::is_none",
        deserialize_with = "super::count::optional"
    )]
    pub cycles: Option<u64>,
}
