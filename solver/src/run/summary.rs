//! The summary of a run.

use super::contact::{Contact, RunOfContact};
use crate::effects::EffectsPlan;
use crate::record::{Outcome, Summary};
use crate::scene::Scene;

/// The summary of a run with its outcome.
pub(super) fn summary<C: Contact>(
    scene: &Scene,
    plan: &EffectsPlan,
    contact: &C,
    run: &RunOfContact<C>,
    outcome: Outcome,
) -> Summary {
    let (state, resistance) = (&run.state, run.electrical.resistance.as_ref());
    let last = contact.report(scene, state, &contact.worn(state), resistance);
    Summary {
        outcome,
        initial: run.initial,
        resolution: contact.resolution(run),
        checks: contact.checks(state, &last),
        last,
        errors: None,
        warnings: Vec::new(),
        compared: run.compared.ended(plan.skipped_change(), &run.life),
        effects: plan.verdicts(),
        crossings: run.crossings.clone(),
        life: run.life.clone(),
        blocks: run.mission.as_ref().map_or_else(Vec::new, |mission| {
            let depths = contact.nodal_depths(state);
            let depths = depths.as_ref().map(|depths| &depths[..]);
            mission.wear(&contact.totals(state), depths)
        }),
    }
}
