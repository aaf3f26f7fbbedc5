//! Requirement: a slider whose stroke takes it off the block's end and back is solved: no contact and no wear
//! off the block, its height held by a stop, balance again after its return.
//! Source: the base scene, whose slider overhangs the block's ends; a part that slides off its pad.
//! Naive: the search for contact finds no pair, nothing balances the load, and the height diverges.

use serde_json::json;

use solver::SolveError;
use solver::contact::ContactError;
use solver::cycle::CycleError;

use super::invariants::{faults, hold};
use super::run::{Run, solve};
use super::specs::{AGREEMENT, cylinder, fuzz_button};

/// A cylinder modelled 0.6 mm to each side over a block of 1 mm, so that it is off it beyond 1.1 mm.
fn on_a_short_block(amplitude_mm: f64) -> Run {
    solve(&cylinder(json!({
        "system": {"radius_mm": 1.0, "flat_length_mm": 1.0, "flat_height_mm": 0.5,
            "slider_half_width_mm": 0.6, "slider_height_mm": 1.0},
        "interface": {"wear": {"receptacle": {"k_over_h_per_mpa": 1e-6}}},
        "motion": {"amplitude_mm": amplitude_mm},
        "cycles": 6,
    })))
}

#[test]
fn a_slider_that_leaves_the_block_returns_into_balance() {
    let run = on_a_short_block(1.5);
    hold(&run);
    let last = run.snapshots.last().expect("the end is kept");
    let pressed = |i: usize| last.positions[i].pressure_mpa.iter().any(|p| *p > 0.0);
    let away = (0..3).filter(|&i| last.positions[i].slider_x_mm.abs() > 1.1);
    assert!(away.clone().count() == 2 && !away.clone().any(pressed));
    let back = (0..3).find(|&i| last.positions[i].slider_x_mm.abs() < 1e-9);
    assert!(pressed(back.expect("the neutral position is kept")));
    assert!(last.friction_loop.tangential_force_n_per_mm.contains(&0.0));
}

/// The part of the stroke off the block causes no wear: a stroke of 10 mm wears no more than one of 1.5 mm.
#[test]
fn sliding_off_the_block_causes_no_wear() {
    let (near, far) = (on_a_short_block(1.5), on_a_short_block(10.0));
    hold(&far);
    let (near, far) = [near, far]
        .map(|run| run.summary().last.receptacle.worn_area_mm2)
        .into();
    assert!((far / near - 1.0).abs() < AGREEMENT, "{near} {far}");
}

/// Far beyond the block's length: 0.0847 mm of block, 0.6 mm of stroke. The round slider sinks beside the block until its
/// flank is vertical, and wears the corner to a slope of 2.7 in the first cycle; with friction (mu = 1.21) no slope beyond
/// 0.83 can be climbed, unless the slider wears its way up. After two cycles the worn area is 8.2e-6 to 8.7e-6 mm^2 with 800 to
/// 6 000 increments a cycle. Beyond, nothing holds the slider up on a slope that friction cannot climb: between the 9th and
/// the 24th cycle it jams, earlier or later with each number of increments.
#[test]
fn a_slider_that_sank_beside_the_block_climbs_its_corner_or_jams() {
    for increments in [1_200, 2_000, 2_200] {
        let run = solve(&fuzz_button(json!({
            "motion": {"amplitude_mm": 0.3},
            "cycles": 2,
            "accuracy": {"overrides": {"increments_per_cycle": increments}},
        })));
        let faults = faults(&run);
        assert!(faults.is_empty(), "{increments}: {}", faults.join("\n"));
        let first = run.reports.iter().find(|report| report.cycle == 1);
        assert!(first.is_some_and(|report| report.receptacle.max_depth_mm > 0.0));
        match &run.end {
            Ok(summary) => {
                let area = summary.last.receptacle.worn_area_mm2;
                assert!(
                    (area / 8.5e-6 - 1.0).abs() < 0.05,
                    "{increments}: {area:.2e} mm^2"
                );
            }
            Err(SolveError::Cycle(CycleError::Increment { source, .. })) => match source {
                ContactError::Jammed { slope, limit, .. } => assert!(slope > limit, "{source}"),
                ContactError::TooMuchWear { share, limit, .. } => {
                    assert!(share > limit, "{source}");
                }
                _ => panic!("{increments}: {source}"),
            },
            Err(error) => panic!("{increments}: {error}"),
        }
    }
}
