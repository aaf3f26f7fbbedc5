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
    use crate::spec::diagnostics::Diagnostics;
    use crate::spec::law::{ByFriction, check_plated};

    /// Constants of each law by which it wears.
    fn constants(law: WearLawName) -> &'static str {
        match law {
            WearLawName::Archard | WearLawName::Sarkar => r#""k":0.002,"hardness_mpa":1700"#,
            WearLawName::Saracibar => r#""k":0.002,"hardness_mpa":1700,"reference_friction":0.5"#,
            WearLawName::DissipatedEnergy => r#""energy_coefficient_mm3_per_j":2e-3"#,
            WearLawName::Barwell => {
                r#""k":0.002,"hardness_mpa":1700,"course":"decelerating","characteristic_dose_mpa_mm":1000"#
            }
            WearLawName::Quinn => {
                r#""activation_energy_j_mol":96e3,"critical_film_um":3,"asperity_diameter_um":5,
                "arrhenius_constant_kg2_m4s":1e2,"oxide_density_kg_m3":5200,"oxygen_fraction":0.2885,"hardness_mpa":1700,
                "contact_temperature_c":400"#
            }
            WearLawName::MildOxidation => {
                r#""oxidation_constant":3.4e-4,"arrhenius_constant_m2_s":1e6,"activation_energy_j_mol":138e3,
                "critical_film_um":10,"contact_temperature_c":600,"hardness_mpa":1700"#
            }
            WearLawName::SevereOxidation => {
                r#""molten_fraction":0.1,"latent_heat_j_m3":2e9,"heat_share":0.5,"oxide_conductivity_w_mk":3.2,
                "oxide_melting_temperature_c":1487,"contact_temperature_c":1400,"diffusion_distance_um":10,"hardness_mpa":1700"#
            }
            WearLawName::Oxidation => {
                r#""k":0.002,"hardness_mpa":1700,"oxidation_constant":3.4e-4,"arrhenius_constant_m2_s":1e6,
                "activation_energy_j_mol":138e3,"critical_film_um":10,"molten_fraction":0.1,"latent_heat_j_m3":2e9,"heat_share":0.5,
                "oxide_conductivity_w_mk":3.2,"oxide_melting_temperature_c":1487,"contact_temperature_c":1400,
                "diffusion_distance_um":10"#
            }
            WearLawName::Rhee => {
                r#""wear_factor":1e-7,"pressure_exponent":1.2,"speed_exponent":0.9,"time_exponent":1.1"#
            }
            WearLawName::LoadRepetition => {
                r#""wear_factor":1e-7,"pressure_exponent":1.2,"repetition_exponent":0.8,"reference_length_mm":0.01"#
            }
            WearLawName::StrainHardening => {
                r#""wear_factor":2.0,"pressure_exponent":1.6,"strain_exponent":-0.5,"activation_temperature_k":6000,
                "reference_length_mm":0.01"#
            }
        }
    }

    /// A wearing receptacle with a law.
    fn scene(law: WearLawName, friction: f64) -> spec::Resolved {
        // Oxides melt at high speeds alone.
        let frequency_hz = match law {
            WearLawName::SevereOxidation | WearLawName::Oxidation => 50_000,
            _ => 50,
        };
        let text = format!(
            r#"{{"system":{{"kind":"cylinder_on_flat"}},"interface":{{"friction":{{"law":"coulomb","coefficient":{friction}}},
            "wear":{{"slider":null,"receptacle":{{"law":"{}",{}}}}}}},"cycles":20000,
            "motion":{{"kind":"reciprocating","amplitude_mm":0.02,"frequency_hz":{frequency_hz}}}}}"#,
            law.as_str(),
            constants(law)
        );
        spec::read(text.as_bytes()).expect("accepted")
    }

    /// A law that a rating scales must scale as a whole: twice the coefficient wears in half of the cycles what it wore in all of them.
    #[test]
    fn depths_of_every_law_depend_on_the_product_of_coefficient_and_cycles() {
        for law in WearLawName::ALL {
            let resolved = scene(law, 0.4);
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

    /// A law takes a hardness exactly if its rate depends on it.
    #[test]
    fn the_rates_of_these_laws_depend_on_hardness() {
        for law in WearLawName::ALL {
            let mut changed = scene(law, 0.4);
            let before = worn_contact_half_length_mm(&changed.scene);
            let wear = &mut changed.spec.interface.wear.receptacle;
            let wear = wear.as_mut().and_then(Option::as_mut).expect("a law");
            wear.hardness_mpa = Some(3400.0);
            let resolved = spec::resolve(&changed.spec);
            let by_hardness = definition(law).takes_hardness();
            assert_eq!(resolved.is_ok(), by_hardness, "{law:?}");
            let after = resolved.map(|resolved| worn_contact_half_length_mm(&resolved.scene));
            let changes = after.is_ok_and(|after| (after / before - 1.0).abs() > 1e-6);
            assert_eq!(changes, by_hardness, "{law:?}");
        }
    }

    #[test]
    fn the_rates_of_these_laws_depend_on_friction() {
        for law in WearLawName::ALL {
            let worn = |friction| worn_contact_half_length_mm(&scene(law, friction).scene);
            let changes = (worn(0.5) / worn(0.4) - 1.0).abs() > 1e-6;
            let by_friction = definition(law).friction != ByFriction::Independent;
            assert_eq!(changes, by_friction, "{law:?}");
        }
    }

    #[test]
    fn the_rates_of_these_laws_are_the_same_in_every_state() {
        for law in WearLawName::ALL {
            let of_engine = scene(law, 0.4).scene.receptacle.wear.expect("a law");
            let uniform = of_engine.uniform().is_some();
            assert_eq!(uniform, definition(law).is_uniform(), "{law:?}");
        }
    }

    #[test]
    fn the_fault_of_a_plating_lists_the_laws_that_it_may_wear_by() {
        let law = scene(WearLawName::Rhee, 0.4).scene.receptacle.wear;
        let mut diagnostics = Diagnostics::default();
        check_plated("/plating/receptacle/0/wear", law, &mut diagnostics);
        let detail = "a plating and its base wear by laws whose rate is the same in every state: archard, sarkar, saracibar, \
                      dissipated_energy; a bare part, with the `plating` `[]`, wears by any";
        assert_eq!(diagnostics.into_faults()[0].detail, detail);
    }
}
