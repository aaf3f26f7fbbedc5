//! Rhee's law of friction materials.

use std::ops::RangeInclusive;

use solver::scene::{self, Rhee};

use super::power::{COURSE_EXPONENT, FACTOR, PRESSURE_EXPONENT, REQUIRED, check_exponents};
use crate::spec::law::definition::{
    ByFriction, FieldGroup, LawDefinition, Scaling, State, each, number,
};

/// Exponents of the speed, -.
const SPEED_EXPONENT: RangeInclusive<f64> = -10.0..=10.0;

const CONSTANTS: FieldGroup = FieldGroup {
    numbers: &[
        number!(wear_factor, "K", FACTOR, REQUIRED).scaled(Scaling::Power(|law| law.time_exponent)),
        number!(pressure_exponent, "a", PRESSURE_EXPONENT, REQUIRED),
        number!(speed_exponent, "b", SPEED_EXPONENT, REQUIRED),
        number!(time_exponent, "c", COURSE_EXPONENT, REQUIRED),
    ],
    resolve: |numbers, values, diagnostics| {
        each(numbers, values, diagnostics);
        check_exponents(
            values,
            values.law.time_exponent,
            "`time_exponent`",
            diagnostics,
        );
    },
};

pub(super) const DEFINITION: LawDefinition = LawDefinition {
    formula: "h = K p^a v^b t^c after a time t of slip",
    states: &[State::Depth, State::Speed],
    friction: ByFriction::Independent,
    groups: &[CONSTANTS],
    choices: &[],
    engine_law: |values| {
        let law = Rhee {
            factor: values.law.wear_factor?,
            pressure_exponent: values.law.pressure_exponent?,
            speed_exponent: values.law.speed_exponent?,
            time_exponent: values.law.time_exponent?,
        };
        Some(scene::WearLaw::Power(law.power_law()))
    },
    outside_range: None,
    #[cfg(test)]
    example: r#""wear_factor":1e-7,"pressure_exponent":1.2,"speed_exponent":0.9,"time_exponent":1.1"#,
};

#[cfg(test)]
mod tests {
    use solver::scene::WearLaw;

    use crate::spec::tests::{accepted, faults};

    fn specification(law: &str, rest: &str) -> String {
        format!(
            r#"{{"system":{{"kind":"sd_card"}},"plating":{{"receptacle":[]}},"interface":{{"wear":{{"receptacle":{{"law":"{law}"{rest}}}}}}}}}"#
        )
    }

    fn pointers(law: &str, rest: &str) -> Vec<String> {
        let found = faults(&specification(law, rest)).into_iter();
        let pointers = found.map(|fault| fault.pointer.replace("/interface/wear/receptacle/", ""));
        pointers.collect()
    }

    const RHEE: &str =
        r#","wear_factor":2e-9,"pressure_exponent":1.2,"speed_exponent":0.8,"time_exponent":0.9"#;
    const REPETITION: &str = r#","wear_factor":1e-13,"pressure_exponent":1.5,"repetition_exponent":0.8,"reference_length_mm":1e-3"#;
    const STRAIN: &str = r#","wear_factor":1e-9,"pressure_exponent":2,"strain_exponent":-0.5,"activation_temperature_k":1000,
        "contact_temperature_c":26.85,"reference_length_mm":1e-3"#;

    #[test]
    fn constants_that_nobody_has_published_are_asked_by_name() {
        assert_eq!(
            pointers("rhee", ""),
            [
                "wear_factor",
                "pressure_exponent",
                "speed_exponent",
                "time_exponent"
            ]
        );
        assert_eq!(
            pointers("load_repetition", ""),
            [
                "wear_factor",
                "pressure_exponent",
                "repetition_exponent",
                "reference_length_mm"
            ]
        );
        assert_eq!(
            pointers("strain_hardening", ""),
            [
                "wear_factor",
                "pressure_exponent",
                "strain_exponent",
                "activation_temperature_k",
                "reference_length_mm"
            ]
        );
        for (law, rest) in [
            ("rhee", RHEE),
            ("load_repetition", REPETITION),
            ("strain_hardening", STRAIN),
        ] {
            let resolved = accepted(&specification(law, rest));
            assert!(matches!(
                resolved.scene.receptacle.wear,
                Some(WearLaw::Power(_))
            ));
            let again = serde_json::to_string(&resolved.spec).expect("JSON");
            assert_eq!(accepted(&again).scene, resolved.scene);
        }
    }

    #[test]
    fn exponents_without_a_limit_at_the_edge_are_refused() {
        let steep = RHEE.replace("0.9", "1.3");
        assert_eq!(pointers("rhee", &steep), ["pressure_exponent"]);
        let steep = REPETITION.replace("0.8", "1.6");
        assert_eq!(pointers("load_repetition", &steep), ["pressure_exponent"]);
        let steep = STRAIN.replace("-0.5", "-1.5");
        assert_eq!(pointers("strain_hardening", &steep), ["pressure_exponent"]);
        let foreign = format!(r#"{RHEE},"reference_length_mm":1"#);
        assert_eq!(pointers("rhee", &foreign), ["reference_length_mm"]);
    }

    #[test]
    fn platings_and_continuous_repetitions_are_refused_by_name() {
        let layer = format!(
            r#"{{"system":{{"kind":"sd_card"}},"plating":{{"receptacle":[{{"material":"silver","thickness_um":1,"wear":{{"law":"rhee"{RHEE}}}}}]}}}}"#
        );
        assert_eq!(faults(&layer)[0].pointer, "/plating/receptacle/0/wear");
        let base = format!(
            r#"{{"system":{{"kind":"sd_card"}},"plating":{{"receptacle":[{{"material":"silver","thickness_um":1}}]}},"interface":
            {{"wear":{{"receptacle":{{"law":"rhee"{RHEE}}}}}}}}}"#
        );
        assert_eq!(faults(&base)[0].pointer, "/interface/wear/receptacle");
        let turning = |law: &str| {
            format!(
                r#"{{"system":{{"kind":"cylinder_on_flat"}},"motion":{{"kind":"continuous","distance_mm":100}},"interface":{{"wear":{{
                "slider":null,"receptacle":{law}}}}}}}"#
            )
        };
        let repetition = turning(&format!(r#"{{"law":"load_repetition"{REPETITION}}}"#));
        assert_eq!(
            faults(&repetition)[0].pointer,
            "/interface/wear/receptacle/law"
        );
        accepted(&turning(&format!(r#"{{"law":"rhee"{RHEE}}}"#)));
    }
}
