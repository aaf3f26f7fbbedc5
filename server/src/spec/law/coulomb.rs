//! Coulomb friction: |q| <= mu p, with a coefficient that is constant, or changes by cycle or by dose.

use api::spec::{Friction, FrictionLaw, Provenance};
use solver::scene;

use crate::spec::diagnostics::Diagnostics;
use crate::spec::law::friction_table::{self, BY_CYCLE, BY_DOSE, COEFFICIENT_RANGE};
use crate::spec::sourced::Sourced;

const LAW: &str = "/interface/friction/law";
const COEFFICIENT: &str = "/interface/friction/coefficient";

/// Resolves the law of a specification; without a coefficient it has the preset's.
pub(super) fn resolve(
    given: &Friction,
    of_preset: Sourced<f64>,
    diagnostics: &mut Diagnostics,
) -> (Friction, scene::Friction) {
    if (given.coefficient, &given.by_cycle, &given.by_dose) == (None, &None, &None) {
        let filled = from_preset(of_preset, diagnostics);
        diagnostics.provenance(LAW, Provenance::Given);
        return filled;
    }
    (given.clone(), given_law(given, diagnostics))
}

fn given_law(given: &Friction, diagnostics: &mut Diagnostics) -> scene::Friction {
    // Placeholders for a law, or for a table, with faults.
    let none = scene::Friction::Coulomb { coefficient: 0.0 };
    let empty = || scene::Table::new(&[(0.0, 0.0)]);
    match (given.coefficient, &given.by_cycle, &given.by_dose) {
        (None, None, None) => none,
        (Some(coefficient), None, None) => {
            diagnostics.check_range(COEFFICIENT, coefficient, &COEFFICIENT_RANGE);
            diagnostics.provenance(COEFFICIENT, Provenance::Given);
            scene::Friction::Coulomb { coefficient }
        }
        (None, Some(points), None) => {
            let table = friction_table::by_cycle(points, diagnostics);
            scene::Friction::ByCycle(table.unwrap_or_else(empty))
        }
        (None, None, Some(points)) => {
            let table = friction_table::by_dose(points, diagnostics);
            scene::Friction::ByDose(table.unwrap_or_else(empty))
        }
        (Some(_), Some(_), _) => {
            diagnostics.exclusive_fields(BY_CYCLE, "coefficient");
            none
        }
        (Some(_), None, Some(_)) => {
            diagnostics.exclusive_fields(BY_DOSE, "coefficient");
            none
        }
        (None, Some(_), Some(_)) => {
            diagnostics.exclusive_fields(BY_DOSE, "by_cycle");
            none
        }
    }
}

/// The law with the coefficient of a preset.
pub(super) fn from_preset(
    of_preset: Sourced<f64>,
    diagnostics: &mut Diagnostics,
) -> (Friction, scene::Friction) {
    let Sourced {
        value: coefficient,
        provenance,
    } = of_preset;
    diagnostics.provenance(LAW, provenance);
    diagnostics.provenance(COEFFICIENT, provenance);
    let filled = Friction {
        law: FrictionLaw::Coulomb.into(),
        coefficient: Some(coefficient),
        by_cycle: None,
        by_dose: None,
    };
    (filled, scene::Friction::Coulomb { coefficient })
}
