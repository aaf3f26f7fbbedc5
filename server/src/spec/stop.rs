//! Conditions that end a run.

use api::spec::Stop;
use solver::scene;
use solver::sides::Side;

use crate::spec::criterion::{self, Modelled, Surfaces, WORN_DEPTH_MM};
use crate::spec::diagnostics::Diagnostics;

/// Most conditions of a job.
pub(in crate::spec) const STOP_LIMIT: usize = 16;

/// Resolves the conditions: those of depths, and limits of the resistance in mOhm.
pub(super) fn resolve(
    given: &[Stop],
    surfaces: Surfaces<'_>,
    diagnostics: &mut Diagnostics,
) -> (Vec<scene::Criterion>, Vec<f64>) {
    diagnostics.check_length("/stop", given.len(), STOP_LIMIT);
    let given = given.iter().take(STOP_LIMIT).enumerate();
    let conditions = given.flat_map(|(index, stop)| {
        condition(&format!("/stop/{index}"), stop, surfaces, diagnostics)
    });
    Modelled::apart(conditions)
}

fn condition(
    pointer: &str,
    stop: &Stop,
    surfaces: Surfaces<'_>,
    diagnostics: &mut Diagnostics,
) -> Vec<Modelled> {
    let depth = format!("{pointer}/worn_depth_mm");
    match (stop.worn_depth_mm, criterion::of_stop(stop)) {
        (Some(_), Some(_)) => {
            diagnostics.exclusive_fields(&depth, "kind");
            Vec::new()
        }
        (None, None) => {
            let detail = "a condition such as `worn_depth_mm`, or a criterion with its `kind`";
            diagnostics.missing(pointer, detail);
            Vec::new()
        }
        (Some(depth_mm), None) => {
            diagnostics.check_fields(pointer, stop, &["worn_depth_mm"], "worn_depth_mm");
            diagnostics.check_range(&depth, depth_mm, &WORN_DEPTH_MM);
            let of_side = |side| Modelled::Depth(scene::Criterion::deepest(side, depth_mm));
            Side::BOTH.into_iter().map(of_side).collect()
        }
        (None, Some(given)) => {
            let resolved = criterion::resolve(pointer, &given, surfaces, diagnostics);
            if resolved.iter().any(|(_, criterion)| criterion.is_none()) {
                let lacks = surfaces.resistance_lacks.join(", ");
                let detail = format!("the contact resistance is not modelled: it needs {lacks}");
                diagnostics.fault(&format!("{pointer}/kind"), detail);
            }
            resolved
                .into_iter()
                .filter_map(|(_, criterion)| criterion)
                .collect()
        }
    }
}
