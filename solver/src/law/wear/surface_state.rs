//! State of a surface that oxidational laws depend on.

use crate::law::temperature::Temperature;

/// Hardness and temperature of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct SurfaceState {
    /// Hardness H, MPa.
    pub hardness_mpa: f64,
    /// Temperature: of the touching asperities where oxides grow, of the bulk where they melt.
    pub temperature: Temperature,
}

impl SurfaceState {
    /// The surface at another hardness than it was given with.
    #[must_use]
    pub(super) fn softened(self, ratio: f64) -> Self {
        Self {
            hardness_mpa: self.hardness_mpa * ratio,
            ..self
        }
    }

    /// The surface of a contact that is warmer than its surroundings by a rise in K.
    #[must_use]
    pub(super) fn heated(self, rise_k: f64) -> Self {
        Self {
            temperature: self.temperature.raised(rise_k),
            ..self
        }
    }
}
