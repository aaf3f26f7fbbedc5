//! Heat of friction and current: wear by the hardness and the laws at the temperature of the contact, which the reports state.

use std::ops::ControlFlow;

use crate::verification::recorder::{Recorder, solve};
use crate::verification::scenes::mccoll;
use crate::verification::verify_mission::with_mission;
use crate::verification::verify_resume::resumes_to_the_same_bits;
use solver::SolveError;
use solver::effects::{EffectsPlan, Verdict, plan};
use solver::error_control;
use solver::law::resistance::Deformation;
use solver::observer::{Event, Observer, Phase};
use solver::record::Summary;
use solver::scene::Effect;
use solver::scene::{
    Accuracy, Block, Conduction, Conductor, Electrical, Friction, Metal, MildOxidation, Motion,
    Scene, SpeedLaw, Spots, SurfaceState, Temperature, Timing, WearLaw,
};
use solver::sides::Sides;

/// Distance of both surfaces to their melting temperature, K.
const MARGIN: f64 = 1_400.0;
/// k/H of the receptacle, 1/MPa.
const RATE: f64 = 2.9e-8;

/// McColl's steel on steel with the period of a stroke, whose receptacle alone wears.
fn at_period(period_s: f64, timing: Timing) -> Scene {
    let mut scene = mccoll();
    scene.motion = Motion::Reciprocating {
        amplitude_mm: 0.025,
        period_s,
    };
    scene.timing = timing;
    scene.slider.wear = None;
    scene.cycles = 3_000;
    scene.output.snapshots_at_cycles = vec![3_000];
    scene.accuracy = Accuracy::from_tolerance(0.02);
    let steel = Conductor {
        conductivity_w_mk: 45.0,
        diffusivity_mm2_s: Some(12.0),
    };
    (scene.slider.thermal, scene.receptacle.thermal) = (Some(steel), Some(steel));
    scene.receptacle.softening.margins_k = vec![Some(MARGIN)];
    scene
}

/// Fast enough to heat the contact by some hundred kelvin.
fn fast(timing: Timing) -> Scene {
    at_period(2e-4, timing)
}

fn solved(scene: &Scene) -> (Summary, Recorder) {
    solve(scene).expect("the scene can be solved")
}

fn verdict(plan: &EffectsPlan, effect: Effect) -> Verdict {
    let mut decisions = plan.decisions.iter();
    let decision = decisions.find(|decision| decision.effect == effect);
    decision.expect("every effect is decided").verdict
}

/// The worn area is k P s with the rates of each computed cycle's temperature.
#[test]
fn a_contact_that_friction_heats_wears_by_its_temperature() {
    for timing in [Timing::Triangle, Timing::Sine] {
        let scene = fast(timing.clone());
        assert_eq!(
            verdict(&plan(&scene), Effect::FrictionalHeating),
            Verdict::Simulated
        );
        let (_, heated) = solved(&scene);
        let mut cold = scene.clone();
        cold.effects = cold.effects.with(Effect::FrictionalHeating, false);
        let (_, cold) = solved(&cold);
        let pairs = heated.reports.windows(2);
        let (mut ideal, mut hottest) = (0.0, 0.0_f64);
        for pair in pairs {
            let temperature = pair[1].temperature.expect("it is computed");
            let rise = temperature.contact_temperature_c - scene.temperature_c;
            let distance = pair[1].sliding_distance_mm - pair[0].sliding_distance_mm;
            ideal += RATE / (1.0 - rise / MARGIN) * scene.load_n_per_mm * distance;
            hottest = hottest.max(rise);
        }
        let last = |run: &Recorder| {
            run.reports
                .last()
                .expect("a report")
                .receptacle
                .worn_area_mm2
        };
        let distance = cold.reports.last().expect("a report").sliding_distance_mm;
        let share = last(&cold) / (RATE * scene.load_n_per_mm * distance);
        // Slip that is lost at the turning points is lost with and without heat.
        let error = last(&heated) / (ideal * share) - 1.0;
        println!(
            "heated by {hottest:.0} K at most, {timing:?}: worn area {:.3} of the cold one, {:.2} % from that of its temperatures",
            last(&heated) / last(&cold),
            100.0 * error
        );
        assert!(last(&heated) > 1.1 * last(&cold));
        assert!(error.abs() < 5e-3, "{error}");
        assert!(
            cold.reports
                .iter()
                .all(|report| report.temperature.is_none())
        );
    }
}

