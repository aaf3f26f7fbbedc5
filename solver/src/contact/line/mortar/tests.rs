use super::*;
use crate::condensation::{BodyOperators, Operators};
use crate::model::{HeatSources, Interface, Profile, Tangential};
use crate::sides::{Side, Sides};

fn body(x: Vec<f64>, profile: Profile) -> BodyOperators {
    let widths = (0..x.len())
        .map(|i| 0.5 * (x[(i + 1).min(x.len() - 1)] - x[i.saturating_sub(1)]))
        .collect();
    BodyOperators {
        x,
        widths,
        profile,
        zones: Vec::new(),
    }
}

fn bodies() -> Operators {
    Operators {
        slider: body(
            vec![-4.0, -1.3, 0.2, 0.9, 5.0],
            Profile::Arc { radius: 10.0 },
        ),
        receptacle: body(vec![-2.0, -1.0, -0.4, 0.5, 1.0, 2.0], Profile::Flat),
    }
}

fn pair(operators: &Operators, slave: Side) -> Pair<'_> {
    Pair {
        operators,
        interface: Interface {
            slave,
            sticks: false,
            slope_weights: Sides {
                slider: 0.0,
                receptacle: 1.0,
            },
            friction: 0.0,
            tangential: Tangential::Omitted,
            wear: Sides::default(),
            load: 1.0,
            spring: 0.0,
            modulus: 1.0,
            heated_by: HeatSources::default(),
        },
    }
}

#[test]
fn averages_reproduce_linear_functions_at_any_position() {
    let operators = bodies();
    for slave in Side::BOTH {
        let pair = pair(&operators, slave);
        for slider_x in [-2.5, -0.37, 0.0, 0.41, 1.9] {
            let mut coupling = Coupling::default();
            let (first, end) = covered(&pair, slider_x);
            coupling.integrate(&pair, slider_x, first, end);
            for i in first..end {
                let (from, row) = coupling.dual_row(i);
                let linear: f64 = row
                    .iter()
                    .zip(&pair.master().x[from..])
                    .map(|(m, x)| m * (3.0 + 0.5 * (x + pair.offset(slider_x))))
                    .sum();
                let expected = 3.0 + 0.5 * pair.slave().x[i];
                assert!((linear - expected).abs() < 1e-13, "{slider_x} {i}");
            }
        }
    }
}

/// Nodes of both meshes coincide to round-off at the ends of a row's support.
#[test]
fn coinciding_nodes_are_coupled_at_any_position() {
    let even = |n: i32| (-n..=n).map(|i| 0.1 * f64::from(i)).collect();
    let operators = Operators {
        slider: body(even(4), Profile::Arc { radius: 10.0 }),
        receptacle: body(even(8), Profile::Flat),
    };
    let mut coupling = Coupling::default();
    for slave in Side::BOTH {
        let pair = pair(&operators, slave);
        for slider_x in (-60..=60).map(|i| 0.01 * f64::from(i)) {
            let covered = covered(&pair, slider_x);
            for i in covered.0..covered.1 {
                coupling.integrate(&pair, slider_x, i, i + 1);
                let sum: f64 = coupling.dual_row(i).1.iter().sum();
                assert!((sum - 1.0).abs() < 1e-12, "{slider_x} {i}: {sum}");
            }
        }
    }
}

#[test]
fn transfers_keep_the_area() {
    let operators = bodies();
    let mut coupling = Coupling::default();
    coupling.integrate(&pair(&operators, Side::Receptacle), 0.3, 0, 6);
    for i in 0..6 {
        let sum: f64 = coupling.standard_row(i).1.iter().sum();
        assert!((sum - operators.receptacle.widths[i]).abs() < 1e-14);
    }
}

#[test]
fn shares_by_parts_keep_the_area_and_averages_become_positive() {
    let operators = bodies();
    let mut coupling = Coupling::default();
    coupling.integrate(&pair(&operators, Side::Receptacle), 0.3, 0, 6);
    for i in 0..6 {
        let (from, before) = coupling.standard_row(i);
        let before = before.to_vec();
        // Parts of very unlike places, as of a base of 260 times the rate beside its plating.
        let part = |j: usize| if j.is_multiple_of(2) { 260.0 } else { 1.0 };
        coupling.share_by(i, part);
        let (shares, averages) = (coupling.standard_row(i).1, coupling.dual_row(i).1);
        let sum: f64 = shares.iter().sum();
        assert!((sum - operators.receptacle.widths[i]).abs() < 1e-14);
        assert!((averages.iter().sum::<f64>() - 1.0).abs() < 1e-14);
        assert!(averages.iter().all(|weight| *weight >= 0.0));
        let scale: f64 = (from..)
            .zip(&before)
            .map(|(j, share)| part(j) * share)
            .sum();
        for ((j, share), before) in (from..).zip(shares).zip(before) {
            assert!((share - part(j) * before * sum / scale).abs() < 1e-14);
        }
    }
}

#[test]
fn nodes_that_the_master_does_not_cover_are_left_out() {
    let operators = bodies();
    let pair = pair(&operators, Side::Receptacle);
    assert_eq!(covered(&pair, 0.0), (0, 6));
    assert_eq!(covered(&pair, 2.5), (2, 6));
    let (first, end) = covered(&pair, 100.0);
    assert_eq!(first, end);
}
