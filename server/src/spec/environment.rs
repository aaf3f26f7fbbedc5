//! Surroundings: the temperature, and the hardnesses of all surfaces at it.

use std::ops::RangeInclusive;

use api::spec::{Environment, Material, MaterialProperties, Spec, WearLaw, WearLawName};
use solver::law::softening::{REFERENCE_C, hardness_ratio};
use solver::scene::Softening;
use solver::sides::Sides;

use crate::spec::diagnostics::Diagnostics;
use crate::spec::materials;
use crate::spec::plating;
use crate::spec::sourced::assumed;

const POINTER: &str = "/environment/temperature_c";

/// °C, from absolute zero to beyond every contact.
pub(in crate::spec) const TEMPERATURE_C: RangeInclusive<f64> = -273.0..=3_000.0;

/// Hz, of the current; from what is direct in all but name to beyond any connector.
pub(in crate::spec) const FREQUENCY_HZ: RangeInclusive<f64> = 1e-3..=1e12;

/// Resolves the surroundings.
pub(super) fn resolve(given: &Environment, diagnostics: &mut Diagnostics) -> Environment {
    let temperature = diagnostics.or_default(POINTER, given.temperature_c, assumed(REFERENCE_C));
    diagnostics.check_range(POINTER, temperature, &TEMPERATURE_C);
    let pointer = "/environment/frequency_hz";
    let frequency_hz = diagnostics.optional(pointer, given.frequency_hz, &FREQUENCY_HZ);
    Environment {
        temperature_c: Some(temperature),
        frequency_hz,
    }
}

/// Hardnesses of the layers and the base of both parts of a specification whose materials and laws are resolved.
pub(super) fn softening(resolved: &Spec, diagnostics: &mut Diagnostics) -> Sides<Softening> {
    let temperature = resolved.environment.temperature_c.unwrap_or(REFERENCE_C);
    let is_reference = (temperature - REFERENCE_C).abs() <= 0.0;
    let materials = materials::by_side(&resolved.materials);
    let laws = laws(resolved);
    let layers = plating::by_side(&resolved.plating);
    Sides::from_fn(|side| {
        let layers = layers.of(side).iter();
        let layers = layers.map(|layer| (layer.material.as_ref(), layer.wear.as_ref()));
        let surfaces = layers.chain([(*materials.of(side), *laws.of(side))]);
        let by_hardness: Vec<_> = surfaces
            .map(|(material, law)| law.filter(|law| wears_by_hardness(law)).map(|_| material))
            .collect();
        let melting = by_hardness.iter().flatten().filter_map(|m| melting_c(*m));
        let margin_k = melting
            .map(|melting| melting - temperature)
            .reduce(f64::min);
        let ratios = by_hardness.iter().map(|material| match material {
            None => Some(1.0),
            Some(material) => ratio(temperature, *material, diagnostics),
        });
        Softening {
            ratios: if is_reference {
                Vec::new()
            } else {
                ratios.collect()
            },
            margin_k,
        }
    })
}

fn wears_by_hardness(law: &WearLaw) -> bool {
    !matches!(
        law.law.known(),
        Some(
            WearLawName::DissipatedEnergy
                | WearLawName::Rhee
                | WearLawName::LoadRepetition
                | WearLawName::StrainHardening
        )
    )
}

fn properties(material: Option<&Material>) -> Option<&MaterialProperties> {
    match material {
        Some(Material::Given(properties)) => Some(properties),
        _ => None,
    }
}

fn melting_c(material: Option<&Material>) -> Option<f64> {
    properties(material)?.melting_temperature_c
}

/// Conductivities of both materials, W/(m K).
pub(super) fn conductivities(resolved: &Spec) -> Sides<Option<f64>> {
    let materials = materials::by_side(&resolved.materials);
    materials.map(|material| properties(material)?.thermal_conductivity_w_mk)
}

/// The laws of the bases.
pub(super) fn laws(resolved: &Spec) -> Sides<Option<&WearLaw>> {
    let wear = &resolved.interface.wear;
    Sides {
        slider: wear.slider.as_ref().and_then(Option::as_ref),
        receptacle: wear.receptacle.as_ref().and_then(Option::as_ref),
    }
}

