//! Skew of a scar toward the last pass.
//!
//! A computed cycle wears with its whole jump first in the pass toward -x, then in that toward +x, where the cycles that it
//! represents pass in turn. This splitting skews the surfaces that it leaves, S_R, toward the last pass by a depth a of first
//! order in the jump. Those between the passes, S_L, are skewed by -a, so that with the surfaces before the cycle, S_0,
//!   a = ((S_0 + S_R)/2 - S_L)/2,
//! and S_R - a is of second order, as the mean of both orders of a split step is (Strang 1963). Single cycles are skewed in
//! truth, by 1/jump of it. A scar is skewed by a thousandth of its depth, the pressure by a tenth of its peak: the contact
//! indents the scar by that little.

use serde::{Deserialize, Serialize};

use crate::number::real_cycles;
use crate::sides::{Side, Sides};

/// Equivalent depth by which both surfaces are skewed toward the last pass.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct Skew {
    /// At the contact nodes, mm.
    depth: Sides<Vec<f64>>,
    /// The jump that it belongs to.
    pub(super) jump: f64,
}

/// Equivalents of the worn depths at the turning points of a computed cycle, mm.
#[derive(Debug)]
pub(super) struct Passes {
    before: Sides<Vec<f64>>,
    /// At the leftmost position.
    pub(super) between: Option<Sides<Vec<f64>>>,
}

impl Passes {
    /// Before the first pass.
    pub(super) fn begin(before: Sides<Vec<f64>>) -> Self {
        Self {
            before,
            between: None,
        }
    }
}

impl Skew {
    /// Returns `true` if surfaces are skewed more than those of single cycles after one of so many cycles.
    pub(super) fn remains_after(&self, jump: u64) -> bool {
        jump > 1 || self.jump > 1.0
    }

    /// Updates the skew with the equivalents of the worn depths before, between and after the passes of a computed cycle of a jump. The skew of
    /// a longer jump before lasts: a shorter one replaces the part of it that is its part of that jump.
    pub(super) fn update(&mut self, passes: &Passes, after: &Sides<Vec<f64>>, jump: u64) {
        let Some(between) = &passes.between else {
            return;
        };
        let jump = real_cycles(jump);
        let part = jump / self.jump.max(jump);
        self.jump += part * (jump - self.jump);
        let excess = 1.0 - 1.0 / jump;
        for side in Side::BOTH {
            let skew = self.depth.of_mut(side);
            skew.resize(after.of(side).len(), 0.0);
            let ends = passes.before.of(side).iter().zip(after.of(side));
            let depths = ends.zip(between.of(side));
            for (skew, ((before, after), between)) in skew.iter_mut().zip(depths) {
                let present = 0.5 * excess * (0.5 * (before + after) - between);
                *skew += part * (present - *skew);
            }
        }
    }

    /// Equivalents without the skew, mm.
    pub(super) fn removed_from(&self, depth: &Sides<Vec<f64>>) -> Sides<Vec<f64>> {
        Sides::from_fn(|side| {
            let skewed = depth.of(side).iter().zip(self.depth.of(side));
            skewed.map(|(depth, skew)| depth - skew).collect()
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn depths(receptacle: [f64; 2]) -> Sides<Vec<f64>> {
        Sides {
            slider: vec![0.0],
            receptacle: receptacle.to_vec(),
        }
    }

    /// Updates a skew with the receptacle's depths before, between and after the passes; returns those after them.
    fn update(skew: &mut Skew, depth: [[f64; 2]; 3], jump: u64) -> Sides<Vec<f64>> {
        let [before, between, after] = depth.map(depths);
        let passes = Passes {
            before,
            between: Some(between),
        };
        skew.update(&passes, &after, jump);
        after
    }

    #[test]
    fn surfaces_that_the_passes_skew_in_turn_are_unskewed() {
        // 10 a cycle, skewed by 1 toward the last pass.
        let mut skew = Skew::default();
        let depth = [[11.0, 9.0], [14.0, 16.0], [21.0, 19.0]];
        let after = update(&mut skew, depth, 1_000_000);
        for depth in skew.removed_from(&after).receptacle {
            assert!((depth - 20.0).abs() < 1e-5, "{depth}");
        }
    }

    #[test]
    fn single_cycles_are_skewed_in_truth() {
        let mut skew = Skew::default();
        let after = update(&mut skew, [[11.0, 9.0], [14.0, 16.0], [21.0, 19.0]], 1);
        assert_eq!(skew.removed_from(&after), after);
        assert!(!skew.remains_after(1) && skew.remains_after(2));
    }

    #[test]
    fn the_skew_of_a_long_jump_lasts_through_short_ones() {
        let mut skew = Skew::default();
        update(
            &mut skew,
            [[101.0, 99.0], [149.0, 151.0], [201.0, 199.0]],
            100,
        );
        let before = skew.depth.receptacle[0];
        // Two cycles that wear evenly.
        update(
            &mut skew,
            [[201.0, 199.0], [202.0, 200.0], [203.0, 201.0]],
            2,
        );
        let after = skew.depth.receptacle[0];
        assert!((after / before - 0.98).abs() < 1e-12, "{before} {after}");
        assert!(skew.remains_after(1));
    }
}
