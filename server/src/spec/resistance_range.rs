//! Warnings of spots that a contact cannot have, and of limits of the resistance that the unworn contact exceeds.

use api::problem::Fault;
use api::spec::{CriterionKind, EnumValue, Spec};
use solver::electrical::{Unworn, unworn};
use solver::scene::{Electrical, Scene};

/// The warnings of a specification as it was given, whose criteria are not divided between the sides yet, and its scene.
pub(super) fn warnings(spec: &Spec, scene: &Scene) -> Vec<Fault> {
    let Some(electrical) = scene.conduction.known() else {
        return Vec::new();
    };
    let unworn = unworn(electrical, scene.load_n_per_mm);
    let mut warnings: Vec<Fault> = spots(electrical, unworn).into_iter().collect();
    warnings.extend(limits(spec).filter(|(_, mohm)| *mohm <= unworn.mohm).map(
        |(pointer, mohm)| {
            let detail = format!(
                "the unworn contact has {:.3} mOhm already, beside the way of the current through the bodies: {mohm} mOhm are exceeded \
                 before the first cycle",
                unworn.mohm
            );
            Fault::new(&pointer, detail)
        },
    ));
    warnings
}

/// Limits of the resistance, mOhm, with their pointers.
fn limits(spec: &Spec) -> impl Iterator<Item = (String, f64)> {
    let stops = spec.stop.iter().enumerate().map(|(index, stop)| {
        let pointer = format!("/stop/{index}/mohm");
        (pointer, stop.kind.as_ref(), stop.mohm)
    });
    let criteria = spec.life.criteria.iter().flatten().enumerate();
    let criteria = criteria.map(|(index, criterion)| {
        let pointer = format!("/life/criteria/{index}/mohm");
        (pointer, Some(&criterion.kind), criterion.mohm)
    });
    stops.chain(criteria).filter_map(|(pointer, kind, mohm)| {
        let is_resistance = kind == Some(&EnumValue::Known(CriterionKind::Resistance));
        Some((pointer, mohm.filter(|_| is_resistance)?))
    })
}

/// The circle of several spots is at least as large as all of them, and no larger than the contact.
fn spots(electrical: &Electrical, unworn: Unworn) -> Option<Fault> {
    let spots = &electrical.spots;
    if spots.count < 2 {
        return None;
    }
    let circle = spots.cluster_diameter_mm;
    let joined = 2.0 * crate::number::real(spots.count).sqrt() * unworn.spot_radius_mm;
    let detail = if joined >= circle {
        format!(
            "{} spots of {:.3e} mm radius carry the load and fill a circle of {joined:.3e} mm: they are taken as one spot of that size",
            spots.count, unworn.spot_radius_mm
        )
    } else if circle > electrical.width_mm {
        format!(
            "the circle of the spots is larger than the contact, which is {} mm wide",
            electrical.width_mm
        )
    } else {
        return None;
    };
    Some(Fault::new("/interface/spots/cluster_diameter_mm", detail))
}

#[cfg(test)]
mod tests {
    use crate::spec::tests::accepted;

    fn pointers(rest: &str) -> Vec<String> {
        let text = format!(
            r#"{{"system":{{"kind":"sd_card"}},"load":{{"kind":"force","n":0.5,"width_mm":0.8}}{rest}}}"#
        );
        let warnings = accepted(&text).warnings.into_iter();
        let pointers = warnings.map(|warning| warning.pointer);
        let concerns = |pointer: &String| pointer.contains("mohm") || pointer.contains("spots");
        pointers.filter(concerns).collect()
    }

    #[test]
    fn limits_that_the_unworn_contact_exceeds_are_warned_of() {
        assert!(pointers("").is_empty());
        let with_film = |layer: &str, rest: &str| {
            let film =
                format!(r#"{{"side":"receptacle"{layer},"specific_resistance_ohm_mm2":1e-5}}"#);
            pointers(&format!(r#","interface":{{"films":[{film}]}}{rest}"#))
        };
        let of = |mohm: f64| {
            let criterion = format!(r#"{{"kind":"resistance","mohm":{mohm}}}"#);
            let rest = format!(
                r#","stop":[{criterion}],"life":{{"criteria":[{{"kind":"base_metal"}},{criterion}]}}"#
            );
            with_film("", &rest)
        };
        // One spot of hard gold over nickel has 1.7 mOhm.
        assert!(of(10.0).is_empty());
        assert_eq!(of(0.5), ["/stop/0/mohm", "/life/criteria/1/mohm"]);
        // A film on the outermost layer counts.
        let limit = r#","stop":[{"kind":"resistance","mohm":10}]"#;
        assert_eq!(with_film(r#","layer":1"#, limit), ["/stop/0/mohm"]);
    }

    #[test]
    fn spots_that_touch_or_lie_beside_the_contact_are_warned_of() {
        let of = |count: u64, diameter_mm: f64| {
            pointers(&format!(
                r#","interface":{{"spots":{{"count":{count},"cluster_diameter_mm":{diameter_mm}}}}}"#
            ))
        };
        assert!(of(10, 0.1).is_empty());
        let warned = ["/interface/spots/cluster_diameter_mm"];
        // Spots of 0.5 N on 1 700 MPa have an area of a circle of 0.019 mm.
        assert_eq!(of(10, 0.019), warned);
        assert!(of(10, 0.02).is_empty());
        assert_eq!(of(10, 0.81), warned);
    }
}
