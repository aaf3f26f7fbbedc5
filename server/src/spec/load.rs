//! The normal load, converted to N per mm of depth.

use std::ops::RangeInclusive;

use api::spec::{Load, LoadKind, Provenance};

use crate::spec::diagnostics::Diagnostics;
use crate::spec::system::{Preset, Shapes};
use crate::spec::unit;

/// MPa on the top face.
pub(in crate::spec) const PRESSURE_MPA: RangeInclusive<f64> = 1e-9..=1e6;
/// N per mm of depth.
pub(in crate::spec) const LINE_FORCE_N_PER_MM: RangeInclusive<f64> = 1e-9..=1e6;
/// N.
pub(in crate::spec) const FORCE_N: RangeInclusive<f64> = 1e-9..=1e7;
/// mm.
pub(in crate::spec) const WIDTH_MM: RangeInclusive<f64> = 1e-6..=1e4;
/// Width of a contact that carries a force, mm: that of contact springs.
const TYPICAL_WIDTH_MM: f64 = 1.0;
/// N per mm of deflection.
pub(in crate::spec) const SPRING_N_PER_MM: RangeInclusive<f64> = 0.0..=1e9;

/// The load of one mm of depth.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct LineLoad {
    /// On the unworn contact, N per mm.
    pub(crate) n_per_mm: f64,
    /// Stiffness of the spring, by which the load falls as the contact wears, N per mm and mm.
    pub(crate) spring_n_per_mm2: f64,
}

/// The load of a preset; a force needs no width where the model has one.
fn of_preset(preset: &Preset, with_width: bool) -> Load {
    let load = preset.load.value.clone();
    Load {
        width_mm: load.width_mm.filter(|_| with_width),
        ..load
    }
}

/// A given load with what it leaves out of a preset's load of the same kind.
fn with_defaults(given: &Load, preset: &Load) -> Load {
    if given.kind != preset.kind {
        return given.clone();
    }
    Load {
        kind: given.kind.clone(),
        mpa: given.mpa.or(preset.mpa),
        n_per_mm: given.n_per_mm.or(preset.n_per_mm),
        n: given.n.or(preset.n),
        width_mm: given.width_mm.or(preset.width_mm),
        spring_n_per_mm: given.spring_n_per_mm.or(preset.spring_n_per_mm),
    }
}

/// Resolves the load. `with_width` is whether the model has no width of its own, so that a force needs one.
pub(crate) fn resolve(
    given: Option<&Load>,
    preset: &Preset,
    with_width: bool,
    shapes: &Shapes,
    diagnostics: &mut Diagnostics,
) -> (Load, LineLoad) {
    let default = of_preset(preset, with_width);
    let provenance_of = |is_given: bool| {
        if is_given {
            Provenance::Given
        } else {
            preset.load.provenance
        }
    };
    let own = given.cloned().unwrap_or_default();
    let load = match given {
        Some(given) => with_defaults(given, &default),
        None => default,
    };
    diagnostics.provenance("/load/kind", provenance_of(given.is_some()));
    let Some(kind) = diagnostics.enum_member("/load/kind", &load.kind) else {
        return (load, LineLoad::default());
    };
    let mut required =
        |field: &str, (given, value): (Option<f64>, Option<f64>), range: RangeInclusive<f64>| {
            let typical = match kind {
                _ if field == "width_mm" => unit::length_mm(TYPICAL_WIDTH_MM),
                LoadKind::Pressure => unit::PRESSURE_MPA,
                LoadKind::LineForce => unit::LINE_FORCE_N_PER_MM,
                LoadKind::Force => unit::FORCE_N,
            };
            let pointer = format!("/load/{field}");
            let Some(value) = value else {
                diagnostics.missing(&pointer, &format!("`{}` needs it", kind.as_str()));
                return 0.0;
            };
            diagnostics.provenance(&pointer, provenance_of(given.is_some()));
            diagnostics.check_unit(&pointer, Some(value), &typical);
            diagnostics.check_range(&pointer, value, &range)
        };
    let (fields, n_per_mm): (&[&str], f64) = match kind {
        // The pressure acts on the whole top face.
        LoadKind::Pressure => (
            &["kind", "mpa", "spring_n_per_mm"],
            required("mpa", (own.mpa, load.mpa), PRESSURE_MPA) * 2.0 * shapes.slider.half_width_mm,
        ),
        LoadKind::LineForce => (
            &["kind", "n_per_mm", "spring_n_per_mm"],
            required(
                "n_per_mm",
                (own.n_per_mm, load.n_per_mm),
                LINE_FORCE_N_PER_MM,
            ),
        ),
        LoadKind::Force => (
            &["kind", "n", "width_mm", "spring_n_per_mm"],
            required("n", (own.n, load.n), FORCE_N)
                / if with_width {
                    required("width_mm", (own.width_mm, load.width_mm), WIDTH_MM)
                } else {
                    1.0
                },
        ),
    };
    diagnostics.check_fields("/load", &load, fields, kind.as_str());
    let spring = load.spring_n_per_mm.map_or(0.0, |spring| {
        diagnostics.provenance(
            "/load/spring_n_per_mm",
            provenance_of(own.spring_n_per_mm.is_some()),
        );
        diagnostics.check_range("/load/spring_n_per_mm", spring, &SPRING_N_PER_MM)
    });
    let depth = match kind {
        LoadKind::Force if with_width => load.width_mm.unwrap_or(1.0),
        LoadKind::Force | LoadKind::Pressure | LoadKind::LineForce => 1.0,
    };
    let line_load = LineLoad {
        n_per_mm,
        spring_n_per_mm2: spring / depth,
    };
    (load, line_load)
}
