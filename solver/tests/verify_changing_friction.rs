//! A coefficient of friction that changes: by cycle, by dose, by layer.
//!
//! * Points or layers of one coefficient are the constant law, to the bit.
//! * Where all of the contact slips, each node is on the cone of its own coefficient.
//! * A film that is worn through at a dose is that of a layer which lasts as long.
//! * A coefficient that rises lets a contact in partial slip stick on a larger part and wear less.

mod along_lines;
mod missions;
mod points;
mod symmetry;

use solver::record::{CycleReport, Outcome, Snapshot};
use solver::scene::{Accuracy, Friction, Scene, Table, WearLaw};
use solver::sides::{Side, Sides};

use crate::verification::recorder::solve;
use crate::verification::scenes::{groove, partial_slip, scar};
use crate::verification::verify_plating::{RATES, THICKNESS, plated};

pub(crate) const LOW: f64 = 0.2;
pub(crate) const HIGH: f64 = 0.55;

pub(crate) fn constant(coefficient: f64) -> Friction {
    Friction::Coulomb { coefficient }
}

pub(crate) fn by_cycle(points: &[(f64, f64)]) -> Friction {
    Friction::ByCycle(Table::new(points))
}

pub(crate) fn by_dose(points: &[(f64, f64)]) -> Friction {
    Friction::ByDose(Table::new(points))
}

pub(crate) fn by_layer(slider: &[f64], receptacle: &[f64]) -> Friction {
    Friction::ByLayer(Sides {
        slider: slider.to_vec(),
        receptacle: receptacle.to_vec(),
    })
}

pub(crate) fn with(scene: &Scene, friction: Friction) -> Scene {
    Scene {
        friction,
        ..scene.clone()
    }
}

/// Every bit that a run reports.
pub(crate) fn bits(scene: &Scene) -> String {
    let (summary, recorder) = solve(scene).expect("the scene can be solved");
    format!(
        "{:?} {:?} {summary:?}",
        recorder.reports, recorder.snapshots
    )
}

pub(crate) fn shortened(mut scene: Scene, cycles: u64) -> Scene {
    scene.cycles = cycles;
    scene.accuracy = Accuracy::from_tolerance(0.1);
    scene.output.snapshots_at_cycles = vec![cycles];
    scene
}

#[test]
fn equal_points_are_the_constant_law_to_the_bit() {
    // The plan leaves out the wear of a slider that hardly wears.
    let mut hard_slider = shortened(scar(), 200);
    hard_slider.slider.wear = Some(WearLaw::Archard {
        k_over_h_per_mpa: 1e-13,
    });
    // Jumps beyond the tolerance, which are rejected where the friction follows from the wear.
    let mut coarse = shortened(scar(), 200);
    coarse.accuracy.tuning.jump_of_done = 20.0;
    let scenes = [
        ("scar", shortened(scar(), 200)),
        ("hard slider", hard_slider),
        ("coarse", coarse),
        ("groove", shortened(groove(), 20)),
        ("partial slip", shortened(partial_slip(), 150)),
        (
            "both worn",
            shortened(plated(0.004, &Side::BOTH, 0, 0.1), 150),
        ),
        (
            "plated",
            shortened(plated(0.1, &[Side::Receptacle], 0, 0.1), 150),
        ),
        (
            "slider",
            shortened(plated(0.1, &[Side::Slider], 0, 0.1), 60),
        ),
    ];
    for (name, scene) in scenes {
        let expected = bits(&with(&scene, constant(0.6)));
        let tables = [
            by_cycle(&[(0.0, 0.6), (7.0, 0.6), (100.0, 0.6), (1e4, 0.6)]),
            by_dose(&[(0.0, 0.6), (1.0, 0.6), (1e6, 0.6)]),
        ];
        for table in tables {
            let found = bits(&with(&scene, table.clone()));
            assert!(found == expected, "{name}: other bits with {table:?}");
        }
        let layers = |side| [0.6].repeat(scene.plating(side).len() + 1);
        for (slider, receptacle) in [
            (layers(Side::Slider), layers(Side::Receptacle)),
            (Vec::new(), layers(Side::Receptacle)),
            (layers(Side::Slider), Vec::new()),
        ] {
            let found = bits(&with(&scene, by_layer(&slider, &receptacle)));
            assert!(found == expected, "{name}: other bits by layer");
        }
    }
}