#[test]
fn slow_contacts_stay_cold_and_nothing_of_the_heat_runs() {
    let slow = at_period(1.0, Timing::Sine);
    let decided = plan(&slow);
    assert_eq!(
        verdict(&decided, Effect::FrictionalHeating),
        Verdict::Skipped
    );
    let mut unknown = slow.clone();
    (unknown.slider.thermal, unknown.receptacle.thermal) = (None, None);
    assert_eq!(solved(&slow).1.reports, solved(&unknown).1.reports);
}

/// A block of some milliseconds is not as warm as a long run, and leaves nothing in the next one.
#[test]
fn a_short_block_of_a_mission_is_warmed_by_its_own_time() {
    let scene = fast(Timing::Triangle);
    let slow = Motion::Reciprocating {
        amplitude_mm: 0.025,
        period_s: 1.0,
    };
    let blocks = [scene.motion, slow].map(|motion| Block {
        motion,
        timing: Timing::Triangle,
        cycles: 20,
    });
    let run = |repeat| {
        let mission = with_mission(scene.clone(), &blocks, repeat);
        let (_, run) = solved(&mission);
        let temperatures = run.reports[1..].iter().map(|report| {
            let temperature = report.temperature.expect("it is computed");
            temperature.contact_temperature_c - scene.temperature_c
        });
        temperatures.collect::<Vec<_>>()
    };
    let rises = run(3);
    let warmest = rises.iter().copied().fold(0.0, f64::max);
    let coldest = rises.iter().copied().fold(f64::INFINITY, f64::min);
    let long = solved(&scene)
        .1
        .reports
        .last()
        .and_then(|report| report.temperature);
    let steady = long.expect("it is computed").contact_temperature_c - scene.temperature_c;
    println!(
        "blocks of 4 ms and 20 s: {warmest:.0} and {coldest:.2} K, a run of 0.6 s ends at {steady:.0} K"
    );
    assert!(warmest < steady && warmest > 20.0, "{warmest} {steady}");
    assert!(coldest < 0.2, "{coldest}");
}

#[test]
fn a_heated_run_resumes_to_the_same_bits() {
    let mut scene = fast(Timing::Sine);
    scene.cycles = 400;
    scene.output.snapshots_at_cycles.clear();
    resumes_to_the_same_bits("heated by friction", &scene, 2);
}

/// Counts how often a run begins to integrate, at first and after it has gone back.
#[derive(Default)]
struct Beginnings(usize);

impl Observer for Beginnings {
    fn on(&mut self, _: Event<'_>) -> ControlFlow<()> {
        ControlFlow::Continue(())
    }

    fn on_phase(&mut self, phase: Phase) {
        self.0 += usize::from(phase == Phase::Cycles);
    }
}

/// A material that melts ends the run with the temperatures.
#[test]
fn a_contact_that_melts_is_reported() {
    let mut scene = fast(Timing::Sine);
    // The slider melts although it does not wear.
    scene.slider.softening.to_melting_k = Some(1.0);
    // An effect that is skipped would not keep it from melting, so that the run does not go back for one.
    scene.friction = Friction::Coulomb { coefficient: 0.02 };
    scene.receptacle.softening.margins_k = vec![Some(2.0)];
    scene.cycles = 100;
    let decided = plan(&scene);
    assert_eq!(verdict(&decided, Effect::Friction), Verdict::Skipped);
    assert_eq!(
        verdict(&decided, Effect::FrictionalHeating),
        Verdict::Simulated
    );
    let mut beginnings = Beginnings::default();
    let error = error_control::solve(&scene, &mut beginnings).expect_err("it melts");
    assert_eq!(beginnings.0, 1);
    assert!(matches!(error, SolveError::Cycle(_)));
    assert!(
        error.to_string().contains("a material of it melts"),
        "{error}"
    );
}

