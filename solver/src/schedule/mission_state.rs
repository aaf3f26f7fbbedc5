//! State of a mission between two computed cycles: its position, what each block has left for its next cycles, and what it has worn.

use serde::{Deserialize, Serialize};

use super::mission::MissionPosition;
use super::stops::StopQuantities;
use crate::number::real_cycles;
use crate::scene::{Mission, Scene};
use crate::sides::{Side, Sides};

/// Wear of a block of a mission.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct BlockWear {
    /// Physical cycles done.
    pub cycles: u64,
    /// Imposed sliding distance, mm.
    pub sliding_distance_mm: f64,
    /// Energy dissipated by friction, mJ/mm.
    pub energy_mj_per_mm: f64,
    /// Worn area of each side, mm^2.
    pub worn_area_mm2: Sides<f64>,
    /// Share of the dose that the deepest point of each side has received, -; 0 of one that has received none.
    pub share_of_deepest: Sides<f64>,
    /// Equivalent depth at the contact nodes, in proportion to the dose, mm.
    equivalent: Sides<Vec<f64>>,
}

/// State of a mission, whose motions leave a history for their next cycles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct MissionState<H> {
    pub(crate) position: MissionPosition,
    /// The block before, until the slider has moved to the turning point where the cycles of the present one begin.
    pub(crate) left: Option<usize>,
    histories: Vec<Option<H>>,
    wear: Vec<BlockWear>,
    /// Totals where the present block and the present repetitions began.
    block: BlockWear,
    repetitions: BlockWear,
    /// Equivalent depth per cycle of the mission over the last repetitions, mm.
    rates: Sides<Vec<f64>>,
}

impl<H> MissionState<H> {
    /// State of the loaded, unworn bodies with these totals.
    pub(crate) fn new(scene: &Scene, mission: &Mission, totals: BlockWear) -> Self {
        let nodes = totals.equivalent.as_ref().map(Vec::len);
        Self {
            position: MissionPosition::first(scene),
            left: None,
            histories: mission.blocks.iter().map(|_| None).collect(),
            wear: vec![BlockWear::default(); mission.blocks.len()],
            block: totals.clone(),
            repetitions: totals,
            rates: nodes.map(|nodes| vec![0.0; nodes]),
        }
    }

    /// Returns `true` if the present block is done after so many cycles.
    pub(crate) fn is_block_done(&self, cycle: u64) -> bool {
        cycle >= self.position.until
    }

    /// Returns `true` if all blocks have been repeated equally often after so many cycles.
    pub(crate) fn is_whole(&self, scene: &Scene, cycle: u64) -> bool {
        self.is_block_done(cycle) && self.position.is_last_block(scene)
    }

    /// Ends the present block at these totals; returns the equivalent depth per cycle of the mission, mm.
    pub(crate) fn end_block(&mut self, scene: &Scene, totals: BlockWear) -> Sides<&[f64]> {
        self.wear[self.position.block].add(&totals, &self.block);
        if self.position.is_last_block(scene) {
            self.rates = totals.equivalent_per_cycle_since(&self.repetitions);
            self.repetitions.clone_from(&totals);
        }
        self.block = totals;
        self.rates.as_slices()
    }

    /// Begins the next block, with the history that the present one leaves; returns that of the next one's motion. `now` is the progress of the
    /// run at the rates of the mission, and `depth` that of a part of a side's scar.
    pub(crate) fn begin_block(
        &mut self,
        scene: &Scene,
        now: StopQuantities,
        depth: impl Fn(Side, f64) -> f64,
        leaves: H,
    ) -> Option<H> {
        let present = self.position.block;
        self.position = self.position.next(scene, now, depth);
        self.left = Some(present);
        self.histories[present] = Some(leaves);
        self.histories[self.position.block].take()
    }

    /// Wear of each block up to these totals, at these worn depths of the nodes, mm.
    pub(crate) fn wear(&self, totals: &BlockWear, depth: Sides<&[f64]>) -> Vec<BlockWear> {
        let mut blocks = self.wear.clone();
        blocks[self.position.block].add(totals, &self.block);
        for side in Side::BOTH {
            let deepest = deepest(depth.of(side));
            let at = |block: &BlockWear| {
                let node = block.equivalent.of(side).get(deepest);
                node.copied().unwrap_or_default()
            };
            let sum: f64 = blocks.iter().map(at).sum();
            for block in &mut blocks {
                let share = if sum > 0.0 { at(block) / sum } else { 0.0 };
                *block.share_of_deepest.of_mut(side) = share;
            }
        }
        blocks
    }

    /// Histories of the motions that are not under way.
    pub(crate) fn histories(&self) -> impl Iterator<Item = &H> {
        self.histories.iter().flatten()
    }
}

impl BlockWear {
    /// Wear of a run without a mission, after so many cycles over a distance in mm.
    pub(crate) fn whole(
        cycles: u64,
        sliding_distance_mm: f64,
        energy_mj_per_mm: f64,
        worn_area_mm2: Sides<f64>,
    ) -> Self {
        Self {
            cycles,
            sliding_distance_mm,
            energy_mj_per_mm,
            worn_area_mm2,
            share_of_deepest: worn_area_mm2.map(|area| if area > 0.0 { 1.0 } else { 0.0 }),
            equivalent: Sides::default(),
        }
    }

    /// The totals with these equivalent depths at the nodes, mm.
    pub(crate) fn with_equivalents(self, equivalent: Sides<Vec<f64>>) -> Self {
        Self { equivalent, ..self }
    }

    /// Adds the difference of two totals.
    fn add(&mut self, after: &Self, before: &Self) {
        self.cycles += after.cycles - before.cycles;
        self.sliding_distance_mm += after.sliding_distance_mm - before.sliding_distance_mm;
        self.energy_mj_per_mm += after.energy_mj_per_mm - before.energy_mj_per_mm;
        for side in Side::BOTH {
            *self.worn_area_mm2.of_mut(side) +=
                after.worn_area_mm2.of(side) - before.worn_area_mm2.of(side);
            let sum = self.equivalent.of_mut(side);
            sum.resize(after.equivalent.of(side).len(), 0.0);
            let worn = after
                .equivalent
                .of(side)
                .iter()
                .zip(before.equivalent.of(side));
            for (sum, (after, before)) in sum.iter_mut().zip(worn) {
                *sum += after - before;
            }
        }
    }

    /// Equivalent depth per cycle since an earlier total, mm.
    fn equivalent_per_cycle_since(&self, before: &Self) -> Sides<Vec<f64>> {
        let cycles = real_cycles((self.cycles - before.cycles).max(1));
        let mut worn = Self::default();
        worn.add(self, before);
        worn.equivalent
            .map(|nodes| nodes.iter().map(|worn| worn / cycles).collect())
    }
}

/// Number of the deepest node.
fn deepest(depth: &[f64]) -> usize {
    let nodes = depth.iter().enumerate();
    let deepest = nodes.fold((0, f64::NEG_INFINITY), |best, (node, depth)| {
        if *depth > best.1 {
            (node, *depth)
        } else {
            best
        }
    });
    deepest.0
}
