//! Barwell's wear law: a rate that falls, stays or grows with the dose D of a place, from k/H on.

use std::ops::RangeInclusive;

use api::spec::{EnumValue, Provenance, WearCourse};
use solver::scene::{self, Barwell, Course};

use crate::spec::diagnostics::Diagnostics;
use crate::spec::law::definition::{
    Absent, ByFriction, FieldGroup, LawDefinition, Number, Scaling, State, each, number,
};
use crate::spec::law::values::Values;
use crate::spec::law::wear_coefficient::K_OVER_H;

/// Characteristic dose, MPa mm: from a passage of a light contact over an atom to that of a heavy one over the longest distance.
const CHARACTERISTIC_DOSE_MPA_MM: RangeInclusive<f64> = 1e-9..=1e16;

const DOSE: FieldGroup = FieldGroup {
    numbers: &[number!(
        characteristic_dose_mpa_mm,
        "D0",
        CHARACTERISTIC_DOSE_MPA_MM,
        Absent::Required(
            "`barwell` needs the dose after which the rate has fallen or grown by a factor of e"
        )
    )
    .scaled(Scaling::Inverse)],
    resolve: course_and_dose,
};

pub(super) const DEFINITION: LawDefinition = LawDefinition {
    formula: "h = (k/H) D0 (1 - exp(-D/D0)), (k/H) D or (k/H) D0 (exp(D/D0) - 1) after a dose D = int p |ds|",
    states: &[State::Depth],
    friction: ByFriction::Independent,
    groups: &[K_OVER_H, DOSE],
    choices: &["course"],
    engine_law: |values| {
        let rate_per_mpa = values.k_over_h_per_mpa()?;
        let course = values.law.course.as_ref().and_then(EnumValue::known);
        let course = match course {
            Some(WearCourse::Steady) => {
                return Some(scene::WearLaw::Archard {
                    k_over_h_per_mpa: rate_per_mpa,
                });
            }
            Some(WearCourse::Accelerating) => Course::Accelerating,
            Some(WearCourse::Decelerating) | None => Course::Decelerating,
        };
        Some(scene::WearLaw::Barwell(Barwell {
            rate_per_mpa,
            dose_mpa_mm: values.law.characteristic_dose_mpa_mm?,
            course,
        }))
    },
    outside_range: None,
    #[cfg(test)]
    example: r#""k":0.002,"hardness_mpa":1700,"course":"decelerating","characteristic_dose_mpa_mm":1000"#,
};

/// Resolves the course, and the dose of one that is not steady.
fn course_and_dose(numbers: &[Number], values: &mut Values<'_>, diagnostics: &mut Diagnostics) {
    let (side, given) = (values.side, values.given);
    if values.k_over_h_per_mpa().is_some_and(|rate| rate <= 0.0) {
        let detail =
            "without an initial rate there is no course; write null if the part does not wear";
        diagnostics.fault(&side.pointer, detail);
    }
    let pointer = side.field("course");
    let course = if let Some(course) = &given.course {
        diagnostics.provenance(&pointer, Provenance::Given);
        diagnostics.enum_member(&pointer, course)
    } else {
        let detail = "`barwell` needs how the rate changes: decelerating, steady or accelerating";
        diagnostics.missing(&pointer, detail);
        None
    };
    if course != Some(WearCourse::Steady) {
        each(numbers, values, diagnostics);
    } else if given.characteristic_dose_mpa_mm.is_some() {
        diagnostics.foreign_field(&side.pointer, "characteristic_dose_mpa_mm", "steady");
    }
}

#[cfg(test)]
mod tests {
    use solver::scene::{Barwell, Course, WearLaw};

    use crate::spec::tests::{accepted, faults};

    fn specification(rest: &str) -> String {
        format!(
            r#"{{"system":{{"kind":"sd_card"}},"plating":{{"receptacle":[]}},"interface":{{"wear":{{"receptacle":{{"law":"barwell",{rest}}}}}}}}}"#
        )
    }

    #[test]
    fn courses_are_those_of_the_specification() {
        let wear = |rest: &str| accepted(&specification(rest)).scene.receptacle.wear;
        let rate = r#""k_over_h_per_mpa":2e-7"#;
        for (name, course) in [
            ("decelerating", Course::Decelerating),
            ("accelerating", Course::Accelerating),
        ] {
            let dose = format!(r#"{rate},"course":"{name}","characteristic_dose_mpa_mm":1500"#);
            let expected = Barwell {
                rate_per_mpa: 2e-7,
                dose_mpa_mm: 1_500.0,
                course,
            };
            assert_eq!(wear(&dose), Some(WearLaw::Barwell(expected)));
        }
        let steady = wear(&format!(r#"{rate},"course":"steady""#));
        assert_eq!(steady.and_then(WearLaw::uniform), Some(2e-7));
        // Submitted again, the resolved specification is the same.
        let text =
            specification(r#""k":1e-4,"course":"decelerating","characteristic_dose_mpa_mm":1500"#);
        let resolved = accepted(&text);
        let again = serde_json::to_string(&resolved.spec).expect("JSON");
        assert_eq!(accepted(&again).scene, resolved.scene);
    }

    #[test]
    fn what_is_missing_or_foreign_is_named() {
        let pointers = |rest: &str| -> Vec<String> {
            let found = faults(&specification(rest)).into_iter();
            found
                .map(|fault| fault.pointer.replace("/interface/wear/receptacle", ""))
                .collect()
        };
        assert_eq!(
            pointers(r#""course":"decelerating""#),
            ["/k", "/characteristic_dose_mpa_mm"]
        );
        assert_eq!(
            pointers(r#""k_over_h_per_mpa":1e-7"#),
            ["/course", "/characteristic_dose_mpa_mm"]
        );
        assert_eq!(
            pointers(r#""k_over_h_per_mpa":1e-7,"course":"steady","characteristic_dose_mpa_mm":1"#),
            ["/characteristic_dose_mpa_mm"]
        );
        assert_eq!(
            pointers(
                r#""k_over_h_per_mpa":1e-7,"course":"decelerating","characteristic_dose_mpa_mm":0"#
            ),
            ["/characteristic_dose_mpa_mm"]
        );
        assert_eq!(pointers(r#""k_over_h_per_mpa":0,"course":"steady""#), [""]);
        assert_eq!(
            pointers(
                r#""k_over_h_per_mpa":1e-7,"course":"slowing","characteristic_dose_mpa_mm":1"#
            ),
            ["/course"]
        );
    }
}
