//! ZIF socket: the rounded tip of a socket's spring on a pin, flat (stamped) or round.
//!
//! ```text
//!    |  tip  |              |  tip  |
//!     \     /                \     /
//!  ____`-.-'____             _.`-.-'._
//!  |  flat pin |            | round pin |
//! ```

use solver::scene::BlockShape;

use crate::spec::sourced::{assumed, typical};
use crate::spec::system::definition::{SystemDefinition, dimension};
use crate::spec::system::preset::{MPGA604_PLATING, RatingPreset, Spring, socket};
use crate::spec::system::shapes::{Shapes, check_crown, flat, length, tip};

pub(super) const DEFINITION: SystemDefinition = SystemDefinition {
    description: "a sprung socket contact on the pin of an integrated circuit",
    dimensions: &[
        dimension!(contact_radius_mm, |_| 0.25, Assumed),
        dimension!(pin_length_mm, |_| 1.5, Assumed),
        dimension!(pin_thickness_mm, |_| 0.46, Typical),
        dimension!(pin_radius_mm),
    ],
    shapes: |system| Shapes {
        slider: tip(length(system.contact_radius_mm)),
        block: BlockShape {
            crown_radius_mm: system.pin_radius_mm,
            ..flat(system.pin_length_mm, system.pin_thickness_mm)
        },
    },
    check: |shapes, diagnostics| check_crown("/system/pin_radius_mm", shapes, diagnostics),
    preset: || {
        socket(&Spring {
            material: "phosphor_bronze",
            force_n: 0.5,
            width_mm: 0.46,
            plating: &MPGA604_PLATING,
            rating: RatingPreset {
                matings: typical(50.0),
                of: "mPGA604 sockets",
                // The way of the sliding cover: the pins are not rubbed while they are put in.
                wipe_mm: assumed(0.5),
            },
        })
    },
};
