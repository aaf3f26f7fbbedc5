//! The contact that a run in gross sliding resolves first.
//!
//! A slider that wears has a flat after a few cycles, several times as wide as the unworn contact. Its width follows from the worn area
//! alone: later cycles forget how the first ones were resolved. An SD card's contact under 10 000 matings of 1.5 mm has a half-width of 2 um at
//! first and 68 um at last; elements and increments for the unworn contact take many times as long.

use super::{edge_step, moves};
use crate::closed_form::expected_wear::{expected_cycles, wear_rates, worn_depth_after};
use crate::closed_form::unworn_contact::{hertz_half_width, radius, sticks};
use crate::number::{real_cycles, whole_cycles};
use crate::scene::{Motion, Power, Scene};
use crate::sides::Side;

/// Amplitude of a wipe over the half-width of the narrowest contact. Arbitrary: presets vibrate by 5 to 75 half-widths.
const LONG: f64 = 100.0;

/// Least half-width of the flat of a shorter stroke over the narrowest one. Arbitrary: a run of 1.5 times takes a seventh of the time.
const WIDER: f64 = 1.4;

/// Most of the flat over the amplitude, so that the ends of a scar are resolved: an SD card's pad is through to its base after 509 000 cycles
/// at 2 % and 539 000 at 10 %; elements of two thirds give 505 000.
const OF_AMPLITUDE: Power = Power {
    value: 0.5,
    exponent: -0.4,
};

/// Part of the expected cycles after which the flat is resolved.
pub const FIRST_FLAT: f64 = 0.05;

/// Half-width of the slider's flat after the first part of a run, mm, where it is wider than the narrowest contact: by any factor in a wipe, also
/// one of a mission, by 1.4 in shorter strokes. `None` of other runs, of point contacts, where a part may stick through a stroke and where the
/// elements are given.
///
/// It is b^2/(2R) deep, at most down to the end of the slider's outer layer.
pub fn first_flat(scene: &Scene) -> Option<f64> {
    let (hertz, radius) = (hertz_half_width(scene), radius(scene));
    let rates = wear_rates(scene, hertz);
    let both = rates.slider + rates.receptacle;
    let narrowest = hertz.max(edge_step(radius, both, scene.load_n_per_mm));
    let mut blocks = scene.blocks();
    blocks.retain(|block| moves(block));
    let amplitudes = blocks.iter().map(|block| block.motion.amplitude_mm());
    let amplitude = amplitudes.fold(0.0, f64::max);
    let is_gross = scene.accuracy.tuning.is_gross(amplitude, narrowest);
    let may_stick = blocks.iter().any(|block| sticks(block, hertz));
    let is_chosen = scene.accuracy.contact_element_mm.is_none();
    if !is_gross || may_stick || !is_chosen || scene.dimension.point().is_some() {
        return None;
    }
    let cycles = real_cycles(expected_cycles(scene, hertz)) * FIRST_FLAT;
    let worn = worn_depth_after(scene, hertz, &scene.surface_wear(), whole_cycles(cycles));
    let outer = scene.plating(Side::Slider).first();
    let depth = outer.map_or(worn.slider, |layer| worn.slider.min(layer.thickness_mm));
    let flat = (2.0 * radius * depth).sqrt();
    let flat = flat.min(OF_AMPLITUDE.at(scene.accuracy.tolerance) * amplitude);
    let least = if amplitude > LONG * narrowest {
        narrowest
    } else {
        WIDER * narrowest
    };
    (flat > least).then_some(flat)
}

