//! Which block of a mission is done next, and how many of its cycles: blocks in their order within a round, several rounds together.
//!
//! A round wears little once many are done, so that n1 cycles of the first block, then n2 of the second, m times, wear like
//! m n1 and then m n2 cycles, up to a change of the scar of the order of what m rounds wear. Rounds taken together are a
//! part of those done, so that their number is a logarithm of the rounds; they end before a cycle that is hit exactly, and change
//! a coefficient of friction by cycle by no more than a jump may, since each of their blocks meets the coefficients of its own cycles.

use serde::{Deserialize, Serialize};

use super::stops::{self, StopQuantities};
use super::stroke::even_friction;
use crate::number::{cycles_at_least, real_cycles};
use crate::scene::{Mission, Scene};
use crate::sides::Side;

/// A position in a mission.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) struct MissionPosition {
    /// The present block; 0 without a mission.
    pub(crate) block: usize,
    /// Cycle of the whole run at which it ends.
    pub(crate) until: u64,
    /// Rounds done before the present ones.
    done: u64,
    /// Rounds that are done together.
    together: u64,
}

impl MissionPosition {
    /// The first block, of one round; all cycles without a mission.
    pub(crate) fn first(scene: &Scene) -> Self {
        let mut first = Self {
            block: 0,
            until: scene.cycles,
            done: 0,
            together: 1,
        };
        if let Some(mission) = &scene.mission {
            first.block = first.following(mission, 0).unwrap_or_default();
            first.until = first.cycles(mission, first.block).min(scene.cycles);
        }
        first
    }

    /// Cycles of a block in the present rounds.
    fn cycles(&self, mission: &Mission, block: usize) -> u64 {
        let rounds = self.done + self.together;
        mission.cycles_of(block, rounds) - mission.cycles_of(block, self.done)
    }

    /// The first block from one on that has cycles in the present rounds.
    fn following(&self, mission: &Mission, from: usize) -> Option<usize> {
        (from..mission.blocks.len()).find(|block| self.cycles(mission, *block) > 0)
    }

    /// Returns `true` if the last block of the present rounds is under way.
    pub(crate) fn is_last_block(&self, scene: &Scene) -> bool {
        let mission = scene.mission.as_ref();
        mission.is_none_or(|mission| self.following(mission, self.block + 1).is_none())
    }

    /// The next cycle that must be hit exactly, or the end of the present block before it, and whether what happens until then may be
    /// reported in detail.
    pub(crate) fn next_reported(&self, scene: &Scene, next: u64) -> (u64, bool) {
        let is_block_end = scene.mission.is_some() && self.until <= next;
        let is_reported = !is_block_end
            || self.until == scene.cycles
            || scene.output.snapshots_at_cycles.contains(&self.until);
        (if is_block_end { self.until } else { next }, is_reported)
    }

    /// The next block. `now` is the progress of the run, whose rates are those of a cycle of the mission, and `depth` that of
    /// a part of a side's scar, mm.
    pub(crate) fn next(
        self,
        scene: &Scene,
        now: StopQuantities,
        depth: impl Fn(Side, f64) -> f64,
    ) -> Self {
        let Some(mission) = &scene.mission else {
            return self;
        };
        let mut next = self;
        if let Some(block) = self.following(mission, self.block + 1) {
            next.block = block;
        } else {
            next.done += self.together;
            next.together = rounds(scene, mission, next.done, now, depth);
            next.block = next.following(mission, 0).unwrap_or_default();
        }
        let cycles = next.cycles(mission, next.block);
        next.until = self.until.saturating_add(cycles).min(scene.cycles);
        next
    }
}

/// Number of rounds that are done together after so many.
fn rounds(
    scene: &Scene,
    mission: &Mission,
    done: u64,
    now: StopQuantities,
    depth: impl Fn(Side, f64) -> f64,
) -> u64 {
    let accuracy = &scene.accuracy;
    let share = accuracy.tuning.repetitions_of_done.at(accuracy.tolerance);
    let cycles_a_round =
        real_cycles(mission.cycles()) * real_cycles(mission.repeat) / real_cycles(mission.rounds());
    let by_cycle = scene.friction.by_cycle();
    let even = even_friction(by_cycle, accuracy.tolerance, now.cycle) / cycles_a_round;
    let refinement = accuracy.refinement.cycles;
    let most = (share / refinement * real_cycles(done)).min(even / refinement);
    // Those before the round in which a cycle is hit exactly.
    let until = stops::next(scene, now, depth);
    let before = mission.rounds_within(until).saturating_sub(done);
    cycles_at_least(most.floor())
        .min(before.max(1))
        .min(mission.rounds() - done)
}
