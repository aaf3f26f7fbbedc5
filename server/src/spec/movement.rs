//! The motion of the contact: one for a number of cycles, or a mission.

use api::spec::{DerivedMotion, MissionBlock, MissionOrder, Motion};
use solver::scene;

use super::motion::ImposedMotion;

/// Resolved motions of a specification.
pub(super) struct Movement {
    /// As written in the resolved specification: a motion and its cycles, or a mission.
    pub(super) motion: Option<Motion>,
    pub(super) cycles: Option<u64>,
    pub(super) mission: Vec<MissionBlock>,
    pub(super) repeat: Option<u64>,
    pub(super) order: Option<MissionOrder>,
    pub(super) drive: scene::Drive,
    /// The motion of the scene, its blocks if there are several, and its cycles.
    pub(super) scene: scene::Motion,
    /// Course in time.
    pub(super) timing: scene::Timing,
    pub(super) blocks: Option<scene::Mission>,
    pub(super) total_cycles: u64,
    /// Distance of a continuous motion, mm.
    pub(super) distance_mm: Option<f64>,
    /// Largest amplitude, mm.
    pub(super) amplitude_mm: f64,
    /// How the motion, or that of each block, was derived.
    pub(super) derived: Option<DerivedMotion>,
    pub(super) derived_blocks: Vec<Option<DerivedMotion>>,
}

impl Movement {
    /// One motion for so many cycles.
    pub(super) fn single(motion: ImposedMotion, cycles: u64) -> Self {
        let distance_mm = motion.spec.distance_mm;
        Self {
            cycles: distance_mm.is_none().then_some(cycles),
            mission: Vec::new(),
            repeat: None,
            order: None,
            drive: motion.drive,
            scene: motion.scene,
            timing: motion.timing,
            blocks: None,
            total_cycles: cycles,
            distance_mm,
            amplitude_mm: motion.scene.amplitude_mm(),
            motion: Some(motion.spec),
            derived: motion.derived,
            derived_blocks: Vec::new(),
        }
    }

    /// The pointer of each motion, and how it was derived.
    pub(super) fn all_derived(&self) -> impl Iterator<Item = (String, &DerivedMotion)> {
        let single = self.derived.iter();
        let single = single.map(|derived| ("/motion".to_owned(), derived));
        let blocks = self.derived_blocks.iter().enumerate();
        let blocks = blocks.filter_map(|(index, derived)| {
            Some((format!("/mission/{index}/motion"), derived.as_ref()?))
        });
        single.chain(blocks)
    }
}
