//! Followed sections of a line as worn, in each block of a mission or in the whole run.

use crate::change::Change;
use crate::forecast::surrogate::Scar;
use crate::model::Layout;
use crate::number::real_cycles;
use crate::scene::{Dimension, Motion, Scene};
use crate::schedule::jump::JumpControl;
use crate::schedule::plan::{CyclePlan, Cycles, Followed};
use crate::schedule::stops::{self, StopQuantities};
use crate::sides::{Side, Sides};

/// A followed section in a motion.
pub(super) struct Section {
    pub(super) scar: Scar,
    jump: JumpControl,
    motion: Motion,
}

/// Followed sections of a line in each block, whose depths add up.
pub(super) struct WornLine {
    blocks: Vec<Vec<Section>>,
    /// Cycles of each block.
    cycles: Vec<f64>,
    /// Depths at which the operators of each section were built, mm, and heights of the bodies.
    built: Vec<Sides<f64>>,
    heights: Sides<f64>,
}

impl Section {
    /// A section in a motion under its line load over the mean one.
    pub(super) fn new(scene: &Scene, layout: &Layout, motion: Motion, load: f64) -> Self {
        let own = Scene {
            dimension: Dimension::PlaneStrain,
            load_n_per_mm: load * scene.load_n_per_mm,
            motion,
            ..scene.clone()
        };
        Self {
            scar: Scar::new(&own, layout, false),
            jump: JumpControl::default(),
            motion,
        }
    }

    fn wear(&mut self, jump: u64) {
        let before = self.scar.depth.clone();
        self.scar.wear(jump);
        let depth = Change {
            before: before.as_slices(),
            after: self.scar.depth.as_slices(),
        };
        self.jump.share(jump);
        self.jump.update(self.scar.widths(), 0.0, depth, jump);
    }

    /// Increments of a cycle.
    fn increments(&self, scene: &Scene, cycles: Cycles) -> usize {
        let mut stroke = self.scar.stroke(scene, cycles.done);
        stroke.is_groove = false;
        let followed = Followed {
            half_width: self.scar.half_width,
            single: self.scar.half_width,
            sticks: false,
        };
        let (motion, accuracy) = (self.motion, &scene.accuracy);
        CyclePlan::new(motion, accuracy, followed, stroke, cycles, false).increments()
    }
}

impl WornLine {
    /// The unworn sections of each block of a scene.
    pub(super) fn new(scene: &Scene, blocks: Vec<Vec<Section>>) -> Self {
        let cycles = scene.blocks().into_iter();
        Self {
            cycles: cycles.map(|block| real_cycles(block.cycles)).collect(),
            built: blocks[0].iter().map(|_| Sides::default()).collect(),
            blocks,
            heights: Sides {
                slider: scene.slider.shape.height_mm,
                receptacle: scene.receptacle.shape.height_mm,
            },
        }
    }

    /// Followed sections.
    pub(super) fn sections(&self) -> usize {
        self.built.len()
    }

    /// Scars of a block.
    pub(super) fn scars(&self, block: usize) -> impl Iterator<Item = &Scar> {
        self.blocks[block].iter().map(|section| &section.scar)
    }

    /// Takes it that another block has worn the surfaces before one.
    pub(super) fn change_motion(&mut self, block: usize) {
        for section in &mut self.blocks[block] {
            section.scar.change_motion();
        }
    }

    /// Returns `true` if the run ends after so many cycles: also where the groove of a section is as deep as the slider's radius.
    pub(super) fn is_done(&self, scene: &Scene, block: usize, cycle: u64) -> bool {
        let depth = |side, part| self.deepest(side, part);
        stops::end(scene, self.progress(block, cycle), depth).is_some()
            || self.deepest(Side::Receptacle, 0.0) >= scene.slider.shape.radius_mm
    }

    /// Depth that a part of the scar has at least, of the deepest section, mm.
    pub(super) fn deepest(&self, side: Side, part: f64) -> f64 {
        let depths = (0..self.sections()).map(|section| {
            let blocks = self.blocks.iter();
            let depths = blocks.map(|block| block[section].scar.depth_of_part(side, part));
            depths.sum()
        });
        depths.fold(0.0, f64::max)
    }

    /// Progress in a block for its stops.
    pub(super) fn progress(&self, block: usize, cycle: u64) -> StopQuantities {
        at_rates(self.fastest_rate(block), cycle)
    }

    /// The same at the mean rate of all blocks.
    pub(super) fn mean_progress(&self, cycle: u64) -> StopQuantities {
        let total: f64 = self.cycles.iter().sum();
        let rates = Sides::from_fn(|side| {
            let blocks = self.cycles.iter().enumerate();
            let sum: f64 = blocks
                .map(|(block, cycles)| cycles * self.fastest_rate(block).of(side))
                .sum();
            sum / total
        });
        at_rates(rates, cycle)
    }

    fn fastest_rate(&self, block: usize) -> Sides<f64> {
        let sections = self.blocks[block].iter();
        let rates = sections.map(|section| section.jump.fastest_rate());
        rates.fold(Sides::default(), |most: Sides<f64>, rate| {
            most.zip(rate).map(|(most, rate)| most.max(rate))
        })
    }

    /// The jump that all sections allow in a block, for the most cycles.
    pub(super) fn next_jump(&mut self, scene: &Scene, block: usize, most: Cycles) -> u64 {
        let mut jump = most.jump;
        for section in &mut self.blocks[block] {
            let mut stroke = section.scar.stroke(scene, most.done);
            stroke.is_groove = false;
            let next = section.jump.next(&scene.accuracy, stroke, most.jump);
            jump = jump.min(next);
        }
        jump
    }

    /// Increments of a cycle in a block: those of the section that needs most.
    pub(super) fn increments(&self, scene: &Scene, block: usize, cycles: Cycles) -> usize {
        let sections = self.blocks[block].iter();
        let increments = sections.map(|section| section.increments(scene, cycles));
        increments.fold(1, usize::max)
    }

    /// Wears all sections by a jump in a block.
    pub(super) fn wear(&mut self, block: usize, jump: u64) {
        for section in &mut self.blocks[block] {
            section.wear(jump);
        }
    }

    /// Counts a condensation of the bodies of each section where one has drifted, for so many sections.
    pub(super) fn rebuild(&mut self, scene: &Scene, share: f64, condensations: &mut Sides<f64>) {
        let drift = scene.accuracy.drift_share();
        for (section, built) in self.built.iter_mut().enumerate() {
            let now = Sides::from_fn(|side| {
                let blocks = self.blocks.iter();
                let depths = blocks.map(|block| block[section].scar.deepest.of(side));
                depths.sum::<f64>()
            });
            let drifted = |side: Side| {
                let (now, built) = (now.of(side), built.of(side));
                now - built > drift * (self.heights.of(side) - built)
            };
            if Side::BOTH.into_iter().any(drifted) {
                *built = now;
                for side in Side::BOTH {
                    *condensations.of_mut(side) += share;
                }
            }
        }
    }
}

fn at_rates(fastest_rate: Sides<f64>, cycle: u64) -> StopQuantities {
    StopQuantities {
        cycle,
        cycles_left: f64::INFINITY,
        fastest_rate,
        worn_through: false,
        exceeds_resistance: false,
    }
}
