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

use super::pair::Pair;
use super::state::ContactState;
use crate::condensation::ZoneOperators;
use crate::sides::Side;

/// Displacement of the slider at which the surfaces are paired, mm, for its imposed displacement, with the mean coefficient of
/// friction of the contact. Stored forces act on the slider, so that the jump of slider over receptacle is the sum of what they do to
/// both bodies.
pub(super) fn position(
    pair: &Pair<'_>,
    last: &ContactState,
    (slider_x, friction): (f64, f64),
) -> f64 {
    if !pair.interface.sticks {
        return slider_x;
    }
    let (mut lag, mut largest) = (0.0, 0.0);
    for side in Side::BOTH {
        let Some(zone) = pair.operators.of(side).zone(&last.loaded(side)) else {
            return slider_x;
        };
        let (elastic, slipping) = mean_displacements(zone, last.force.of(side));
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
fn mean_displacements(zone: &ZoneOperators, force: &[f64]) -> (f64, f64) {
    let forces = force.chunks_exact(2).enumerate();
    let loaded = forces.filter(|(_, f)| f[1] != 0.0);
    let (mut under_force, mut turned, mut total) = (0.0, 0.0, 0.0);
    for (j, f) in loaded.clone() {
        let nodes = zone.nodes();
        let response = zone.to_force_at(j, &nodes);
        for (i, weight) in loaded.clone() {
            let [x_per_x, x_per_y] = response.map(|column| column[2 * (i - nodes.start)]);
            under_force += weight[1] * (f[0] * x_per_x + f[1] * x_per_y);
            turned += weight[1] * f[1] * x_per_x;
        }
        total += f[1];
    }
    if total > 0.0 {
        (under_force / total, turned.abs() / total)
    } else {
        (0.0, 0.0)
    }
}