/// The temperature enters oxidational laws that state none of their own, and no other.
#[test]
fn an_oxide_grows_at_the_temperature_of_the_contact() {
    let law = |temperature| {
        WearLaw::OfSpeed(SpeedLaw::MildOxidation(MildOxidation {
            constant: 3.4e-4,
            arrhenius_m2_s: 1e12,
            activation_j_mol: 138e3,
            film_um: 10.0,
            surface: SurfaceState {
                hardness_mpa: 6_865.0,
                temperature,
            },
        }))
    };
    let mut scene = fast(Timing::Triangle);
    scene.cycles = 1_000;
    scene.receptacle.softening.margins_k = vec![None];
    let area = |scene: &Scene| {
        let (_, run) = solved(scene);
        run.reports
            .last()
            .expect("a report")
            .receptacle
            .worn_area_mm2
    };
    scene.receptacle.wear = Some(law(Temperature::OfSurroundings(700.0)));
    let warm = area(&scene);
    scene.receptacle.wear = Some(law(Temperature::OfContact(700.0)));
    let given = area(&scene);
    assert_eq!(
        verdict(&plan(&scene), Effect::FrictionalHeating),
        Verdict::Skipped
    );
    assert!(warm > 2.0 * given, "{warm} {given}");
}

/// A contact of copper that a current heats, at a speed at which friction does not.
fn conducting(current_a: f64) -> Scene {
    let mut scene = at_period(1.0, Timing::Sine);
    let metal = Metal {
        bottom_mm: f64::INFINITY,
        resistivity_ohm_m: 1.7e-7,
        hardness_mpa: 1_700.0,
        film: None,
    };
    scene.conduction = Conduction::Known(Box::new(Electrical {
        width_mm: 0.05,
        metals: Sides {
            slider: vec![metal],
            receptacle: vec![metal],
        },
        spots: Spots {
            count: 1,
            cluster_diameter_mm: 0.0,
            deformation: Deformation::Plastic,
        },
        frequency_hz: None,
        current_a: Some(current_a),
        stop_mohm: Vec::new(),
        life_mohm: Vec::new(),
    }));
    scene
}

#[test]
fn a_current_heats_the_constriction_by_its_voltage() {
    let weak = conducting(0.1);
    assert_eq!(
        verdict(&plan(&weak), Effect::JouleHeating),
        Verdict::Skipped
    );
    let strong = conducting(12.0);
    assert_eq!(
        verdict(&plan(&strong), Effect::JouleHeating),
        Verdict::Simulated
    );
    let (_, run) = solved(&strong);
    let (first, last) = (&run.reports[0], run.reports.last().expect("a report"));
    let resistance = first.resistance.expect("it is computed");
    let constriction =
        resistance.slider_constriction_mohm + resistance.receptacle_constriction_mohm;
    // T^2 - T0^2 = V^2/(4 L).
    let voltage = 1e-3 * constriction * 12.0;
    let surroundings = strong.temperature_c + 273.15;
    let contact = (surroundings.powi(2) + voltage.powi(2) / (4.0 * 2.44e-8)).sqrt();
    let found = last
        .temperature
        .expect("it is computed")
        .contact_temperature_c
        + 273.15;
    assert!((found / contact - 1.0).abs() < 1e-9, "{found} {contact}");
    let cold = solved(&weak).1;
    let ratio = last.receptacle.worn_area_mm2
        / cold
            .reports
            .last()
            .expect("a report")
            .receptacle
            .worn_area_mm2;
    let expected = 1.0 / (1.0 - (contact - surroundings) / MARGIN);
    println!(
        "12 A heat the contact to {contact:.0} K: {ratio:.4} of the cold wear, {expected:.4} by its hardness"
    );
    assert!(
        (ratio / expected - 1.0).abs() < 5e-3 && ratio > 1.02,
        "{ratio} {expected}"
    );
}
