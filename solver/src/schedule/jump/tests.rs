//! Jumps by estimated errors, limits and reports.

use super::*;
use crate::scene::Refinement;
use crate::schedule::stroke::Passes;

const ACCURACY: Accuracy = Accuracy::from_tolerance(0.02);

fn change<'a>(before: &'a Sides<Vec<f64>>, after: &'a Sides<Vec<f64>>) -> Change<Sides<&'a [f64]>> {
    Change {
        before: before.as_slices(),
        after: after.as_slices(),
    }
}

/// Wears the only node of the receptacle.
fn wear(control: &mut JumpControl, before: f64, after: f64, jump: u64) {
    let depth = |receptacle: f64| Sides {
        slider: vec![0.0],
        receptacle: vec![receptacle],
    };
    let widths = Sides {
        slider: &[1.0][..],
        receptacle: &[1.0][..],
    };
    let (before, after) = (depth(before), depth(after));
    control.update(widths, 0.0, change(&before, &after), jump);
}

const STROKE: Stroke = Stroke {
    passes: Passes::Whole,
    gross: false,
    smoothing: 0.0,
    is_groove: false,
    both: false,
    error_factor: 1.0,
    skew: 0.0,
    cycles: 1_000,
    even_friction: f64::INFINITY,
};

#[test]
fn a_steady_rate_lets_jumps_grow_and_a_changing_one_shrinks_them() {
    let mut control = JumpControl::default();
    assert_eq!(control.next(&ACCURACY, STROKE, 1000), 1);
    wear(&mut control, 0.0, 8.0, 8);
    wear(&mut control, 8.0, 16.0, 8);
    assert_eq!(control.next(&ACCURACY, STROKE, 64), 16);
    wear(&mut control, 16.0, 40.0, 8);
    assert!(control.next(&ACCURACY, STROKE, 1000) < 8);
}

#[test]
fn either_surface_controls_the_jump() {
    let swap = |depth: &Sides<Vec<f64>>| Sides {
        slider: depth.receptacle.clone(),
        receptacle: depth.slider.clone(),
    };
    let depth = |receptacle: [f64; 2]| Sides {
        slider: vec![0.0; 3],
        receptacle: receptacle.to_vec(),
    };
    let (of_two, of_three) = ([1.0, 2.0], [1.0; 3]);
    let states = [[0.0, 0.0], [1.0, 2.0], [3.0, 3.0], [7.0, 4.0]].map(depth);
    let (mut one, mut other) = (JumpControl::default(), JumpControl::default());
    for step in states.windows(2) {
        let widths = Sides {
            slider: &of_three[..],
            receptacle: &of_two[..],
        };
        one.update(widths, 0.0, change(&step[0], &step[1]), 5);
        let widths = Sides {
            slider: &of_two[..],
            receptacle: &of_three[..],
        };
        let swapped = [swap(&step[0]), swap(&step[1])];
        other.update(widths, 0.0, change(&swapped[0], &swapped[1]), 5);
    }
    assert!((one.error - other.error).abs() < 1e-15 && one.error > 0.1);
    assert!((one.fastest_rate().receptacle - 0.8).abs() < 1e-15);
    assert!((other.fastest_rate().slider - 0.8).abs() < 1e-15);
    assert!((mean_error([&one].into_iter()) - mean_error([&other].into_iter())).abs() < 1e-15);
}

const GROSS: Stroke = Stroke {
    gross: true,
    ..STROKE
};

#[test]
fn gross_sliding_jumps_a_small_part_of_the_cycles_done() {
    let mut control = JumpControl::default();
    wear(&mut control, 0.0, 100.0, 100);
    wear(&mut control, 100.0, 200.0, 100);
    assert_eq!(control.next(&ACCURACY, STROKE, 10_000), 200);
    assert_eq!(control.next(&ACCURACY, GROSS, 10_000), 24);
}

