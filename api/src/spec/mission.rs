//! Mission: blocks of different motions.

use serde::{Deserialize, Serialize};
use utoipa::ToSchema;

use super::Motion;
use crate::enum_value::string_enum;

string_enum! {
    /// Order of the cycles of a mission.
    MissionOrder {
        /// In each repetition one block after the other.
        InOrder = "in_order",
        /// The cycles of each block spread evenly over all repetitions.
        Mixed = "mixed",
    }
}

/// A block of a mission.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize, ToSchema)]
pub struct MissionBlock {
    /// Display name.
    #[serde(skip_serializing_if = "Option::is_none")]
    pub name: Option<String>,
    /// Motion, of any kind but `continuous`.
    pub motion: Motion,
    /// Cycles in one repetition; `motion.duration_s` stands for them where it is given.
    #[serde(
        default,
        skip_serializing_if = "Option::is_none",
        deserialize_with = "super::count::optional"
    )]
    pub cycles: Option<u64>,
}
