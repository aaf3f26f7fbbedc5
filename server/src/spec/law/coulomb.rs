//! Coulomb friction: |q| <= mu p.

use std::ops::RangeInclusive;

use api::spec::{Friction, FrictionLaw, Provenance};
use solver::scene;

use crate::spec::diagnostics::Diagnostics;

const LAW: &str = "/interface/friction/law";
const COEFFICIENT: &str = "/interface/friction/coefficient";

/// Coefficient of friction, -; the highest of clean metals in air stay below 2.
pub(in crate::spec) const RANGE: RangeInclusive<f64> = 0.0..=2.0;

/// Resolves the law of a specification.
pub(super) fn resolve(given: &Friction, diagnostics: &mut Diagnostics) -> scene::Friction {
    let Some(coefficient) = given.coefficient else {
        diagnostics.missing(COEFFICIENT, "`coulomb` needs it");
        return scene::Friction::Frictionless;
    };
    diagnostics.check_range(COEFFICIENT, coefficient, &RANGE);
    diagnostics.provenance(COEFFICIENT, Provenance::Given);
    scene::Friction::Coulomb { coefficient }
}

/// The law with the coefficient of a preset.
pub(super) fn from_preset(
    coefficient: f64,
    provenance: Provenance,
    diagnostics: &mut Diagnostics,
) -> (Friction, scene::Friction) {
    diagnostics.provenance(LAW, provenance);
    diagnostics.provenance(COEFFICIENT, provenance);
    let filled = Friction {
        law: FrictionLaw::Coulomb.into(),
        coefficient: Some(coefficient),
    };
    (filled, scene::Friction::Coulomb { coefficient })
}
