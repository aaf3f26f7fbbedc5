//! The plan of a resolved specification: effects with reasons, and closed-form figures of the unworn contact.

use std::collections::BTreeMap;
use std::f64::consts::PI;

use api::plan::{Plan, PlannedEffect};
use solver::model::resolution;
use solver::scene::{Scene, WearLaw};

use crate::estimate::notes;
use crate::spec::Resolved;

/// The plan of a specification.
pub fn plan(resolved: &Resolved) -> Plan {
    Plan {
        effects: effects(&resolved.scene),
        estimates: estimates(&resolved.scene)
            .into_iter()
            .chain(resolved.footprint.figures())
            .chain(resolved.workload.figures())
            .collect(),
        notes: notes::notes(resolved),
    }
}

fn effects(scene: &Scene) -> BTreeMap<String, PlannedEffect> {
    let decided = solver::effects::plan(scene).decisions;
    decided
        .into_iter()
        .map(|decision| {
            let planned = PlannedEffect {
                simulated: decision.simulated,
                reason: decision.reason,
            };
            (decision.effect.name().to_owned(), planned)
        })
        .collect()
}

/// Hertz line contact (K. L. Johnson, *Contact Mechanics*, eq. 4.43 to 4.45): the engine's a,
/// p0 = 2 P / (pi a); and what Archard's law makes of one full pass: (k/H) P per crossed point.
fn estimates(scene: &Scene) -> BTreeMap<String, f64> {
    let load = scene.load_n_per_mm;
    let half_width = resolution::choose(scene).hertz_half_width;
    let way = scene.motion.distance_per_cycle_mm();
    let mut estimates = BTreeMap::from([
        ("line_load_n_per_mm".to_owned(), load),
        ("hertz_half_width_mm".to_owned(), half_width),
        (
            "hertz_peak_pressure_mpa".to_owned(),
            2.0 * load / (PI * half_width),
        ),
        ("sliding_distance_per_cycle_mm".to_owned(), way),
    ]);
    for (side, law) in [
        ("slider", scene.slider.wear),
        ("receptacle", scene.receptacle.wear),
    ] {
        if let Some(WearLaw::Archard { k_over_h_per_mpa }) = law {
            let area = k_over_h_per_mpa * load * way;
            estimates.insert(format!("{side}_ideal_area_per_cycle_mm2"), area);
            if side == "receptacle" {
                estimates.insert(
                    "receptacle_full_pass_depth_mm".to_owned(),
                    k_over_h_per_mpa * load,
                );
            }
        }
    }
    estimates
}
