//! Friction that a specification leaves out: the preset's coefficient, for its own surfaces as the preset states it, and
//! assumed for others.

use api::spec::{Material, PlatingLayer};
use solver::sides::{Side, Sides};

use crate::spec::plating_choice::PlatingChoice;
use crate::spec::sourced::{Sourced, assumed};
use crate::spec::system::{FrictionPreset, Preset};

/// The coefficient of a preset for parts with these platings and given materials.
pub(super) fn coefficient(
    materials: Sides<Option<&Material>>,
    preset: &Preset,
    plating_choices: Sides<PlatingChoice<'_>>,
) -> Sourced<f64> {
    let is_bare = |side| !plating_choices.of(side).is_plated();
    let FrictionPreset {
        surfaces,
        coefficient,
    } = if Side::BOTH.into_iter().all(is_bare) {
        preset.bare_friction
    } else {
        preset.friction
    };
    let is_of_pair = |side: Side| {
        let surface = surface(*plating_choices.of(side), *materials.of(side), side, preset);
        surface == Some(*surfaces.of(side))
    };
    if Side::BOTH.into_iter().all(is_of_pair) {
        coefficient
    } else {
        assumed(coefficient.value)
    }
}

/// Name of the material at the surface of a part, if it has one.
fn surface<'a>(
    plating_choice: PlatingChoice<'a>,
    material: Option<&'a Material>,
    side: Side,
    preset: &Preset,
) -> Option<&'a str> {
    match plating_choice {
        PlatingChoice::Given([PlatingLayer { material, .. }, ..]) => name(material.as_ref()?),
        PlatingChoice::Given([]) => None,
        PlatingChoice::Preset(layers) => Some(layers.first()?.material.value),
        PlatingChoice::Removed | PlatingChoice::Bare => match material {
            Some(material) => name(material),
            None => Some(preset.materials.of(side).value),
        },
    }
}

fn name(material: &Material) -> Option<&str> {
    match material {
        Material::Named(name) => Some(name),
        // A given material may have other properties than the library's.
        Material::Given(_) => None,
    }
}

#[cfg(test)]
mod tests {
    use api::spec::Provenance;

    use crate::spec::tests::accepted;

    fn friction(rest: &str) -> (f64, Provenance) {
        let spec = accepted(&format!(r#"{{"system":{{"kind":"fuzz_button"}}{rest}}}"#)).spec;
        let friction = spec.interface.friction.and_then(|law| law.coefficient);
        (
            friction.expect("Coulomb's law"),
            spec.provenance["/interface/friction/coefficient"],
        )
    }

    #[test]
    fn a_coefficient_belongs_to_its_pair_of_surfaces() {
        assert_eq!(friction(""), (0.55, Provenance::Typical));
        let copper = r#","materials":{"slider":"copper","receptacle":"copper"},"plating":{"slider":[],"receptacle":[]}"#;
        assert_eq!(friction(copper), (1.21, Provenance::Source));
        // Beryllium copper on copper, and copper on gold.
        let bare = r#","plating":{"slider":[],"receptacle":[]}"#;
        assert_eq!(friction(bare), (1.21, Provenance::Assumed));
        let one = r#","materials":{"slider":"copper"}"#;
        assert_eq!(friction(one), (0.55, Provenance::Typical));
        let layer = |material: &str| {
            format!(
                r#","plating":{{"slider":[{{"material":"{material}","thickness_um":1,"wear":{{"law":"archard","k":1e-5}}}}]}},
                "interface":{{"wear":{{"slider":null}}}}"#
            )
        };
        assert_eq!(friction(&layer("hard_gold")), (0.55, Provenance::Typical));
        assert_eq!(friction(&layer("tin")), (0.55, Provenance::Assumed));
    }
}
