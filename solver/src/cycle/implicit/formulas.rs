//! Formula of a jump, node by node.
//!
//! The formula of two steps takes a part of the dose from the jump before. Where a fast layer comes to lie open, the dose of the slow one above it
//! would dig a hole which no pressure, of one sign, fills again: only the dose since then in the jump before counts, and it wears no more than what is
//! left above the next faster layer. The shapes at the end take what is lost by that, so that both sides take the work of all cycles.

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
    /// The jump before, if it was implicit.
    pub(super) last: Option<LastJump<'a>>,
}

/// A dose at the end of a jump is a known part and that of some cycles on the shapes there.
pub(super) struct Formulas {
    pub(super) formula: Formula,
    /// Known parts of the doses, MPa mm.
    pub(super) known: Sides<Vec<f64>>,
    /// Cycles on the last shapes.
    pub(super) cycles: f64,
}

impl Formulas {
    /// The formula of two steps, or Euler's without a jump before.
    pub(super) fn new(from: JumpFrom<'_>) -> Self {
        let (dose, cycles) = (from.dose, from.cycles);
        let (formula, weight) = two_steps(from.last.map(|last| last.cycles), cycles);
        let Some(last) = from.last.filter(|_| formula == Formula::TwoSteps) else {
            return Self {
                formula,
                known: dose.clone(),
                cycles,
            };
        };
        let share = cycles / last.cycles * (1.0 - weight);
        let taken = Sides::from_fn(|side| from.taken(side, last, share));
        let work = |side, doses: &[f64]| dot(doses, from.widths.of(side));
        let works = Sides::from_fn(|side| work(side, taken.of(side)));
        let worn = Side::BOTH
            .into_iter()
            .filter(|side| *from.laws.wears().of(*side));
        // Both sides take the work of the cycles: that of the side which loses more.
        let least = worn
            .clone()
            .map(|side| *works.of(side))
            .fold(f64::INFINITY, f64::min);
        let of_cycle = worn
            .map(|side| work(side, from.of_cycle.of(side)))
            .fold(0.0, f64::max);
        let known = Sides::from_fn(|side| {
            let part = least / works.of(side).max(f64::MIN_POSITIVE);
            let nodes = dose.of(side).iter().zip(taken.of(side));
            nodes
                .map(|(dose, taken)| dose + part.min(1.0) * taken)
                .collect()
        });
        Self {
            formula,
            known,
            cycles: if of_cycle > 0.0 {
                cycles - least / of_cycle
            } else {
                cycles * weight
            },
        }
    }
}

impl JumpFrom<'_> {
    /// Doses that a side takes from a share of those of the jump before, MPa mm.
    fn taken(&self, side: Side, last: LastJump<'_>, share: f64) -> Vec<f64> {
        let in_last = last.cycles / self.laws.rate(side).max(f64::MIN_POSITIVE);
        let nodes = self.dose.of(side).iter().zip(self.depth.of(side));
        let nodes = nodes.zip(*last.rates.of(side));
        let taken = nodes.map(|((dose, depth), rate)| {
            let layers = self.laws.without_faster(side, *depth);
            let in_layers = (in_last * rate).min(dose - layers.start);
            (share * in_layers).min(layers.end - dose).max(0.0)
        });
        taken.collect()
    }
}