/// Energy of a run and that of the cycles up to a report.
pub(crate) fn energy(scene: &Scene) -> f64 {
    let (summary, _) = solve(scene).expect("the scene can be solved");
    assert_eq!(summary.outcome, Outcome::Completed);
    summary.last.dissipated_energy_mj_per_mm
}

/// Coefficients at the nodes of a snapshot by the worn depths of the snapshot before.
fn coefficients(before: &Snapshot, at: impl Fn(f64) -> f64) -> Vec<f64> {
    before.receptacle.depth_mm.iter().map(|d| at(*d)).collect()
}

/// Single cycles, so that the depths at the beginning of one are those reported at the end of the one before. The receptacle
/// carries the tractions, and its places alone determine the coefficient.
#[test]
fn every_place_in_gross_slip_is_on_the_cone_of_its_own_coefficient() {
    // Eight passes of the middle.
    let thickness = 1e-6;
    let mut scene = plated(0.02, &[Side::Receptacle], 24, 0.1);
    scene.receptacle.plating.truncate(1);
    scene.receptacle.plating[0].thickness_mm = thickness;
    scene.accuracy.cycle_jump = Some(1);
    scene.output.snapshots_at_cycles = (1..=scene.cycles).collect();
    let layer = |depth: f64| if depth >= thickness { HIGH } else { LOW };
    let film = |depth: f64| {
        let most = thickness / RATES[0];
        let dose = if depth < thickness {
            depth / RATES[0]
        } else {
            most + (depth - thickness) / RATES[2]
        };
        LOW + (HIGH - LOW) * (dose / (2.0 * most)).min(1.0)
    };
    let dose = thickness / RATES[0];
    let laws: [(Friction, &dyn Fn(f64) -> f64); 2] = [
        (by_layer(&[], &[LOW, HIGH]), &layer),
        (by_dose(&[(0.0, LOW), (2.0 * dose, HIGH)]), &film),
    ];
    for (friction, at) in laws {
        let mut scene = with(&scene, friction);
        // Otherwise the plan leaves the shear out of the solve.
        for on in [false, true] {
            let effect = solver::scene::Effect::Friction;
            scene.effects = scene.effects.clone().with(effect, on);
            let (summary, run) = solve(&scene).expect("the scene can be solved");
            assert!(
                summary.checks.friction_cone < 1e-8 && summary.checks.friction_use < 1.0 + 1e-12
            );
            let (mut mixed, mut worst) = (0, 0.0_f64);
            for pair in run.snapshots.windows(2) {
                let mu = coefficients(&pair[0], at);
                for field in &pair[1].positions {
                    let peak = field.pressure_mpa.iter().fold(0.0, |m: f64, p| m.max(*p));
                    let first = pair[1].receptacle.x_mm.iter();
                    let first = first.take_while(|x| **x < field.x_mm[0]).count();
                    let mut touched = Vec::new();
                    for (i, p) in field.pressure_mpa.iter().enumerate() {
                        let q = field.shear_mpa[i].abs();
                        worst = worst.max((q - mu[first + i] * p).abs() / peak);
                        if *p > 0.0 {
                            touched.push(mu[first + i]);
                        }
                    }
                    let differs = |mu: &f64| (mu - touched[0]).abs() > 1e-3;
                    mixed += usize::from(touched.iter().any(differs));
                }
            }
            println!(
                "cone of each node, friction on {on}: off by {worst:.1e} of the peak, {mixed} contacts of more than one coefficient"
            );
            assert!(worst < 1e-10, "{worst}");
            assert!(mixed > 3, "{mixed} contacts have more than one coefficient");
        }
    }
}

