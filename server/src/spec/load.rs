//! The normal load, brought to N per mm of depth.

use api::spec::{Load, LoadKind, Provenance};

use crate::reference::presets::Preset;
use crate::spec::diagnostics::{Diagnostics, Range};
use crate::spec::geometry::Shapes;

/// MPa on the top face.
const PRESSURE_MPA: Range = Range {
    from: 1e-9,
    to: 1e6,
};
/// N per mm of depth.
const LINE_FORCE_N_PER_MM: Range = Range {
    from: 1e-9,
    to: 1e6,
};
/// N.
const FORCE_N: Range = Range {
    from: 1e-9,
    to: 1e7,
};
/// mm.
const WIDTH_MM: Range = Range {
    from: 1e-6,
    to: 1e4,
};

/// N per mm of deflection.
const SPRING_N_PER_MM: Range = Range { from: 0.0, to: 1e9 };

/// The load of one mm of depth.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct LineLoad {
    /// On the unworn contact, N per mm.
    pub(crate) n_per_mm: f64,
    /// What a spring loses as the contact sinks, N per mm and mm.
    pub(crate) spring_n_per_mm2: f64,
}

/// Fills in the load.
pub(crate) fn resolve(
    given: Option<&Load>,
    preset: &Preset,
    shapes: &Shapes,
    diagnostics: &mut Diagnostics,
) -> (Load, LineLoad) {
    let (load, from) = match given {
        Some(load) => (load.clone(), Provenance::Given),
        None => (preset.load.value.clone(), preset.load.from),
    };
    diagnostics.note("/load/kind", from);
    let Some(kind) = diagnostics.known("/load/kind", &load.kind) else {
        return (load, LineLoad::default());
    };
    let own: &[&str] = match kind {
        LoadKind::Pressure => &["mpa"],
        LoadKind::LineForce => &["n_per_mm"],
        LoadKind::Force => &["n", "width_mm"],
    };
    let mut required = |field: &str, value: Option<f64>, range: Range| {
        let pointer = format!("/load/{field}");
        let Some(value) = value else {
            diagnostics.missing(&pointer, &format!("`{}` needs it", kind.as_str()));
            return 0.0;
        };
        diagnostics.note(&pointer, from);
        diagnostics.check(&pointer, value, range)
    };
    let n_per_mm = match kind {
        // The pressure acts on the whole top face.
        LoadKind::Pressure => {
            required("mpa", load.mpa, PRESSURE_MPA) * 2.0 * shapes.slider.half_width_mm
        }
        LoadKind::LineForce => required("n_per_mm", load.n_per_mm, LINE_FORCE_N_PER_MM),
        LoadKind::Force => {
            let (n, width_mm) = (
                required("n", load.n, FORCE_N),
                required("width_mm", load.width_mm, WIDTH_MM),
            );
            n / width_mm
        }
    };
    let fields = [
        ("mpa", load.mpa),
        ("n_per_mm", load.n_per_mm),
        ("n", load.n),
        ("width_mm", load.width_mm),
    ];
    for (field, value) in fields {
        diagnostics.misplaced(
            "/load",
            &[(field, value.is_some() && !own.contains(&field))],
            kind.as_str(),
        );
    }
    let spring = load.spring_n_per_mm.map_or(0.0, |spring| {
        diagnostics.note("/load/spring_n_per_mm", from);
        diagnostics.check("/load/spring_n_per_mm", spring, SPRING_N_PER_MM)
    });
    let depth = if kind == LoadKind::Force {
        load.width_mm.unwrap_or(1.0)
    } else {
        1.0
    };
    (
        load,
        LineLoad {
            n_per_mm,
            spring_n_per_mm2: spring / depth,
        },
    )
}
