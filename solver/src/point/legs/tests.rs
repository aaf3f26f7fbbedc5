use super::*;
use crate::closed_form::{PointAccuracy, PointBody, SlipRegime};
use crate::law::elastic::Elastic;
use crate::sides::Sides;

fn scene(path: CyclePath) -> PointScene {
    let body = PointBody {
        radius_along_mm: Some(1.0),
        radius_across_mm: Some(1.0),
        elastic: Elastic {
            youngs_modulus_mpa: 1e5,
            poisson_ratio: 0.3,
        },
        wear: None,
    };
    PointScene {
        bodies: Sides {
            slider: body,
            receptacle: body,
        },
        force_n: 1.0,
        spring_n_per_mm: 0.0,
        friction: 0.3,
        slip: SlipRegime::Gross,
        amplitude_mm: -0.02,
        path,
        cycles: 1,
        accuracy: PointAccuracy::from_tolerance(0.02),
    }
}

fn ends(path: CyclePath) -> Vec<(f64, Option<Position>, bool)> {
    let legs = legs(&scene(path)).into_iter();
    legs.map(|leg| (leg.to, leg.at, leg.turns)).collect()
}

#[test]
fn a_cycle_goes_to_and_fro_through_the_neutral_position() {
    let found = ends(CyclePath::ToAndFro);
    let expected = [
        (0.0, None, false),
        (-0.02, Some(Position::Leftmost), true),
        (0.0, Some(Position::Neutral), false),
        (0.02, Some(Position::Rightmost), true),
    ];
    assert_eq!(found, expected);
}

#[test]
fn strokes_between_turning_points_are_divided_where_they_pass_the_neutral_position() {
    let turns = TurningPoints::new(&[0.02, 0.005, 0.01, -0.015]).expect("they alternate");
    let found = ends(CyclePath::Turning(turns));
    let expected = [
        (0.005, None, true),
        (0.01, None, true),
        (0.0, None, false),
        (-0.015, Some(Position::Leftmost), true),
        (0.0, Some(Position::Neutral), false),
        (0.02, Some(Position::Rightmost), true),
    ];
    assert_eq!(found, expected);
    let length: f64 = legs(&scene(CyclePath::Turning(turns)))
        .iter()
        .map(Leg::length)
        .sum();
    assert!((length - turns.path_mm()).abs() < 1e-15);
}

#[test]
fn a_continuous_motion_has_none() {
    assert_eq!(legs(&scene(CyclePath::Continuous { mm: 0.3 })), []);
}
