//! Which block of a mission is done next, and how many of its cycles: blocks in their order, several repetitions together.
//!
//! A repetition wears little once many are done, so that n1 cycles of the first block, then n2 of the second, m times, wear like
//! m n1 and then m n2 cycles, up to a change of the scar of the order of what m repetitions wear. Repetitions taken together are a
//! part of those done, so that their number is a logarithm of the repetitions; they end before a cycle that is hit exactly, and change
//! a coefficient of friction by cycle by no more than a jump may, since each of their blocks meets the coefficients of its own cycles.

use serde::{Deserialize, Serialize};

use super::jump::even_friction;
use super::stops::{self, Progress};
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
    /// Repetitions done before the present ones.
    done: u64,
    /// Repetitions that are done together.
    together: u64,
}

impl MissionPosition {
    /// The first block, of one repetition; all cycles without a mission.
    pub(crate) fn first(scene: &Scene) -> Self {
        let until = scene.mission.as_ref().map_or(scene.cycles, |mission| {
            mission.blocks.first().map_or(0, |block| block.cycles)
        });
        Self {
            block: 0,
            until: until.min(scene.cycles),
            done: 0,
            together: 1,
        }
    }

    /// Whether the last block of the present repetitions is under way.
    pub(crate) fn is_last_block(&self, scene: &Scene) -> bool {
        let blocks = scene
            .mission
            .as_ref()
            .map_or(1, |mission| mission.blocks.len());
        self.block + 1 >= blocks
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
        now: Progress,
        depth: impl Fn(Side, f64) -> f64,
    ) -> Self {
        let Some(mission) = &scene.mission else {
            return self;
        };
        let mut next = self;
        if self.is_last_block(scene) {
            next.block = 0;
            next.done += self.together;
            next.together = repetitions(scene, mission, (next.done, now), depth);
        } else {
            next.block += 1;
        }
        let cycles = mission.blocks[next.block].cycles;
        next.until = (self.until + cycles.saturating_mul(next.together)).min(scene.cycles);
        next
    }
}

/// Number of repetitions that are done together after so many.
fn repetitions(
    scene: &Scene,
    mission: &Mission,
    (done, now): (u64, Progress),
    depth: impl Fn(Side, f64) -> f64,
) -> u64 {
    let accuracy = &scene.accuracy;
    let share = accuracy.tuning.repetitions_of_done.at(accuracy.tolerance);
    let even = even_friction(scene, now.cycle) / real_cycles(mission.cycles());
    let refinement = accuracy.refinement.cycles;
    let most = (share / refinement * real_cycles(done)).min(even / refinement);
    // Those before the repetition in which a cycle is hit exactly.
    let until = stops::next(scene, now, depth);
    let before = (until - now.cycle) / mission.cycles();
    cycles_at_least(most.floor())
        .min(before.max(1))
        .min(mission.repeat - done)
}
