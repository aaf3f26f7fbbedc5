//! The run of a point contact: cycles until it ends, with the events of the run of a section.

mod snapshot;

use std::ops::ControlFlow;

use super::resistance::{self, Consequence};
use crate::SolveError;
use crate::checkpoint::{Earlier, Misfit, PointRun, Resumable};
use crate::effects::{Effect, EffectsPlan};
use crate::electrical::{AreaContact, ElectricalState};
use crate::number::{count, real_cycles};
use crate::observer::{Event, Observer, Phase};
use crate::point::{DepthMap, PointError, PointIntegrator, PointScene, PointState, SlipRegime};
use crate::record::{
    self, Checks, Compared, CycleReport, Exposed, Initial, Life, Outcome, PointEnd, Resolution,
    Summary, WornArea,
};
use crate::scene::Scene;
use crate::schedule::stops::{self, Progress};
use crate::sides::Sides;
use snapshot::snapshot;

/// Solves a point contact by a plan, after earlier runs of it.
pub(super) fn begin(
    scene: &Scene,
    plan: &EffectsPlan,
    earlier: Earlier,
    observer: &mut dyn Observer,
) -> Result<Summary, SolveError> {
    observer.on_phase(Phase::Cycles);
    let contact = contact_of(scene, plan)?;
    let (_, state) = PointIntegrator::start(&contact)?;
    let mut electrical = ElectricalState::default();
    update_resistance((scene, plan), &mut electrical, &state);
    let unworn = state.last();
    let initial = Initial {
        peak_pressure_mpa: unworn.peak_pressure_mpa,
        contact_half_width_mm: unworn.half_length_along_mm,
        contact_resistance_mohm: electrical.total_mohm(),
    };
    let mut run = PointRun {
        state,
        initial,
        crossings: Vec::new(),
        compared: Compared::default(),
        life: Life::default(),
        electrical,
        earlier,
    };
    let depth = depths(&run.state);
    let report = report(scene, &run, &depth);
    run.compared.push(&report);
    let snapshot = snapshot((scene, &contact), &run.state, depth);
    let events = [Event::Cycle(&report), Event::Snapshot(&snapshot)];
    if events
        .into_iter()
        .any(|event| observer.on(event).is_break())
    {
        return Ok(summary((scene, plan, &contact), &run, Outcome::Stopped));
    }
    advance(scene, plan.clone(), run, observer)
}

/// Solves a point contact by a plan from a checkpoint to its end.
pub(super) fn proceed(
    scene: &Scene,
    plan: &EffectsPlan,
    run: PointRun,
    observer: &mut dyn Observer,
) -> Result<Summary, SolveError> {
    if run.state.cycle() > scene.cycles {
        let (cycle, cycles) = (run.state.cycle(), scene.cycles);
        return Err(Misfit::Beyond { cycle, cycles }.into());
    }
    observer.on_phase(Phase::Cycles);
    let plan = plan.after(&run.crossings);
    advance(scene, plan, run, observer)
}

/// Computes cycles until the run ends; where it calls for an effect that was skipped, it goes on from the cycle before with it.
fn advance(
    scene: &Scene,
    mut plan: EffectsPlan,
    mut run: PointRun,
    observer: &mut dyn Observer,
) -> Result<Summary, SolveError> {
    loop {
        let contact = contact_of(scene, &plan)?;
        run.state.resume(&contact);
        let flow = integrate((scene, &plan, &contact), &mut run, observer)?;
        match flow {
            ControlFlow::Break(outcome) => {
                return Ok(summary((scene, &plan, &contact), &run, outcome));
            }
            ControlFlow::Continue(()) => plan = plan.after(&run.crossings),
        }
    }
}

