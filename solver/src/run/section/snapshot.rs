//! Snapshots of a run.

use crate::SolveError;
use crate::condensation::Condensed;
use crate::cycle::{CycleRecord, CycleState};
use crate::fields;
use crate::model::Model;
use crate::record::{self, Snapshot};
use crate::scene::Scene;

/// The snapshot of a state, with fields inside the bodies where the scene asks for them.
pub(super) fn snapshot(
    scene: &Scene,
    model: &Model,
    condensed: &Condensed,
    state: &CycleState,
    record: CycleRecord,
) -> Result<Snapshot, SolveError> {
    let fields = if scene.output.fields {
        fields::placed(model, condensed, &state.depth, &record.contacts)?
    } else {
        Vec::new()
    };
    Ok(record::snapshot(model, state, record, fields))
}
