//! What a run of stations is computed from.

use super::error::StationError;
use crate::effects::Effect;
use crate::scene::{Drive, Friction, Motion, Scene};
use crate::sides::Side;

/// Line of the contact.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum LineShape {
    /// A circle in the plane of the motion.
    Ring {
        /// Radius of its centre line, mm.
        radius_mm: f64,
    },
    /// A straight line across the motion.
    Straight {
        /// Its length, mm.
        width_mm: f64,
        /// Radius by which the slider's surface recedes from the middle of the line to its ends, mm; straight if absent.
        crown_radius_mm: Option<f64>,
        /// Tilt of the slider about the direction of motion, mrad.
        tilt_mrad: f64,
    },
}

/// What carries the sections of the slider.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Top {
    /// The same line load everywhere.
    Even,
    /// A rigid body that does not rotate: the same height everywhere.
    Rigid,
}

/// A contact along a line.
#[derive(Debug, Clone, PartialEq)]
pub struct StationScene {
    /// The plane section, with its motion along x; its line load is not used.
    pub section: Scene,
    /// The line.
    pub line: LineShape,
    /// What carries the sections.
    pub top: Top,
    /// Normal force F on the whole line, N.
    pub force_n: f64,
    /// Number of stations along the half ring or the width, with both ends.
    pub stations: usize,
    /// Threads that the stations are solved in; results do not depend on it.
    pub threads: usize,
    /// Worn depth of either side that ends the run, mm.
    pub stop_depth_mm: Option<f64>,
}

impl LineShape {
    /// Length L of the line, mm.
    pub fn length_mm(self) -> f64 {
        match self {
            Self::Ring { radius_mm } => 2.0 * std::f64::consts::PI * radius_mm,
            Self::Straight { width_mm, .. } => width_mm,
        }
    }
}

impl StationScene {
    /// Stations that suffice for a tolerance: under a rigid top depths at 1 000 cycles of the thesis' ring are 15.81, 15.93 and 15.97 um with
    /// 9, 17 and 33 of them.
    pub fn stations_for(tolerance: f64) -> usize {
        match tolerance {
            coarse if coarse > 0.03 => 9,
            medium if medium > 0.01 => 17,
            _ => 33,
        }
    }

    /// Mean line load F/L, N/mm.
    pub fn mean_line_load(&self) -> f64 {
        self.force_n / self.line.length_mm()
    }

    /// The plane scene under the mean line load, without sticking and with nothing that a section of a line does not have.
    pub(super) fn plane(&self) -> Scene {
        let section = self.section.clone();
        Scene {
            load_n_per_mm: self.mean_line_load(),
            effects: section.effects.clone().with(Effect::StickMemory, false),
            ..section
        }
    }

    /// Amplitude of the motion, mm; none of one that turns inside or is continuous.
    pub(super) fn amplitude_mm(&self) -> Option<f64> {
        match self.section.motion {
            Motion::Reciprocating { amplitude_mm, .. } => Some(amplitude_mm),
            Motion::Periodic { .. } | Motion::Continuous { .. } => None,
        }
    }

    /// Checks the scene.
    ///
    /// # Errors
    /// A value outside of its range, a law or a motion that stations do not have.
    pub(super) fn check(&self) -> Result<(), StationError> {
        let amplitude = self.amplitude_mm().ok_or(StationError::Motion)?;
        if !matches!(
            self.section.friction,
            Friction::Coulomb { .. } | Friction::Frictionless
        ) {
            return Err(StationError::FrictionLaw);
        }
        let size = match self.line {
            LineShape::Ring { radius_mm } => radius_mm,
            LineShape::Straight {
                width_mm,
                crown_radius_mm,
                ..
            } => crown_radius_mm.map_or(width_mm, |radius| radius.min(width_mm)),
        };
        for (name, value) in [
            ("normal force in N", self.force_n),
            ("length of the line in mm", size),
            ("magnitude of the amplitude in mm", amplitude.abs()),
        ] {
            if !(value > 0.0 && value.is_finite()) {
                return Err(StationError::Value { name, value });
            }
        }
        if let LineShape::Ring { radius_mm } = self.line
            && amplitude.abs() >= radius_mm
        {
            return Err(StationError::Amplitude {
                amplitude_mm: amplitude.abs(),
                radius_mm,
            });
        }
        if self.stations < 2 {
            return Err(StationError::Stations {
                stations: self.stations,
            });
        }
        if self.top == Top::Rigid && self.section.drive != Drive::Handle {
            return Err(StationError::Drive);
        }
        if self.section.spring_n_per_mm2 != 0.0 {
            return Err(StationError::Spring);
        }
        let wear = self.section.surface_wear();
        for side in Side::BOTH {
            if wear.of(side).is_some_and(|wear| wear.uniform().is_none()) {
                return Err(StationError::Law { side: side.name() });
            }
        }
        Ok(())
    }
}
