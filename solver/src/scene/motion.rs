//! The imposed relative motion.

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
            Self::Continuous { step_mm } => step_mm,
        }
    }

    /// Duration of a cycle, s; none of a continuous motion.
    pub fn period_s(self) -> Option<f64> {
        match self {
            Self::Reciprocating { period_s, .. } => Some(period_s),
            Self::Continuous { .. } => None,
        }
    }

    /// Amplitude of the contact's motion over the receptacle, mm.
    pub fn amplitude_mm(self) -> f64 {
        match self {
            Self::Reciprocating { amplitude_mm, .. } => amplitude_mm,
            Self::Continuous { .. } => 0.0,
        }
    }
}
