//! The imposed relative motion.

use super::turning_points::TurningPoints;
use crate::number::real;

/// Imposed relative motion.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Motion {
    /// Reciprocating around the neutral position, toward +x first. Quasi-static contact does not depend on time: waveform and period
    /// change the result by wear laws of time and speed alone.
    Reciprocating {
        /// Amplitude, mm.
        amplitude_mm: f64,
        /// Duration of a cycle, s.
        period_s: f64,
    },
    /// Periodic with turning points between the outermost ones, beginning at the neutral position on its last way to +x in a period.
    Periodic {
        /// Turning points about the neutral position.
        turns: TurningPoints,
        /// Duration of a cycle, s.
        period_s: f64,
    },
    /// The slider's surface slides through a contact that stays at one position of the receptacle, as for a ring
    /// rotating on a block. A cycle of the run is the distance `step_mm`; the slider must not wear.
    Continuous {
        /// Distance of one cycle, mm.
        step_mm: f64,
    },
}

impl Motion {
    /// Imposed sliding distance of a cycle, mm.
    pub fn distance_per_cycle_mm(self) -> f64 {
        match self {
            Self::Reciprocating { amplitude_mm, .. } => 4.0 * amplitude_mm,
            Self::Periodic { turns, .. } => turns.path_mm(),
            Self::Continuous { step_mm } => step_mm,
        }
    }

    /// Duration of a cycle, s; none of a continuous motion.
    pub fn period_s(self) -> Option<f64> {
        match self {
            Self::Reciprocating { period_s, .. } | Self::Periodic { period_s, .. } => {
                Some(period_s)
            }
            Self::Continuous { .. } => None,
        }
    }

    /// Amplitude of the contact's motion over the receptacle, mm.
    pub fn amplitude_mm(self) -> f64 {
        match self {
            Self::Reciprocating { amplitude_mm, .. } => amplitude_mm,
            Self::Periodic { turns, .. } => turns.amplitude_mm(),
            Self::Continuous { .. } => 0.0,
        }
    }

    /// Returns `true` if it turns between its outermost turning points.
    pub(crate) fn turns_inside(self) -> bool {
        matches!(self, Self::Periodic { .. })
    }

    /// Amplitude of the reciprocating motion that passes a place as often on the same path as this one passes the place that it
    /// passes most, mm: its groove is as deep.
    pub(crate) fn equivalent_amplitude_mm(self) -> f64 {
        match self {
            Self::Periodic { turns, .. } => turns.path_mm() / (2.0 * real(turns.most_passes())),
            Self::Reciprocating { .. } | Self::Continuous { .. } => self.amplitude_mm(),
        }
    }

    /// The reciprocating motion between the outermost turning points.
    pub(crate) fn outer(self) -> Self {
        match self {
            Self::Periodic { turns, period_s } => Self::Reciprocating {
                amplitude_mm: turns.amplitude_mm(),
                period_s,
            },
            Self::Reciprocating { .. } | Self::Continuous { .. } => self,
        }
    }
}
