//! DIMM: a semicircular socket contact on a memory module's flat pad.

use crate::spec::system::definition::{SystemDefinition, dimension};
use crate::spec::system::preset::plated;
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
    preset: || plated("phosphor_bronze", 0.6, 0.6),
};
