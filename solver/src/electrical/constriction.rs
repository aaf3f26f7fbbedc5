//! Constriction of the current through all spots of a contact that is everywhere like one of its patches.
//!
//! n equal spots share the force; each converges the current in the layers that are left (`law::resistance::layered`). Together they
//! have (`law::resistance::spots`) 1/n of one spot's resistance and, of each side, rho/(2 pi n^2) times the sum of 1/s_ij, rho that of one
//! material with the resistance of a disc as large as their circle. Spots whose areas would fill the circle have joined to one of
//! their area.

use std::f64::consts::PI;

use serde::{Deserialize, Serialize};

use super::patches::Patch;
use crate::law::resistance::{Conductor, half_space, spots};
use crate::number::real;
use crate::scene::{Electrical, MOST_METALS, Metal, Spots};
use crate::sides::{Side, Sides};

/// mOhm in an ohm, and mm in a m.
const MILLI: f64 = 1e3;

/// Constriction of a patch, if all of the contact were like it.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub(super) struct Constriction {
    /// Resistance of each side, mOhm.
    pub(super) mohm: Sides<f64>,
    /// Radius of a spot, mm.
    pub(super) radius_mm: f64,
}

/// The current between spots.
pub(super) struct Spreading {
    /// The sum of 1/s_ij over n^2, 1/mm.
    pair_sum_per_mm: f64,
}

impl Spreading {
    pub(super) fn of(given: &Spots) -> Self {
        let places = spots::in_circle(given.count, 0.5 * given.cluster_diameter_mm);
        Self {
            pair_sum_per_mm: spots::pair_sum(&places),
        }
    }

    /// The constriction of a patch under the force of the whole contact, N.
    pub(super) fn of_patch(
        &self,
        electrical: &Electrical,
        force_n: f64,
        patch: &Patch,
    ) -> Constriction {
        let Electrical { metals, spots, .. } = electrical;
        let shown = Sides::from_fn(|side| metals.of(side)[*patch.metal.of(side)].hardness_mpa);
        let hardness = shown.slider.min(shown.receptacle);
        let count = real(spots.count);
        let radius_mm = spots.deformation.radius_mm(force_n / count, hardness);
        let circle_mm = 0.5 * spots.cluster_diameter_mm;
        let joined_mm = count.sqrt() * radius_mm;
        let is_joined = spots.count == 1 || joined_mm >= circle_mm;
        let mohm = Sides::from_fn(|side: Side| {
            let (mut stack, count_left) = ([NOTHING; MOST_METALS], metals.of(side).len());
            let first = *patch.metal.of(side);
            let left = &metals.of(side)[first..count_left];
            let stack = conductors(left, *patch.depth.of(side), &mut stack);
            if is_joined {
                return MILLI * half_space(joined_mm, stack);
            }
            let alone = half_space(radius_mm, stack) / count;
            // 4 a R of the circle, in ohm mm.
            let resistivity = 4.0 * circle_mm * half_space(circle_mm, stack);
            MILLI * (alone + resistivity * self.pair_sum_per_mm / (2.0 * PI))
        });
        Constriction { mohm, radius_mm }
    }
}

const NOTHING: Conductor = Conductor {
    resistivity_ohm_m: 0.0,
    thickness_mm: 0.0,
};

/// Conductors of the metals that are left below a depth, mm.
fn conductors<'a>(
    left: &[Metal],
    depth: f64,
    stack: &'a mut [Conductor; MOST_METALS],
) -> &'a [Conductor] {
    let mut top = depth;
    for (conductor, metal) in stack.iter_mut().zip(left) {
        *conductor = Conductor {
            resistivity_ohm_m: metal.resistivity_ohm_m,
            thickness_mm: (metal.bottom_mm - top).max(0.0),
        };
        top = metal.bottom_mm;
    }
    &stack[..left.len().min(MOST_METALS)]
}
