//! Wear of the strokes of a computed cycle, as equivalent depth.

use super::{CycleState, Integrator};
use crate::law::surface;
use crate::number::real_cycles;
use crate::sides::Sides;

impl Integrator<'_> {
    /// Equivalents of the depths of both surfaces, mm.
    pub(super) fn equivalents(&self, depth: &Sides<Vec<f64>>) -> Sides<Vec<f64>> {
        let wear = self.wear;
        Sides::from_fn(|side| surface::equivalents(*wear.of(side), depth.of(side)).into_owned())
    }

    /// Wear of the receptacle since these depths, mm, over a number of cycles, as equivalent depth.
    pub(super) fn wear_per_cycle(
        &self,
        state: &CycleState,
        before: &[f64],
        cycles: u64,
    ) -> Vec<f64> {
        let wear = self.wear.receptacle;
        let [after, before] =
            [&state.depth.receptacle, before].map(|depth| surface::equivalents(wear, depth));
        let worn = after.iter().zip(&before[..]);
        worn.map(|(after, before)| (after - before) / real_cycles(cycles))
            .collect()
    }
}