#[test]
fn a_jump_that_hits_a_cycle_does_not_slow_down_the_growth() {
    let mut control = JumpControl::default();
    wear(&mut control, 0.0, 100.0, 100);
    wear(&mut control, 100.0, 200.0, 100);
    // 200 are allowed, 10 remain before a report.
    assert_eq!(control.next(&ACCURACY, STROKE, 10), 10);
    wear(&mut control, 200.0, 210.0, 10);
    assert_eq!(control.next(&ACCURACY, STROKE, 10_000), 209);
}

#[test]
fn the_last_jump_of_gross_sliding_before_a_report_is_a_short_one() {
    let mut control = JumpControl::default();
    wear(&mut control, 0.0, 100.0, 100);
    wear(&mut control, 100.0, 200.0, 100);
    let next = |remaining| control.clone().next(&ACCURACY, GROSS, remaining);
    assert_eq!([40, 20, 10, 5, 3].map(next), [19, 17, 7, 2, 3]);
    // Not that of a scar, nor of a groove.
    assert_eq!(control.clone().next(&ACCURACY, STROKE, 40), 40);
    let groove = Stroke {
        is_groove: true,
        ..GROSS
    };
    assert_eq!(control.next(&ACCURACY, groove, 40), 40);
}

#[test]
fn a_jump_that_would_skew_the_pressure_is_reduced() {
    let mut control = JumpControl::default();
    wear(&mut control, 0.0, 100.0, 100);
    wear(&mut control, 100.0, 200.0, 100);
    let skewed = |skew| Stroke { skew, ..STROKE };
    assert_eq!(control.next(&ACCURACY, skewed(0.005), 8_000), 80);
    assert_eq!(control.next(&ACCURACY, skewed(1.0), 8_000), 8);
}

#[test]
fn refined_jumps_are_shorter_and_grow_more_slowly() {
    let refined = |cycles| Accuracy {
        refinement: Refinement {
            cycles,
            ..Refinement::NONE
        },
        ..ACCURACY
    };
    let mut control = JumpControl::default();
    wear(&mut control, 0.0, 100.0, 100);
    wear(&mut control, 100.0, 200.0, 100);
    // As steady as it is, the jump grows by 2, 4 and the root of 2, up to the 200 cycles done over the refinement.
    for (cycles, jump) in [(1.0, 200), (0.5, 400), (2.0, 100)] {
        let next = control.next(&refined(cycles), STROKE, 1_000_000);
        assert!(next.abs_diff(jump) <= 1, "{cycles}: {next}");
    }
    let fixed = Accuracy {
        cycle_jump: Some(100),
        ..refined(0.25)
    };
    assert_eq!(control.next(&fixed, STROKE, 1_000), 400);
}

#[test]
fn a_fixed_jump_stops_at_what_remains() {
    let fixed = Accuracy {
        cycle_jump: Some(100),
        ..ACCURACY
    };
    assert_eq!(JumpControl::default().next(&fixed, STROKE, 250), 100);
    assert_eq!(JumpControl::default().next(&fixed, STROKE, 50), 50);
}

#[test]
fn an_error_that_does_not_fall_with_the_jump_does_not_shrink_jumps_to_single_cycles() {
    let stroke = Stroke {
        cycles: 1_000_000,
        ..STROKE
    };
    let mut control = JumpControl::default();
    let (mut done, mut depth, mut computed) = (0, 0.0, 0);
    while done < 100_000 {
        let jump = control.next(&ACCURACY, stroke, 1_000_000 - done);
        // Two rates by turns, whatever the jump.
        let rate = if done > 1_000 && computed % 2 == 0 {
            2.0
        } else {
            1.0
        };
        let after = depth + rate * real_cycles(jump);
        wear(&mut control, depth, after, jump);
        (done, depth, computed) = (done + jump, after, computed + 1);
    }
    // 0.05 times 2 % of the cycles done.
    assert!((97..105).contains(&control.last), "{}", control.last);
}
