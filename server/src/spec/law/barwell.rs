//! Barwell's wear law: a rate that falls, stays or grows with the dose D of a place, from k/H on.

use std::ops::RangeInclusive;

use api::spec::{Provenance, WearCourse, WearLaw};
use solver::scene::{self, Barwell, Course};

use crate::spec::diagnostics::Diagnostics;
use crate::spec::law::wear_coefficient;
use crate::spec::law::wearing_side::WearingSide;

/// The fields of the law.
const FIELDS: [&str; 6] = [
    "law",
    "k",
    "hardness_mpa",
    "k_over_h_per_mpa",
    "course",
    "characteristic_dose_mpa_mm",
];

/// Characteristic dose, MPa mm: from a passage of a light contact over an atom to that of a heavy one over the longest distance.
pub(in crate::spec) const CHARACTERISTIC_DOSE_MPA_MM: RangeInclusive<f64> = 1e-9..=1e16;

/// Resolves the law of a specification.
pub(super) fn resolve(
    side: &WearingSide<'_>,
    given: &WearLaw,
    diagnostics: &mut Diagnostics,
) -> (WearLaw, Option<scene::WearLaw>) {
    diagnostics.check_fields(&side.pointer, given, &FIELDS, "barwell");
    let (filled, k_over_h) = wear_coefficient::resolve(side, given, diagnostics);
    if k_over_h.is_some_and(|rate| rate <= 0.0) {
        let detail =
            "without an initial rate there is no course; write null if the part does not wear";
        diagnostics.fault(&side.pointer, detail);
    }
    let course = course(side, given, diagnostics);
    let pointer = side.field("characteristic_dose_mpa_mm");
    if course == Some(WearCourse::Steady) {
        if given.characteristic_dose_mpa_mm.is_some() {
            diagnostics.foreign_field(&side.pointer, "characteristic_dose_mpa_mm", "steady");
        }
        let law = k_over_h.map(|k_over_h_per_mpa| scene::WearLaw::Archard { k_over_h_per_mpa });
        return (filled, law);
    }
    let dose_mpa_mm = diagnostics.required(
        &pointer,
        given.characteristic_dose_mpa_mm,
        &CHARACTERISTIC_DOSE_MPA_MM,
        "`barwell` needs the dose after which the rate has fallen or grown by a factor of e",
    );
    let course = match course {
        Some(WearCourse::Accelerating) => Course::Accelerating,
        _ => Course::Decelerating,
    };
    let law = k_over_h.map(|rate_per_mpa| {
        scene::WearLaw::Barwell(Barwell {
            rate_per_mpa,
            dose_mpa_mm,
            course,
        })
    });
    (filled, law)
}

fn course(
    side: &WearingSide<'_>,
    given: &WearLaw,
    diagnostics: &mut Diagnostics,
) -> Option<WearCourse> {
    let pointer = side.field("course");
    let Some(course) = &given.course else {
        let detail = "`barwell` needs how the rate changes: decelerating, steady or accelerating";
        diagnostics.missing(&pointer, detail);
        return None;
    };
    diagnostics.provenance(&pointer, Provenance::Given);
    diagnostics.enum_member(&pointer, course)
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
