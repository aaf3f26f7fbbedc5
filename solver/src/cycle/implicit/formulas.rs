//! Formula of a jump, node by node.
//!
//! That of two steps takes a part of the dose from the jump before. Where a fast layer comes to lie open, the dose of the slow one above it
//! would dig a hole which no pressure, of one sign, fills again: only the dose of the present layer in the jump before counts, and it wears no more than
//! what is left of that layer. The shapes at the end take what is lost by that, so that a side takes the work of all cycles.

use super::dose_laws::DoseLaws;
use crate::linear::vector::dot;
use crate::schedule::jump::Formula;
use crate::schedule::jump::implicit::{LastJump, two_steps};
use crate::sides::{Side, Sides};

/// A jump from these surfaces.
#[derive(Clone, Copy)]
pub(super) struct JumpFrom<'a> {
    pub(super) laws: &'a DoseLaws,
    /// Doses so far and of one cycle, MPa mm.
    pub(super) dose: &'a Sides<Vec<f64>>,
    pub(super) of_cycle: &'a Sides<Vec<f64>>,
    /// Widths of the nodes, mm.
    pub(super) widths: Sides<&'a [f64]>,
    /// Depths, mm.
    pub(super) depth: &'a Sides<Vec<f64>>,
    /// Cycles of the jump.
    pub(super) cycles: f64,
    /// The jump before, if the formula of two steps serves.
    pub(super) last: Option<LastJump<'a>>,
}

/// A dose at the end of a jump is a known part and that of some cycles on the shapes there.
pub(super) struct Formulas {
    pub(super) formula: Formula,
    /// Known parts of the doses, MPa mm.
    pub(super) known: Sides<Vec<f64>>,
    /// Cycles on the last shapes.
    pub(super) cycles: Sides<f64>,
}

impl Formulas {
    /// The formula of two steps, or Euler's without a jump before.
    pub(super) fn new(from: JumpFrom<'_>) -> Self {
        let (dose, cycles) = (from.dose, from.cycles);
        let (formula, weight) = two_steps(from.last.map(|last| last.cycles), cycles);
        let Some(last) = from.last else {
            return Self {
                formula,
                known: dose.clone(),
                cycles: Sides::from_fn(|_| cycles),
            };
        };
        let share = cycles / last.cycles * (1.0 - weight);
        let known = Sides::from_fn(|side| from.known(side, last, share));
        let on_last = Sides::from_fn(|side| {
            let work = |doses: &[f64]| dot(doses, from.widths.of(side));
            let of_cycle = work(from.of_cycle.of(side));
            let grown = work(known.of(side)) - work(dose.of(side));
            if of_cycle > 0.0 {
                cycles - grown / of_cycle
            } else {
                cycles * weight
            }
        });
        Self {
            formula,
            known,
            cycles: on_last,
        }
    }
}

impl JumpFrom<'_> {
    /// Known parts of the doses of a side with a share of those of the jump before, MPa mm.
    fn known(&self, side: Side, last: LastJump<'_>, share: f64) -> Vec<f64> {
        let in_last = last.cycles / self.laws.rate(side).max(f64::MIN_POSITIVE);
        let nodes = self.dose.of(side).iter().zip(self.depth.of(side));
        let nodes = nodes.zip(*last.rates.of(side));
        let known = nodes.map(|((dose, depth), rate)| {
            let layer = self.laws.layer(side, *depth);
            let in_layer = (in_last * rate).min(dose - layer.start);
            dose + (share * in_layer).min(layer.end - dose).max(0.0)
        });
        known.collect()
    }
}
