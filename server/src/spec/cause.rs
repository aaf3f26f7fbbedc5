//! The field that causes a fault of the whole scene: the given one without which there would be none.

use api::spec::{Model, Spec, System, SystemKind};

use crate::spec::system;

/// A given field: its pointer, and how it is left out.
type Field = (&'static str, fn(&mut Spec));

/// Fields on which mesh and strains depend, besides the dimensions. The most specific is first.
const FIELDS: [Field; 6] = [
    ("/accuracy/overrides/contact_element_mm", |spec| {
        if let Some(overrides) = &mut spec.accuracy.overrides {
            overrides.contact_element_mm = None;
        }
    }),
    ("/motion/amplitude_mm", |spec| {
        if let Some(motion) = &mut spec.motion {
            motion.amplitude_mm = None;
        }
    }),
    ("/accuracy/tolerance", |spec| spec.accuracy.tolerance = None),
    ("/accuracy/preset", |spec| spec.accuracy.preset = None),
    ("/load", |spec| spec.load = None),
    ("/materials", |spec| {
        spec.materials = api::spec::Materials::default();
    }),
];

/// A length of the model: its name and its field.
type Length = (&'static str, fn(&mut Model) -> &mut Option<f64>);

/// Lengths of the model, on which strains and mesh depend as on those of the system.
const LENGTHS: [Length; 4] = [
    ("radius_z_mm", |model| &mut model.radius_z_mm),
    ("crown_radius_mm", |model| &mut model.crown_radius_mm),
    ("width_mm", |model| &mut model.width_mm),
    ("outer_diameter_mm", |model| &mut model.outer_diameter_mm),
];

/// Returns the pointer of the first given field that, left out, would make a specification possible; another one if none
/// alone does.
pub(super) fn of_fault(
    spec: &Spec,
    kind: SystemKind,
    otherwise: &str,
    is_possible: impl Fn(&Spec) -> bool,
) -> String {
    let is_cause = |leave_out: &dyn Fn(&mut Spec)| {
        let mut without = spec.clone();
        leave_out(&mut without);
        without != *spec && is_possible(&without)
    };
    for (pointer, leave_out) in FIELDS {
        if is_cause(&leave_out) {
            return pointer.to_owned();
        }
    }
    for (name, field) in system::definition(kind).dimension_fields() {
        if is_cause(&|spec| *field(&mut spec.system) = None) {
            return format!("/system/{name}");
        }
    }
    for (name, field) in LENGTHS {
        let leave_out = |spec: &mut Spec| {
            if let Some(model) = &mut spec.model {
                *field(model) = None;
            }
        };
        if is_cause(&leave_out) {
            return format!("/model/{name}");
        }
    }
    // A model may require the length: nothing shows then that another field is the cause, unless it is given as well.
    let mut model = spec.model.clone().unwrap_or_default();
    let given = LENGTHS
        .iter()
        .find(|(_, field)| field(&mut model).is_some());
    match given {
        Some((name, _)) if !is_given(spec, otherwise) => format!("/model/{name}"),
        _ => otherwise.to_owned(),
    }
}

/// Returns `true` if a specification says more of a part than its kind.
fn is_given(spec: &Spec, part: &str) -> bool {
    match part {
        "/load" => spec.load.is_some(),
        _ => {
            spec.system
                != System {
                    kind: spec.system.kind.clone(),
                    ..System::default()
                }
        }
    }
}
