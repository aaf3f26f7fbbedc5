//! Point contacts as runs of a scene: checkpoints, lives, stops, errors and resistance are those of a section's run.
//!
//! A ball of 0.4 mm under 0.5 N on a flat, +-20 um: the spring of a memory card.

use solver::closed_form::middle_line_load_n_per_mm;
use solver::effects;
use solver::record::{Outcome, Quantity, Summary};
use solver::scene::Effect;
use solver::scene::{Accuracy, Criterion, Layer, Motion, Refinement, Scene, WearLaw};
use solver::sides::Side;

use crate::verification::recorder::{check_stated_error, solve};
use crate::verification::scenes::sprung_contact;
use crate::verification::verify_resume::resumes_to_the_same_bits;
use crate::verification::verify_section_and_ball::as_ball;

const FORCE: f64 = 0.5;
const RADIUS: f64 = 0.4;
/// k/H of gold on gold, 1/MPa.
const GOLD: f64 = 1e-5 / 1700.0;

/// The ball, of which the sides wear by these rates in 1/MPa.
pub(crate) fn ball(slider: f64, receptacle: f64, amplitude_mm: f64, cycles: u64) -> Scene {
    let law = |k_over_h_per_mpa: f64| {
        (k_over_h_per_mpa > 0.0).then_some(WearLaw::Archard { k_over_h_per_mpa })
    };
    let mut scene = sprung_contact();
    (scene.slider.wear, scene.receptacle.wear) = (law(slider), law(receptacle));
    scene.motion = Motion::Reciprocating {
        amplitude_mm,
        period_s: 0.05,
    };
    scene.cycles = cycles;
    scene.output.snapshots_at_cycles = vec![cycles];
    scene.accuracy = Accuracy::from_tolerance(0.02);
    scene.spring_n_per_mm2 = 0.0;
    as_ball(&mut scene, FORCE, RADIUS);
    scene
}

fn done(scene: &Scene) -> Summary {
    solve(scene).expect("it can be solved").0
}

#[test]
fn a_resumed_point_contact_reaches_the_bits_of_the_undisturbed_run() {
    let mut scene = ball(4.0 * GOLD, 4.0 * GOLD, 0.02, 2_000);
    let layer = Layer {
        thickness_mm: 0.3e-3,
        rate_per_mpa: GOLD,
    };
    (scene.slider.plating, scene.receptacle.plating) = (vec![layer], vec![layer]);
    scene.spring_n_per_mm2 = 10.0 * scene.load_n_per_mm / FORCE;
    scene.life = vec![Criterion::deepest(Side::Slider, 0.3e-3)];
    scene.output.snapshots_at_cycles = vec![300, 2_000];
    let (summary, _) = resumes_to_the_same_bits("plated ball", &scene, 2);
    assert!(summary.life.criteria[0].cycles.is_some());
    // Doses through layers, whose depths have no rate in common: round-off of some thousand increments.
    assert!(summary.checks.worn_area < 1e-10, "{:?}", summary.checks);
    let stuck = ball(GOLD, GOLD, 2e-4, 500);
    assert!(effects::plan(&stuck).simulates(Effect::StickMemory));
    resumes_to_the_same_bits("sticking ball", &stuck, 2);
}

#[test]
fn companions_of_a_point_contact_are_resumed_too() {
    let mut scene = ball(GOLD, GOLD, 0.02, 1_000);
    scene.accuracy = Accuracy::from_tolerance(0.1);
    scene.accuracy.estimate_errors = true;
    let (first, second) = (done(&scene), done(&scene));
    assert_eq!(format!("{first:?}"), format!("{second:?}"));
    assert!(
        first
            .errors
            .is_some_and(|errors| errors.worn_depth.relative > 0.0)
    );
}

