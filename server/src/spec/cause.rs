//! The field that causes a fault of the whole scene: the given one without which there would be none.

use api::spec::{Spec, SystemKind};

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
    otherwise.to_owned()
}
