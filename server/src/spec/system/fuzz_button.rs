//! Fuzz button: the lower half of a wire, cut at its axis, on a block of circuit board.
//!
//! ```text
//!   +---------+  top face at the axis
//!    \  wire /
//!  ___`-...-'___
//!  |   pcb     |
//! ```
//!
//! Fuzz buttons are made of gold-plated beryllium copper (the source); its base scene rubs bare copper on bare copper and is the
//! specification `examples/fuzz_button.json`. They are pressed and not wiped, so that no number of matings follows from their
//! wear (the source mentions 500 000 insertions).

use api::spec::{Drive, Load, LoadKind, Waveform};

use crate::spec::sourced::{assumed, source, typical};
use crate::spec::system::definition::{SystemDefinition, dimension};
use crate::spec::system::preset::{Preset, USUAL_PLATING, archard, friction, sides};
use crate::spec::system::shapes::{Shapes, flat, half_round, length};

pub(super) const DEFINITION: SystemDefinition = SystemDefinition {
    description: "a wire's lower half on a circuit board's block",
    dimensions: &[
        dimension!(wire_diameter_mm, |_| 0.0508, Source),
        dimension!(pcb_length_mm, |_| 0.084_67, Source),
        dimension!(pcb_height_mm, |_| 0.0635, Assumed),
    ],
    shapes: |system| Shapes {
        slider: half_round(0.5 * length(system.wire_diameter_mm)),
        block: flat(system.pcb_length_mm, system.pcb_height_mm),
    },
    check: |_, _| {},
    preset,
};

fn preset() -> Preset {
    Preset {
        materials: sides(source("becu"), source("copper")),
        plating: sides(&USUAL_PLATING, &USUAL_PLATING),
        // Gold on gold under fretting has 0.55 to 0.60.
        friction: friction("hard_gold", "hard_gold", typical(0.55)),
        bare_friction: friction("copper", "copper", source(1.21)),
        wear: sides(
            assumed(Some(archard(0.011, 427.0))),
            source(Some(archard(0.011, 427.0))),
        ),
        load: source(Load {
            kind: LoadKind::Pressure.into(),
            mpa: Some(10.0),
            ..Load::default()
        }),
        waveform: source(Waveform::Sine),
        amplitude_mm: source(0.033_868),
        period_s: source(16.0),
        // The source moves every slider node; a rigid handle is the physical drive.
        drive: assumed(Drive::SliderTop),
        cycles: source(2000),
        rating: None,
    }
}
