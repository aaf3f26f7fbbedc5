use std::f64::consts::{PI, TAU};

use super::*;
use crate::number::real;

const KAPPA: f64 = 100.0;
const CONDUCTIVITY: f64 = 300.0;

fn body(diffusivity: Option<f64>) -> Conductor {
    Conductor {
        conductivity_w_mk: CONDUCTIVITY,
        diffusivity_mm2_s: diffusivity,
    }
}

/// A body that takes no heat, beside which the other one takes all of it.
const INSULATOR: Conductor = Conductor {
    conductivity_w_mk: 0.0,
    diffusivity_mm2_s: None,
};

fn heat(amplitude_mm: f64, period_s: f64) -> SlidingHeat {
    SlidingHeat {
        half_width_mm: 0.01,
        amplitude_mm,
        period_s,
        duration_s: f64::INFINITY,
        distance_mm: 1.0,
        resting: body(Some(KAPPA)),
        passed: body(Some(KAPPA)),
    }
}

/// Mean over a sine of the temperature, weighted by the heat: that which counts for wear by distance.
fn weighted(of: impl Fn(f64) -> f64) -> f64 {
    const TIMES: usize = 32;
    let (mut sum, mut weight) = (0.0, 0.0);
    for i in 0..TIMES {
        let phase = TAU * (real(i) + 0.5) / real(TIMES);
        sum += phase.cos().abs() * of(phase);
        weight += phase.cos().abs();
    }
    sum / weight
}

/// The temperature in the middle of the source by Green's function of a half-plane,
///   T = int Q'(t - s)/(2 pi K s) mean over the source of exp(-r^2/(4 kappa s)) ds,
/// of a source that oscillates over the body, or stays on it. The sink is the time from which on nothing counts any more: with
/// d = sqrt(4 kappa s) exp(-gamma/2) a steady source at rest has ln(d/a) + 1. Over a time that holds many periods, the source has its
/// mean heat, and is anywhere on its track.
fn greens(heat: &SlidingHeat, moves: bool, phase: f64) -> f64 {
    const STEPS: usize = 1_500;
    const PLACES: usize = 24;
    const PERIODS: f64 = 8.0;
    let (a, omega) = (heat.half_width_mm, TAU / heat.period_s);
    let steady = heat.distance_mm.powi(2) * EULER.exp() / (4.0 * KAPPA);
    let last = steady.min(heat.duration_s);
    let first = 1e-5 * a * a / KAPPA;
    let place = |phase: f64| {
        if moves {
            heat.amplitude_mm * phase.sin()
        } else {
            0.0
        }
    };
    let near = |then: f64, s: f64| {
        let moved = place(phase) - place(then);
        let spread = |j: usize| {
            let x = moved + a * (2.0 * (real(j) + 0.5) / real(PLACES) - 1.0);
            (-x * x / (4.0 * KAPPA * s)).exp()
        };
        // Q' of a mean of 1.
        0.5 * PI * then.cos().abs() * (0..PLACES).map(spread).sum::<f64>() / real(PLACES)
    };
    let integral = |from: f64, to: f64, at: &dyn Fn(f64) -> f64| {
        // ds/s is even in the logarithm.
        let step = (to / from).ln() / real(STEPS);
        let places = (0..STEPS).map(|i| from * (step * (real(i) + 0.5)).exp());
        step * places.map(at).sum::<f64>()
    };
    let until = (PERIODS * heat.period_s).clamp(first, last);
    let mut sum = integral(first, until, &|s| near(phase - omega * s, s));
    if until < last {
        let mean = |s: f64| {
            let then = |i: usize| TAU * (real(i) + 0.5) / 48.0;
            (0..48).map(|i| near(then(i), s)).sum::<f64>() / 48.0
        };
        sum += integral(until, last, &mean);
    }
    sum / (2.0 * PI * CONDUCTIVITY)
}

#[test]
fn the_temperature_at_rest_is_that_of_a_uniform_line_source() {
    // Q'/(pi K) (ln(d/a) + 1): two bodies take half of it each.
    let unknown = SlidingHeat {
        resting: body(None),
        passed: body(None),
        ..heat(0.0, 1.0)
    };
    let exact = (100_f64.ln() + 1.0) / (2.0 * PI * CONDUCTIVITY);
    assert!((unknown.rise(2.0, 1.0) / (2.0 * exact) - 1.0).abs() < 1e-14);
    // Slow sliding has it, too.
    let slow = heat(0.05, 1e3);
    assert!((slow.rise(0.2, 0.1) / (0.2 * exact) - 1.0).abs() < 1e-14);
}

