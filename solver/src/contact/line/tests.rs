//! Wear laws in the contact solve, on the fuzz button with both sides worn.

use super::*;
use crate::condensation::{Operators, condense};
use crate::law::pace::Pace;
use crate::law::surface::SurfaceWear;
use crate::law::wear::power::{Measure, PowerLaw};
use crate::law::wear::{LocalState, WearLaw};
use crate::model::{build, tests::fuzz_button};
use crate::sides::{Side, Sides};

/// Slip of the increments, mm, about the half-width of the contact.
const STEP: f64 = 4e-4;
const K: f64 = 0.011 / 427.0;

fn power(exponent: f64) -> WearLaw {
    WearLaw::PressurePower {
        k_per_mpa: K,
        reference_mpa: 400.0,
        exponent,
    }
}

/// Recession of the receptacle and of the slider, mm, paths and pressures at the receptacle's nodes.
struct Worn {
    state: ContactState,
    path: Vec<f64>,
    recession: Sides<Vec<f64>>,
    area: Sides<f64>,
    first: Sides<usize>,
}

/// Loads the unworn bodies, slides one increment without wear, and then one that stands for so many cycles.
fn wear(laws: &Sides<Option<WearLaw>>, cycles: f64) -> (Operators, Worn) {
    wear_from(laws, cycles, None)
}

/// The same, the last increment from a start.
fn wear_from(
    laws: &Sides<Option<WearLaw>>,
    cycles: f64,
    start: Option<WarmStart<'_>>,
) -> (Operators, Worn) {
    let scene = fuzz_button();
    let mut model = build(&scene, &crate::effects::plan(&scene)).expect("the scene can be meshed");
    model.interface.wear = laws
        .map(|law| SurfaceWear::new(&[], law).map(|wear| wear.during(Pace::at_speed(1.0), STEP)));
    let operators = condense(&model, 1).expect("it can be condensed").operators;
    let pair = Pair {
        operators: &operators,
        interface: model.interface,
    };
    let depth = operators.as_ref().map(|body| vec![0.0; body.x.len()]);
    let slope = Sides::from_fn(|side| slopes(operators.of(side), depth.of(side), side));
    let surfaces = Surfaces {
        depth: depth.as_slices(),
        slope: slope.as_slices(),
        friction: Sides::default(),
    };
    let mut solver = Solver::default();
    let (mut state, mut next) = (
        ContactState::untouched(&operators, Side::Receptacle),
        ContactState::untouched(&operators, Side::Receptacle),
    );
    for (slider_x, cycles) in [(0.0, 0.0), (STEP, 0.0), (2.0 * STEP, cycles)] {
        let to = Displacement {
            slider_x,
            surface_slip: 0.0,
            along: 0.0,
            height: None,
            repeated: false,
            cycles,
            lemke: false,
            start: start.filter(|_| cycles > 0.0),
        };
        let done = solver
            .advance(&pair, &surfaces, &state, to, &mut next)
            .expect("Newton's method converges");
        assert!(done.complementarity <= GAP_TOLERANCE && done.friction_cone <= GAP_TOLERANCE);
        if cycles > 0.0 {
            let worn = Worn {
                path: done.path.to_vec(),
                recession: done.recession.map(<[f64]>::to_vec),
                area: done.worn_area,
                first: done.first,
                state: next.clone(),
            };
            return (operators, worn);
        }
        std::mem::swap(&mut state, &mut next);
    }
    unreachable!("the last increment wears")
}

fn area(operators: &Operators, worn: &Worn, side: Side) -> f64 {
    let widths = &operators.of(side).widths[*worn.first.of(side)..];
    let depths = worn.recession.of(side);
    widths.iter().zip(depths).map(|(w, depth)| w * depth).sum()
}

#[test]
fn recession_is_the_rate_at_the_end_of_the_increment() {
    for exponent in [0.6, 1.0, 2.0] {
        let laws = Sides {
            slider: Some(power(exponent)),
            receptacle: Some(power(exponent)),
        };
        let cycles = 4.0;
        let (operators, worn) = wear(&laws, cycles);
        let mut deepest = 0.0_f64;
        for (l, (path, depth)) in worn.path.iter().zip(&worn.recession.receptacle).enumerate() {
            let pressure = worn.state.pressure[worn.first.receptacle + l];
            let rate = power(exponent).rate(LocalState {
                pressure,
                slip: path / pressure.max(f64::MIN_POSITIVE),
                ..LocalState::default()
            });
            let expected = cycles * rate.value * path;
            assert!(
                (depth - expected).abs() <= 1e-12 * expected,
                "{exponent}: {depth} {expected}"
            );
            deepest = deepest.max(*depth);
        }
        // The wear opens the gap by more than the bodies deform: the solve is implicit in it.
        assert!(deepest > 0.1 * worn.state.indentation, "{deepest}");
        for side in Side::BOTH {
            let (area, expected) = (area(&operators, &worn, side), *worn.area.of(side));
            assert!(
                (area / expected - 1.0).abs() < 1e-12,
                "{exponent} {side:?}: {area} {expected}"
            );
        }
        assert!((worn.area.slider / worn.area.receptacle - 1.0).abs() < 1e-12);
    }
}

