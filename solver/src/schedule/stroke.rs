//! Stroke of a contact, and how far it limits a jump.

use crate::number::real_cycles;
use crate::scene::{Accuracy, Motion, Scene, Table, Tuning};
use crate::sides::Sides;

/// A computed cycle wears `jump` passes at once, so that scar and pressure are skewed toward the last pass, the
/// pressure by about a third of k jump s E*/b (b: half-width, s: stroke), which stays below this.
fn largest_skew(accuracy: &Accuracy) -> f64 {
    let tuning = &accuracy.tuning;
    tuning.skew.at(accuracy.tolerance).max(tuning.least_skew)
}

/// The same over the tolerance where the skew is not removed from what is reported. Measured with an inner loop in `McColl`'s scar: the
/// pressure is off by 9.7 % for 0.29 and by 2.6 % for 0.06.
const REPORTED_SKEW: f64 = 2.0;

/// Largest relative change of a coefficient of friction by cycle within a jump, over the tolerance. A jump takes the mean of its
/// cycles, so that energy and wear are exact to the second order in it, and the reported contact is off by half of it.
const CHANGE_OF_FRICTION: f64 = 1.0;

/// Passes of a cycle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Passes {
    /// One to either side.
    Whole,
    /// Several of different lengths: no skew of a jump is removed from what is reported.
    Unequal,
}

/// Movement of a contact.
#[derive(Debug, Clone, Copy)]
pub(crate) struct Movement {
    /// Amplitude, mm.
    pub(crate) amplitude: f64,
    /// Half-width of the contact, mm.
    pub(crate) half_width: f64,
    /// Part of the displacement by which the contact travels over the receptacle.
    pub(crate) travel: f64,
    /// A part of the contact may stick.
    pub(crate) sticks: bool,
}

/// Limits of a jump besides its error.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Stroke {
    /// Gross reciprocating sliding: the contact leaves its own width.
    pub(crate) gross: bool,
    /// k E*, by which a pass wears off the waves that earlier increments have left; 0 where the slider wears too.
    pub(crate) smoothing: f64,
    /// Only the receptacle wears, in a groove that is longer than the contact: jumps extrapolate single cycles.
    pub(crate) is_groove: bool,
    /// Both bodies wear, or one whose wear is in no proportion to the pressure.
    pub(super) both: bool,
    /// Factor on the allowed error of a jump.
    pub(super) error_factor: f64,
    pub(super) passes: Passes,
    /// Pressure skew of a single cycle, k s E*/b.
    pub(crate) skew: f64,
    /// Cycles of the whole run.
    pub(super) cycles: u64,
    /// Cycles within which the coefficient of friction changes by as much as it may in a jump.
    pub(super) even_friction: f64,
}

impl Stroke {
    /// The stroke of a movement, for the wear rates k_s, k_r in 1/MPa and E* in MPa.
    pub(crate) fn new(
        tuning: &Tuning,
        rates: Sides<f64>,
        modulus: f64,
        movement: Movement,
        cycles: u64,
    ) -> Self {
        let Movement {
            amplitude,
            half_width,
            travel,
            sticks,
        } = movement;
        let wear = rates.slider + rates.receptacle;
        let only_receptacle = rates.slider <= 0.0 && rates.receptacle > 0.0;
        let gross = tuning.is_gross(amplitude, half_width);
        Self {
            gross,
            smoothing: if only_receptacle { wear * modulus } else { 0.0 },
            is_groove: only_receptacle && tuning.is_gross(amplitude * travel, half_width),
            both: rates.slider > 0.0 && rates.receptacle > 0.0,
            error_factor: if gross || sticks || amplitude <= 0.0 {
                1.0
            } else {
                tuning.scar_jump_error
            },
            passes: Passes::Whole,
            skew: wear * 2.0 * amplitude * modulus / half_width,
            cycles,
            even_friction: f64::INFINITY,
        }
    }

    /// The stroke of a body whose wear is in no proportion to the pressure: the step of a jump lowers the pressure of a longer contact,
    /// which leaves the wear of other laws as it is.
    #[must_use]
    pub(crate) fn of_uneven_wear(self) -> Self {
        Self { both: true, ..self }
    }

    /// Returns `true` if one cycle reshapes the contact of two bodies that wear.
    pub(crate) fn reshapes_both(self) -> bool {
        self.both && self.skew > 1.0
    }

    /// Limits jumps from a number of cycles on by the change of a coefficient of friction by cycle.
    pub(crate) fn limit_change_of_friction(&mut self, scene: &Scene, done: u64) {
        let tolerance = scene.accuracy.tolerance;
        self.even_friction = even_friction(scene.friction.by_cycle(), tolerance, done);
    }

    /// One that turns between its outermost turning points: several passes of different lengths wear the groove, which the
    /// extrapolation of two whole ones does not describe.
    #[must_use]
    pub(crate) fn turning_inside(self, motion: Motion) -> Self {
        let amplitude = motion.amplitude_mm().abs();
        Self {
            // Half of the path is passed to either side.
            skew: self.skew * motion.distance_per_cycle_mm() / (4.0 * amplitude),
            smoothing: 0.0,
            is_groove: false,
            passes: Passes::Unequal,
            ..self
        }
    }

    /// Largest estimated error of a jump.
    pub(super) fn largest_error(self, accuracy: &Accuracy) -> f64 {
        let Accuracy {
            tolerance, tuning, ..
        } = accuracy;
        tolerance * self.error_factor * tuning.jump_error.at(*tolerance).max(1.0)
    }

    /// The largest jump after `done` cycles.
    pub(super) fn most(self, accuracy: &Accuracy, done: u64) -> f64 {
        let Accuracy {
            tolerance, tuning, ..
        } = accuracy;
        let done = real_cycles(done);
        let most = if self.gross {
            let share = if self.both {
                tuning.gross_jump_of_both
            } else if self.is_groove {
                tuning.groove_jump_of_done
            } else {
                tuning.gross_jump_of_done
            };
            (share * tolerance).min(tuning.jump_of_done) * done
        } else {
            let sufficient = real_cycles(self.cycles) * tolerance / tuning.sufficient_cycles;
            let unskewed = largest_skew(accuracy) / self.skew.max(f64::MIN_POSITIVE);
            let tolerated = REPORTED_SKEW * tolerance / self.skew.max(f64::MIN_POSITIVE);
            let most = if self.passes == Passes::Unequal && tolerated >= 1.0 {
                tolerated
            } else {
                unskewed.max(sufficient)
            };
            (tuning.jump_of_done * done).min(most)
        };
        most.min(self.even_friction) / accuracy.refinement.cycles
    }
}

/// Cycles after so many within which a coefficient of friction by cycle changes by as much as it may in a jump of a tolerance; without
/// bound where places differ in it.
pub(crate) fn even_friction(by_cycle: Option<&Table>, tolerance: f64, done: u64) -> f64 {
    let part = CHANGE_OF_FRICTION * tolerance;
    by_cycle.map_or(f64::INFINITY, |table| {
        table.distance_of_change(real_cycles(done), part)
    })
}
