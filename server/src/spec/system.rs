//! Contact systems, one file a kind: its dimensions with defaults, its geometry, the limits of that geometry, and its
//! preset. The rest of the crate knows no kind.

mod cylinder_on_flat;
mod dimm;
mod fuzz_button;
mod preset;
mod sd_card;
mod shapes;
mod zif;

use std::ops::RangeInclusive;

use api::spec::{Provenance, System, SystemKind};

use crate::spec::diagnostics::Diagnostics;

pub(crate) use preset::{ArchardPreset, Preset};
pub(crate) use shapes::Shapes;

/// Lengths of a contact system, mm: from 1 nm to 10 m.
const LENGTH_MM: RangeInclusive<f64> = 1e-6..=1e4;

/// One kind of contact system.
pub(crate) struct SystemDefinition {
    /// Description in a few words.
    pub(crate) description: &'static str,
    /// Its dimensions, in the order in which defaults are computed from one another.
    dimensions: &'static [Dimension],
    /// Builds both bodies from the dimensions.
    shapes: fn(&System) -> Shapes,
    /// Adds a fault for each dimension that cannot be combined with the others.
    check: fn(&Shapes, &mut Diagnostics),
    /// Values for what a specification leaves out.
    pub(crate) preset: fn() -> Preset,
}

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

/// A dimension of a kind.
struct Dimension {
    /// Its field in the specification.
    name: &'static str,
    field: fn(&mut System) -> &mut Option<f64>,
    /// Its default, from the dimensions before it; `None` for an optional dimension.
    default: fn(&System) -> Option<f64>,
    /// Provenance of the default.
    provenance: Provenance,
}

/// `dimension!(field, |system| default, provenance)`, or `dimension!(field)` for an optional dimension.
macro_rules! dimension {
    ($field:ident, |$system:pat_param| $default:expr, $provenance:ident) => {
        $crate::spec::system::Dimension {
            name: stringify!($field),
            field: |system| &mut system.$field,
            default: |$system| Some($default),
            provenance: api::spec::Provenance::$provenance,
        }
    };
    ($field:ident) => {
        $crate::spec::system::Dimension {
            name: stringify!($field),
            field: |system| &mut system.$field,
            default: |_| None,
            provenance: api::spec::Provenance::Given,
        }
    };
}
use dimension;

impl SystemDefinition {
    /// Names of all dimensions, optional ones included.
    pub(crate) fn dimension_names(&self) -> impl Iterator<Item = &'static str> {
        self.dimensions.iter().map(|dimension| dimension.name)
    }
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
