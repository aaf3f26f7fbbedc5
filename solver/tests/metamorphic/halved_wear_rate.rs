//! Half the wear rate over twice the cycles.
//!
//! Archard's law knows only the product of rate and distance. Two forms:
//!
//! * A computed cycle of 2 J physical ones at half the rate removes what one of J removes, in every increment: with jumps and
//!   increments given, the bits of all depths are the same. Allowed: nothing. Left out are scenes whose meshes differ: the
//!   step that a single pass wears may be wider than the contact; and grooves in a receptacle that wears alone, whose jumps
//!   extrapolate the wear of a single cycle, which is half as much.
//! * With jumps that the tolerance chooses the scar is the same within both tolerances. What remains is physical: a single
//!   pass wears half as much, and the contact leans on that step while it slides. It falls with the number of cycles, so the
//!   drawn cycles are taken eight times as many at an eighth of the rate; the peak pressure of a groove, which belongs to the
//!   step, is left out. In partial slip the later half of the cycles is compared, by what it wears of the whole: unlike
//!   bodies slip while they are loaded, and where the stroke hardly slips, the wear of the few cycles in which that slip shakes
//!   down is most of it, whose number is not doubled.

use solver::SolveError;
use solver::model::Layout;
use solver::record::SideReport;
use solver::scene::Scene;
use solver::sides::{Side, Sides};

use super::comparison::{Allowed, Deviation, compare};
use super::{ALL, SLIDING, STICKING, TOLERANCE, holds, holds_plated};
use crate::verification::random_scenes::{Drawn, Regime, scale_wear};
use crate::verification::recorder::solve;

/// So many times the cycles at a rate that wears the same area.
fn slower(scene: &Scene, times: u32) -> Scene {
    let mut scene = scene.clone();
    let factor = f64::from(times).recip();
    scene.cycles *= u64::from(times);
    scale_wear(&mut scene, factor);
    scene
}

fn the_same_bits_with_twice_the_jump(drawn: &Drawn) -> Result<Option<Vec<Deviation>>, SolveError> {
    if drawn.regime == Regime::LongGroove && drawn.scene.slider.wear.is_none() {
        return Ok(None);
    }
    let mut fast = Scene {
        cycles: 8,
        ..drawn.scene.clone()
    };
    fast.accuracy.increments_per_cycle = Some(20);
    let mut slow = slower(&fast, 2);
    fast.accuracy.cycle_jump = Some(2);
    slow.accuracy.cycle_jump = Some(4);
    if Layout::of(&fast)? != Layout::of(&slow)? {
        return Ok(None);
    }
    let (fast, slow) = (solve(&fast)?.0, solve(&slow)?.0);
    let allowed = Allowed {
        // A replayed contact is that of a single cycle, which wears half as much.
        peak: f64::INFINITY,
        ..Allowed::within(0.0)
    };
    Ok(Some(compare(&fast, &slow, allowed)))
}

fn the_same_scar_at_half_the_rate(drawn: &Drawn) -> Result<Option<Vec<Deviation>>, SolveError> {
    let scene = &drawn.scene;
    let (fast, slow) = (solve(&slower(scene, 8))?.0, solve(&slower(scene, 16))?.0);
    let mut allowed = Allowed::within(2.0 * TOLERANCE);
    if drawn.regime == Regime::LongGroove {
        allowed.peak = f64::INFINITY;
    }
    Ok(Some(compare(&fast, &slow, allowed)))
}

/// Areas that the later half of the cycles, and all of them, wear off each side, mm^2.
fn worn_areas(mut scene: Scene) -> Result<Sides<[f64; 2]>, SolveError> {
    let half = scene.cycles / 2;
    scene.output.snapshots_at_cycles = vec![half];
    let (summary, recorder) = solve(&scene)?;
    let earlier = recorder.at(half);
    let areas = |now: SideReport, then: SideReport| {
        [now.worn_area_mm2 - then.worn_area_mm2, now.worn_area_mm2]
    };
    Ok(Sides {
        slider: areas(summary.last.slider, earlier.slider),
        receptacle: areas(summary.last.receptacle, earlier.receptacle),
    })
}

fn the_same_later_wear_at_half_the_rate(
    drawn: &Drawn,
) -> Result<Option<Vec<Deviation>>, SolveError> {
    let fast = worn_areas(slower(&drawn.scene, 8))?;
    let slow = worn_areas(slower(&drawn.scene, 16))?;
    let of = |side: Side| {
        let ([fast, of_fast], [slow, of_slow]) = (fast.of(side), slow.of(side));
        Deviation {
            quantity: format!("later wear of the {}", side.name()),
            found: (fast - slow).abs() / of_fast.max(*of_slow).max(f64::MIN_POSITIVE),
            allowed: 2.0 * TOLERANCE,
        }
    };
    Ok(Some(Side::BOTH.map(of).to_vec()))
}

#[test]
fn half_the_rate_with_twice_the_jump_changes_no_bit() {
    holds(
        "half the rate, twice the jump",
        &ALL,
        the_same_bits_with_twice_the_jump,
    );
}

#[test]
fn half_the_rate_wears_the_same_scar_in_gross_slip() {
    holds("half the rate", &SLIDING, the_same_scar_at_half_the_rate);
}

#[test]
fn half_the_rate_wears_the_same_later_in_partial_slip() {
    holds(
        "half the rate",
        &STICKING,
        the_same_later_wear_at_half_the_rate,
    );
}

#[test]
fn half_the_rate_with_twice_the_jump_changes_no_bit_of_plated_bodies() {
    holds_plated(
        "half the rate, twice the jump",
        &ALL,
        the_same_bits_with_twice_the_jump,
    );
}

#[test]
fn half_the_rate_wears_the_same_scar_of_plated_bodies_in_gross_slip() {
    holds_plated("half the rate", &SLIDING, the_same_scar_at_half_the_rate);
}
