//! Presets: what a contact system assumes for everything that a specification leaves out. Reference data with
//! provenance.
//!
//! "Source" is the thesis named in [`crate::reference::materials`]; no assumed value is declared as sourced.

use api::spec::{Drive, Load, LoadKind, Waveform};
use solver::sides::Sides;

use crate::spec::sourced::{Sourced, assumed, typical};

/// Archard's law of a preset.
#[derive(Debug, Clone, Copy)]
pub(crate) struct ArchardPreset {
    /// Wear coefficient, -.
    pub(crate) k: f64,
    /// Hardness, MPa.
    pub(crate) hardness_mpa: f64,
}

/// Values for what a specification leaves out, except for dimensions.
#[derive(Debug, Clone)]
pub(crate) struct Preset {
    pub(crate) materials: Sides<Sourced<&'static str>>,
    pub(crate) friction: Sourced<f64>,
    pub(crate) wear: Sides<Sourced<Option<ArchardPreset>>>,
    pub(crate) load: Sourced<Load>,
    pub(crate) waveform: Sourced<Waveform>,
    pub(crate) amplitude_mm: Sourced<f64>,
    pub(crate) period_s: Sourced<f64>,
    pub(crate) drive: Sourced<Drive>,
    pub(crate) cycles: Sourced<u64>,
}

/// Archard's law with k and H, MPa.
pub(super) const fn archard(k: f64, hardness_mpa: f64) -> ArchardPreset {
    ArchardPreset { k, hardness_mpa }
}

/// The values of both sides.
pub(super) const fn sides<T>(slider: T, receptacle: T) -> Sides<T> {
    Sides { slider, receptacle }
}

/// A sprung contact on a pad, both plated with hard gold over copper alloys: the plating determines friction, wear
/// and hardness (k of silver in the table of the source, which lists none of gold; H of hard gold), the base metals
/// the elasticity.
///
/// The source states insertion forces (40 N over 9 pins, 97 N for a module), which are friction of many contacts on
/// the way in and not the normal force of one at rest; that one is assumed.
pub(super) fn plated(spring: &'static str, force_n: f64, width_mm: f64) -> Preset {
    let load = Load {
        kind: LoadKind::Force.into(),
        n: Some(force_n),
        width_mm: Some(width_mm),
        ..Load::default()
    };
    Preset {
        materials: sides(typical(spring), typical("copper")),
        friction: typical(0.3),
        wear: sides(assumed(None), assumed(Some(archard(0.004, 1700.0)))),
        load: assumed(load),
        waveform: assumed(Waveform::Sine),
        amplitude_mm: assumed(0.02),
        period_s: assumed(0.05),
        drive: assumed(Drive::SliderTop),
        cycles: assumed(1000),
    }
}
