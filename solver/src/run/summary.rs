//! The summary of a run.

use crate::checkpoint::SectionRun;
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
    let state = &run.state;
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
            relocations: run.relocations,
            estimated_relative_error: match &run.mission {
                Some(mission) => mission.mean_error(state),
                None => state.jump.mean_error(),
            },
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
            mission.wear(state, &model.interface.wear)
        }),
    }
}
