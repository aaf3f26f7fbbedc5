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

/// A layer of a preset's plating. It wears by Archard's law with the hardness of its material.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct LayerPreset {
    /// Material in the library.
    pub(crate) material: Sourced<&'static str>,
    pub(crate) thickness_um: Sourced<f64>,
    /// Wear coefficient, -.
    pub(crate) k: Sourced<f64>,
}

/// Coefficient of friction of a pair of surfaces.
#[derive(Debug, Clone, Copy)]
pub(crate) struct FrictionPreset {
    /// Materials of the surfaces, of plated parts those of their outermost layers.
    pub(crate) surfaces: Sides<&'static str>,
    /// The coefficient, -.
    pub(crate) coefficient: Sourced<f64>,
}

/// Number of matings that connectors of a kind are rated for.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RatingPreset {
    /// Rated matings.
    pub(crate) matings: Sourced<f64>,
    /// Whose rating it is.
    pub(crate) of: &'static str,
    /// Path of the contact over the pad in one direction of a mating, mm.
    pub(crate) wipe_mm: Sourced<f64>,
}

/// Values for what a specification leaves out, except for dimensions.
#[derive(Debug, Clone)]
pub(crate) struct Preset {
    /// Base materials.
    pub(crate) materials: Sides<Sourced<&'static str>>,
    /// Layers over them, from the surface down.
    pub(crate) plating: Sides<&'static [LayerPreset]>,
    /// Friction of the parts with their platings.
    pub(crate) friction: FrictionPreset,
    /// Friction where both parts are bare.
    pub(crate) bare_friction: FrictionPreset,
    /// Wear of bare parts: of a metal without a coefficient in the library where the preset is plated.
    pub(crate) wear: Sides<Sourced<Option<ArchardPreset>>>,
    pub(crate) load: Sourced<Load>,
    pub(crate) waveform: Sourced<Waveform>,
    pub(crate) amplitude_mm: Sourced<f64>,
    pub(crate) period_s: Sourced<f64>,
    pub(crate) drive: Sourced<Drive>,
    pub(crate) cycles: Sourced<u64>,
    /// The rating of the kind, if one is published.
    pub(crate) rating: Option<RatingPreset>,
}

/// Wear coefficient of hard gold on hard gold, -. Nobody has published one of a plating. Dry contacts of hard gold are said to have 1e-5
/// to 1e-4, without a source that could be cited; the least of this range, because with any larger one the tip of a memory card's
/// spring contradicts the rated 10 000 matings even more (its gold lasts 2 270 of them with this one, 227 with 1e-4).
const HARD_GOLD_K: f64 = 1e-5;
/// Wear coefficient of nickel on nickel or gold, -: that of poorly lubricated identical metals (general knowledge), to which the remains of
/// the gold amount.
const NICKEL_K: f64 = 2e-4;
/// Archard's law of bare metals without a coefficient in the library: k as of clean identical metals, 1.5e-3 to 5e-3 (general
/// knowledge), the value that the source lists for silver; the hardness of hard gold, used where the metal has none of its own.
const BARE_METAL: ArchardPreset = archard(0.004, 1700.0);

/// A layer of gold over nickel with thicknesses, um, of some provenance.
const fn gold_over_nickel(gold_um: Sourced<f64>, nickel_um: Sourced<f64>) -> [LayerPreset; 2] {
    [
        LayerPreset {
            material: assumed("hard_gold"),
            thickness_um: gold_um,
            k: assumed(HARD_GOLD_K),
        },
        LayerPreset {
            material: assumed("nickel"),
            thickness_um: nickel_um,
            k: assumed(NICKEL_K),
        },
    ]
}

/// 30 microinches of hard gold over 50 of nickel, a usual plating of durable contacts.
pub(super) const USUAL_PLATING: [LayerPreset; 2] = gold_over_nickel(assumed(0.76), assumed(1.27));
/// The contacts of mPGA604 sockets: 0.762 um of gold over 1.27 um of nickel (their data sheet).
pub(super) const MPGA604_PLATING: [LayerPreset; 2] =
    gold_over_nickel(typical(0.762), typical(1.27));

/// Archard's law with k and H, MPa.
pub(super) const fn archard(k: f64, hardness_mpa: f64) -> ArchardPreset {
    ArchardPreset { k, hardness_mpa }
}

/// The values of both sides.
pub(super) const fn sides<T>(slider: T, receptacle: T) -> Sides<T> {
    Sides { slider, receptacle }
}

/// A coefficient of friction of a pair of surfaces.
pub(super) const fn friction(
    slider: &'static str,
    receptacle: &'static str,
    coefficient: Sourced<f64>,
) -> FrictionPreset {
    FrictionPreset {
        surfaces: sides(slider, receptacle),
        coefficient,
    }
}

/// A socket's spring: its base material, its force and width, its plating, and the rating of its kind.
pub(super) struct Spring {
    pub(super) material: &'static str,
    pub(super) force_n: f64,
    pub(super) width_mm: f64,
    pub(super) plating: &'static [LayerPreset],
    pub(super) rating: RatingPreset,
}

/// A sprung contact on a pad, both plated with hard gold over nickel over copper alloys: the plating determines friction and wear, the
/// base metals the elasticity.
///
/// The source states insertion forces (40 N over 9 pins, 97 N for a module), which are friction of many contacts on
/// the way in and not the normal force of one at rest; that one is assumed.
pub(super) fn socket(spring: &Spring) -> Preset {
    let Spring {
        material,
        force_n,
        width_mm,
        plating,
        rating,
    } = *spring;
    let load = Load {
        kind: LoadKind::Force.into(),
        n: Some(force_n),
        width_mm: Some(width_mm),
        ..Load::default()
    };
    Preset {
        materials: sides(typical(material), typical("copper")),
        plating: sides(plating, &USUAL_PLATING),
        friction: friction("hard_gold", "hard_gold", typical(0.3)),
        bare_friction: friction(material, "copper", typical(0.3)),
        wear: sides(assumed(Some(BARE_METAL)), assumed(Some(BARE_METAL))),
        load: assumed(load),
        waveform: assumed(Waveform::Sine),
        amplitude_mm: assumed(0.02),
        period_s: assumed(0.05),
        drive: assumed(Drive::SliderTop),
        cycles: assumed(1000),
        rating: Some(rating),
    }
}
