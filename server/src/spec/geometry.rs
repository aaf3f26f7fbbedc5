//! Geometry: the two bodies of each contact system, built from its dimensions.
//!
//! Every slider is an arc that touches y = 0 at x = 0 under a flat top face, every receptacle a block below; what
//! differs is how much of the arc there is and what the block stands for. A spring's own compliance is not in the
//! bodies: it is `spring_n_per_mm` of the load.

use api::spec::{System, SystemKind};
use solver::scene::{BlockShape, SliderShape};

/// The shapes of both bodies.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Shapes {
    pub(crate) slider: SliderShape,
    pub(crate) block: BlockShape,
}

/// The shapes of a system whose dimensions are filled in.
pub(crate) fn shapes(kind: SystemKind, system: &System) -> Shapes {
    match kind {
        SystemKind::FuzzButton => fuzz_button(system),
        SystemKind::SdCard => sd_card(system),
        SystemKind::Dimm => dimm(system),
        SystemKind::Zif => zif(system),
        SystemKind::CylinderOnFlat => cylinder_on_flat(system),
    }
}

/// The lower half of a wire, cut at its axis, on a block of circuit board.
///
/// ```text
///   +---------+  top face at the axis
///    \  wire /
///  ___`-...-'___
///  |   pcb     |
/// ```
fn fuzz_button(system: &System) -> Shapes {
    Shapes {
        slider: half_round(0.5 * length(system.wire_diameter_mm)),
        block: flat(system.pcb_length_mm, system.pcb_height_mm),
    }
}

/// The rounded tip of a formed spring on a card's flat pad: the bend turns off into the legs of the spring at three
/// quarters of its radius, and the legs are not modelled.
///
/// ```text
///    |  tip  |
///     \     /
///  ____`-.-'____
///  |    pad    |
/// ```
fn sd_card(system: &System) -> Shapes {
    Shapes {
        slider: tip(length(system.contact_radius_mm)),
        block: flat(system.pad_length_mm, system.pad_height_mm),
    }
}

/// A semicircular socket contact on a module's flat pad.
fn dimm(system: &System) -> Shapes {
    Shapes {
        slider: half_round(length(system.contact_radius_mm)),
        block: flat(system.pad_length_mm, system.pad_height_mm),
    }
}

/// The rounded tip of a socket's spring on a pin, flat (stamped) or round.
///
/// ```text
///    |  tip  |              |  tip  |
///     \     /                \     /
///  ____`-.-'____             _.`-.-'._
///  |  flat pin |            | round pin |
/// ```
fn zif(system: &System) -> Shapes {
    let pin = flat(system.pin_length_mm, system.pin_thickness_mm);
    Shapes {
        slider: tip(length(system.contact_radius_mm)),
        block: BlockShape {
            crown_radius_mm: system.pin_radius_mm,
            ..pin
        },
    }
}

/// Part of a cylinder on a block with a flat or crowned top: the bench geometry.
fn cylinder_on_flat(system: &System) -> Shapes {
    let block = flat(system.flat_length_mm, system.flat_height_mm);
    Shapes {
        slider: SliderShape {
            radius_mm: length(system.radius_mm),
            half_width_mm: length(system.slider_half_width_mm),
            height_mm: length(system.slider_height_mm),
        },
        block: BlockShape {
            crown_radius_mm: system.crown_radius_mm,
            ..block
        },
    }
}

/// Half a round bar, its top face through the axis.
fn half_round(radius_mm: f64) -> SliderShape {
    SliderShape {
        radius_mm,
        half_width_mm: radius_mm,
        height_mm: radius_mm,
    }
}

/// A rounded tip: three quarters of its radius to each side, one radius high.
fn tip(radius_mm: f64) -> SliderShape {
    SliderShape {
        radius_mm,
        half_width_mm: 0.75 * radius_mm,
        height_mm: radius_mm,
    }
}

fn flat(length_mm: Option<f64>, height_mm: Option<f64>) -> BlockShape {
    BlockShape {
        length_mm: length(length_mm),
        height_mm: length(height_mm),
        crown_radius_mm: None,
    }
}

/// A dimension; `dimensions` fills in each one of the kind before shapes are made.
fn length(value: Option<f64>) -> f64 {
    value.unwrap_or_default()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn sockets_differ_in_how_much_of_the_arc_there_is() {
        let with = |kind| System {
            contact_radius_mm: Some(0.4),
            pad_length_mm: Some(2.0),
            pad_height_mm: Some(0.3),
            pin_radius_mm: Some(0.9),
            ..System::of_kind(kind)
        };
        let width = |kind| shapes(kind, &with(kind)).slider.half_width_mm;
        assert!((width(SystemKind::Dimm) - 0.4).abs() < 1e-15);
        assert!((width(SystemKind::SdCard) - 0.3).abs() < 1e-15);
        let zif = shapes(SystemKind::Zif, &with(SystemKind::Zif));
        assert_eq!(zif.block.crown_radius_mm, Some(0.9));
        let sd_card = shapes(SystemKind::SdCard, &with(SystemKind::SdCard));
        assert_eq!(sd_card.block.crown_radius_mm, None);
    }
}
