//! The settings of a run that a study varies.

use std::fmt;

use api::results::AccuracyReached;
use api::spec::{CycleJump, Overrides};
use serde::{Deserialize, Serialize};

use crate::number::real;

/// The settings of a run that a study varies.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// Surface element size under the contact, mm.
    pub contact_element_mm: f64,
    /// Increments per computed cycle.
    pub increments_per_cycle: u32,
    /// Physical cycles per computed cycle.
    pub cycle_jump: f64,
    /// Sections along a line; absent where the contact has none.
    #[serde(default, skip_serializing_if = "Option::is_none")]
    pub stations: Option<u32>,
}

impl Settings {
    /// The settings that a tolerance led to, in a run of so many cycles.
    pub(crate) fn used(cycles: u64, used: &AccuracyReached, stations: Option<u32>) -> Self {
        Self {
            contact_element_mm: used.contact_element_mm,
            increments_per_cycle: used.increments_per_cycle,
            cycle_jump: real(cycles) / real(used.computed_cycles.max(1)),
            stations,
        }
    }

    /// Settings that a specification fixes; `None` if it leaves one open.
    pub(crate) fn of(overrides: &Overrides) -> Option<Self> {
        let Some(CycleJump::Fixed(jump)) = overrides.cycle_jump else {
            return None;
        };
        Some(Self {
            contact_element_mm: overrides.contact_element_mm?,
            increments_per_cycle: overrides.increments_per_cycle?,
            cycle_jump: real(jump),
            stations: overrides.stations,
        })
    }

    /// Sections along the line; 1 where there are none.
    pub(crate) fn sections(self) -> f64 {
        self.stations.map_or(1.0, f64::from)
    }

    /// The jump as an integer.
    #[expect(
        clippy::cast_possible_truncation,
        clippy::cast_sign_loss,
        reason = "jumps are integers from 1 to 1e8"
    )]
    pub fn jump(self) -> u64 {
        self.cycle_jump as u64
    }
}

impl fmt::Display for Settings {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        write!(
            f,
            "elements of {:.3e} mm, {} increments, jump {}",
            self.contact_element_mm, self.increments_per_cycle, self.cycle_jump
        )?;
        self.stations
            .map_or(Ok(()), |stations| write!(f, ", {stations} sections"))
    }
}
