//! The load on the unworn bodies: cycle 0.

use std::ops::ControlFlow;

use super::computed::{Computed, UNLIMITED};
use super::resistance;
use super::snapshot::snapshot;
use crate::SolveError;
use crate::checkpoint::{EarlierRuns, SectionRun, SectionState};
use crate::condensation::{self, Condensed};
use crate::cycle::{BlockWear, CycleState, Integrator, MissionState};
use crate::effects::EffectsPlan;
use crate::electrical::ElectricalState;
use crate::model::{self, Model};
use crate::observer::{Event, Observer, Phase, Restart};
use crate::record::{self, Compared, Initial, Life};
use crate::scene::Scene;
use crate::sides::Sides;

/// The loaded, unworn bodies, and what their load required.
pub(super) struct Loaded {
    pub(super) plan: EffectsPlan,
    pub(super) model: Model,
    pub(super) condensed: Condensed,
    pub(super) run: SectionRun,
    /// `Break` if the observer has stopped the run.
    pub(super) flow: ControlFlow<()>,
}

/// Meshes, condenses and loads the unworn bodies: with wider zones where the contact is too wide for them, and with effects that were
/// skipped where it has no solution without them.
pub(super) fn load_unworn(
    scene: &Scene,
    plan: &EffectsPlan,
    observer: &mut dyn Observer,
) -> Result<Loaded, SolveError> {
    observer.on_phase(Phase::Mesh);
    let (mut plan, mut model) = (plan.clone(), model::build(scene, plan)?);
    observer.on_phase(Phase::Condense);
    let mut condensed = condensation::condense(&model, scene.threads)?;
    let (mut crossings, mut widened) = (Vec::new(), 1.0);
    loop {
        let error = match load(scene, &plan, &model, &condensed, observer) {
            Ok((mut run, flow)) => {
                (run.crossings, run.state.widened) = (crossings, widened);
                return Ok(Loaded {
                    plan,
                    model,
                    condensed,
                    run,
                    flow,
                });
            }
            Err(error) => error,
        };
        let required = plan.required_after_failure(0);
        let restart = match required.first() {
            _ if error.needs_wider_zones() => Restart::WiderZones(&error),
            Some(first) => Restart::Without(first.effect, &error),
            None => return Err(error),
        };
        if observer.on(Event::Restart(restart)).is_break() {
            return Err(error);
        }
        if error.needs_wider_zones() {
            widened *= model::ZONE_WIDENING;
            model = model.with_zones_widened(widened)?;
            condensed = condensation::condense(&model, scene.threads)?;
        } else {
            crossings.extend(required);
            plan = plan.after(&crossings);
            model.follow(scene, &plan);
        }
    }
}

/// Cycle 0: the unworn, loaded state.
fn load(
    scene: &Scene,
    plan: &EffectsPlan,
    model: &Model,
    condensed: &Condensed,
    observer: &mut dyn Observer,
) -> Result<(SectionRun, ControlFlow<()>), SolveError> {
    let mut state = CycleState::start(&condensed.operators, model.interface.slave);
    let blocks = scene.blocks();
    let mut integrator = Integrator::new(&blocks[0], model, &condensed.operators);
    let record = integrator.apply_load(&mut state)?;
    let mut electrical = ElectricalState::default();
    if let Some(evaluation) = resistance::evaluation(scene, plan) {
        let unworn = Computed {
            evaluation: &evaluation,
            scene,
            model,
            condensed,
            before: &state,
            after: &state,
        };
        evaluation.update(&mut electrical, |part| unworn.contact(part, UNLIMITED));
        state.constriction_mohm = electrical.constriction_mohm();
    }
    let report = record::report(scene, model, &state, electrical.resistance);
    let mut compared = Compared::default();
    compared.push(&report);
    let mut flow = observer.on(Event::Cycle(&report));
    if flow.is_continue() {
        let snapshot = snapshot(scene, model, condensed, &state, record)?;
        flow = observer.on(Event::Snapshot(&snapshot));
    }
    if flow.is_continue() {
        integrator.initial_quarter(&mut state)?;
    }
    let initial = Initial {
        peak_pressure_mpa: report.peak_pressure_mpa,
        contact_half_width_mm: report.contact_half_width_mm,
        contact_resistance_mohm: electrical.total_mohm(),
    };
    let mission = scene.mission.as_ref();
    let run = SectionRun {
        mission: mission.map(|mission| {
            let totals = BlockWear::total(&state, &Sides::default());
            MissionState::new(scene, mission, totals)
        }),
        state: SectionState {
            cycle_state: state,
            built: None,
            relocations: 0,
            widened: 1.0,
        },
        initial,
        crossings: Vec::new(),
        compared,
        life: Life::default(),
        electrical,
        earlier: EarlierRuns::default(),
    };
    Ok((run, flow))
}
