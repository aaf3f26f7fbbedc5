//! Cylinder on flat: part of a cylinder on a block with a flat or crowned top, the bench geometry of the literature.

use api::spec::{Drive, Load, LoadKind, System, Waveform};
use solver::scene::{BlockShape, SliderShape};

use crate::spec::diagnostics::Diagnostics;
use crate::spec::sourced::{assumed, typical};
use crate::spec::system::definition::{SystemDefinition, dimension};
use crate::spec::system::preset::{Preset, archard, friction, sides};
use crate::spec::system::shapes::{Shapes, check_crown, flat, length, sagitta};

pub(super) const DEFINITION: SystemDefinition = SystemDefinition {
    description: "a cylinder on a block, the bench geometry of the literature",
    dimensions: &[
        dimension!(radius_mm, |_| 6.0, Assumed),
        dimension!(flat_length_mm, |_| 12.0, Assumed),
        dimension!(flat_height_mm, |_| 6.0, Assumed),
        dimension!(
            slider_half_width_mm,
            |system| 0.75 * length(system.radius_mm),
            Assumed
        ),
        dimension!(slider_height_mm, |system| length(system.radius_mm), Assumed),
        dimension!(crown_radius_mm),
    ],
    shapes,
    check: |shapes, diagnostics| {
        check_slider(&shapes.slider, diagnostics);
        check_crown("/system/crown_radius_mm", shapes, diagnostics);
    },
    preset,
};

fn shapes(system: &System) -> Shapes {
    Shapes {
        slider: SliderShape {
            radius_mm: length(system.radius_mm),
            half_width_mm: length(system.slider_half_width_mm),
            height_mm: length(system.slider_height_mm),
        },
        block: BlockShape {
            crown_radius_mm: system.crown_radius_mm,
            ..flat(system.flat_length_mm, system.flat_height_mm)
        },
    }
}

/// Checks the modelled part of the cylinder: not wider than the cylinder, and with some height at its sides.
fn check_slider(slider: &SliderShape, diagnostics: &mut Diagnostics) {
    let SliderShape {
        radius_mm,
        half_width_mm,
        height_mm,
    } = *slider;
    if !(radius_mm > 0.0 && half_width_mm > 0.0) {
        return;
    }
    if half_width_mm > radius_mm {
        let detail = format!("{half_width_mm} exceeds the radius of {radius_mm}");
        diagnostics.fault("/system/slider_half_width_mm", detail);
        return;
    }
    let sagitta = sagitta(radius_mm, half_width_mm);
    if height_mm < sagitta {
        let detail = format!(
            "{height_mm} is below the arc's own height of {sagitta} at the half width {half_width_mm}"
        );
        diagnostics.fault("/system/slider_height_mm", detail);
    }
}

fn preset() -> Preset {
    let friction = friction("steel", "steel", typical(0.78));
    Preset {
        materials: sides(assumed("steel"), assumed("steel")),
        plating: sides(&[], &[]),
        friction,
        bare_friction: friction,
        wear: sides(assumed(None), assumed(Some(archard(1.0e-4, 6865.0)))),
        load: assumed(Load {
            kind: LoadKind::LineForce.into(),
            n_per_mm: Some(18.5),
            ..Load::default()
        }),
        waveform: assumed(Waveform::Triangle),
        amplitude_mm: assumed(0.025),
        period_s: assumed(0.05),
        drive: assumed(Drive::ReceptacleBase),
        cycles: assumed(1000),
        rating: None,
    }
}
