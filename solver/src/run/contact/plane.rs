//! The run of a plane section: its mesh follows the worn surfaces, and its operators are condensed again where the geometry has drifted or
//! the contact has outgrown its zones.

use std::borrow::Cow;

use super::computed::Computed;
use super::{Bodies, Contact, Moment};
use crate::SolveError;
use crate::ale;
use crate::change::Change;
use crate::checkpoint::{Resumable, SectionRun, SectionState};
use crate::condensation::{self, Condensed};
use crate::cycle::{CycleRecord, CycleState, Integrator, MotionHistory, mean_error};
use crate::effects::EffectsPlan;
use crate::electrical::{ContactResistance, ElectricalState, Evaluation, Touching};
use crate::fields;
use crate::law::surface;
use crate::model::{self, Model, ZONE_WIDENING};
use crate::observer::{Observer, Phase};
use crate::record::{self, Checks, CycleReport, Exposed, Resolution, Snapshot};
use crate::scene::{Motion, Scene};
use crate::schedule::mission_state::{BlockWear, MissionState};
use crate::sides::{Side, Sides};

/// A plane section: its model and its operators.
pub(in crate::run) struct Plane {
    model: Model,
    condensed: Condensed,
    /// Factor by which the zones of the unworn section are wider than the scene's.
    widened: f64,
}

impl Bodies for Plane {
    type State = SectionState;
    type History = MotionHistory;
    type Contact<'a> = PlaneContact<'a>;

    const HAS_PHASES: bool = true;

    fn unworn(
        scene: &Scene,
        plan: &EffectsPlan,
        observer: &mut dyn Observer,
    ) -> Result<Self, SolveError> {
        observer.on_phase(Phase::Mesh);
        let model = model::build(scene, plan)?;
        observer.on_phase(Phase::Condense);
        Self::condensed(scene, model, 1.0)
    }

    fn resumed(
        scene: &Scene,
        plan: &EffectsPlan,
        state: &mut SectionState,
        observer: &mut dyn Observer,
    ) -> Result<Self, SolveError> {
        observer.on_phase(Phase::Mesh);
        let unworn = model::build(scene, plan)?;
        state.check(&unworn)?;
        let model = state.model(&unworn)?;
        observer.on_phase(Phase::Condense);
        Self::condensed(scene, model, state.widened)
    }

    fn with_effects(
        mut self,
        scene: &Scene,
        plan: &EffectsPlan,
        _: Option<&mut SectionState>,
        _: &mut dyn Observer,
    ) -> Result<Self, SolveError> {
        self.model.follow(scene, plan);
        Ok(self)
    }

    fn widened(self, scene: &Scene) -> Result<Self, SolveError> {
        let widened = self.widened * ZONE_WIDENING;
        let model = self.model.with_zones_widened(widened)?;
        Self::condensed(scene, model, widened)
    }

    fn renewed(
        self,
        scene: &Scene,
        state: &mut SectionState,
        observer: &mut dyn Observer,
    ) -> Result<Self, SolveError> {
        observer.on_phase(Phase::Relocate);
        state.relocated();
        let model = state.model(&self.model)?;
        observer.on_phase(Phase::Condense);
        let condensed = condensation::renew(&model, &self.model, self.condensed, scene.threads)?;
        Ok(Self {
            model,
            condensed,
            widened: state.widened,
        })
    }

    fn contact<'a>(&'a mut self, block: &'a Scene) -> PlaneContact<'a> {
        PlaneContact {
            integrator: Integrator::new(block, &self.model, &self.condensed.operators),
            plane: self,
            record: CycleRecord::default(),
        }
    }
}

impl Plane {
    fn condensed(scene: &Scene, model: Model, widened: f64) -> Result<Self, SolveError> {
        Ok(Self {
            condensed: condensation::condense(&model, scene.threads)?,
            model,
            widened,
        })
    }
}

/// The contact of a section.
pub(in crate::run) struct PlaneContact<'a> {
    plane: &'a Plane,
    integrator: Integrator<'a>,
    /// Record of the last computed cycle.
    record: CycleRecord,
}

