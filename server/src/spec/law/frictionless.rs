//! No friction: q = 0.

use api::spec::Friction;
use solver::scene;

use crate::spec::diagnostics::Diagnostics;

/// Resolves the law of a specification.
pub(super) fn resolve(given: &Friction, diagnostics: &mut Diagnostics) -> scene::Friction {
    diagnostics.check_fields("/interface/friction", given, &["law"], "frictionless");
    scene::Friction::Frictionless
}
