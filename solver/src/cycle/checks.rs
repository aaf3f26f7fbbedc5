//! Residuals that a run reports.

use serde::{Deserialize, Serialize};

/// Worst residuals over the run, each relative to its scale.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub struct Checks {
    /// |sum of vertical forces - load| over the load on the unworn contact.
    pub force_balance: f64,
    /// The same with the normals of the surfaces as worn at that moment, at the positions whose contacts are reported: those
    /// of the solve are of the beginning of the computed cycle.
    pub force_balance_present_normals: f64,
    /// |worn area of the profile - accumulated integral of the wear rate| over the latter.
    pub worn_area: f64,
    /// Largest violation of gap >= 0, p >= 0, p gap = 0, over its scale.
    pub complementarity: f64,
    /// Largest excess of |q| over mu p, over the peak pressure.
    pub friction_cone: f64,
    /// Largest |sum of shear forces| over mu times the sum of normal ones; 1 in gross slip.
    pub friction_use: f64,
}

impl Checks {
    /// The larger ones of two runs or places.
    pub(crate) fn worse_of(self, other: Self) -> Self {
        Self {
            force_balance: self.force_balance.max(other.force_balance),
            force_balance_present_normals: self
                .force_balance_present_normals
                .max(other.force_balance_present_normals),
            worn_area: self.worn_area.max(other.worn_area),
            complementarity: self.complementarity.max(other.complementarity),
            friction_cone: self.friction_cone.max(other.friction_cone),
            friction_use: self.friction_use.max(other.friction_use),
        }
    }
}
