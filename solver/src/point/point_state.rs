//! State of a run of a point contact between two computed cycles, and what is read from it.

use serde::{Deserialize, Serialize};

use super::contact_at_position::ContactAtPosition;
use super::friction::WindowFriction;
use super::jump::JumpControl;
use super::legs::{Leg, legs};
use super::record::{DepthMap, PointCycle};
use super::state::State;
use crate::closed_form::PointScene;
use crate::law::friction::contact::ContactFriction;
use crate::number::real_cycles;
use crate::schedule::step::Position;
use crate::sides::{Side, Sides};

/// State of a run between two computed cycles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct PointState {
    pub(super) sliding: State,
    pub(super) control: JumpControl,
    /// The contact at the neutral position, and at both turning points of the last cycle.
    pub(super) neutral: ContactAtPosition,
    pub(super) turning: [ContactAtPosition; 2],
    pub(super) done: u64,
    /// Imposed sliding distance, mm.
    pub(super) sliding_distance_mm: f64,
    pub(super) computed: usize,
    /// Most contact solves of a cycle.
    pub(super) most_increments: usize,
    pub(super) last: PointCycle,
    /// Sum of the errors of all jumps, each times its cycles.
    pub(super) error_sum: f64,
    /// Line load in N/mm and force in N along x at the ends of the increments of the last cycle, where a part may stick.
    pub(super) increments: Vec<(f64, f64)>,
}

/// A point of the friction loop.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LoopPoint {
    /// Displacement of the slider, mm.
    pub(crate) displacement_mm: f64,
    /// Line load along x of the middle section, N/mm.
    pub(crate) line_load_n_per_mm: f64,
    /// Force along x, N.
    pub(crate) force_n: f64,
}

impl LoopPoint {
    fn new(displacement_mm: f64, tangential: (f64, f64)) -> Self {
        Self {
            displacement_mm,
            line_load_n_per_mm: tangential.0,
            force_n: tangential.1,
        }
    }
}

/// Worst residuals of a run, relative.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Residuals {
    /// Of the normal force.
    pub(crate) force: f64,
    /// Of the dose of either body beside the sliding work.
    pub(crate) dose: f64,
    /// Shear beyond mu p over the peak pressure.
    pub(crate) friction_cone: f64,
    /// Of the complementarity of gap and pressure.
    pub(crate) contact: f64,
    /// Tangential over mu times the normal force.
    pub(crate) friction_use: f64,
}

impl PointState {
    /// Cycles done.
    pub(crate) fn cycle(&self) -> u64 {
        self.done
    }

    /// The last computed cycle.
    pub(crate) fn last(&self) -> &PointCycle {
        &self.last
    }

    /// Worn depths of a side.
    pub(crate) fn depth(&self, side: Side) -> DepthMap {
        let surface = self.sliding.surfaces.of(side);
        let cells = surface.dose.cells(self.sliding.lattice.size_mm);
        DepthMap::new(&cells, surface.depths_mm())
    }

    /// Largest wear of a place of each side per cycle in the last computed one, as equivalent depth, mm.
    pub(crate) fn fastest_rate(&self) -> Sides<f64> {
        Sides::from_fn(|side| self.sliding.surfaces.of(side).fastest_rate())
    }

    /// Wear per cycle by which the deepest place of a side would come to an equivalent depth in mm as soon as the first place does, mm.
    pub(crate) fn rate_toward(&self, side: Side, limit: f64) -> f64 {
        self.sliding.surfaces.of(side).rate_toward(limit)
    }

    /// Worn depths of both sides at each cell of the contact at the neutral position after a part of the last computed cycle, whose doses grow
    /// evenly, and at most these, mm.
    pub(crate) fn depths_in_contact(&self, part: f64, limits: Sides<f64>) -> Vec<Sides<f64>> {
        let (cells, lattice) = (self.neutral.cells, &self.sliding.lattice);
        // The window may have been widened since.
        let widened = lattice.window().0 - cells.along_x / 2;
        let first = Sides::from_fn(|side| {
            let row = lattice.first_row(side, lattice.amplitude) + widened;
            (row, lattice.half(side).1 - cells.along_z / 2)
        });
        let loaded = self.neutral.pressure_mpa.iter().enumerate();
        let loaded = loaded.filter(|(_, pressure)| **pressure > 0.0);
        let depths = loaded.map(|(index, _)| {
            let (row, column) = (index / cells.along_z, index % cells.along_z);
            Sides::from_fn(|side| {
                let surface = self.sliding.surfaces.of(side);
                let (first_row, first_column) = *first.of(side);
                let dose = surface.dose_within(part, first_row + row, first_column + column);
                surface.depth_mm(dose).min(*limits.of(side))
            })
        });
        depths.collect()
    }

    /// Cells of the window, their length in mm, and the contact solves and iterations so far.
    pub(crate) fn size(&self) -> (usize, f64, (usize, usize)) {
        let cells = self.sliding.lattice.cells();
        (cells.count(), cells.dx_mm, self.sliding.work)
    }

