//! Presets: what each contact system takes for what a specification leaves out. Reference data with provenance.
//!
//! "Source" is the thesis named in [`crate::reference::materials`]; nothing assumed is passed off as sourced.

use api::spec::{Drive, Load, LoadKind, Provenance, SystemKind, Waveform};

use Provenance::{Assumed, Source, Typical};

/// A value and where it comes from.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Known<T> {
    /// The value.
    pub(crate) value: T,
    /// Where it comes from.
    pub(crate) from: Provenance,
}

const fn known<T>(value: T, from: Provenance) -> Known<T> {
    Known { value, from }
}

/// Archard's law of a preset: k and H in MPa.
pub(crate) type Archard = Known<(f64, f64)>;

/// What a contact system takes for what is left out; its dimensions stand in [`crate::spec::dimensions`].
#[derive(Debug, Clone)]
pub(crate) struct Preset {
    pub(crate) slider: Known<&'static str>,
    pub(crate) receptacle: Known<&'static str>,
    pub(crate) friction: Known<f64>,
    pub(crate) slider_wear: Known<Option<(f64, f64)>>,
    pub(crate) receptacle_wear: Archard,
    pub(crate) load: Known<Load>,
    pub(crate) waveform: Known<Waveform>,
    pub(crate) amplitude_mm: Known<f64>,
    pub(crate) period_s: Known<f64>,
    pub(crate) drive: Known<Drive>,
    pub(crate) cycles: Known<u64>,
}

fn load(kind: LoadKind) -> Load {
    Load {
        kind: kind.into(),
        mpa: None,
        n_per_mm: None,
        n: None,
        width_mm: None,
        spring_n_per_mm: None,
    }
}

fn force(n: f64, width_mm: f64) -> Load {
    Load {
        n: Some(n),
        width_mm: Some(width_mm),
        ..load(LoadKind::Force)
    }
}

impl Preset {
    /// The preset of a kind.
    pub(crate) fn of(kind: SystemKind) -> Self {
        match kind {
            SystemKind::FuzzButton => Self::fuzz_button(),
            SystemKind::CylinderOnFlat => Self::cylinder_on_flat(),
            // The source states insertion forces (40 N over 9 pins, 97 N for a module), which are friction of many
            // contacts on the way in and not the normal force of one at rest; that one is assumed.
            SystemKind::SdCard => Self {
                load: known(force(0.5, 0.8), Assumed),
                ..Self::plated("becu")
            },
            SystemKind::Dimm => Self {
                load: known(force(0.6, 0.6), Assumed),
                ..Self::plated("phosphor_bronze")
            },
            SystemKind::Zif => Self {
                load: known(force(0.5, 0.46), Assumed),
                ..Self::plated("phosphor_bronze")
            },
        }
    }

    fn fuzz_button() -> Self {
        Self {
            slider: known("copper", Source),
            receptacle: known("copper", Source),
            friction: known(1.21, Source),
            slider_wear: known(None, Source),
            receptacle_wear: known((0.011, 427.0), Source),
            load: known(
                Load {
                    mpa: Some(10.0),
                    ..load(LoadKind::Pressure)
                },
                Source,
            ),
            waveform: known(Waveform::Sine, Source),
            amplitude_mm: known(0.033_868, Source),
            period_s: known(16.0, Source),
            // The source moves every slider node; the rigid handle is the physical one.
            drive: known(Drive::SliderTop, Assumed),
            cycles: known(2000, Source),
        }
    }

    fn cylinder_on_flat() -> Self {
        Self {
            slider: known("steel", Assumed),
            receptacle: known("steel", Assumed),
            friction: known(0.78, Typical),
            slider_wear: known(None, Assumed),
            receptacle_wear: known((1.0e-4, 6865.0), Assumed),
            load: known(
                Load {
                    n_per_mm: Some(18.5),
                    ..load(LoadKind::LineForce)
                },
                Assumed,
            ),
            waveform: known(Waveform::Triangle, Assumed),
            amplitude_mm: known(0.025, Assumed),
            period_s: known(0.05, Assumed),
            drive: known(Drive::ReceptacleBase, Assumed),
            cycles: known(1000, Assumed),
        }
    }

    /// A sprung contact on a pad, both plated with hard gold over copper alloys: the plating gives friction, wear
    /// and hardness (k of silver in the table of the source, for want of one of gold; H of hard gold), the base metals the elasticity.
    fn plated(spring: &'static str) -> Self {
        Self {
            slider: known(spring, Typical),
            receptacle: known("copper", Typical),
            friction: known(0.3, Typical),
            slider_wear: known(None, Assumed),
            receptacle_wear: known((0.004, 1700.0), Assumed),
            load: known(force(0.5, 0.8), Assumed),
            waveform: known(Waveform::Sine, Assumed),
            amplitude_mm: known(0.02, Assumed),
            period_s: known(0.05, Assumed),
            drive: known(Drive::SliderTop, Assumed),
            cycles: known(1000, Assumed),
        }
    }
}