impl Contact for PlaneContact<'_> {
    type State = SectionState;
    type History = MotionHistory;
    type Worn = ();

    fn load(&mut self) -> Result<SectionState, SolveError> {
        let Plane {
            model,
            condensed,
            widened,
        } = self.plane;
        let mut state = CycleState::start(&condensed.operators, model.interface.slave);
        self.record = self.integrator.apply_load(&mut state)?;
        Ok(SectionState {
            cycle_state: state,
            built: None,
            relocations: 0,
            widened: *widened,
        })
    }

    fn initial_quarter(&mut self, state: &mut SectionState) -> Result<(), SolveError> {
        Ok(self.integrator.initial_quarter(&mut state.cycle_state)?)
    }

    fn compute_cycle(
        &mut self,
        state: &mut SectionState,
        until: u64,
        is_reported: bool,
    ) -> Result<(), SolveError> {
        let state = &mut state.cycle_state;
        self.record = self.integrator.compute_cycle(state, until, is_reported)?;
        Ok(())
    }

    fn has_drifted(&self, scene: &Scene, state: &SectionState) -> bool {
        let model = &self.plane.model;
        model.relocates && ale::has_drifted(model, &state.cycle_state.depth, &scene.accuracy)
    }

    fn widen(state: &mut SectionState) {
        state.widen();
    }

    fn restore(state: &mut SectionState, before: SectionState) {
        let work = state.cycle_state.work;
        *state = before;
        state.cycle_state.work = work;
    }

    fn cycle(state: &SectionState) -> u64 {
        state.cycle_state.cycle
    }

    fn max_depth_mm(state: &SectionState) -> Sides<f64> {
        state.cycle_state.depth.largest_of_each()
    }

    fn fastest_rate(state: &SectionState) -> Sides<f64> {
        state.cycle_state.jump.fastest_rate()
    }

    fn cycles_left(&self, state: &SectionState) -> f64 {
        self.cycles_left_at(state, state.cycle_state.jump.rates())
    }

    fn is_worn_through(&self, state: &SectionState) -> bool {
        let spines = &self.integrator.spines;
        spines.are_worn_through(&state.cycle_state.depth)
    }

    fn change_motion(&mut self, state: &mut SectionState, from: Motion) -> Result<(), SolveError> {
        let state = &mut state.cycle_state;
        Ok(self.integrator.change_motion(state, from)?)
    }

    fn totals(&self, state: &SectionState) -> BlockWear {
        let (state, wear) = (&state.cycle_state, self.plane.model.interface.wear);
        let whole = BlockWear::whole(
            state.cycle,
            state.sliding_distance,
            state.energy,
            state.worn_area,
        );
        whole.with_equivalents(Sides::from_fn(|side| {
            surface::equivalents(*wear.of(side), state.depth.of(side)).into_owned()
        }))
    }

    fn nodal_depths<'a>(&self, state: &'a SectionState) -> Sides<Cow<'a, [f64]>> {
        state.cycle_state.depth.as_slices().map(Cow::Borrowed)
    }

    fn cycles_left_at(&self, state: &SectionState, rates: Sides<&[f64]>) -> f64 {
        let (wear, depth) = (self.plane.model.interface.wear, &state.cycle_state.depth);
        let rates = Sides::from_fn(|side| {
            surface::at_relative_rates(*wear.of(side), rates.of(side), depth.of(side))
        });
        let rates = rates.as_ref().map(|rates| &rates[..]);
        self.integrator.spines.cycles_left(depth, rates)
    }

    fn take_history(state: &mut SectionState) -> MotionHistory {
        state.cycle_state.take_motion_history()
    }

    fn continue_motion(state: &mut SectionState, history: MotionHistory) {
        state.cycle_state.continue_motion(history);
    }

    fn touching(
        &self,
        scene: &Scene,
        evaluation: &Evaluation<'_>,
        states: Change<&SectionState>,
        moment: Moment,
    ) -> Touching {
        let computed = Computed {
            scene,
            model: &self.plane.model,
            condensed: &self.plane.condensed,
            states: Change {
                before: &states.before.cycle_state,
                after: &states.after.cycle_state,
            },
        };
        computed.contact(evaluation, moment)
    }

    fn follow_resistance(state: &mut SectionState, electrical: &ElectricalState) {
        state.cycle_state.constriction_mohm = electrical.constriction_mohm();
    }

    fn worn(&self, _: &SectionState) {}

    fn surface<'a>(&'a self, state: &'a SectionState, (): &'a (), side: Side) -> impl Exposed + 'a {
        record::worn_surface(&self.plane.model, &state.cycle_state, side)
    }

    fn report(
        &self,
        scene: &Scene,
        state: &SectionState,
        (): &(),
        resistance: Option<&ContactResistance>,
    ) -> CycleReport {
        let model = &self.plane.model;
        record::report(scene, model, &state.cycle_state, resistance.copied())
    }

    /// With fields inside the bodies where the scene asks for them.
    fn snapshot(
        &self,
        scene: &Scene,
        state: &SectionState,
        (): &(),
    ) -> Result<Snapshot, SolveError> {
        let (model, state) = (&self.plane.model, &state.cycle_state);
        let fields = if scene.output.fields {
            let contacts = &self.record.contacts;
            fields::placed(model, &self.plane.condensed, &state.depth, contacts)?
        } else {
            Vec::new()
        };
        Ok(record::snapshot(model, state, self.record.clone(), fields))
    }

    fn resolution(&self, run: &SectionRun) -> Resolution {
        let (model, state) = (&self.plane.model, &run.state.cycle_state);
        let histories = run.mission.iter().flat_map(MissionState::histories);
        Resolution {
            contact_element_mm: model.sizes.contact_element,
            contact_elements: model.bodies.receptacle.contact_x().len() - 1,
            increments_per_cycle: u32::try_from(state.most_increments).unwrap_or(u32::MAX),
            computed_cycles: state.computed_cycles,
            work: state.work,
            dofs: model.bodies.slider.dofs() + model.bodies.receptacle.dofs(),
            relocations: run.state.relocations,
            estimated_relative_error: mean_error(state, histories),
        }
    }

    fn checks(&self, state: &SectionState, last: &CycleReport) -> Checks {
        Checks {
            worn_area: record::worn_area_residual(&state.cycle_state, last),
            ..state.cycle_state.checks
        }
    }
    fn resumable(run: &SectionRun) -> Resumable<'_> {
        Resumable::Section(run)
    }
}