/// Sources at rest, composed of uniform ones: the mean under a uniform source, ln(d/2b) + 3/2, and the middle of one in proportion to Hertz'
/// pressure, ln(2d/b) + 1/2. The temperature of the middle of a uniform one lies between them.
#[test]
fn a_uniform_source_at_rest_lies_between_its_mean_and_that_of_hertz_pressure() {
    const PARTS: usize = 20_000;
    let (half_width, distance) = (0.01, 1.0);
    // pi K T/Q' in the middle of a uniform source.
    let middle = |half_width_mm: f64| {
        let alone = SlidingHeat {
            half_width_mm,
            passed: INSULATOR,
            resting: body(None),
            ..heat(0.0, 1.0)
        };
        PI * CONDUCTIVITY * alone.rise(1.0, 1.0)
    };
    let parts = || (0..PARTS).map(|i| (real(i) + 0.5) / real(PARTS));
    // A place divides a source into halves of two that have it in their middle.
    let at = |x: f64| {
        0.5 * ((1.0 + x) * middle(half_width * (1.0 + x))
            + (1.0 - x) * middle(half_width * (1.0 - x)))
    };
    let mean = parts().map(at).sum::<f64>() / real(PARTS);
    // Uniform sources of the half-widths b sin(t) with the heats (4/pi) sin(t)^2 dt.
    let of_hertz = |part: f64| {
        let sine = (0.5 * PI * part).sin();
        2.0 * sine * sine * middle(half_width * sine)
    };
    let hertz = parts().map(of_hertz).sum::<f64>() / real(PARTS);
    let ratio = distance / half_width;
    for (found, exact) in [
        (mean, (0.5 * ratio).ln() + 1.5),
        (hertz, (2.0 * ratio).ln() + 0.5),
    ] {
        assert!((found / exact - 1.0).abs() < 1e-6, "{found} {exact}");
    }
    assert!(mean < middle(half_width) && middle(half_width) < hertz);
}

/// Heat that has flowed for some periods, in a body at rest and in one that the contact moves over.
#[test]
fn a_contact_warms_up_with_the_time_of_sliding() {
    for (periods, moves) in [(1.0, false), (3.0, false), (1.0, true), (3.0, true)] {
        let warm = SlidingHeat {
            duration_s: 1e-3 * periods,
            ..heat(0.02, 1e-3)
        };
        let alone = SlidingHeat {
            resting: if moves { INSULATOR } else { warm.resting },
            passed: if moves { warm.passed } else { INSULATOR },
            ..warm
        };
        let mean = 4.0 * 0.02 / 1e-3;
        let found = weighted(|phase| alone.rise(0.5 * PI * mean * phase.cos().abs(), mean) / mean);
        let exact = weighted(|phase| greens(&warm, moves, phase));
        let error = found / exact - 1.0;
        assert!((0.0..0.06).contains(&error), "{periods} {moves}: {error}");
        let steady = SlidingHeat {
            duration_s: f64::INFINITY,
            ..alone
        };
        assert!(steady.rise(mean, mean) > 1.02 * alone.rise(mean, mean));
    }
}

/// Both kinds of body alone, from quasi-steady to a period in which heat does not cross the contact.
#[test]
fn oscillating_sources_have_the_temperatures_of_greens_functions() {
    let mut worst = 0.0_f64;
    for amplitude in [0.02, 0.1, 0.4] {
        for period in [10.0, 0.1, 1e-2, 1e-3, 1e-4] {
            for moves in [false, true] {
                let both = heat(amplitude, period);
                let alone = SlidingHeat {
                    resting: if moves { INSULATOR } else { both.resting },
                    passed: if moves { both.passed } else { INSULATOR },
                    ..both
                };
                let fastest = TAU * amplitude / period;
                let found = weighted(|phase| {
                    // Friction that dissipates 1 W/m on average.
                    let mean = fastest * 2.0 / PI;
                    alone.rise(fastest * phase.cos().abs(), mean) / mean
                });
                let exact = weighted(|phase| greens(&both, moves, phase));
                let error = found / exact - 1.0;
                // An upper limit where the contact is as fast as heat: 16 % where it crosses its width in 2 us.
                assert!(
                    (0.0..0.17).contains(&error),
                    "{amplitude} mm, {period} s, moves: {moves}: {error}"
                );
                worst = worst.max(if moves { 0.0 } else { error });
            }
        }
    }
    // A body at rest.
    assert!(worst < 0.03, "{worst}");
}
