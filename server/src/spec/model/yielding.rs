//! Contacts whose unworn peak pressure is beyond the hardness of their surfaces.

use api::problem::Fault;
use solver::effects::Effect;
use solver::scene::Scene;

/// A warning of a peak pressure beyond the hardness of the softer surface, whether it wears or not.
pub(super) fn yields(scene: &Scene) -> Option<Fault> {
    let mut decisions = solver::effects::plan(scene).decisions.into_iter();
    let plasticity = decisions.find(|decision| decision.effect == Effect::Plasticity)?;
    let ratio = plasticity.indicator?.unworn;
    (ratio > 1.0).then(|| {
        let detail = format!(
            "the peak pressure of the unworn contact is {ratio:.2} times the hardness of the softer surface: it yields, and is simulated \
             as elastic"
        );
        Fault::new("/load", detail)
    })
}
