//! Error of plane strain: an SD card's tip as a section of 0.8 mm width and as a ball, under 0.5 N, on a pad of gold.
//!
//! ```text
//!   section: (4/3) h sqrt(2 R h) w = k F s          ball: pi R h^2 = k F s
//! ```
//! The plan states the ratio of both lives (`effects::across_width`).

use solver::closed_form::middle_line_load_n_per_mm;
use solver::law::elastic::Elastic;
use solver::record::Outcome;
use solver::scene::{Accuracy, Criterion, Dimension, Motion, Point, Scene, WearLaw};
use solver::sides::{Side, Sides};

use crate::verification::recorder::solve;
use crate::verification::scenes::sprung_contact;

const RADIUS: f64 = 0.4;
const WIDTH: f64 = 0.8;
const FORCE: f64 = 0.5;
const AMPLITUDE: f64 = 0.1;
/// 30 microinches of gold.
const DEPTH: f64 = 0.76e-3;
const LAW: WearLaw = WearLaw::Archard {
    k_over_h_per_mpa: 6e-8,
};

fn section(elastic: Sides<Elastic>) -> Scene {
    let mut scene = sprung_contact();
    scene.spring_n_per_mm2 = 0.0;
    scene.load_n_per_mm = FORCE / WIDTH;
    scene.slider.shape.radius_mm = RADIUS;
    scene.slider.shape.half_width_mm = 0.3;
    scene.slider.shape.height_mm = RADIUS;
    scene.receptacle.shape.length_mm = 2.0;
    scene.receptacle.shape.height_mm = 0.3;
    scene.receptacle.shape.crown_radius_mm = None;
    (scene.slider.elastic, scene.receptacle.elastic) = (elastic.slider, elastic.receptacle);
    (scene.slider.wear, scene.receptacle.wear) = (Some(LAW), None);
    scene.motion = Motion::Reciprocating {
        amplitude_mm: AMPLITUDE,
        period_s: 1.0,
    };
    scene.cycles = 200_000;
    scene.accuracy = Accuracy::from_tolerance(0.05);
    scene.stop = vec![Criterion::deepest(Side::Slider, DEPTH)];
    scene
}

/// Makes a section that of a body of this radius across the sliding direction, mm, on a flat under a force in N.
pub(crate) fn as_ball(scene: &mut Scene, force_n: f64, radius_across_mm: f64) {
    scene.dimension = Dimension::Point(Point {
        force_n,
        radius_across_mm: Sides {
            slider: Some(radius_across_mm),
            receptacle: None,
        },
    });
    scene.load_n_per_mm = middle_line_load_n_per_mm(scene);
}

/// The same tip as a ball under the same force.
fn ball(section: &Scene) -> Scene {
    let mut scene = section.clone();
    as_ball(&mut scene, FORCE, RADIUS);
    scene.accuracy = Accuracy::from_tolerance(0.02);
    scene
}

#[test]
fn a_ball_is_worn_sooner_than_a_section_as_the_plan_says() {
    let elastic = Sides {
        slider: Elastic {
            youngs_modulus_mpa: 131e3,
            poisson_ratio: 0.3,
        },
        receptacle: Elastic {
            youngs_modulus_mpa: 117e3,
            poisson_ratio: 0.34,
        },
    };
    let plane = section(elastic);
    let real = |count: u64| f64::from(u32::try_from(count).expect("it is small"));
    let cycles = |scene: &Scene| {
        let (summary, _) = solve(scene).expect("it can be solved");
        assert_eq!(summary.outcome, Outcome::StopCondition);
        real(summary.last.cycle)
    };
    let (of_section, of_ball) = (cycles(&plane), cycles(&ball(&plane)));
    let closed = WIDTH / (0.75 * std::f64::consts::PI / 2.0_f64.sqrt() * (RADIUS * DEPTH).sqrt());
    println!(
        "section {of_section} cycles, ball {of_ball}: {:.2} times sooner, closed {closed:.2}",
        of_section / of_ball
    );
    // The ball is pressed in by half of that depth, which the closed form leaves out: 8 % of its life.
    assert!((of_section / of_ball / closed - 1.0).abs() < 0.1);
}
