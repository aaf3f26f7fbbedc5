//! Jumps that are implicit in the worn shapes, on a surrogate: the run's own control, with the error of the surrogate's mean wear against the
//! trapezoidal rule.

use super::surrogate::Scar;
use crate::cycle::implicit_jumps_are_possible;
use crate::effects;
use crate::model::Tangential;
use crate::number::real_cycles;
use crate::scene::{Accuracy, Effect, Scene};
use crate::schedule::jump::implicit::{ImplicitWear, two_steps};
use crate::schedule::jump::{Formula, JumpControl};
use crate::schedule::stroke::Stroke;
use crate::sides::{Side, Sides};

/// For each block of a mission, or for the whole run, `true` if its jumps may be implicit.
pub(super) fn of_blocks(scene: &Scene) -> Vec<bool> {
    let plan = effects::plan(scene);
    let heats = plan.simulates(Effect::FrictionalHeating) || plan.simulates(Effect::JouleHeating);
    let tangential = Tangential::of(&plan);
    let blocks = scene.blocks();
    let are_possible = blocks
        .iter()
        .map(|block| !heats && implicit_jumps_are_possible(block, tangential));
    are_possible.collect()
}

/// An implicit jump.
pub(super) struct ImplicitStep {
    /// Cycles.
    pub(super) jump: u64,
    formula: Formula,
    /// Wear of the next cycle before it, mm.
    first: Sides<Vec<f64>>,
}

impl ImplicitStep {
    /// The next one of a control, never beyond `remaining`; `None` where single cycles are computed.
    pub(super) fn next(
        control: &mut JumpControl,
        scar: &Scar,
        accuracy: &Accuracy,
        stroke: Stroke,
        remaining: u64,
    ) -> Option<Self> {
        let before = control.clone();
        let jump = control.next_implicit(accuracy, stroke, remaining);
        if jump <= 1 {
            *control = before;
            return None;
        }
        let last = control.last_implicit().map(|last| last.cycles);
        let (formula, _) = two_steps(last, real_cycles(jump));
        Some(Self {
            jump,
            formula,
            first: scar.of_cycle(),
        })
    }

    /// Wear of so many cycles from these depths in mm, which the scar has worn.
    pub(super) fn wear(self, scar: &Scar, before: &Sides<Vec<f64>>, done: u64) -> ImplicitWear {
        let rates = scar.mean_since(before, done);
        let last = scar.of_cycle();
        let (mut area, mut error) = (0.0, 0.0);
        for side in Side::BOTH {
            let ends = self.first.of(side).iter().zip(last.of(side));
            let nodes = rates.of(side).iter().zip(ends);
            for ((mean, (first, last)), width) in nodes.zip(*scar.widths().of(side)) {
                area += width * mean;
                error += width * (mean - 0.5 * (first + last)).abs();
            }
        }
        ImplicitWear {
            formula: self.formula,
            rates,
            error: if area > 0.0 { error / area } else { 0.0 },
            area,
        }
    }
}