    /// Computed cycles, and the most contact solves of one.
    pub(crate) fn computed(&self) -> (usize, usize) {
        (self.computed, self.most_increments)
    }

    /// The contact at the neutral position.
    pub(crate) fn neutral(&self) -> &ContactAtPosition {
        &self.neutral
    }

    /// The contact at the ends of both passes of the last cycle.
    pub(crate) fn turning(&self) -> &[ContactAtPosition; 2] {
        &self.turning
    }

    /// Takes the contact at the end of a leg of the cycle.
    pub(super) fn take_contact(&mut self, position: Option<Position>, contact: ContactAtPosition) {
        let [left, right] = &mut self.turning;
        match position {
            Some(Position::Neutral) => self.neutral = contact,
            Some(Position::Leftmost) => *left = contact,
            Some(Position::Rightmost) => *right = contact,
            None => {}
        }
    }

    /// The friction loop of the last cycle from the neutral position on. Of gross slip a rectangle for each stroke.
    pub(crate) fn friction_loop(&self, scene: &PointScene) -> Vec<LoopPoint> {
        let legs = legs(scene);
        let sticks = !self.increments.is_empty() && self.increments.len() == legs.len();
        let neutral = legs
            .iter()
            .position(|leg| leg.at == Some(Position::Neutral));
        let first = neutral.map_or(0, |neutral| neutral + 1);
        let forth = self.neutral.tangential;
        let mut points = vec![LoopPoint::new(0.0, forth)];
        for number in (first..legs.len()).chain(0..first) {
            let leg = &legs[number];
            if sticks {
                points.push(LoopPoint::new(leg.to, self.increments[number]));
                continue;
            }
            if leg.turns {
                let arriving = self.gross_friction(leg);
                let reversed = (-arriving.0, -arriving.1);
                points.push(LoopPoint::new(leg.to, arriving));
                points.push(LoopPoint::new(leg.to, reversed));
            }
        }
        if !sticks && !legs.is_empty() {
            points.push(LoopPoint::new(0.0, forth));
        }
        points
    }

    /// Line load and force along x at the end of a leg that slips as a whole.
    fn gross_friction(&self, leg: &Leg) -> (f64, f64) {
        let [left, right] = self.turning.each_ref().map(|at| at.tangential);
        match leg.at {
            Some(Position::Leftmost) => left,
            Some(Position::Rightmost) => right,
            // The neutral position is passed to the right.
            Some(Position::Neutral) | None => {
                let (line, whole) = self.neutral.tangential;
                let magnitude = |force: f64| leg.direction() * force.abs();
                (magnitude(line), magnitude(whole))
            }
        }
    }

    /// Worst residuals so far.
    pub(crate) fn residuals(&self, scene: &PointScene, friction: &ContactFriction) -> Residuals {
        let (force, contact) = self.sliding.worst_residuals;
        let forces = self.friction_loop(scene).into_iter();
        let most = forces.fold(0.0, |most: f64, point| most.max(point.force_n.abs()));
        // A spring presses most before its contact wears in the cycle.
        let largest = |at: &ContactAtPosition| at.friction * at.force_n;
        let [left, right] = self.turning.each_ref().map(largest);
        let limit = largest(&self.neutral).max(left).max(right);
        Residuals {
            force,
            dose: self.dose_residual(),
            friction_cone: self.friction_cone(friction),
            contact,
            friction_use: if limit > 0.0 { most / limit } else { 0.0 },
        }
    }

    /// |integral of the dose over a body - sliding work| over the latter, of the worse body.
    fn dose_residual(&self) -> f64 {
        let state = &self.sliding;
        let cells = state.lattice.cells();
        let residual = |dose: &[f64]| {
            if state.sliding_work > 0.0 {
                (cells.integral(dose) / state.sliding_work - 1.0).abs()
            } else {
                0.0
            }
        };
        let residuals = Side::BOTH.map(|side| residual(&state.surfaces.of(side).dose.values));
        residuals[0].max(residuals[1])
    }

    /// Largest shear beyond mu p where a part may stick, over the peak pressure. In gross slip the shear is mu p.
    fn friction_cone(&self, friction: &ContactFriction) -> f64 {
        let state = &self.sliding;
        let (along, across) = &state.shear;
        let pressure = &state.pressure.values;
        let bounds = WindowFriction::of(friction, state, state.position).bounds(pressure);
        let shear = along.values.iter().zip(&across.values);
        let beyond = shear.zip(bounds).map(|((x, z), bound)| x.hypot(*z) - bound);
        let peak = pressure
            .iter()
            .fold(f64::MIN_POSITIVE, |most, p| p.max(most));
        beyond.fold(0.0, f64::max) / peak
    }

    /// Mean error of the jumps, weighted with their cycles.
    pub(crate) fn mean_jump_error(&self) -> f64 {
        self.error_sum / real_cycles(self.done.max(1))
    }

    /// Gives a state of a checkpoint the laws of its scene.
    pub(crate) fn resume(&mut self, scene: &PointScene) {
        for side in Side::BOTH {
            let wear = scene.bodies.of(side).wear;
            self.sliding.surfaces.of_mut(side).resume(wear);
        }
    }
}
