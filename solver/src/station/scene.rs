//! Input of a run of stations.

use super::error::StationError;
use super::place::places;
use super::spacing;
use crate::along_line::{SectionsError, check_section, check_slip};
use crate::closed_form::line_contact::{Touch, touch};
use crate::law::elastic::contact_modulus;
use crate::number::{nearest, positive, real};
use crate::scene::Effect;
use crate::scene::{Accuracy, Dimension, Drive, Line, LineShape, Scene, Top};

/// A contact along a line.
#[derive(Debug, Clone, PartialEq)]
pub struct StationScene {
    /// The plane section, with its motion along x; its line load is not used.
    pub section: Scene,
    /// The line.
    pub line: LineShape,
    /// Support of the sections.
    pub top: Top,
    /// Normal force F on the whole line, N.
    pub force_n: f64,
    /// Number of stations along the half ring, the half of a straight line or all of one with a tilt, with both ends.
    pub stations: usize,
}

/// Stations along half of a line that suffice for a tolerance: under a rigid top depths at 1 000 cycles of the thesis' ring are 15.81, 15.93
/// and 15.97 um with 9, 17 and 33 of them.
pub(crate) fn stations_for(tolerance: f64) -> usize {
    match tolerance {
        coarse if coarse > 0.03 => 9,
        medium if medium > 0.01 => 17,
        _ => 33,
    }
}

/// Fewest stations of a line whose sections differ, and of one whose sections are all alike.
const FEWEST: usize = 3;
const ALIKE: usize = 2;
/// Fewest intervals along the unworn contact of a crown or a tilt from where it touches first, whatever the tolerance: of four the trapezoidal
/// sum of a parabola is 1 % low, of two 6 %.
const FEWEST_WITHIN: usize = 2;

/// Intervals along the unworn contact of a crown or a tilt from where it touches first.
pub(super) fn intervals_within(accuracy: &Accuracy) -> usize {
    let chosen = stations_for(accuracy.tolerance) / 2;
    nearest(accuracy.refinement.mesh * real(chosen)).max(FEWEST_WITHIN)
}

/// Stations of a line with an unworn contact: given or by the tolerance, and refined with the mesh to an odd number, which has one in the middle.
fn stations_of(line: &Line, touch: Touch, accuracy: &Accuracy) -> usize {
    if line.stations.is_none() && line.shape.is_even() {
        return ALIKE;
    }
    let chosen = line
        .stations
        .unwrap_or_else(|| stations_for(accuracy.tolerance));
    let half = 0.5 * real(chosen.saturating_sub(1));
    let [unrefined, refined] = [half, accuracy.refinement.mesh * half].map(nearest);
    let chosen = if refined == unrefined {
        chosen
    } else {
        (2 * refined + 1).max(FEWEST)
    };
    if line.stations.is_some() {
        return chosen;
    }
    chosen.max(needed(line.shape, touch, intervals_within(accuracy)))
}

/// Stations that a straight line needs so that so many intervals lie in its unworn contact; 0 of a ring.
fn needed(shape: LineShape, touch: Touch, within: usize) -> usize {
    let LineShape::Straight { .. } = shape else {
        return 0;
    };
    let (left, right) = spacing::sides(shape, touch.at_mm);
    let sides = [left, right].map(|length| spacing::intervals(length, touch.length_mm, within));
    sides[0] + sides[1] + 1
}

/// `Tuning::sufficient_cycles` of sections: the jumps of one that slides mostly along the line, or whose scar is about as wide as its stroke,
/// bound those of all. On the thesis' ring under a rigid top at 2 %, 2.5, 1 and 0.5 take 141, 77 and 56 computed cycles to cycle 1 000; the
/// depth differs by 0.3 %, the volume by 0.4 and 0.8 %.
const SUFFICIENT_CYCLES: f64 = 1.0;

/// Least load that meshes are chosen for over the largest one of the unworn contact. Arbitrary: of a contact that has grown to ten times its
/// length.
const PART_OF_LARGEST: f64 = 0.1;

impl StationScene {
    /// The contact along a line of a scene; `None` for another one.
    pub fn of(scene: &Scene) -> Option<Self> {
        let line = scene.dimension.line()?;
        let mut own = Self {
            stations: 0,
            section: Scene {
                dimension: Dimension::PlaneStrain,
                ..scene.clone()
            },
            line: line.shape,
            top: line.top,
            force_n: line.force_n,
        };
        own.stations = stations_of(line, own.touch(), &scene.accuracy);
        Some(own)
    }

