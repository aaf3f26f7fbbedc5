//! The summary of a run.

use crate::checkpoint::SectionRun;
use crate::cycle::{BlockWear, MissionState, mean_error};
use crate::effects::EffectsPlan;
use crate::model::Model;
use crate::record::{self, Outcome, Resolution, Summary};
use crate::scene::Scene;

/// The summary of a run with its outcome.
pub(super) fn summary(
    scene: &Scene,
    plan: &EffectsPlan,
    model: &Model,
    run: &SectionRun,
    outcome: Outcome,
) -> Summary {
    let state = &run.state.cycle_state;
    let last = record::report(scene, model, state, run.electrical.resistance);
    let mut checks = state.checks;
    checks.worn_area = record::worn_area_residual(state, &last);
    Summary {
        outcome,
        initial: run.initial,
        resolution: Resolution {
            contact_element_mm: model.sizes.contact_element,
            contact_elements: model.bodies.receptacle.contact_x().len() - 1,
            increments_per_cycle: u32::try_from(state.most_increments).unwrap_or(u32::MAX),
            computed_cycles: state.computed_cycles,
            work: state.work,
            dofs: model.bodies.slider.dofs() + model.bodies.receptacle.dofs(),
            relocations: run.state.relocations,
            estimated_relative_error: mean_error(
                state,
                run.mission.iter().flat_map(MissionState::histories),
            ),
        },
        last,
        checks,
        errors: None,
        warnings: Vec::new(),
        compared: run.compared.ended(plan.skipped_change(), &run.life),
        effects: plan.verdicts(),
        crossings: run.crossings.clone(),
        life: run.life.clone(),
        blocks: run.mission.as_ref().map_or_else(Vec::new, |mission| {
            let totals = BlockWear::total(state, &model.interface.wear);
            mission.wear(&totals, state.depth.as_slices())
        }),
    }
}
