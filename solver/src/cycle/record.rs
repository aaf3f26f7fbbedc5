//! From the state of the integrator to what the histories keep.

use super::{CycleState, Sweep};
use crate::contact::ContactState;
use crate::history::{
    CycleReport, DepthProfile, PlacedFields, Position, SideReport, Snapshot, TractionField,
};
use crate::model::Model;
use crate::scene::Scene;

/// A scar ends where its depth falls below this part of the largest one; outside the reach of the contact it is
/// exactly zero.
const SCAR_EDGE: f64 = 1e-3;

/// The report of the present state.
pub fn report(scene: &Scene, model: &Model, state: &CycleState) -> CycleReport {
    let x = model.receptacle.contact_x();
    let interface = &model.interface;
    let has_identity = |k: f64| k > 0.0 && interface.spring <= 0.0;
    let ideal = |k: f64| has_identity(k).then_some(k * interface.load * state.sliding_distance);
    let side = |x: &[f64], widths: &[f64], depth: &[f64], k: f64| SideReport {
        max_depth_mm: depth.iter().fold(0.0, |m: f64, d| m.max(*d)),
        worn_area_mm2: widths.iter().zip(depth).map(|(w, d)| w * d).sum(),
        ideal_area_mm2: ideal(k),
        scar_half_width_mm: scar_half_width(x, depth),
    };
    let slider_x = model.slider.contact_x();
    CycleReport {
        cycle: state.cycle,
        jump: state.jump.last,
        jump_error: state.jump.error,
        sliding_distance_mm: state.sliding_distance,
        receptacle: side(
            x,
            &model.receptacle.contact_widths(),
            &state.receptacle_depth,
            interface.receptacle_wear,
        ),
        slider: side(
            slider_x,
            &model.slider.contact_widths(),
            &state.slider_depth,
            interface.slider_wear,
        ),
        station_depth_mm: scene
            .output
            .stations_mm
            .iter()
            .map(|&station| interpolate(x, &state.receptacle_depth, station))
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
    sweep: Sweep,
    fields: Vec<PlacedFields>,
) -> Snapshot {
    let profile = |x: &[f64], depth: &[f64]| DepthProfile {
        x_mm: x.to_vec(),
        depth_mm: depth.to_vec(),
    };
    let x = model.receptacle.contact_x();
    let at = |(position, contact): &(Position, ContactState)| tractions(*position, x, contact);
    Snapshot {
        cycle: state.cycle,
        receptacle: profile(x, &state.receptacle_depth),
        slider: profile(model.slider.contact_x(), &state.slider_depth),
        positions: sweep.contacts.iter().map(at).collect(),
        friction_loop: sweep.friction_loop,
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

/// Half the distance between the places where the depth falls below the edge's share of the largest depth, mm.
///
/// The depth goes to zero at an angle somewhere between the last worn node and the next one; the line through the last
/// two worn nodes tells where. Interpolating to the unworn node instead would put the edge there, up to an element too
/// far out.
fn scar_half_width(x: &[f64], depth: &[f64]) -> f64 {
    let limit = SCAR_EDGE * depth.iter().fold(0.0, |m: f64, d| m.max(*d));
    let worn = |d: &f64| *d > limit;
    let (Some(first), Some(last)) = (depth.iter().position(worn), depth.iter().rposition(worn))
    else {
        return 0.0;
    };
    let edge = |node: usize, inner: Option<usize>, outer: Option<usize>| {
        let Some(outer) = outer else { return x[node] };
        let fall = inner.map_or(0.0, |i| (depth[i] - depth[node]) / (x[node] - x[i]).abs());
        let reach = (x[outer] - x[node]).abs();
        let out = if fall * reach > depth[node] - limit {
            (depth[node] - limit) / fall
        } else {
            reach * (depth[node] - limit) / (depth[node] - depth[outer])
        };
        x[node] + out * (x[outer] - x[node]).signum()
    };
    let inside = |node: usize| (first..=last).contains(&node).then_some(node);
    let left = edge(first, inside(first + 1), first.checked_sub(1));
    let right = edge(
        last,
        last.checked_sub(1).and_then(inside),
        Some(last + 1).filter(|&node| node < x.len()),
    );
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
    relative(report.receptacle.worn_area_mm2, interface.receptacle_wear)
        .max(relative(report.slider.worn_area_mm2, interface.slider_wear))
}
