//! Spots of real contact.

use std::ops::RangeInclusive;

use api::spec::{SpotDeformation, Spots};
use solver::law::resistance::{Asperity, Deformation};
use solver::scene;

use crate::spec::diagnostics::Diagnostics;
use crate::spec::sourced::assumed;

/// Spots: counts of micrographs end at some hundreds, and the resistance hardly depends on more.
pub(in crate::spec) const COUNT: RangeInclusive<u64> = 1..=1_000;
/// mm; from some atoms to beyond any contact.
pub(in crate::spec) const CLUSTER_DIAMETER_MM: RangeInclusive<f64> = 1e-6..=1e3;
/// mm; from some atoms to a crown that is nearly flat.
pub(in crate::spec) const ASPERITY_RADIUS_MM: RangeInclusive<f64> = 1e-6..=1e4;

const POINTER: &str = "/interface/spots";

/// Resolves the spots beside the contact modulus of the bodies, MPa.
pub(super) fn resolve(
    given: Option<&Spots>,
    modulus_mpa: f64,
    diagnostics: &mut Diagnostics,
) -> (Spots, scene::Spots) {
    let given = given.cloned().unwrap_or_default();
    let at = |field: &str| format!("{POINTER}/{field}");
    let count = diagnostics.or_default(&at("count"), given.count, assumed(1));
    diagnostics.check_count(&at("count"), count, &COUNT);
    let diameter = diagnostics.optional(
        &at("cluster_diameter_mm"),
        given.cluster_diameter_mm,
        &CLUSTER_DIAMETER_MM,
    );
    match (count > 1, diameter) {
        (true, None) => diagnostics.missing(
            &at("cluster_diameter_mm"),
            "the diameter of the circle that several spots fill",
        ),
        (false, Some(_)) => diagnostics.fault(
            &at("cluster_diameter_mm"),
            "one spot fills no circle; give their `count`, too",
        ),
        _ => {}
    }
    let (deformation, law) = deformation(&given, modulus_mpa, diagnostics);
    let filled = Spots {
        count: Some(count),
        deformation: Some(deformation.into()),
        ..given
    };
    let spots = scene::Spots {
        count: usize::try_from(count).unwrap_or(1),
        cluster_diameter_mm: diameter.unwrap_or_default(),
        deformation: law,
    };
    (filled, spots)
}

fn deformation(
    given: &Spots,
    modulus_mpa: f64,
    diagnostics: &mut Diagnostics,
) -> (SpotDeformation, Deformation) {
    let pointer = format!("{POINTER}/asperity_radius_mm");
    let radius = diagnostics.optional(&pointer, given.asperity_radius_mm, &ASPERITY_RADIUS_MM);
    let default = if radius.is_some() {
        SpotDeformation::Auto
    } else {
        SpotDeformation::Plastic
    };
    let named = format!("{POINTER}/deformation");
    let chosen = given.deformation.as_ref();
    let chosen = chosen.and_then(|chosen| diagnostics.enum_member(&named, chosen));
    let chosen = diagnostics.or_default(&named, chosen, assumed(default));
    let asperity = radius.map(|radius_mm| Asperity {
        radius_mm,
        modulus_mpa,
    });
    let law = match (chosen, asperity) {
        (SpotDeformation::Plastic, None) => Deformation::Plastic,
        (SpotDeformation::Plastic, Some(_)) => {
            diagnostics.foreign_field(POINTER, "asperity_radius_mm", "plastic");
            Deformation::Plastic
        }
        (SpotDeformation::Elastic, Some(asperity)) => Deformation::Elastic(asperity),
        (SpotDeformation::Auto, Some(asperity)) => Deformation::LowerPressure(asperity),
        (SpotDeformation::Elastic | SpotDeformation::Auto, None) => {
            diagnostics.missing(&pointer, "the radius of an elastic spot");
            Deformation::Plastic
        }
    };
    (chosen, law)
}