/// A layer of the base's rate, worn through at a depth, and a film that lasts the dose of that depth.
#[test]
fn a_film_that_ends_at_a_dose_is_a_layer_that_lasts_as_long() {
    let mut scene = plated(0.02, &[Side::Receptacle], 400, 0.02);
    scene.receptacle.plating.truncate(1);
    scene.receptacle.plating[0].rate_per_mpa = RATES[2];
    let dose = THICKNESS[0] / RATES[2];
    let layers = energy(&with(&scene, by_layer(&[], &[LOW, HIGH])));
    let step = [(dose, LOW), (1.000_001 * dose, HIGH)];
    let film = energy(&with(&scene, by_dose(&step)));
    println!("film by dose over layer: energy {:.6}", film / layers);
    assert!((film / layers - 1.0).abs() < 2e-3, "{film} {layers}");
}

/// The largest tangential force of the last loop over the load.
fn used(snapshot: &Snapshot, load: f64) -> f64 {
    let forces = snapshot.friction_loop.tangential_force_n_per_mm.iter();
    forces.fold(0.0, |m: f64, q| m.max(q.abs())) / load
}

/// The case of the issue: 0.2 while the plating is there, above 0.5 where it is through.
#[test]
fn the_force_rises_as_a_plating_is_worn_through() {
    for sides in [&[Side::Receptacle][..], &Side::BOTH] {
        let mut scene = plated(0.02, sides, 6_000, 0.1);
        let layers = [LOW, LOW, HIGH];
        let slider = if sides.len() == 2 { &layers[..] } else { &[] };
        scene.friction = by_layer(slider, &layers);
        scene.output.snapshots_at_cycles = vec![1, 6_000];
        let load = scene.load_n_per_mm;
        let (summary, run) = solve(&scene).expect("the scene can be solved");
        let ends = [&run.snapshots[1], &run.snapshots[run.snapshots.len() - 1]];
        let ends = ends.map(|snapshot| used(snapshot, load));
        println!(
            "friction by layer, {} plated: Q/P {:.3} in cycle 1, {:.3} at the end",
            sides.len(),
            ends[0],
            ends[1]
        );
        assert!(
            (ends[0] / LOW - 1.0).abs() < 0.02 && ends[1] > 0.5,
            "{ends:?}"
        );
        assert!(summary.checks.worn_area < 1e-11 && summary.checks.friction_cone < 1e-8);
        // Some of the plating may still carry at the end.
        let mean = |report: &CycleReport| report.friction_coefficient;
        let (first, last) = (mean(&run.reports[0]), mean(&summary.last));
        assert!((first / LOW - 1.0).abs() < 1e-12, "{first}");
        assert!(last > 0.8 * HIGH && last < HIGH * (1.0 + 1e-12), "{last}");
    }
}

#[test]
fn a_coefficient_that_rises_in_partial_slip_wears_less() {
    let scene = shortened(partial_slip(), 1_000);
    let run = |friction| {
        let (summary, run) = solve(&with(&scene, friction)).expect("the scene can be solved");
        let last = &run.snapshots[run.snapshots.len() - 1];
        let turned = &last.positions[last.positions.len() - 1];
        let nodes = turned.pressure_mpa.iter().zip(&turned.shear_mpa);
        let loaded = nodes.clone().filter(|(p, _)| **p > 0.0).count();
        let sticking = nodes.filter(|(p, q)| q.abs() < 0.39 * **p).count();
        assert!(loaded > 0);
        (summary.last.receptacle.worn_area_mm2, sticking)
    };
    let (worn, sticking) = run(constant(0.4));
    for rising in [
        by_cycle(&[(0.0, 0.4), (300.0, 0.4), (600.0, 0.8)]),
        by_dose(&[(0.0, 0.4), (200.0, 0.8)]),
    ] {
        let (less, more) = run(rising);
        println!(
            "rising friction in partial slip: worn area {less:.3e} for {worn:.3e}, {more} nodes below 0.39 p for {sticking}"
        );
        assert!(less < 0.95 * worn, "{less} {worn}");
    }
}
