//! Contact systems, one file a kind: its dimensions with defaults, its geometry, the limits of that geometry, and its
//! preset. The rest of the crate knows no kind.

mod cylinder_on_flat;
mod definition;
mod dimm;
mod fuzz_button;
mod preset;
mod sd_card;
mod shapes;
mod zif;

use std::ops::RangeInclusive;

use api::spec::{Provenance, System, SystemKind};

use crate::spec::diagnostics::Diagnostics;
use crate::spec::unit::length_mm;

use definition::SystemDefinition;
pub(crate) use preset::{ArchardPreset, FrictionPreset, LayerPreset, Preset, RatingPreset};
pub(crate) use shapes::Shapes;

/// Lengths of a contact system, mm: from 1 nm to 10 m.
pub(in crate::spec) const LENGTH_MM: RangeInclusive<f64> = 1e-6..=1e4;

/// Returns the definition of a kind.
pub(crate) fn definition(kind: SystemKind) -> &'static SystemDefinition {
    match kind {
        SystemKind::FuzzButton => &fuzz_button::DEFINITION,
        SystemKind::SdCard => &sd_card::DEFINITION,
        SystemKind::Dimm => &dimm::DEFINITION,
        SystemKind::Zif => &zif::DEFINITION,
        SystemKind::CylinderOnFlat => &cylinder_on_flat::DEFINITION,
    }
}

/// Names of the dimensions of all kinds.
pub(in crate::spec) fn dimension_names() -> Vec<&'static str> {
    let names = SystemKind::ALL.into_iter();
    let mut names: Vec<_> = names
        .flat_map(|kind| definition(kind).dimension_names())
        .collect();
    names.sort_unstable();
    names.dedup();
    names
}

/// Resolves the dimensions of a kind and builds both bodies.
pub(crate) fn resolve(
    kind: SystemKind,
    given: &System,
    diagnostics: &mut Diagnostics,
) -> (System, Shapes) {
    let definition = definition(kind);
    let (mut given, mut system) = (given.clone(), System::of_kind(kind));
    diagnostics.provenance("/system/kind", Provenance::Given);
    for dimension in definition.dimensions {
        let pointer = format!("/system/{}", dimension.name);
        let value = match *(dimension.field)(&mut given) {
            Some(value) => {
                diagnostics.provenance(&pointer, Provenance::Given);
                if let Some(default) = (dimension.default)(&System::of_kind(kind)) {
                    diagnostics.check_unit(&pointer, Some(value), &length_mm(default));
                }
                Some(diagnostics.check_range(&pointer, value, &LENGTH_MM))
            }
            // A default computed from a faulty dimension is no fault of its own.
            None => (dimension.default)(&system)
                .inspect(|_| diagnostics.provenance(&pointer, dimension.provenance)),
        };
        *(dimension.field)(&mut system) = value;
    }
    let fields: Vec<&str> = definition.dimension_names().chain(["kind"]).collect();
    diagnostics.check_fields("/system", &given, &fields, kind.as_str());
    let shapes = (definition.shapes)(&system);
    (definition.check)(&shapes, diagnostics);
    (system, shapes)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sockets_differ_in_the_modelled_part_of_their_arc() {
        let with = |kind| System {
            contact_radius_mm: Some(0.4),
            pad_length_mm: Some(2.0),
            pad_height_mm: Some(0.3),
            pin_radius_mm: Some(0.9),
            ..System::of_kind(kind)
        };
        let shapes = |kind| (definition(kind).shapes)(&with(kind));
        let width = |kind| shapes(kind).slider.half_width_mm;
        assert!((width(SystemKind::Dimm) - 0.4).abs() < 1e-15);
        assert!((width(SystemKind::SdCard) - 0.3).abs() < 1e-15);
        let crown = |kind| shapes(kind).block.crown_radius_mm;
        assert_eq!(crown(SystemKind::Zif), Some(0.9));
        assert_eq!(crown(SystemKind::SdCard), None);
    }
}
