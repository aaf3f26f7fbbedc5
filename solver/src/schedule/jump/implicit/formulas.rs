//! Formula of a jump, place by place of both surfaces.
//!
//! The formula of two steps takes a part of the dose from the jump before. Where a fast layer comes to lie open, the dose of the slow one above it
//! would dig a hole which no pressure, of one sign, fills again: only the dose since then in the jump before counts, and it wears no more than what is
//! left above the next faster layer. The shapes at the end take what is lost by that, so that both sides take the work of all cycles.

use super::{LastJump, two_steps};
use crate::law::dose_laws::DoseLaws;
use crate::linear::vector::dot;
use crate::schedule::jump::Formula;
use crate::sides::{Side, Sides};

/// A jump from these surfaces.
pub(crate) struct JumpFrom<'a> {
    pub(crate) laws: &'a DoseLaws,
    /// Doses so far and of one cycle, MPa mm.
    pub(crate) dose: &'a Sides<Vec<f64>>,
    pub(crate) of_cycle: &'a Sides<Vec<f64>>,
    /// Widths or areas of the places, of one unit.
    pub(crate) sizes: Sides<&'a [f64]>,
    /// Depths, mm.
    pub(crate) depth: &'a Sides<Vec<f64>>,
    /// Cycles of the jump.
    pub(crate) cycles: f64,
    /// The jump before, if it was implicit.
    pub(crate) last: Option<LastDoses>,
}

/// Doses of the jump before.
pub(crate) struct LastDoses {
    /// Cycles.
    pub(crate) cycles: f64,
    /// Doses of all of them, MPa mm.
    pub(crate) dose: Sides<Vec<f64>>,
}

/// A dose at the end of a jump is a known part and that of some cycles on the shapes there.
pub(crate) struct Formulas {
    pub(crate) formula: Formula,
    /// Known parts of the doses, MPa mm.
    pub(crate) known: Sides<Vec<f64>>,
    /// Cycles on the last shapes.
    pub(crate) cycles: f64,
}

impl Formulas {
    /// The formula of two steps, or Euler's without a jump before.
    pub(crate) fn new(from: &JumpFrom<'_>) -> Self {
        let (dose, cycles) = (from.dose, from.cycles);
        let (formula, weight) = two_steps(from.last.as_ref().map(|last| last.cycles), cycles);
        let last = from.last.as_ref().filter(|_| formula == Formula::TwoSteps);
        let Some(last) = last else {
            return Self {
                formula,
                known: dose.clone(),
                cycles,
            };
        };
        let share = cycles / last.cycles * (1.0 - weight);
        let taken = Sides::from_fn(|side| from.taken(side, last.dose.of(side), share));
        let work = |side, doses: &[f64]| dot(doses, from.sizes.of(side));
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
            let places = dose.of(side).iter().zip(taken.of(side));
            places
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

impl LastDoses {
    /// By the rates of a jump; `None` without one for each of so many places of both sides.
    pub(crate) fn of(last: LastJump<'_>, laws: &DoseLaws, places: Sides<usize>) -> Option<Self> {
        let is_of = |side: &Side| last.rates.of(*side).len() == *places.of(*side);
        Side::BOTH.iter().all(is_of).then(|| Self {
            cycles: last.cycles,
            dose: Sides::from_fn(|side| {
                let cycles = last.cycles / laws.rate(side).max(f64::MIN_POSITIVE);
                let rates = last.rates.of(side).iter();
                rates.map(|rate| cycles * rate).collect()
            }),
        })
    }
}

impl JumpFrom<'_> {
    /// Doses that a side takes from a share of those of the jump before, MPa mm.
    fn taken(&self, side: Side, last: &[f64], share: f64) -> Vec<f64> {
        let places = self.dose.of(side).iter().zip(self.depth.of(side));
        let taken = places.zip(last).map(|((dose, depth), last)| {
            let layers = self.laws.without_faster(side, *depth);
            let in_layers = last.min(dose - layers.start);
            (share * in_layers).min(layers.end - dose).max(0.0)
        });
        taken.collect()
    }
}
