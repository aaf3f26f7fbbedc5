//! SD card: the rounded tip of a formed spring on a card's flat pad. The bend continues into the legs of the spring
//! at three quarters of its radius; the legs are not modelled.
//!
//! ```text
//!    |  tip  |
//!     \     /
//!  ____`-.-'____
//!  |    pad    |
//! ```

use crate::spec::sourced::{assumed, typical};
use crate::spec::system::definition::{SystemDefinition, dimension};
use crate::spec::system::preset::{RatingPreset, Spring, USUAL_PLATING, socket};
use crate::spec::system::shapes::{Shapes, flat, length, tip};

pub(super) const DEFINITION: SystemDefinition = SystemDefinition {
    description: "a rounded spring contact on a memory card's flat pad",
    dimensions: &[
        dimension!(contact_radius_mm, |_| 0.4, Assumed),
        dimension!(pad_length_mm, |_| 2.0, Assumed),
        dimension!(pad_height_mm, |_| 0.3, Assumed),
    ],
    shapes: |system| Shapes {
        slider: tip(length(system.contact_radius_mm)),
        block: flat(system.pad_length_mm, system.pad_height_mm),
    },
    check: |_, _| {},
    preset: || {
        socket(&Spring {
            material: "becu",
            force_n: 0.5,
            width_mm: 0.8,
            plating: &USUAL_PLATING,
            rating: RatingPreset {
                matings: typical(10_000.0),
                of: "miniSD sockets",
                wipe_mm: assumed(1.5),
            },
        })
    },
};
