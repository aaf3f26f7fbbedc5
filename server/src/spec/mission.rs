//! Mission: blocks of motions of any kind but `continuous`, one after the other or mixed, repeated.
//!
//! A block is resolved like a specification of its own that has its motion and cycles. One block, however often repeated, is a
//! motion with all of its cycles.

use std::ops::RangeInclusive;

use api::spec::{DerivedMotion, MissionBlock, MissionOrder, MotionKind, Spec};
use solver::scene;

use super::diagnostics::{Diagnostics, NAME_LIMIT};
use super::motion::{self, HeldContact, ImposedMotion};
use super::movement::Movement;
use super::sourced::assumed;
use super::system::Preset;

/// Most blocks of a mission.
pub(in crate::spec) const BLOCK_LIMIT: usize = 64;
/// Repetitions of a mission.
pub(in crate::spec) const REPEAT: RangeInclusive<u64> = 1..=1_000_000_000;
/// Cycles of all blocks and repetitions: 10 years at 2 kHz are 6e11.
const TOTAL_CYCLES: u64 = 1_000_000_000_000;

/// Resolves a mission that has blocks.
pub(super) fn resolve(
    given: &Spec,
    preset: &Preset,
    contact: HeldContact,
    diagnostics: &mut Diagnostics,
) -> Movement {
    let beside = [
        ("/motion", given.motion.is_some()),
        ("/cycles", given.cycles.is_some()),
    ];
    for (pointer, _) in beside.into_iter().filter(|(_, is_given)| *is_given) {
        diagnostics.exclusive_fields(pointer, "mission");
    }
    diagnostics.check_length("/mission", given.mission.len(), BLOCK_LIMIT);
    let blocks = given.mission.iter().take(BLOCK_LIMIT).enumerate();
    let blocks: Vec<_> = blocks
        .map(|(index, given)| block(index, given, preset, contact, diagnostics))
        .collect();
    check_drives(&blocks, diagnostics);
    let repeat = diagnostics.or_default("/repeat", given.repeat, assumed(1));
    diagnostics.check_count("/repeat", repeat, &REPEAT);
    let order = given.order.as_ref();
    let order = order.and_then(|order| diagnostics.enum_member("/order", order));
    let order = diagnostics.or_default("/order", order, assumed(MissionOrder::InOrder));
    let mission = scene::Mission {
        blocks: blocks.iter().map(Block::scene).collect(),
        repeat,
        order: match order {
            MissionOrder::InOrder => scene::Order::InOrder,
            MissionOrder::Mixed => scene::Order::Mixed,
        },
    };
    let total_cycles = mission.cycles().saturating_mul(repeat);
    if total_cycles > TOTAL_CYCLES {
        let detail = format!("{total_cycles} cycles in all, at most {TOTAL_CYCLES} are allowed");
        diagnostics.fault("/mission", detail);
    }
    let amplitudes = blocks.iter().map(|block| block.motion.scene.amplitude_mm());
    Movement {
        motion: None,
        cycles: None,
        repeat: Some(repeat),
        order: Some(order),
        drive: blocks[0].motion.drive,
        amplitude_mm: amplitudes.fold(0.0, f64::max),
        scene: match &mission.blocks[..] {
            [single] => single.motion,
            _ => mission.mean_motion(),
        },
        // The speeds of several blocks differ, whatever their courses.
        timing: match &mission.blocks[..] {
            [single] => single.timing.clone(),
            _ => scene::Timing::Sine,
        },
        blocks: (mission.blocks.len() > 1).then_some(mission),
        total_cycles,
        distance_mm: None,
        derived: None,
        derived_blocks: blocks.iter().map(Block::derived).collect(),
        mission: blocks.into_iter().map(Block::into_spec).collect(),
    }
}

/// A resolved block.
struct Block {
    name: Option<String>,
    motion: ImposedMotion,
    cycles: u64,
}

impl Block {
    fn scene(&self) -> scene::Block {
        scene::Block {
            motion: self.motion.scene,
            timing: self.motion.timing.clone(),
            cycles: self.cycles,
        }
    }

    fn derived(&self) -> Option<DerivedMotion> {
        self.motion.derived.clone()
    }

    fn into_spec(self) -> MissionBlock {
        MissionBlock {
            name: self.name,
            motion: self.motion.spec,
            cycles: Some(self.cycles),
        }
    }
}

fn block(
    index: usize,
    given: &MissionBlock,
    preset: &Preset,
    contact: HeldContact,
    diagnostics: &mut Diagnostics,
) -> Block {
    let below = format!("/mission/{index}");
    if let Some(name) = &given.name {
        diagnostics.check_text(&format!("{below}/name"), name, NAME_LIMIT);
    }
    let mut part = Diagnostics::default();
    let motion = motion::resolve(Some(&given.motion), preset, contact, &mut part);
    let is_continuous = motion.spec.distance_mm.is_some();
    if is_continuous {
        let kind = MotionKind::Continuous.as_str();
        part.fault(
            "/motion/kind",
            format!("a block of a mission cannot be `{kind}`"),
        );
    }
    let is_counted = given.cycles.is_some() || motion.is_timed();
    if !is_counted && !is_continuous {
        part.missing("/cycles", "a block needs its number of cycles");
    }
    let cycles = motion::cycles(given.cycles, &motion, preset, &mut part);
    diagnostics.adopt(&below, &["/motion", "/cycles"], part);
    Block {
        name: given.name.clone(),
        motion,
        cycles,
    }
}

/// All blocks move the same boundary of the bodies.
fn check_drives(blocks: &[Block], diagnostics: &mut Diagnostics) {
    let Some(first) = blocks.first() else { return };
    for (index, block) in blocks.iter().enumerate().skip(1) {
        if block.motion.drive != first.motion.drive {
            diagnostics.fault(
                &format!("/mission/{index}/motion/drive"),
                "`slider_body` cannot be combined with other drives in one mission",
            );
        }
    }
}

#[cfg(test)]
mod tests;
