//! What a run of stations is computed from.

use super::error::StationError;
use crate::effects::Effect;
use crate::model::resolution;
use crate::number::{nearest, real};
use crate::scene::{Accuracy, Dimension, Drive, Friction, Line, LineShape, Motion, Scene, Top};
use crate::sides::Side;

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
    /// Number of stations along the half ring, the half of a straight line or all of one with a tilt, with both ends.
    pub stations: usize,
    /// Threads that the stations are solved in; results do not depend on it.
    pub threads: usize,
}

/// Stations along half of a line that suffice for a tolerance: under a rigid top depths at 1 000 cycles of the thesis' ring are 15.81, 15.93 and 15.97 um with
/// 9, 17 and 33 of them.
pub fn stations_for(tolerance: f64) -> usize {
    match tolerance {
        coarse if coarse > 0.03 => 9,
        medium if medium > 0.01 => 17,
        _ => 33,
    }
}

/// Fewest stations of a line whose sections differ, and of one whose sections are all alike.
const FEWEST: usize = 3;
const ALIKE: usize = 2;

/// Stations of a line of a scene: given or by its tolerance, and refined with its mesh to an odd number, which has one in the middle.
pub fn stations_of(line: &Line, accuracy: &Accuracy) -> usize {
    if line.stations.is_none() && line.shape.is_even() {
        return ALIKE;
    }
    let chosen = line
        .stations
        .unwrap_or_else(|| stations_for(accuracy.tolerance));
    let half = 0.5 * real(chosen.saturating_sub(1));
    let [unrefined, refined] = [half, accuracy.refinement.mesh * half].map(nearest);
    if refined == unrefined {
        return chosen;
    }
    (2 * refined + 1).max(FEWEST)
}

/// `Tuning::sufficient_cycles` of sections: the jumps of one that slides mostly along the line, or whose scar is about as wide as its stroke,
/// bound those of all. On the thesis' ring under a rigid top at 2 %, 2.5, 1 and 0.5 take 141, 77 and 56 computed cycles to cycle 1 000; the
/// depth differs by 0.3 %, the volume by 0.4 and 0.8 %.
const SUFFICIENT_CYCLES: f64 = 1.0;

impl StationScene {
    /// The contact along a line of a scene; `None` for another one.
    pub fn of(scene: &Scene) -> Option<Self> {
        let line = scene.dimension.line()?;
        Some(Self {
            stations: stations_of(line, &scene.accuracy),
            section: Scene {
                dimension: Dimension::PlaneStrain,
                ..scene.clone()
            },
            line: line.shape,
            top: line.top,
            force_n: line.force_n,
            threads: line.threads,
        })
    }

    /// Mean line load F/L, N/mm.
    pub fn mean_line_load(&self) -> f64 {
        self.force_n / self.line.length_mm()
    }

    /// The plane scene under the mean line load, without sticking and with nothing that a section of a line does not have.
    pub(crate) fn plane(&self) -> Scene {
        let mut section = self.section.clone();
        section.accuracy.tuning.sufficient_cycles = SUFFICIENT_CYCLES;
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

    /// Checks the scene, and that all of a contact of a half-width in mm slips in each stroke.
    ///
    /// # Errors
    /// A value outside of its range, a law or a motion that stations do not have, a contact that may stick.
    pub fn check_all(&self, half_width: f64) -> Result<(), StationError> {
        self.check()?;
        self.check_slip(&self.plane(), half_width)
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
        let wear = self.section.surface_wear();
        for side in Side::BOTH {
            if wear.of(side).is_some_and(|wear| wear.dose_rate().is_none()) {
                return Err(StationError::Law { side: side.name() });
            }
        }
        Ok(())
    }

    /// Checks that all of the contact slips in each stroke.
    pub(super) fn check_slip(&self, plane: &Scene, half_width: f64) -> Result<(), StationError> {
        let free = Scene {
            effects: self.section.effects.clone(),
            ..plane.clone()
        };
        if resolution::sticks(&free, half_width) {
            return Err(StationError::Sticks {
                amplitude_mm: plane.motion.amplitude_mm().abs(),
                least_mm: 2.0 * resolution::gross_slip(&free, half_width),
            });
        }
        Ok(())
    }
}