impl Scene {
    /// The scene whose mesh resolves the unworn contact, where that of this scene is for a wider one: with a short stroke.
    pub(crate) fn at_rest(&self) -> Option<Self> {
        self.accuracy.narrowest_contact_mm?;
        let mut rest = Self {
            motion: Motion::Reciprocating {
                amplitude_mm: self.accuracy.tuning.gross_from * hertz_half_width(self),
                period_s: 1.0,
            },
            cycles: 1,
            mission: None,
            ..self.clone()
        };
        rest.accuracy.narrowest_contact_mm = None;
        Some(rest)
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::model::tests::fuzz_button;
    use crate::scene::{Layer, WearLaw};

    const ARCHARD: WearLaw = WearLaw::Archard {
        k_over_h_per_mpa: 1e-7,
    };

    fn to_and_fro(amplitude_mm: f64) -> Motion {
        Motion::Reciprocating {
            amplitude_mm,
            period_s: 1.0,
        }
    }

    /// A wire that wears by 1 000 wipes of 1 mm.
    fn wipe() -> Scene {
        let mut scene = fuzz_button();
        scene.motion = to_and_fro(0.5);
        scene.cycles = 1_000;
        scene.slider.wear = Some(ARCHARD);
        scene.receptacle.wear = None;
        scene
    }

    #[test]
    fn long_strokes_resolve_the_flat_of_their_first_cycles() {
        let flat = |cycles| {
            let scene = Scene { cycles, ..wipe() };
            first_flat(&scene).expect("it has a flat")
        };
        // The segment of a twentieth of the cycles, (3 R k P s/2)^(1/3).
        let segment = (1.5 * 0.0254 * 1e-7 * wipe().load_n_per_mm * 2.0 * 50.0).cbrt();
        assert!((flat(1_000) / segment - 1.0).abs() < 1e-3);
        assert!((flat(8_000) / flat(1_000) - 2.0).abs() < 1e-3);
        let mut plated = wipe();
        plated.slider.plating = vec![Layer {
            thickness_mm: 1e-4,
            rate_per_mpa: 1e-7,
        }];
        let through = (2.0_f64 * 0.0254 * 1e-4).sqrt();
        let found = first_flat(&plated).expect("it has a flat");
        assert!((found / through - 1.0).abs() < 1e-12);
    }

    /// A flat 1.4 times as wide as the narrowest contact calls for it, and at most half of the amplitude is resolved.
    #[test]
    fn shorter_strokes_resolve_a_wider_flat() {
        let mut scene = wipe();
        scene.motion = to_and_fro(0.02);
        scene.cycles = 40;
        assert_eq!(first_flat(&scene), None);
        scene.cycles = 100_000;
        let segment = (1.5 * 0.0254 * 1e-7 * scene.load_n_per_mm * 0.08 * 5_000.0).cbrt();
        let found = first_flat(&scene).expect("it has a flat");
        assert!((found / segment - 1.0).abs() < 1e-3, "{found} {segment}");
        scene.cycles = 100_000_000;
        assert_eq!(first_flat(&scene), Some(0.01));
        scene.accuracy.tolerance = 0.1;
        let coarse = first_flat(&scene).expect("it has a flat");
        assert!((coarse / 0.019 - 1.0).abs() < 0.01, "{coarse}");
    }

    #[test]
    fn other_runs_resolve_the_unworn_contact() {
        let is_none = |change: fn(&mut Scene)| {
            let mut scene = wipe();
            change(&mut scene);
            first_flat(&scene).is_none() && scene.at_rest().is_none()
        };
        assert!(is_none(|scene| scene.slider.wear = None));
        assert!(is_none(|scene| scene.cycles = 10));
        assert!(is_none(|scene| scene.motion = to_and_fro(1e-4)));
        assert!(is_none(
            |scene| scene.accuracy.contact_element_mm = Some(1e-4)
        ));
    }

    /// A scar about the unworn contact has finer elements than a groove.
    #[test]
    fn the_unworn_contact_has_a_mesh_of_its_own() {
        let mut scene = wipe();
        scene.accuracy.narrowest_contact_mm = first_flat(&scene);
        let of_run = crate::resolution::choose(&scene);
        let at_rest = scene.at_rest().expect("it has its own mesh");
        let of_unworn = crate::resolution::choose(&at_rest);
        assert!(of_unworn.contact_element < 0.2 * of_unworn.hertz_half_width);
        assert!(of_run.contact_element > of_run.hertz_half_width / 8.0);
        assert!(of_unworn.spacing.receptacle.zone_half < 0.1 * of_run.spacing.receptacle.zone_half);
    }
}
