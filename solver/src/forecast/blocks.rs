//! Surrogates for what each block of a mission wears; a single one without a mission. Their depths add up.

use super::surrogate::Scar;
use crate::ale;
use crate::closed_form::unworn_contact;
use crate::model::Layout;
use crate::number::real_cycles;
use crate::scene::{Motion, Scene};
use crate::schedule::jump::JumpControl;
use crate::schedule::stops::{self, StopQuantities};
use crate::sides::{Side, Sides};

/// A block with its own scar.
pub(super) struct Block {
    pub(super) motion: Motion,
    pub(super) scar: Scar,
    pub(super) jump: JumpControl,
}

/// The blocks of a run.
pub(super) struct WornBlocks {
    pub(super) blocks: Vec<Block>,
    /// Cycles of each block in one repetition.
    cycles: Vec<f64>,
    /// Heights of the bodies when their operators were built, and unworn, mm.
    built: Sides<f64>,
    heights: Sides<f64>,
}

impl WornBlocks {
    pub(super) fn new(scene: &Scene, layout: &Layout) -> Self {
        let heights = Sides {
            slider: scene.slider.shape.height_mm,
            receptacle: scene.receptacle.shape.height_mm,
        };
        let blocks = scene.blocks();
        let hertz = layout.sizes.hertz_half_width;
        let of_block = |scene: &Scene| Block {
            motion: scene.motion,
            scar: Scar::new(
                scene,
                layout,
                layout.sizes.sticks && unworn_contact::sticks(scene, hertz),
            ),
            jump: JumpControl::default(),
        };
        Self {
            cycles: blocks
                .iter()
                .map(|block| real_cycles(block.cycles))
                .collect(),
            blocks: blocks.iter().map(|block| of_block(block)).collect(),
            built: heights,
            heights,
        }
    }

    /// Returns `true` if the run ends after so many cycles.
    pub(super) fn is_done(&self, scene: &Scene, block: usize, cycle: u64) -> bool {
        let depth = |side, part| self.depth_of_part(side, part);
        stops::end(scene, self.progress(block, cycle), depth).is_some()
    }

    /// Depth that a part of a side's scar has at least, mm.
    pub(super) fn depth_of_part(&self, side: Side, part: f64) -> f64 {
        let depths = self
            .blocks
            .iter()
            .map(|block| block.scar.depth_of_part(side, part));
        depths.sum()
    }

    /// Progress of the forecast run in a block for its stops.
    pub(super) fn progress(&self, block: usize, cycle: u64) -> StopQuantities {
        self.progress_at(self.blocks[block].fastest_rate(), cycle)
    }

    /// The same at the mean rate of all blocks.
    pub(super) fn mean_progress(&self, cycle: u64) -> StopQuantities {
        let total: f64 = self.cycles.iter().sum();
        let rates = Sides::from_fn(|side| {
            let blocks = self.blocks.iter().zip(&self.cycles);
            let sum: f64 = blocks
                .map(|(block, cycles)| cycles * block.fastest_rate().of(side))
                .sum();
            sum / total
        });
        self.progress_at(rates, cycle)
    }

    /// The same at rates of each side, mm a cycle.
    fn progress_at(&self, rates: Sides<f64>, cycle: u64) -> StopQuantities {
        let left = self.remaining();
        let shares = left.zip(self.heights).map(|(left, height)| left / height);
        let cycles = left
            .zip(rates)
            .map(|(left, rate)| left / rate.max(f64::MIN_POSITIVE));
        let initial = self.blocks[0].scar.initial;
        StopQuantities {
            cycle,
            cycles_left: cycles.slider.min(cycles.receptacle),
            fastest_rate: initial.zip(rates).map(|(initial, rate)| initial * rate),
            worn_through: shares.slider.min(shares.receptacle) < ale::WORN_THROUGH_SHARE,
            // Not foreseen: a film is there at once where a layer is through.
            exceeds_resistance: false,
        }
    }

    /// Remaining heights of the bodies at the deepest point, mm.
    fn remaining(&self) -> Sides<f64> {
        Sides::from_fn(|side| {
            let depths = self.blocks.iter().map(|block| block.scar.deepest.of(side));
            self.heights.of(side) - depths.sum::<f64>()
        })
    }

    /// Counts a condensation of the bodies that have changed where one has drifted.
    pub(super) fn rebuild(&mut self, scene: &Scene, condensations: &mut Sides<u32>) {
        let now = self.remaining();
        let share = scene.accuracy.drift_share();
        let drifted = |side: Side| self.built.of(side) - now.of(side) > share * self.built.of(side);
        if Side::BOTH.into_iter().any(drifted) {
            for side in Side::BOTH {
                *condensations.of_mut(side) += u32::from(now.of(side) < self.built.of(side));
            }
            self.built = now;
        }
    }
}

impl Block {
    /// Largest wear of a point of each side per cycle, mm.
    fn fastest_rate(&self) -> Sides<f64> {
        self.jump.fastest_rate()
    }
}
