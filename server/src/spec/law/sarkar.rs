//! Sarkar's wear law.

use solver::scene;

use crate::spec::law::definition::{ByFriction, LawDefinition};
use crate::spec::law::wear_coefficient::K_OVER_H;

pub(super) const DEFINITION: LawDefinition = LawDefinition {
    formula: "dh = (k/H) sqrt(1 + 3 mu^2) p |ds|",
    states: &[],
    friction: ByFriction::Growing,
    groups: &[K_OVER_H],
    choices: &[],
    engine_law: |values| {
        Some(scene::WearLaw::Sarkar {
            k_over_h_per_mpa: values.k_over_h_per_mpa()?,
            friction: values.friction,
        })
    },
    outside_range: None,
    #[cfg(test)]
    example: r#""k":0.002,"hardness_mpa":1700"#,
};
