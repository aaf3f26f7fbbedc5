//! Pairing: which points of the two surfaces lie opposite each other.
//!
//! Surfaces that stick move together although the slider's far side is displaced: the bodies deform. They are therefore
//! paired at the imposed displacement less its elastic part, the lag. Pairing a sticking contact by the imposed
//! displacement would interpolate its tractions over other nodes in each increment; in partial slip, where the shear at
//! the edge of the stick zone is exactly mu p in the fully worn state, such errors let the edge slip, wear and never
//! come back.
//!
//! The lag is that of the last increment with the new displacement added, up to that of gross slip. The gap corrects a
//! wrong lag to first order, so that it need not be exact: where all of the contact slips in each stroke, it is left
//! out.

use super::deformation::WIDE;
use super::pair::Pair;
use super::state::ContactState;
use crate::condensation::ZoneOperators;
use crate::sides::Side;
use std::ops::Range;

/// Displacement of the slider at which the surfaces are paired, mm, for its imposed displacement, with the mean coefficient of
/// friction of the contact. Stored forces act on the slider, so that the jump of slider over receptacle is the sum of what they do to
/// both bodies.
pub(super) fn position(pair: &Pair<'_>, last: &ContactState, slider_x: f64, friction: f64) -> f64 {
    if !pair.interface.sticks {
        return slider_x;
    }
    let (mut lag, mut largest) = (0.0, 0.0);
    for side in Side::BOTH {
        let loaded = last.loaded(side);
        let Some(zone) = pair.operators.of(side).zone(&loaded) else {
            return slider_x;
        };
        let (elastic, slipping) = mean_displacements(zone, &loaded, last.force.of(side));
        lag -= elastic;
        largest += friction * slipping;
    }
    let step = slider_x - last.slider_x;
    let lag = if step > 0.0 {
        (lag + step).min(lag.max(largest))
    } else {
        (lag + step).max(lag.min(-largest))
    };
    slider_x - lag
}

/// Mean of u_x over the contact, weighted by its vertical forces, under nodal forces, and the size of the same under
/// their vertical part turned into the tangential direction, mm.
fn mean_displacements(zone: &ZoneOperators, loaded: &Range<usize>, force: &[f64]) -> (f64, f64) {
    let own = &force[2 * loaded.start..2 * loaded.end];
    let vertical = || own.iter().skip(1).step_by(2);
    let total: f64 = vertical().sum();
    if total <= 0.0 {
        return (0.0, 0.0);
    }
    let (under_force, turned) = if loaded.len() >= WIDE {
        let turned: Vec<f64> = vertical().flat_map(|f| [*f, 0.0]).collect();
        let mean = |forces: &[f64]| {
            let mut moved = vec![0.0; forces.len()];
            zone.add_displacements(loaded, forces, loaded, &mut moved);
            let weighted = vertical().zip(moved.iter().step_by(2));
            weighted.map(|(weight, u)| weight * u).sum::<f64>()
        };
        (mean(own), mean(&turned))
    } else {
        each_by_each(zone, force)
    };
    (under_force / total, turned.abs() / total)
}

/// The sums of both, node by node.
fn each_by_each(zone: &ZoneOperators, force: &[f64]) -> (f64, f64) {
    let forces = force.chunks_exact(2).enumerate();
    let loaded = forces.filter(|(_, f)| f[1] != 0.0);
    let (mut under_force, mut turned) = (0.0, 0.0);
    for (j, f) in loaded.clone() {
        let nodes = zone.nodes();
        let response = zone.to_force_at(j, &nodes);
        for (i, weight) in loaded.clone() {
            let [x_per_x, x_per_y] = response.map(|column| column[2 * (i - nodes.start)]);
            under_force += weight[1] * (f[0] * x_per_x + f[1] * x_per_y);
            turned += weight[1] * f[1] * x_per_x;
        }
    }
    (under_force, turned)
}