    /// The unworn contact.
    pub(super) fn touch(&self) -> Touch {
        let (slider, receptacle) = (self.section.slider.elastic, self.section.receptacle.elastic);
        touch(self.line, self.force_n, contact_modulus(slider, receptacle))
    }

    /// Returns `true` if line loads that differ along the line change the heights of its sections against each other. Of a ring under a rigid top
    /// lifts are below 3e-5 of its depth (`coupling`).
    pub(super) fn is_coupled(&self) -> bool {
        match self.top {
            Top::Even => false,
            Top::Rigid => matches!(self.line, LineShape::Straight { .. }) && !self.line.is_even(),
            Top::Pressure => !self.line.is_even(),
        }
    }

    /// Number of stations within a distance in mm from the place that touches first.
    pub(crate) fn stations_within(&self, mm: f64) -> usize {
        let touch = self.touch();
        let within = intervals_within(&self.section.accuracy);
        let places = places(self.line, self.stations, touch, within).into_iter();
        let along = places.map(|place| place.along_mm());
        along.filter(|z| (z - touch.at_mm).abs() <= mm).count()
    }

    /// Mean line load F/L, N/mm.
    pub(crate) fn mean_line_load(&self) -> f64 {
        self.force_n / self.line.length_mm()
    }

    /// The line load that meshes are chosen for, N/mm: the mean, or, where a short contact carries far more under a rigid top, a part of that.
    fn meshed_line_load(&self) -> f64 {
        let mean = self.mean_line_load();
        match self.top {
            Top::Even => mean,
            Top::Rigid | Top::Pressure => mean.max(PART_OF_LARGEST * self.touch().line_load),
        }
    }

    /// The plane scene under about the mean line load, without sticking and with nothing that a section of a line does not have.
    pub(crate) fn plane(&self) -> Scene {
        let mut section = self.section.clone();
        section.accuracy.tuning.sufficient_cycles = SUFFICIENT_CYCLES;
        Scene {
            load_n_per_mm: self.meshed_line_load(),
            effects: section.effects.clone().with(Effect::StickMemory, false),
            ..section
        }
    }

    /// Checks the scene, and that all of its contact slips in each stroke.
    ///
    /// # Errors
    /// A value outside of its range, a law or a motion that stations do not have, a contact that may stick.
    pub fn check_all(&self) -> Result<(), StationError> {
        self.check()?;
        let least = needed(self.line, self.touch(), FEWEST_WITHIN);
        if self.stations < least && !self.line.is_even() {
            return Err(StationError::Spacing {
                stations: self.stations,
                least,
            });
        }
        Ok(self.check_slip(&self.plane())?)
    }

    /// Checks the scene.
    ///
    /// # Errors
    /// A value outside of its range, a law or a motion that stations do not have.
    pub(super) fn check(&self) -> Result<(), StationError> {
        let amplitude = check_section(&self.section)?;
        let size = match self.line {
            LineShape::Ring { radius_mm, .. } => radius_mm,
            LineShape::Straight {
                width_mm,
                crown_radius_mm,
                ..
            } => crown_radius_mm.map_or(width_mm, |radius| radius.min(width_mm)),
        };
        positive(self.force_n, StationError::ForceRange)?;
        positive(size, StationError::LengthRange)?;
        if let LineShape::Ring { radius_mm, .. } = self.line
            && amplitude >= radius_mm
        {
            return Err(StationError::Amplitude {
                amplitude_mm: amplitude,
                radius_mm,
            });
        }
        let half_block = 0.5 * self.section.receptacle.shape.length_mm;
        // Waves around a ring belong to one ring of matter: the section below its wire, turned around its axis.
        if let LineShape::Ring { radius_mm, .. } = self.line
            && self.is_coupled()
            && half_block > radius_mm
        {
            return Err(StationError::BeyondAxis {
                half_block_mm: half_block,
                radius_mm,
            });
        }
        if self.stations < 2 {
            return Err(StationError::Stations {
                stations: self.stations,
            });
        }
        if self.top != Top::Even && self.section.drive != Drive::Handle {
            return Err(StationError::Drive);
        }
        Ok(())
    }

    /// Checks that all of the contact slips in each stroke.
    pub(super) fn check_slip(&self, plane: &Scene) -> Result<(), SectionsError> {
        // The most loaded section sticks longest.
        let line_load = match self.top {
            Top::Even => self.mean_line_load(),
            Top::Rigid | Top::Pressure => self.touch().line_load,
        };
        check_slip(&Scene {
            effects: self.section.effects.clone(),
            load_n_per_mm: line_load,
            ..plane.clone()
        })
    }
}
