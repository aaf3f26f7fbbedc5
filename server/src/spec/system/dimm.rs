//! DIMM: a semicircular socket contact on a memory module's flat pad.

use crate::spec::sourced::assumed;
use crate::spec::system::definition::{SystemDefinition, dimension};
use crate::spec::system::preset::{RatingPreset, Spring, USUAL_PLATING, socket};
use crate::spec::system::shapes::{Shapes, flat, half_round, length};

pub(super) const DEFINITION: SystemDefinition = SystemDefinition {
    description: "a semicircular socket contact on a memory module's pad",
    dimensions: &[
        dimension!(contact_radius_mm, |_| 0.3, Assumed),
        dimension!(pad_length_mm, |_| 2.5, Typical),
        dimension!(pad_height_mm, |_| 0.6, Assumed),
    ],
    shapes: |system| Shapes {
        slider: half_round(length(system.contact_radius_mm)),
        block: flat(system.pad_length_mm, system.pad_height_mm),
    },
    check: |_, _| {},
    preset: || {
        socket(&Spring {
            material: "phosphor_bronze",
            force_n: 0.6,
            width_mm: 0.6,
            plating: &USUAL_PLATING,
            rating: RatingPreset {
                matings: assumed(25.0),
                of: "sockets of memory modules",
                wipe_mm: assumed(1.5),
            },
        })
    },
};
