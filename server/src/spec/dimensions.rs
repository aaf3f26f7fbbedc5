//! Dimensions: which belong to which kind of system, their defaults and limits.

use api::spec::{Provenance, System, SystemKind};
use solver::scene::{BlockShape, SliderShape};

use crate::spec::diagnostics::{Diagnostics, Range};
use crate::spec::geometry;
use crate::spec::geometry::Shapes;

use Provenance::{Assumed, Source, Typical};

/// Lengths that make a contact system, mm: from 1 nm to 10 m.
const LENGTH_MM: Range = Range {
    from: 1e-6,
    to: 1e4,
};

/// A dimension of a kind: its field, default (from the dimensions before it) and provenance.
struct Dimension {
    field: &'static str,
    default: fn(&System) -> f64,
    from: Provenance,
}

const fn dimension(
    field: &'static str,
    default: fn(&System) -> f64,
    from: Provenance,
) -> Dimension {
    Dimension {
        field,
        default,
        from,
    }
}

/// Every dimension of the specification, by field.
const FIELDS: [&str; 15] = [
    "wire_diameter_mm",
    "pcb_length_mm",
    "pcb_height_mm",
    "radius_mm",
    "flat_length_mm",
    "flat_height_mm",
    "slider_half_width_mm",
    "slider_height_mm",
    "contact_radius_mm",
    "pad_length_mm",
    "pad_height_mm",
    "pin_length_mm",
    "pin_thickness_mm",
    CROWN,
    ROUND_PIN,
];

/// Radii of convex tops, which need not be given: without them the top is flat.
const CROWN: &str = "crown_radius_mm";
const ROUND_PIN: &str = "pin_radius_mm";

const FUZZ_BUTTON: &[Dimension] = &[
    dimension("wire_diameter_mm", |_| 0.0508, Source),
    dimension("pcb_length_mm", |_| 0.084_67, Source),
    dimension("pcb_height_mm", |_| 0.0635, Assumed),
];

const CYLINDER_ON_FLAT: &[Dimension] = &[
    dimension("radius_mm", |_| 6.0, Assumed),
    dimension("flat_length_mm", |_| 12.0, Assumed),
    dimension("flat_height_mm", |_| 6.0, Assumed),
    dimension(
        "slider_half_width_mm",
        |system| 0.75 * system.radius_mm.unwrap_or_default(),
        Assumed,
    ),
    dimension(
        "slider_height_mm",
        |system| system.radius_mm.unwrap_or_default(),
        Assumed,
    ),
];

const SD_CARD: &[Dimension] = &[
    dimension("contact_radius_mm", |_| 0.4, Assumed),
    dimension("pad_length_mm", |_| 2.0, Assumed),
    dimension("pad_height_mm", |_| 0.3, Assumed),
];

const DIMM: &[Dimension] = &[
    dimension("contact_radius_mm", |_| 0.3, Assumed),
    dimension("pad_length_mm", |_| 2.5, Typical),
    dimension("pad_height_mm", |_| 0.6, Assumed),
];

const ZIF: &[Dimension] = &[
    dimension("contact_radius_mm", |_| 0.25, Assumed),
    dimension("pin_length_mm", |_| 1.5, Assumed),
    dimension("pin_thickness_mm", |_| 0.46, Typical),
];

fn of_kind(kind: SystemKind) -> &'static [Dimension] {
    match kind {
        SystemKind::FuzzButton => FUZZ_BUTTON,
        SystemKind::CylinderOnFlat => CYLINDER_ON_FLAT,
        SystemKind::SdCard => SD_CARD,
        SystemKind::Dimm => DIMM,
        SystemKind::Zif => ZIF,
    }
}

/// Names of all dimensions of a kind, those without a default included.
pub(crate) fn names(kind: SystemKind) -> Vec<&'static str> {
    let named = of_kind(kind).iter().map(|dimension| dimension.field);
    named.chain(crown(kind)).collect()
}

/// The dimension that makes a receptacle convex; it has no default.
fn crown(kind: SystemKind) -> Option<&'static str> {
    match kind {
        SystemKind::CylinderOnFlat => Some(CROWN),
        SystemKind::Zif => Some(ROUND_PIN),
        SystemKind::FuzzButton | SystemKind::SdCard | SystemKind::Dimm => None,
    }
}