/// Depth within its tolerance and its stated error, whichever side wears; the reference has 1.5 times the cells and increments,
/// and a third of the jumps.
#[test]
fn stated_errors_hold_in_point_contacts() {
    for (name, slider, receptacle, amplitude) in
        [("pad alone", 0.0, GOLD, 0.02), ("both", GOLD, GOLD, 0.02)]
    {
        let mut scene = ball(slider, receptacle, amplitude, 400);
        scene.accuracy.estimate_errors = true;
        let mut fine = scene.clone();
        fine.accuracy.estimate_errors = false;
        fine.accuracy.refinement = Refinement {
            mesh: 1.5,
            increments: 1.5,
            cycles: 3.0,
        };
        let (found, fine) = (done(&scene), done(&fine));
        check_stated_error(name, &found, &fine);
        let errors = found.errors.expect("errors are estimated");
        let peak = found.last.peak_pressure_mpa / fine.last.peak_pressure_mpa - 1.0;
        println!(
            "{name}: peak {:.2} % off, stated {:?}",
            100.0 * peak,
            errors.parts(Quantity::PeakPressure)
        );
    }
}

/// The life by a depth is the cycle at which a run stops at it.
#[test]
fn the_life_of_a_ball_is_where_its_run_stops() {
    let mut scene = ball(GOLD, GOLD, 0.05, 3_000);
    let criterion = Criterion::deepest(Side::Slider, 0.4e-3);
    scene.life = vec![criterion];
    let life = done(&scene).life.criteria[0].cycles.expect("it is reached");
    scene.life.clear();
    scene.stop = vec![criterion];
    let stopped = done(&scene);
    assert_eq!(stopped.outcome, Outcome::StopCondition);
    let cycles = f64::from(u32::try_from(stopped.last.cycle).expect("it is small"));
    // Jumps to a stop are shorter than those of a life, by which other cycles are computed.
    assert!((life / cycles - 1.0).abs() < 0.01, "{life} {cycles}");
    // Half of the cap is through later than its middle.
    scene.stop = vec![Criterion {
        part: 0.5,
        ..criterion
    }];
    scene.cycles = 50_000;
    let half = done(&scene);
    assert_eq!(half.outcome, Outcome::StopCondition);
    // The part of a paraboloid that is deeper than d is 1 - d/h of it: h = 2 d, and a cap that deep has four times the volume. The
    // receptacle's groove takes a part of the depth.
    let ratio = f64::from(u32::try_from(half.last.cycle).expect("it is small")) / cycles;
    println!("half of the cap: {ratio:.2} times the cycles of its middle");
    assert!((3.2..4.8).contains(&ratio), "{ratio}");
}

/// Volume, energy and line loads: of the whole contact F s, of its middle section the integral of its own line load.
#[test]
fn a_point_run_has_the_volumes_of_its_force_and_the_areas_of_its_middle_section() {
    let cycles = 1_000_u32;
    let scene = ball(GOLD, 3.0 * GOLD, 0.05, u64::from(cycles));
    let found = done(&scene);
    let work = FORCE * 4.0 * 0.05 * f64::from(cycles);
    let last = &found.last;
    for (side, rate) in [(&last.slider, GOLD), (&last.receptacle, 3.0 * GOLD)] {
        let volume = side.worn_volume_mm3.expect("it has a volume");
        // Round-off of some thousand increments.
        assert!((volume / (rate * work) - 1.0).abs() < 1e-10, "{volume}");
        assert!(
            side.ideal_volume_mm3
                .is_some_and(|ideal| (ideal / volume - 1.0).abs() < 1e-10)
        );
        // The middle section lies between two columns, which are merged with their neighbours as the contact grows.
        let ideal = side.ideal_area_mm2.expect("it has an identity");
        assert!((side.worn_area_mm2 / ideal - 1.0).abs() < 1e-3, "{side:?}");
    }
    let extent = last.extent.expect("it has an extent");
    assert!((extent.dissipated_energy_mj / (0.3 * work) - 1.0).abs() < 1e-10);
    let line = last.slider.ideal_area_mm2.expect("it wears") / GOLD * 0.3;
    assert!((last.dissipated_energy_mj_per_mm / line - 1.0).abs() < 1e-10);
    assert!(found.checks.force_balance < 1e-12 && found.checks.worn_area < 1e-10);
}

