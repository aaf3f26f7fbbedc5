//! All wear on the receptacle, and all of it on the slider.
//!
//! The gap opens by the sum of both depths, the receptacle's in its own frame and the slider's in one that moves by the
//! amplitude A. Where A is small against the half-width b of the scar the two frames are one, and pressures, worn area and
//! energy cannot depend on the side: exact for A/b -> 0, whatever the elasticity, because the stiffness is that of the
//! unworn bodies. Otherwise the receptacle's profile is the slider's, smeared by up to A to either side: half-width +A;
//! for a parabola of half-width b, depth -(A/b)^2. The amplitude is reduced to 0.1 of the Hertz half-width at most, with
//! the rate raised.
//!
//! Allowed: both tolerances and A/b, squared in depth; three times the tolerances and A/b for the peak pressure.

use solver::SolveError;
use solver::scene::{Motion, Scene, WearLaw};

use super::comparison::{Allowed, Deviation};
use super::{SLIDING, STICKING, TOLERANCE, holds, holds_in_found};
use crate::verification::random_scenes::{Drawn, Regime, scale_wear};
use crate::verification::recorder::solve;

fn short(scene: &Scene) -> (Scene, f64) {
    let mut scene = scene.clone();
    let half_width = solver::model::Layout::of(&scene)
        .expect("a drawn scene can be meshed")
        .sizes
        .hertz_half_width;
    let before = scene.motion.amplitude_mm();
    let amplitude_mm = before.min(0.1 * half_width);
    scene.motion = Motion::Reciprocating {
        amplitude_mm,
        period_s: 1.0,
    };
    let factor = before / amplitude_mm;
    scale_wear(&mut scene, factor);
    (scene, amplitude_mm)
}

/// The rate of both sides together.
fn total_rate(scene: &Scene) -> WearLaw {
    let rates = [scene.slider.wear, scene.receptacle.wear]
        .into_iter()
        .flatten();
    let k_over_h_per_mpa = rates.filter_map(WearLaw::uniform).sum();
    WearLaw::Archard { k_over_h_per_mpa }
}

fn the_same_on_either_side(drawn: &Drawn) -> Result<Option<Vec<Deviation>>, SolveError> {
    if drawn.regime == Regime::LongGroove {
        return Ok(None);
    }
    let (scene, amplitude) = short(&drawn.scene);
    let rate = Some(total_rate(&scene));
    let (mut below, mut above) = (scene.clone(), scene);
    (below.receptacle.wear, below.slider.wear) = (rate, None);
    (above.receptacle.wear, above.slider.wear) = (None, rate);
    let (below, above) = (solve(&below)?.0, solve(&above)?.0);
    let allowed = Allowed::within(2.0 * TOLERANCE).or_stated([&below, &above]);
    let (below, above) = (below.last, above.last);
    let (one, other) = (&below.receptacle, &above.slider);
    let smear = amplitude / other.scar_half_width_mm;
    Ok(Some(vec![
        Deviation::of(
            "depth",
            (one.max_depth_mm, other.max_depth_mm),
            allowed.depth + smear * smear,
        ),
        Deviation::of(
            "scar width",
            (one.scar_half_width_mm, other.scar_half_width_mm),
            allowed.width + smear,
        ),
        Deviation::of(
            "worn area",
            (one.worn_area_mm2, other.worn_area_mm2),
            allowed.area,
        ),
        Deviation::of(
            "energy",
            (
                below.dissipated_energy_mj_per_mm,
                above.dissipated_energy_mj_per_mm,
            ),
            allowed.area,
        ),
        Deviation::of(
            "peak pressure",
            (below.peak_pressure_mpa, above.peak_pressure_mpa),
            allowed.peak + smear,
        ),
    ]))
}

#[test]
fn wear_on_either_side_opens_the_same_gap_in_gross_slip() {
    holds("moved wear", &SLIDING, the_same_on_either_side);
}

#[test]
fn wear_on_either_side_opens_the_same_gap_in_partial_slip() {
    holds("moved wear", &STICKING, the_same_on_either_side);
}

/// Scenes that differed by 4 to 66 % of the worn area while the surfaces were paired by the imposed displacement.
#[test]
fn wear_moves_in_the_scenes_found() {
    let some = [14, 60, 121, 181];
    holds_in_found("moved wear, found", &some, the_same_on_either_side);
}

mod long {
    use super::*;

    #[test]
    #[ignore = "long: takes 12 s"]
    fn wear_moves_in_the_other_scenes_found() {
        let others = [
            15, 30, 48, 51, 54, 61, 62, 63, 72, 108, 135, 147, 170, 180, 183,
        ];
        holds_in_found("moved wear, found", &others, the_same_on_either_side);
    }
}

#[test]
#[ignore = "depth off by 7 % at 2 %, by 1.1 % at 1 %: the estimated errors of both answers miss it"]
fn wear_moves_where_the_estimates_miss() {
    holds_in_found("moved wear, missed", &[168], the_same_on_either_side);
}
