//! Warnings where a wear law is used outside of the range of its definition, or an oxidational one below the temperature of the
//! surroundings.

use api::problem::Fault;
use api::spec::{Spec, WearLaw as Given};
use solver::scene::{Scene, WearLaw};
use solver::sides::Side;

use crate::spec::environment;
use crate::spec::law::definition;

/// The warnings of a resolved specification.
pub(super) fn warnings(spec: &Spec, scene: &Scene) -> Vec<Fault> {
    let laws = [
        (Side::Slider, scene.slider.wear),
        (Side::Receptacle, scene.receptacle.wear),
    ];
    let given = environment::laws(spec);
    let warnings = laws.into_iter().flat_map(|(side, law)| {
        let (Some(law), Some(given)) = (law, *given.of(side)) else {
            return Vec::new();
        };
        let pointer = format!("/interface/wear/{}", side.name());
        let mut found = Vec::new();
        if let Some(outside) = given
            .law
            .known()
            .and_then(|name| definition(name).outside_range)
        {
            found.extend(outside(law, scene).map(|detail| Fault::new(&pointer, detail)));
        }
        if let WearLaw::OfSpeed(_) = law {
            let pointer = format!("{pointer}/contact_temperature_c");
            let cold = colder_than_surroundings(spec, given);
            found.extend(cold.map(|detail| Fault::new(pointer, detail)));
        }
        found
    });
    warnings.collect()
}

fn colder_than_surroundings(spec: &Spec, law: &Given) -> Option<String> {
    let (contact, surroundings) = (law.contact_temperature_c?, spec.environment.temperature_c?);
    (contact < surroundings).then(|| {
        format!("{contact} °C is less than the {surroundings} °C of the surroundings, which a contact that rubs exceeds")
    })
}

#[cfg(test)]
mod tests {
    use crate::spec;

    fn details(law: &str, motion: &str) -> Vec<String> {
        let text = format!(
            r#"{{"system":{{"kind":"cylinder_on_flat"}},"motion":{motion},"interface":{{"wear":{{"slider":null,"receptacle":{law}}}}}}}"#
        );
        let resolved = spec::read(text.as_bytes()).expect("accepted");
        let warnings = super::warnings(&resolved.spec, &resolved.scene).into_iter();
        warnings.map(|warning| warning.detail).collect()
    }

    fn continuous(speed: f64) -> String {
        format!(r#"{{"kind":"continuous","distance_mm":1000,"speed_mm_s":{speed}}}"#)
    }

    const SEVERE: &str = r#"{"law":"severe_oxidation","molten_fraction":0.01,"latent_heat_j_m3":2e9,"heat_share":0.5,
        "oxide_conductivity_w_mk":3.2,"oxide_melting_temperature_c":1487,"contact_temperature_c":20,"diffusion_distance_um":10,
        "hardness_mpa":6865}"#;

    fn mild(temperature_c: f64) -> String {
        format!(
            r#"{{"law":"mild_oxidation","oxidation_constant":3.4e-4,"arrhenius_constant_m2_s":1e6,"activation_energy_j_mol":138e3,
            "contact_temperature_c":{temperature_c},"critical_film_um":10,"hardness_mpa":6865}}"#
        )
    }

    #[test]
    fn slow_sliding_is_outside_the_range_of_oxidational_laws() {
        assert!(details(SEVERE, &continuous(5_000.0)).is_empty());
        let slow = details(SEVERE, &continuous(10.0));
        assert!(
            slow.len() == 1 && slow[0].starts_with("nothing wears"),
            "{slow:?}"
        );
        let law = mild(426.85);
        assert!(details(&law, &continuous(1_000.0)).is_empty());
        let fretting = r#"{"kind":"reciprocating","amplitude_mm":0.025,"frequency_hz":20}"#;
        let slow = details(&law, fretting);
        assert!(
            slow.len() == 1 && slow[0].contains("2.0000 mm/s"),
            "{slow:?}"
        );
        let cold = details(&mild(-50.0), &continuous(1_000.0));
        assert!(
            cold.len() == 2 && cold[1].contains("surroundings, which"),
            "{cold:?}"
        );
        let hot = details(&mild(2_900.0), &continuous(1e-3));
        assert!(hot.len() == 1 && hot[0].contains("at most one"), "{hot:?}");
    }

    #[test]
    fn an_oxide_that_does_not_grow_is_warned_of() {
        let law = |rest: &str| {
            format!(
                r#"{{"law":"mild_oxidation","oxidation_constant":3.4e-4,"arrhenius_constant_m2_s":1e6,"activation_energy_j_mol":138e3,
                "critical_film_um":10{rest}}}"#
            )
        };
        let motion = r#"{"kind":"reciprocating","amplitude_mm":0.2,"frequency_hz":250}"#;
        let found = details(&law(""), motion);
        assert!(found[0].contains("which is no wear"), "{found:?}");
        assert!(details(&law(r#","contact_temperature_c":427"#), motion).is_empty());
    }
}
