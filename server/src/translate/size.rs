//! How large a solve is: what its plan expects it to need.

use solver::model::{self, BodyModel};
use solver::scene::Scene;

/// What a process needs before it solves anything, MB.
const BASE_MB: f64 = 24.0;
/// Dense matrices of a body's contact unknowns that are held at once while it is condensed.
const DENSE_COPIES: f64 = 4.0;
/// Bytes a degree of freedom of assembly and factor.
const BYTES_PER_DOF: f64 = 4_000.0;

/// Size of a solve.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Size {
    /// Degrees of freedom of both meshes.
    pub(super) dofs: f64,
    /// Memory that is expected, MB.
    pub(super) memory_mb: f64,
}

/// The size of a scene; nothing where it cannot be meshed.
pub(super) fn of(scene: &Scene) -> Option<Size> {
    let model = model::build(scene).ok()?;
    let bodies = [&model.slider, &model.receptacle];
    let bytes: f64 = bodies.into_iter().map(body_bytes).sum();
    Some(Size {
        dofs: bodies.into_iter().map(|body| real(body.dofs())).sum(),
        memory_mb: BASE_MB + bytes / f64::from(1 << 20),
    })
}

fn body_bytes(body: &BodyModel) -> f64 {
    let unknowns = 2.0 * real(body.contact.1 - body.contact.0);
    DENSE_COPIES * 8.0 * unknowns * unknowns + BYTES_PER_DOF * real(body.dofs())
}

#[expect(clippy::cast_precision_loss, reason = "meshes stay far below 2^53")]
fn real(count: usize) -> f64 {
    count as f64
}