/// Hardness of a material at a temperature over that at 20 °C; `None` where its melting temperature is not known.
fn ratio(
    temperature: f64,
    material: Option<&Material>,
    diagnostics: &mut Diagnostics,
) -> Option<f64> {
    let melting = melting_c(material)?;
    if temperature >= melting {
        let name = properties(material).and_then(|properties| properties.name.as_deref());
        let name = name.unwrap_or("a material");
        let detail = format!("{temperature} is not below the {melting} at which {name} melts");
        diagnostics.fault(POINTER, detail);
        return None;
    }
    Some(hardness_ratio(temperature, melting))
}

#[cfg(test)]
mod tests {
    use solver::effects::{Effect, Verdict, plan};
    use solver::scene::Scene;

    use crate::spec::Resolved;
    use crate::spec::tests::{accepted, faults};

    /// An SD card with tin on the pad at a temperature.
    fn tinned(temperature: &str, rest: &str) -> Resolved {
        accepted(&format!(
            r#"{{"system":{{"kind":"sd_card"}},"environment":{{"temperature_c":{temperature}}},"plating":{{"receptacle":[{{"material":"tin",
            "thickness_um":3,"wear":{{"law":"archard","k":1e-4}}}}]}}{rest}}}"#
        ))
    }

    fn verdict(scene: &Scene) -> (Verdict, String) {
        let mut decisions = plan(scene).decisions.into_iter();
        let softening = decisions.find(|d| d.effect == Effect::ThermalSoftening);
        let softening = softening.expect("it is decided");
        (softening.verdict, softening.reason)
    }

    #[test]
    fn tin_softens_at_85_degrees_and_wears_faster() {
        let rate = |resolved: &Resolved| resolved.scene.receptacle.outer_rate().expect("a rate");
        let (warm, cool) = (tinned("85", ""), tinned("20", ""));
        let ratio = rate(&warm) / rate(&cool);
        assert!((ratio - 211.9 / 146.9).abs() < 1e-12, "{ratio}");
        assert_eq!(verdict(&warm.scene).0, Verdict::Simulated);
        let (skipped, reason) = verdict(&cool.scene);
        assert!(
            skipped == Verdict::Skipped && reason.contains("20 °C"),
            "{reason}"
        );
        // Negligible beside a tolerance of 10 %, of which an effect may take a fifth.
        let rest = r#","accuracy":{"tolerance":0.1}"#;
        assert_eq!(verdict(&tinned("22", rest).scene).0, Verdict::Skipped);
        // Submitted again, the resolved specification is the same.
        let again = serde_json::to_string(&warm.spec).expect("JSON");
        assert_eq!(accepted(&again).scene, warm.scene);
    }

    #[test]
    fn an_unknown_melting_temperature_is_named_and_one_that_is_passed_refused() {
        let own = r#","materials":{"receptacle":{"youngs_modulus_mpa":117000,"poisson_ratio":0.34}},
            "interface":{"wear":{"receptacle":{"law":"archard","k_over_h_per_mpa":1e-8}}}"#;
        let unknown = tinned("85", own);
        let (verdict, reason) = verdict(&unknown.scene);
        assert_eq!(verdict, Verdict::InputMissing);
        assert!(reason.contains("melting_temperature_c"), "{reason}");
        let warned = unknown.warnings.iter();
        let mut warned = warned.filter(|fault| fault.pointer == "/effects/thermal_softening");
        assert!(warned.next().is_some());
        let molten = r#"{"system":{"kind":"dimm"},"materials":{"receptacle":"tin"},"environment":{"temperature_c":240}}"#;
        let found = faults(molten);
        assert_eq!(found[0].pointer, "/environment/temperature_c");
        assert!(found[0].detail.contains("tin melts"), "{}", found[0].detail);
        let law = r#","interface":{"wear":{"receptacle":{"law":"dissipated_energy","energy_coefficient_mm3_per_j":1e-5}}}"#;
        let bare = format!(
            r#"{{"system":{{"kind":"sd_card"}},"environment":{{"temperature_c":85}}{law}}}"#
        );
        assert!(accepted(&bare).scene.receptacle.softening.ratios == [Some(1.0)]);
    }
}
