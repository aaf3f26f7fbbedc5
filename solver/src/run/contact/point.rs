//! The run of a point contact: what its reports and snapshots are made of. Profiles and tractions are those of its middle section; maps are
//! of the whole contact.

use std::borrow::Cow;

use super::{Bodies, Contact, Moment, Worn};
use crate::SolveError;
use crate::change::Change;
use crate::checkpoint::{PointRun, Resumable};
use crate::closed_form::{PointScene, SlipRegime};
use crate::contact::Work;
use crate::effects::EffectsPlan;
use crate::electrical::{AreaContact, ContactResistance, Evaluation, Touching};
use crate::interpolation::part_way;
use crate::number::count;
use crate::observer::Observer;
use crate::point::{
    ContactAtPosition, DepthMap, PointError, PointHistory, PointIntegrator, PointMotions,
    PointState, legs,
};
use crate::record::{
    self, AreaMaps, Checks, CycleReport, DepthProfile, Exposed, FrictionLoop, PointEnd, Position,
    PressureMap, Resolution, Snapshot, TractionField, WornArea,
};
use crate::scene::{Effect, Motion, Scene};
use crate::schedule::mission_state::BlockWear;
use crate::sides::{Side, Sides};

impl Bodies for PointIntegrator {
    type State = PointState;
    type History = PointHistory;
    type Contact<'a> = &'a mut Self;

    fn unworn(scene: &Scene, plan: &EffectsPlan, _: &mut dyn Observer) -> Result<Self, SolveError> {
        let contact = contact_of(scene, plan)?;
        Ok(Self::unloaded(&motions_of(&contact, scene, plan))?)
    }

    fn resumed(
        scene: &Scene,
        plan: &EffectsPlan,
        state: &mut PointState,
        _: &mut dyn Observer,
    ) -> Result<Self, SolveError> {
        let contact = contact_of(scene, plan)?;
        state.resume(&contact);
        Ok(Self::resume(&motions_of(&contact, scene, plan), state))
    }

    fn contact<'a>(&'a mut self, block: &'a Scene) -> &'a mut Self {
        self.take_motion(block);
        self
    }
}

impl Contact for &mut PointIntegrator {
    type State = PointState;
    type History = PointHistory;
    type Worn = Worn<Sides<DepthMap>>;

    fn load(&mut self) -> Result<PointState, SolveError> {
        Ok((**self).load()?)
    }

    fn compute_cycle(
        &mut self,
        state: &mut PointState,
        until: u64,
        _: bool,
    ) -> Result<(), SolveError> {
        (**self).compute_cycle(state, until)?;
        Ok(())
    }

    fn cycle(state: &PointState) -> u64 {
        state.cycle()
    }

    fn max_depth_mm(state: &PointState) -> Sides<f64> {
        state.last().max_depth_mm
    }

    fn fastest_rate(state: &PointState) -> Sides<f64> {
        state.fastest_rate()
    }

    fn rate_toward(state: &PointState, side: Side, limit: f64) -> f64 {
        state.rate_toward(side, limit)
    }

    fn change_motion(&mut self, state: &mut PointState, from: Motion) -> Result<(), SolveError> {
        Ok((**self).change_motion(state, from)?)
    }

    fn totals(&self, state: &PointState) -> BlockWear {
        (**self).totals(state)
    }

    /// Doses.
    fn nodal_depths<'a>(&self, state: &'a PointState) -> Sides<Cow<'a, [f64]>> {
        self.doses(state).map(Cow::Owned)
    }

    fn take_history(state: &mut PointState) -> PointHistory {
        state.take_motion_history()
    }

    fn continue_motion(state: &mut PointState, history: PointHistory) {
        state.continue_motion(history);
    }

    /// At the cells of the contact after the cycles.
    fn touching(
        &self,
        _: &Scene,
        evaluation: &Evaluation<'_>,
        states: Change<&PointState>,
        moment: Moment,
    ) -> Touching {
        let Change { before, after } = states;
        let contact = AreaContact {
            force_n: part_way(before.last().force_n, after.last().force_n, moment.part),
            depths_mm: after.depths_in_contact(moment.part, moment.deepest),
        };
        evaluation.area(&contact, moment.time_s)
    }

    fn worn(&self, state: &PointState) -> Worn<Sides<DepthMap>> {
        let maps = Sides::from_fn(|side| state.depth(side));
        Worn {
            scars: maps.as_ref().map(|map| WornArea::new(&map.depth_mm)),
            places: maps,
        }
    }

    fn surface<'a>(
        &'a self,
        _: &'a PointState,
        worn: &'a Worn<Sides<DepthMap>>,
        side: Side,
    ) -> impl Exposed + 'a {
        worn.scars.of(side)
    }

    fn report(
        &self,
        scene: &Scene,
        state: &PointState,
        worn: &Worn<Sides<DepthMap>>,
        resistance: Option<&ContactResistance>,
    ) -> CycleReport {
        record::point_report(&PointEnd {
            scene,
            cycle: state.last(),
            depth: &worn.places,
            resistance,
        })
    }

    fn snapshot(
        &self,
        _: &Scene,
        state: &PointState,
        worn: &Worn<Sides<DepthMap>>,
    ) -> Result<Snapshot, SolveError> {
        let depth = worn.places.clone();
        Ok(snapshot(self.scene(), state, depth))
    }

    fn resolution(&self, run: &PointRun) -> Resolution {
        let state = &run.state;
        let (cells, cell_mm, (solves, iterations)) = state.size();
        let (computed, most_increments) = state.computed();
        Resolution {
            contact_element_mm: cell_mm,
            contact_elements: cells,
            increments_per_cycle: u32::try_from(most_increments).unwrap_or(u32::MAX),
            computed_cycles: count(computed),
            work: Work {
                increments: count(solves),
                factorizations: 0,
                unknowns: count(iterations).saturating_mul(count(cells)),
                response_entries: 0,
            },
            dofs: cells,
            relocations: 0,
            estimated_relative_error: state.mean_jump_error(),
        }
    }

    /// The area is that of the doses, which every law has: layers have no rate of their own.
    fn checks(&self, state: &PointState, _: &CycleReport) -> Checks {
        let residuals = state.residuals(self.scene(), self.friction());
        Checks {
            force_balance: residuals.force,
            force_balance_present_normals: residuals.force,
            worn_area: residuals.dose,
            complementarity: residuals.contact,
            friction_cone: residuals.friction_cone,
            friction_use: residuals.friction_use,
        }
    }

    fn resumable(run: &PointRun) -> Resumable<'_> {
        Resumable::Point(run)
    }
}