/// Computes cycles until the run ends (`Break`) or calls for an effect (`Continue`).
fn integrate(
    (scene, plan, contact): (&Scene, &EffectsPlan, &PointScene),
    run: &mut PointRun,
    observer: &mut dyn Observer,
) -> Result<ControlFlow<Outcome>, SolveError> {
    const STOPPED: ControlFlow<Outcome> = ControlFlow::Break(Outcome::Stopped);
    let mut integrator = PointIntegrator::resume(contact, &run.state);
    // Where a limit of the resistance was passed by too much.
    let mut until_limit = u64::MAX;
    let mut scars = scars(&depths(&run.state));
    while run.state.cycle() < scene.cycles {
        let before = run.state.clone();
        let now = progress(scene, run);
        let until = stops::next(scene, now, |side, part| scars.of(side).depth_of_part(part));
        integrator.compute_cycle(&mut run.state, until.min(until_limit))?;
        let cycles = (before.cycle(), run.state.cycle());
        let called_for = plan.crossed(scene, cycles, run.state.last().max_depth_mm);
        if !called_for.is_empty() {
            run.state = before;
            run.crossings.extend(called_for);
            return Ok(ControlFlow::Continue(()));
        }
        let electrical_before = run.electrical.clone();
        update_resistance((scene, plan), &mut run.electrical, &run.state);
        let resistances = (&electrical_before, &run.electrical);
        if let Some(Consequence::GoTo(sooner)) =
            resistance::consequence(scene, plan, cycles, resistances)
        {
            run.state = before;
            (run.electrical, until_limit) = (electrical_before, sooner);
            continue;
        }
        until_limit = u64::MAX;
        let depth = depths(&run.state);
        scars = self::scars(&depth);
        let report = report(scene, run, &depth);
        run.compared.push(&report);
        push_life(scene, run, (&electrical_before, &scars));
        if observer.on(Event::Cycle(&report)).is_break() {
            return Ok(STOPPED);
        }
        let end = stops::end(scene, progress(scene, run), |side, part| {
            scars.of(side).depth_of_part(part)
        });
        if end.is_some()
            || scene
                .output
                .snapshots_at_cycles
                .contains(&run.state.cycle())
        {
            let snapshot = snapshot((scene, contact), &run.state, depth);
            if observer.on(Event::Snapshot(&snapshot)).is_break() {
                return Ok(STOPPED);
            }
        }
        if let Some(outcome) = end {
            return Ok(ControlFlow::Break(outcome));
        }
        if observer
            .on(Event::Checkpoint(Resumable::Point(run)))
            .is_break()
        {
            return Ok(STOPPED);
        }
    }
    Ok(ControlFlow::Break(Outcome::Completed))
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

fn depths(state: &PointState) -> Sides<DepthMap> {
    Sides::from_fn(|side| state.depth(side))
}

fn scars(depth: &Sides<DepthMap>) -> Sides<WornArea> {
    depth.as_ref().map(|map| WornArea::new(&map.depth_mm))
}

fn report(scene: &Scene, run: &PointRun, depth: &Sides<DepthMap>) -> CycleReport {
    record::point_report(&PointEnd {
        scene,
        cycle: run.state.last(),
        depth,
        resistance: run.electrical.resistance.as_ref(),
    })
}

/// Takes the contact after a computed cycle into the resistance, if the plan has it.
fn update_resistance(
    (scene, plan): (&Scene, &EffectsPlan),
    electrical: &mut ElectricalState,
    state: &PointState,
) {
    if let Some(evaluation) = resistance::evaluation(scene, plan) {
        let contact = AreaContact {
            force_n: state.last().force_n,
            depths_mm: state.depths_in_contact(),
            time_s: scene
                .elapsed(real_cycles(state.cycle()))
                .1
                .unwrap_or_default(),
        };
        evaluation.update_area(electrical, &contact);
    }
}

/// Takes a computed cycle into the life by the criteria of the scene.
fn push_life(
    scene: &Scene,
    run: &mut PointRun,
    (before, scars): (&ElectricalState, &Sides<WornArea>),
) {
    let cycle = run.state.cycle();
    if let Some((limits, resistances)) = resistance::of_life(scene, (before, &run.electrical)) {
        run.life.push_resistance(limits, cycle, resistances);
    }
    run.life.push(scene, cycle, |side| scars.of(side));
}

/// Its progress for its stops: half-spaces are never worn through.
fn progress(scene: &Scene, run: &PointRun) -> Progress {
    Progress {
        cycle: run.state.cycle(),
        cycles_left: f64::INFINITY,
        fastest_rate: run.state.fastest_rate(),
        worn_through: false,
        exceeds_resistance: resistance::exceeds_limit(scene, &run.electrical),
    }
}

/// The summary of a run with its outcome.
fn summary(
    (scene, plan, contact): (&Scene, &EffectsPlan, &PointScene),
    run: &PointRun,
    outcome: Outcome,
) -> Summary {
    let last = report(scene, run, &depths(&run.state));
    let (cells, cell_mm, (solves, iterations)) = run.state.size();
    let (computed, most_increments) = run.state.computed();
    Summary {
        outcome,
        initial: run.initial,
        resolution: Resolution {
            contact_element_mm: cell_mm,
            contact_elements: cells,
            increments_per_cycle: u32::try_from(most_increments).unwrap_or(u32::MAX),
            computed_cycles: count(computed),
            work: crate::contact::Work {
                increments: count(solves),
                factorizations: 0,
                unknowns: count(iterations).saturating_mul(count(cells)),
                response_entries: 0,
            },
            dofs: cells,
            relocations: 0,
            estimated_relative_error: run.state.mean_jump_error(),
        },
        checks: checks(contact, run),
        last,
        errors: None,
        warnings: Vec::new(),
        compared: run.compared.ended(plan.skipped_change(), &run.life),
        effects: plan.verdicts(),
        crossings: run.crossings.clone(),
        life: run.life.clone(),
        blocks: Vec::new(),
    }
}

/// Worst residuals so far. The area is that of the doses, which every law has: layers have no rate of their own.
fn checks(contact: &PointScene, run: &PointRun) -> Checks {
    let residuals = run.state.residuals(contact);
    Checks {
        force_balance: residuals.force,
        force_balance_present_normals: residuals.force,
        worn_area: residuals.dose,
        complementarity: residuals.contact,
        friction_cone: residuals.friction_cone,
        friction_use: residuals.friction_use,
    }
}
