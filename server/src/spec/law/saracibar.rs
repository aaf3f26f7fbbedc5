//! Saracibar and Chiumenti's wear law.

use std::ops::RangeInclusive;

use solver::scene;

use crate::spec::law::definition::{Absent, ByFriction, FieldGroup, LawDefinition, each, number};
use crate::spec::law::wear_coefficient::K_OVER_H;

/// Coefficient of friction mu0, -: that of a measurement, which is not 0.
const REFERENCE_FRICTION: RangeInclusive<f64> = 1e-3..=2.0;

pub(super) const DEFINITION: LawDefinition = LawDefinition {
    formula: "dh = (k/H) (mu/mu0) p |ds|",
    states: &[],
    friction: ByFriction::Proportional,
    groups: &[
        K_OVER_H,
        FieldGroup {
            numbers: &[number!(
                reference_friction,
                "mu0",
                REFERENCE_FRICTION,
                Absent::Required(
                    "`saracibar` needs the coefficient of friction at which k was measured"
                )
            )],
            resolve: each,
        },
    ],
    choices: &[],
    engine_law: |values| {
        Some(scene::WearLaw::Saracibar {
            k_over_h_per_mpa: values.k_over_h_per_mpa()?,
            friction: values.friction,
            reference_friction: values.given.reference_friction?,
        })
    },
    outside_range: None,
    #[cfg(test)]
    example: r#""k":0.002,"hardness_mpa":1700,"reference_friction":0.5"#,
};
