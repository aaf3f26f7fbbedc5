//! The wear coefficients of a specification.

use api::rating::Coefficient;
use api::spec::{Material, PlatingLayer, Spec, WearLaw};

use crate::spec::law::definition;
use crate::spec::materials::name;

/// Multiplies all of them by a factor; returns them with their values before and after.
pub(crate) fn scale(spec: &mut Spec, factor: f64) -> Vec<Coefficient> {
    let mut scaled = Vec::new();
    let materials = spec.materials.clone();
    let wear = &mut spec.interface.wear;
    let bases = [
        ("slider", &mut wear.slider, materials.slider),
        ("receptacle", &mut wear.receptacle, materials.receptacle),
    ];
    for (side, law, material) in bases {
        let pointer = format!("/interface/wear/{side}");
        if let Some(Some(law)) = law {
            scaled.extend(scale_law(&pointer, material.as_ref(), law, factor));
        }
    }
    let plating = &mut spec.plating;
    for (side, layers) in [
        ("slider", &mut plating.slider),
        ("receptacle", &mut plating.receptacle),
    ] {
        for (index, PlatingLayer { material, wear, .. }) in layers.iter_mut().flatten().enumerate()
        {
            let pointer = format!("/plating/{side}/{index}/wear");
            if let Some(law) = wear {
                scaled.extend(scale_law(&pointer, material.as_ref(), law, factor));
            }
        }
    }
    scaled
}

/// Scales the constants of a law; all depths depend on the product of its wear coefficient and cycles.
fn scale_law(
    pointer: &str,
    material: Option<&Material>,
    law: &mut WearLaw,
    factor: f64,
) -> Vec<Coefficient> {
    let Some(name_of_law) = law.law.known() else {
        return Vec::new();
    };
    let mut scaled = Vec::new();
    for number in definition(name_of_law).numbers() {
        let Some(scaling) = number.scaling else {
            continue;
        };
        let factor = scaling.factor(law, factor);
        let Some(value) = (number.of)(law) else {
            continue;
        };
        let given = std::mem::replace(value, *value * factor);
        scaled.push(Coefficient {
            pointer: format!("{pointer}/{}", number.field),
            material: material.and_then(name).map(str::to_owned),
            given,
            implied: *value,
        });
    }
    scaled
}

#[cfg(test)]
mod tests {
    use api::spec::WearLawName;
    use solver::closed_form::expected_wear::worn_contact_half_length_mm;
    use solver::closed_form::unworn_contact::hertz_half_width;

    use super::*;
    use crate::spec;
    use crate::spec::law::tests::wearing;

    /// A law that a rating scales must scale as a whole: twice the coefficient wears in half of the cycles what it wore in all of them.
    #[test]
    fn depths_of_every_law_depend_on_the_product_of_coefficient_and_cycles() {
        for law in WearLawName::ALL {
            let resolved = wearing(law, 0.4);
            let mut changed = resolved.spec.clone();
            let scaled = scale(&mut changed, 2.0);
            assert!(!scaled.is_empty(), "{law:?}");
            changed.cycles = Some(10_000);
            changed.output.snapshots_at_cycles = None;
            let changed = spec::resolve(&changed).expect("accepted").scene;
            let [before, after] = [&resolved.scene, &changed].map(worn_contact_half_length_mm);
            assert!(before > 1.01 * hertz_half_width(&changed), "{law:?} wears");
            let off = (after / before - 1.0).abs();
            assert!(off < 1e-9, "{law:?}: {before} {after}");
        }
    }
}
