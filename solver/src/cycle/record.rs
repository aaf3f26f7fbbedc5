//! From the state of the integrator to what the histories keep.

use super::{CycleRecord, CycleState};
use crate::contact::ContactState;
use crate::history::{
    CycleReport, DepthProfile, PlacedFields, Position, SideReport, Snapshot, TractionField,
};
use crate::model::Model;
use crate::scene::Scene;

/// The edge of a scar is on the line through its last two nodes that are deeper than this part of its largest depth.
const SCAR_EDGE: f64 = 0.02;

/// The report of the present state.
pub fn report(scene: &Scene, model: &Model, state: &CycleState) -> CycleReport {
    let x = model.bodies.receptacle.contact_x();
    let interface = &model.interface;
    let has_identity = |k: f64| k > 0.0 && interface.spring <= 0.0;
    let ideal = |k: f64| has_identity(k).then_some(k * interface.load * state.sliding_distance);
    let side = |x: &[f64], widths: &[f64], depth: &[f64], k: f64| SideReport {
        max_depth_mm: depth.iter().fold(0.0, |m: f64, d| m.max(*d)),
        worn_area_mm2: widths.iter().zip(depth).map(|(w, d)| w * d).sum(),
        ideal_area_mm2: ideal(k),
        scar_half_width_mm: scar_half_width(x, depth),
    };
    let slider_x = model.bodies.slider.contact_x();
    CycleReport {
        cycle: state.cycle,
        jump: state.jump.last,
        jump_error: state.jump.error,
        sliding_distance_mm: state.sliding_distance,
        receptacle: side(
            x,
            &model.bodies.receptacle.contact_widths(),
            &state.depth.receptacle,
            interface.wear.receptacle,
        ),
        slider: side(
            slider_x,
            &model.bodies.slider.contact_widths(),
            &state.depth.slider,
            interface.wear.slider,
        ),
        station_depth_mm: scene
            .output
            .stations_mm
            .iter()
            .map(|&station| interpolate(x, &state.depth.receptacle, station))
            .collect(),
        load_n_per_mm: state.neutral.load,
        peak_pressure_mpa: state.neutral.peak_pressure,
        contact_half_width_mm: state.neutral.half_width,
        dissipated_energy_mj_per_mm: state.energy,
    }
}

/// The snapshot of the present state with what the last sweep recorded, and fields if there are any.
pub fn snapshot(
    model: &Model,
    state: &CycleState,
    record: CycleRecord,
    fields: Vec<PlacedFields>,
) -> Snapshot {
    let profile = |x: &[f64], depth: &[f64]| DepthProfile {
        x_mm: x.to_vec(),
        depth_mm: depth.to_vec(),
    };
    let x = model.bodies.receptacle.contact_x();
    let at = |(position, contact): &(Position, ContactState)| tractions(*position, x, contact);
    Snapshot {
        cycle: state.cycle,
        receptacle: profile(x, &state.depth.receptacle),
        slider: profile(model.bodies.slider.contact_x(), &state.depth.slider),
        positions: record.contacts.iter().map(at).collect(),
        friction_loop: record.friction_loop,
        fields,
    }
}

/// Tractions of the present contact, with one unloaded node at either end.
fn tractions(position: Position, x: &[f64], contact: &ContactState) -> TractionField {
    let (first, end) = contact.active_range().unwrap_or((0, 0));
    let span = first.saturating_sub(1)..(end + 1).min(x.len());
    TractionField {
        position,
        slider_x_mm: contact.slider_x,
        x_mm: x[span.clone()].to_vec(),
        pressure_mpa: contact.pressure[span.clone()].to_vec(),
        shear_mpa: contact.shear[span].to_vec(),
    }
}

/// Linear interpolation; the end values beyond the ends.
fn interpolate(x: &[f64], y: &[f64], at: f64) -> f64 {
    let i = x.partition_point(|&x| x < at).clamp(1, x.len() - 1);
    let t = ((at - x[i - 1]) / (x[i] - x[i - 1])).clamp(0.0, 1.0);
    (1.0 - t) * y[i - 1] + t * y[i]
}

/// Half the distance between the edges of the scar, mm.
///
/// The depth goes to zero at an angle, but for a foot of an element or two that the mesh makes. The line through the last
/// two nodes above the foot tells the edge to about a tenth of an element; interpolating to the first unworn
/// node would put it up to an element too far out.
fn scar_half_width(x: &[f64], depth: &[f64]) -> f64 {
    let limit = SCAR_EDGE * depth.iter().fold(0.0, |m: f64, d| m.max(*d));
    let deep = |d: &f64| *d > limit;
    let (Some(first), Some(last)) = (depth.iter().position(deep), depth.iter().rposition(deep))
    else {
        return 0.0;
    };
    let edge = |node: usize, inner: usize, end: usize| {
        let rise = (depth[inner] - depth[node]) / (x[inner] - x[node]);
        let out = x[node] - depth[node] / rise;
        if node == end || inner == node || !out.is_finite() {
            return x[node];
        }
        // Not beyond the first unworn node.
        let unworn = if node < end {
            (node..=end).find(|&i| depth[i] <= 0.0)
        } else {
            (end..=node).rev().find(|&i| depth[i] <= 0.0)
        };
        let bound = x[unworn.unwrap_or(end)];
        out.clamp(x[node].min(bound), x[node].max(bound))
    };
    let left = edge(first, (first + 1).min(last), 0);
    let right = edge(last, last.saturating_sub(1).max(first), x.len() - 1);
    0.5 * (right - left)
}

/// |worn area of the profiles - k times the accumulated integral of p |slip||, over the latter; 0 without wear.
pub(crate) fn worn_area_residual(model: &Model, state: &CycleState, report: &CycleReport) -> f64 {
    let relative = |area: f64, k: f64| {
        let expected = k * state.friction_path;
        if expected > 0.0 {
            (area - expected).abs() / expected
        } else {
            0.0
        }
    };
    let interface = &model.interface;
    relative(report.receptacle.worn_area_mm2, interface.wear.receptacle)
        .max(relative(report.slider.worn_area_mm2, interface.wear.slider))
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A circular segment on a mesh that does not meet its edges, with a foot on the right: 0.5 (1.7 + 1.3).
    #[test]
    fn edges_lie_between_the_nodes() {
        let x: Vec<f64> = (0..=80_u32).map(|i| -2.0 + 0.05 * f64::from(i)).collect();
        let mut depth: Vec<f64> = x.iter().map(|x| ((1.7 + x) * (1.3 - x)).max(0.0)).collect();
        let foot = depth.iter().rposition(|d| *d > 0.0).expect("worn") + 1;
        depth[foot] = 1e-3;
        assert!((scar_half_width(&x, &depth) - 1.5).abs() < 0.01);
    }

    #[test]
    fn a_groove_over_the_whole_block_ends_with_it() {
        assert!((scar_half_width(&[-1.0, 0.0, 1.0], &[0.5, 1.0, 0.4]) - 1.0).abs() < 1e-15);
        assert!(scar_half_width(&[-1.0, 0.0, 1.0], &[0.0; 3]).abs() < 1e-15);
        assert!(scar_half_width(&[-1.0, 0.0, 1.0], &[0.0, 1.0, 0.0]).abs() < 1e-15);
    }
}