/// The contact with what the plan simulates.
fn contact_of(scene: &Scene, plan: &EffectsPlan) -> Result<PointScene, PointError> {
    let slip = if plan.simulates(Effect::StickMemory) {
        SlipRegime::Partial
    } else {
        SlipRegime::Gross
    };
    let mut contact = PointScene::of(scene, slip).ok_or(PointError::Dimension)?;
    let (slider, receptacle) = (&scene.slider, &scene.receptacle);
    let motion = scene.timed_motion().constant();
    let on = plan.surface_effects();
    contact.bodies.slider.wear = slider
        .surface_wear(on, motion)
        .filter(|_| plan.simulates(Effect::SliderWear));
    contact.bodies.receptacle.wear = receptacle
        .surface_wear(on, motion)
        .filter(|_| plan.simulates(Effect::ReceptacleWear));
    if !plan.simulates(Effect::SpringFading) {
        contact.spring_n_per_mm = 0.0;
    }
    Ok(contact)
}

/// Motions of the contact, with the friction of what the plan simulates.
fn motions_of(contact: &PointScene, scene: &Scene, plan: &EffectsPlan) -> PointMotions {
    PointMotions::of(contact, scene, plan.surface_effects().plating)
}

/// The snapshot of the present state.
fn snapshot(contact: &PointScene, state: &PointState, depth: Sides<DepthMap>) -> Snapshot {
    let profile = |side| {
        let map: &DepthMap = depth.of(side);
        DepthProfile {
            x_mm: map.x_mm.clone(),
            depth_mm: map.section(),
        }
    };
    // Cycles begin at the right turning point.
    let [left, right] = state.turning();
    let end_of = |position| {
        let legs = legs(contact).into_iter();
        let mut ends = legs.filter(move |leg| leg.at == Some(position));
        ends.next().map(|leg| leg.to)
    };
    let mut placed = vec![(Position::Neutral, 0.0, state.neutral())];
    // Before the first cycle, and in a continuous motion, there are no turning points.
    if state.cycle() > 0 {
        let turning = [(Position::Rightmost, right), (Position::Leftmost, left)];
        let turning = turning.into_iter();
        placed.extend(turning.filter_map(|(position, at)| Some((position, end_of(position)?, at))));
    }
    Snapshot {
        cycle: state.cycle(),
        receptacle: profile(Side::Receptacle),
        slider: profile(Side::Slider),
        positions: placed
            .iter()
            .map(|&(position, slider_x_mm, placed)| tractions(position, slider_x_mm, placed))
            .collect(),
        friction_loop: friction_loop(contact, state),
        fields: Vec::new(),
        line_fields: Vec::new(),
        area: Some(AreaMaps {
            pressure: pressure_map(state.neutral()),
            depth,
        }),
        stations: Vec::new(),
    }
}

fn tractions(position: Position, slider_x_mm: f64, placed: &ContactAtPosition) -> TractionField {
    TractionField {
        position,
        slider_x_mm,
        x_mm: placed.x_on_receptacle(),
        pressure_mpa: placed.section_pressure(),
        shear_mpa: placed.shear_mpa.clone(),
    }
}

fn pressure_map(placed: &ContactAtPosition) -> PressureMap {
    let cells = placed.cells;
    PressureMap {
        x_mm: placed.x_on_receptacle(),
        z_mm: (0..cells.along_z)
            .map(|column| cells.z_mm(column))
            .collect(),
        pressure_mpa: placed.pressure_mpa.clone(),
    }
}

/// The loop of the last cycle.
fn friction_loop(contact: &PointScene, state: &PointState) -> FrictionLoop {
    let mut found = FrictionLoop::default();
    for point in state.friction_loop(contact) {
        found.displacement_mm.push(point.displacement_mm);
        found
            .tangential_force_n_per_mm
            .push(point.line_load_n_per_mm);
        found.tangential_force_n.push(point.force_n);
    }
    found
}
