//! State of a point contact between increments: worn surfaces, pressure, shear, and the grids that they are on.

use serde::{Deserialize, Serialize};

use super::energy::{DissipatedEnergy, WholeAndSection};
use super::field::{Axis, Field};
use super::lattice::Lattice;
use super::surface::Surface;
use crate::closed_form::{PointScene, SlipRegime};
use crate::sides::{Side, Sides};

/// State between increments.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct State {
    pub(super) lattice: Lattice,
    pub(super) surfaces: Sides<Surface>,
    /// On the window, MPa.
    pub(super) pressure: Field,
    /// Position of the slider, cells from its leftmost one.
    pub(super) position: usize,
    /// Sliding work since the run began, the integral of p |ds| over the contact, N mm: F s in gross slip.
    pub(super) sliding_work: f64,
    /// The same per mm of depth of the middle section, N.
    pub(super) section_work: f64,
    /// Coefficient of friction in the present computed cycle, -, where it is the same at every place.
    pub(super) coefficient: f64,
    /// Energy dissipated since the run began, mJ, and per mm of depth of the middle section, mJ/mm.
    pub(super) energy: WholeAndSection<DissipatedEnergy>,
    /// Normal force, N, which a spring reduces as the slider sinks.
    pub(super) force_n: f64,
    /// Approach of the bodies by deformation and wear, and that of the unworn contact, mm.
    pub(super) approach_mm: f64,
    pub(super) unworn_approach_mm: Option<f64>,
    /// Worst residuals of the normal force and of the contact, relative.
    pub(super) worst_residuals: (f64, f64),
    /// Contact solves and their iterations.
    pub(super) work: (usize, usize),
    /// Shear along and across the sliding direction where a part may stick, MPa.
    pub(super) shear: (Field, Field),
    /// Path of each cell in the increment, mm.
    pub(super) slip: Field,
    /// Pressures at the positions of the last implicit jump, MPa; none after a computed cycle.
    pub(super) passing: Vec<Field>,
}

impl State {
    /// The unworn contact without load, where the first pass begins.
    pub(super) fn unworn(scene: &PointScene, lattice: Lattice) -> Self {
        let window = || Field::zero(lattice.window());
        Self {
            lattice,
            surfaces: Sides::from_fn(|side| {
                Surface::new(scene.bodies.of(side).wear, lattice.half(side))
            }),
            pressure: window(),
            position: start(scene, &lattice),
            sliding_work: 0.0,
            section_work: 0.0,
            coefficient: 0.0,
            energy: WholeAndSection::default(),
            force_n: scene.force_n,
            approach_mm: 0.0,
            unworn_approach_mm: None,
            worst_residuals: (0.0, 0.0),
            work: (0, 0),
            shear: (window(), window()),
            slip: window(),
            passing: Vec::new(),
        }
    }

    /// Adds sliding work under mean coefficients of friction.
    pub(super) fn add_work(&mut self, work: WholeAndSection<f64>, friction: WholeAndSection<f64>) {
        self.sliding_work += work.whole;
        self.section_work += work.section;
        self.energy.whole.add(friction.whole, work.whole);
        self.energy.section.add(friction.section, work.section);
    }

    /// Goes back to an earlier state; the work since then counts.
    pub(super) fn go_back(&mut self, before: &Self) {
        let work = self.work;
        self.clone_from(before);
        self.work = work;
    }

    /// Moves everything to grids of another size.
    pub(super) fn resize(&mut self, lattice: Lattice) {
        for side in Side::BOTH {
            self.surfaces.of_mut(side).resize(lattice.half(side));
        }
        self.change_window(|field| field.resized(lattice.window()));
        self.lattice = lattice;
    }

    /// Moves everything to cells of twice the size along an axis, at a turning point.
    pub(super) fn merge(&mut self, axis: Axis, lattice: Lattice) {
        for side in Side::BOTH {
            self.surfaces.of_mut(side).merge(axis, lattice.half(side));
        }
        self.change_window(|field| field.merged(axis).resized(lattice.window()));
        if axis == Axis::Along {
            self.position = (self.position / 2).min(2 * lattice.amplitude);
        }
        self.lattice = lattice;
    }

    /// Forgets the tractions of a motion of which a part has stuck: all of the contact slips in the next one.
    pub(super) fn forget_shear(&mut self) {
        let zero = Field::zero(self.lattice.window());
        self.shear = (zero.clone(), zero.clone());
        self.slip = zero;
    }

    /// Changes the fields of the window.
    fn change_window(&mut self, change: impl Fn(&Field) -> Field) {
        let (along, across) = &mut self.shear;
        let window = [&mut self.pressure, along, across, &mut self.slip];
        for field in window.into_iter().chain(&mut self.passing) {
            *field = change(field);
        }
    }
}

/// Position of the slider where the passes of a motion begin; the neutral one where surfaces wear in place.
pub(super) fn start(scene: &PointScene, lattice: &Lattice) -> usize {
    match scene.slip {
        SlipRegime::Gross => lattice.position(-scene.amplitude_mm),
        SlipRegime::Partial => lattice.amplitude,
    }
}