/// Fills in the dimensions of a kind and makes the shapes.
pub(crate) fn resolve(
    kind: SystemKind,
    given: &System,
    diagnostics: &mut Diagnostics,
) -> (System, Shapes) {
    let mut given = given.clone();
    let mut system = System::of_kind(kind);
    diagnostics.note("/system/kind", Provenance::Given);
    for dimension in of_kind(kind) {
        let pointer = format!("/system/{}", dimension.field);
        let default = (dimension.default)(&system);
        let stated = field(&mut given, dimension.field).take();
        // A default made from a faulty dimension is no fault of its own.
        if let Some(value) = stated {
            diagnostics.check(&pointer, value, LENGTH_MM);
        }
        let value = diagnostics.take(&pointer, stated, default, dimension.from);
        *field(&mut system, dimension.field) = Some(value);
    }
    let crown = crown(kind);
    if let Some(name) = crown {
        let radius = field(&mut given, name).take();
        if let Some(radius) = radius {
            let pointer = format!("/system/{name}");
            diagnostics.note(&pointer, Provenance::Given);
            diagnostics.check(&pointer, radius, LENGTH_MM);
        }
        *field(&mut system, name) = radius;
    }
    for name in FIELDS {
        let left_over = field(&mut given, name).is_some();
        diagnostics.misplaced("/system", &[(name, left_over)], kind.as_str());
    }
    let shapes = geometry::shapes(kind, &system);
    fits(kind, &shapes, diagnostics);
    if let Some(name) = crown {
        crown_fits(name, &shapes.block, diagnostics);
    }
    (system, shapes)
}

/// The modelled part of a cylinder must be a body: not wider than the cylinder, and with some height at its sides.
fn fits(kind: SystemKind, shapes: &Shapes, diagnostics: &mut Diagnostics) {
    let SliderShape {
        radius_mm,
        half_width_mm,
        height_mm,
    } = shapes.slider;
    if kind != SystemKind::CylinderOnFlat || !(radius_mm > 0.0 && half_width_mm > 0.0) {
        return;
    }
    if half_width_mm > radius_mm {
        diagnostics.fault(
            "/system/slider_half_width_mm",
            format!("{half_width_mm} exceeds the radius of {radius_mm}"),
        );
        return;
    }
    let sagitta = radius_mm - (radius_mm * radius_mm - half_width_mm * half_width_mm).sqrt();
    if height_mm < sagitta {
        diagnostics.fault(
            "/system/slider_height_mm",
            format!("{height_mm} is below the arc's own height of {sagitta} at the half width {half_width_mm}"),
        );
    }
}

/// A convex top must be as wide as the block is long, and leave some of the block's sides.
fn crown_fits(name: &str, block: &BlockShape, diagnostics: &mut Diagnostics) {
    let Some(radius) = block.crown_radius_mm else {
        return;
    };
    let (pointer, half) = (format!("/system/{name}"), 0.5 * block.length_mm);
    if radius < half {
        let detail = format!("{radius} is below half the length of {}", block.length_mm);
        diagnostics.fault(&pointer, detail);
        return;
    }
    let sagitta = radius - (radius * radius - half * half).sqrt();
    if sagitta > 0.98 * block.height_mm {
        let detail = format!(
            "{radius} makes an arc {sagitta} high, above 0.98 of the height of {}",
            block.height_mm
        );
        diagnostics.fault(&pointer, detail);
    }
}

fn field<'a>(system: &'a mut System, name: &str) -> &'a mut Option<f64> {
    match name {
        "wire_diameter_mm" => &mut system.wire_diameter_mm,
        "pcb_length_mm" => &mut system.pcb_length_mm,
        "pcb_height_mm" => &mut system.pcb_height_mm,
        "radius_mm" => &mut system.radius_mm,
        "flat_length_mm" => &mut system.flat_length_mm,
        "flat_height_mm" => &mut system.flat_height_mm,
        "slider_half_width_mm" => &mut system.slider_half_width_mm,
        "slider_height_mm" => &mut system.slider_height_mm,
        "contact_radius_mm" => &mut system.contact_radius_mm,
        "pad_length_mm" => &mut system.pad_length_mm,
        "pad_height_mm" => &mut system.pad_height_mm,
        "pin_length_mm" => &mut system.pin_length_mm,
        "pin_thickness_mm" => &mut system.pin_thickness_mm,
        CROWN => &mut system.crown_radius_mm,
        ROUND_PIN => &mut system.pin_radius_mm,
        other => unreachable!("`{other}` is not a dimension"),
    }
}