/// A law of which a power of the depth adds, with or without slip.
fn of_power(measure: Measure) -> PowerLaw {
    PowerLaw {
        exponent: 0.8,
        factor: 1e-8,
        pressure_exponent: 1.5,
        measure,
        thermal: None,
    }
}

const MEASURES: [Measure; 2] = [
    Measure::SlipTime {
        speed_exponent: 0.5,
    },
    Measure::Time,
];

#[test]
fn a_power_of_the_depth_adds_by_the_pressure_at_the_end_of_the_increment() {
    for law in MEASURES.map(of_power) {
        let laws = Sides {
            slider: Some(WearLaw::Power(law)),
            receptacle: Some(WearLaw::Power(law)),
        };
        let (operators, worn) = wear(&laws, 4.0);
        let exposure = law.exposure(Pace::at_speed(1.0), STEP);
        let mut deepest = 0.0_f64;
        for (l, (path, depth)) in worn.path.iter().zip(&worn.recession.receptacle).enumerate() {
            let pressure = worn.state.pressure[worn.first.receptacle + l];
            let slip = path / pressure.max(f64::MIN_POSITIVE);
            let expected = law
                .recession(0.0, 4.0 * exposure.increase(pressure, slip)[0])
                .0;
            assert!(
                (depth - expected).abs() <= 1e-12 * expected,
                "{depth} {expected}"
            );
            deepest = deepest.max(*depth);
        }
        assert!(deepest > 0.1 * worn.state.indentation, "{deepest}");
        for side in Side::BOTH {
            let (area, expected) = (area(&operators, &worn, side), *worn.area.of(side));
            assert!(
                (area / expected - 1.0).abs() < 1e-12,
                "{side:?}: {area} {expected}"
            );
        }
    }
}

#[test]
fn a_rate_that_varies_without_exponent_wears_like_a_uniform_one() {
    let both = |law| Sides {
        slider: Some(law),
        receptacle: Some(law),
    };
    let archard = WearLaw::Archard {
        k_over_h_per_mpa: K,
    };
    let (_, uniform) = wear(&both(archard), 4.0);
    let (_, varying) = wear(&both(power(0.0)), 4.0);
    for side in Side::BOTH {
        let deepest = uniform
            .recession
            .of(side)
            .iter()
            .fold(0.0, |m: f64, d| m.max(*d));
        let pairs = uniform
            .recession
            .of(side)
            .iter()
            .zip(varying.recession.of(side));
        for (uniform, varying) in pairs {
            assert!(
                (uniform - varying).abs() <= 1e-10 * deepest,
                "{uniform} {varying}"
            );
        }
    }
}

#[test]
fn sides_wear_by_their_own_laws() {
    let laws = Sides {
        slider: Some(power(1.0)),
        receptacle: Some(WearLaw::Archard {
            k_over_h_per_mpa: K,
        }),
    };
    let (operators, worn) = wear(&laws, 4.0);
    let expected: f64 = worn
        .path
        .iter()
        .zip(&worn.state.pressure[worn.first.receptacle..])
        .zip(&operators.receptacle.widths[worn.first.receptacle..])
        .map(|((path, pressure), width)| 4.0 * K * pressure / 400.0 * path * width)
        .sum();
    assert!((area(&operators, &worn, Side::Slider) / expected - 1.0).abs() < 1e-12);
    let receptacle = worn.area.receptacle / area(&operators, &worn, Side::Receptacle);
    assert!((receptacle - 1.0).abs() < 1e-12);
}

#[test]
fn any_start_leads_to_the_same_contact() {
    for law in [
        power(1.0),
        WearLaw::Power(of_power(MEASURES[0])),
        WearLaw::Power(of_power(MEASURES[1])),
    ] {
        starts_lead_to_the_same_contact(law);
    }
}

fn starts_lead_to_the_same_contact(law: WearLaw) {
    let laws = Sides {
        slider: Some(law),
        receptacle: Some(law),
    };
    let (_, worn) = wear(&laws, 4.0);
    let (first, end) = worn.state.active_range().expect("the bodies touch");
    let peak = worn.state.peak_pressure();
    // All of a wide contact sticks under a hundredfold pressure, slips backward, or a single node touches.
    for (first, nodes, status, pressure) in [
        (first.saturating_sub(20), 60, Status::Stick, 100.0 * peak),
        (first, end - first, Status::SlipLeft, peak),
        (first, 1, Status::SlipRight, peak),
    ] {
        let start = WarmStart {
            first,
            status: &vec![status; nodes],
            pressure: &vec![pressure; nodes],
        };
        let (_, other) = wear_from(&laws, 4.0, Some(start));
        let pressures = worn.state.pressure.iter().zip(&other.state.pressure);
        let off = pressures.fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()));
        // The gaps converge to 1e-11 of the indentation, pressures to some hundred times that.
        assert!(off < 1e-8 * peak, "{status:?}: {}", off / peak);
        assert_eq!(worn.state.status, other.state.status);
    }
}