/// A short stroke sticks in part, and what slips is less than the whole stroke.
#[test]
fn the_plan_decides_whether_a_ball_may_stick() {
    let plan = |amplitude| effects::plan(&ball(GOLD, GOLD, amplitude, 100));
    assert!(plan(2e-4).simulates(Effect::StickMemory));
    assert!(!plan(0.02).simulates(Effect::StickMemory));
    let loose = done(&ball(GOLD, GOLD, 2e-4, 100));
    let whole = 0.3 * FORCE * 4.0 * 2e-4 * 100.0;
    let energy = loose
        .last
        .extent
        .map_or(0.0, |extent| extent.dissipated_energy_mj);
    println!(
        "ball at 0.2 um: {:.1} % of the energy of gross slip",
        100.0 * energy / whole
    );
    // Mindlin's loop at 0.65 of the onset has about a third; wear has the annulus slip less.
    assert!(energy > 0.0 && energy < 0.7 * whole, "{energy} {whole}");
    println!(
        "ball at 0.2 um: shear beyond mu p {:.1e} of the peak",
        loose.checks.friction_cone
    );
}

/// Springs of a ball on a flat that wears, against a solution of the same contact that shares no code with the engine: 2.3197e-7 and 2.1348e-7
/// mm^3 after 1 000 cycles with 100 and 1 000 N/mm, 0.4844 and 0.398 N at the neutral position.
#[test]
fn springs_of_a_ball_lose_the_load_of_an_independent_solution() {
    let sprung = |spring: f64, amplitude: f64| {
        let mut scene = ball(0.0, GOLD, amplitude, 1_000);
        scene.slider.elastic.youngs_modulus_mpa = 131e3;
        scene.slider.elastic.poisson_ratio = 0.3;
        scene.load_n_per_mm = middle_line_load_n_per_mm(&scene);
        scene.spring_n_per_mm2 = spring * scene.load_n_per_mm / FORCE;
        scene
    };
    for (spring, volume, load) in [(100.0, 2.3197e-7, 0.4844), (1_000.0, 2.1348e-7, 0.398)] {
        let found = done(&sprung(spring, 0.02)).last;
        let worn = found.receptacle.worn_volume_mm3.expect("it has a volume");
        let extent = found.extent.expect("it has an extent");
        println!(
            "spring of {spring} N/mm: {worn:.4e} mm^3, {:.4} N",
            extent.load_n
        );
        // The load of an increment is that of the approach before it, which moves the load at a place by what it changes in an increment.
        assert!((worn / volume - 1.0).abs() < 3e-3, "{worn}");
        assert!((extent.load_n / load - 1.0).abs() < 1e-2, "{extent:?}");
    }
    // Stiffer than the contact, 2 E* a = 1 790 N/mm, and with a part that sticks: the load only falls.
    for scene in [sprung(4_000.0, 0.02), sprung(4_000.0, 1e-3)] {
        let (_, recorder) = solve(&scene).expect("it can be solved");
        let loads: Vec<f64> = recorder
            .reports
            .iter()
            .filter_map(|report| Some(report.extent?.load_n))
            .collect();
        // An increment beside another one of the stroke has a little more or less.
        assert!(
            loads.windows(2).all(|pair| pair[1] < 1.02 * pair[0]),
            "{loads:?}"
        );
        assert!(loads[loads.len() - 1] < 0.98 * loads[0], "{loads:?}");
    }
}

/// The loop of a cycle dissipates what the history says that it did.
#[test]
fn the_loop_of_a_sprung_ball_has_the_energy_of_its_cycle() {
    let mut scene = ball(0.0, GOLD, 0.02, 1_000);
    scene.spring_n_per_mm2 = 1_000.0 * scene.load_n_per_mm / FORCE;
    scene.accuracy.cycle_jump = Some(50);
    let (_, recorder) = solve(&scene).expect("it can be solved");
    let last = &recorder.snapshots.last().expect("a snapshot").friction_loop;
    let points: Vec<(f64, f64)> = last
        .displacement_mm
        .iter()
        .copied()
        .zip(last.tangential_force_n.iter().copied())
        .collect();
    let area = points
        .windows(2)
        .map(|ends| 0.5 * (ends[0].1 + ends[1].1) * (ends[1].0 - ends[0].0));
    let area: f64 = area.sum();
    let energies: Vec<f64> = recorder.reports[recorder.reports.len() - 2..]
        .iter()
        .filter_map(|report| Some(report.extent?.dissipated_energy_mj))
        .collect();
    let energy = (energies[1] - energies[0]) / 50.0;
    println!("loop {area:.5e} mJ, history {energy:.5e} mJ a cycle");
    // Between the neutral position and the turning points the load is not linear.
    assert!((area / energy - 1.0).abs() < 0.03, "{area} {energy}");
}
