//! Blocks of a mission over all of its repetitions.

use api::results::BlockExtent;
use api::spec::Spec;
use solver::scene::{Block, Mission, Motion};

use super::movement::Movement;
use crate::number::real;

const SECONDS_PER_HOUR: f64 = 3_600.0;

/// The blocks of a resolved specification.
pub(super) fn extents(filled: &Spec, movement: &Movement) -> Vec<BlockExtent> {
    let single = [Block {
        motion: movement.scene,
        timing: movement.timing.clone(),
        cycles: movement.total_cycles,
    }];
    let (blocks, repeat) = match &movement.blocks {
        Some(Mission { blocks, repeat, .. }) => (&blocks[..], *repeat),
        None => (&single[..], 1),
    };
    let named = filled.mission.iter().zip(&movement.derived_blocks);
    named
        .zip(blocks)
        .map(|((given, derived), block)| {
            let extent = of_cycles(block.motion, block.cycles.saturating_mul(repeat));
            BlockExtent {
                name: given.name.clone(),
                motion: derived.clone(),
                ..extent
            }
        })
        .collect()
}

/// So many cycles of a motion.
fn of_cycles(motion: Motion, cycles: u64) -> BlockExtent {
    BlockExtent {
        cycles,
        amplitude_mm: motion.amplitude_mm(),
        sliding_distance_mm: real(cycles) * motion.distance_per_cycle_mm(),
        duration_h: real(cycles) * motion.period_s().unwrap_or_default() / SECONDS_PER_HOUR,
        ..BlockExtent::default()
    }
}
