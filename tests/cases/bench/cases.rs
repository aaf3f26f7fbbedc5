//! The cases of the benchmark.

use std::ops::ControlFlow;

use server::solve;
use server::spec;
use server::spec::Resolved;
use solver::SolveError;
use solver::condensation::{self, Condensed};
use solver::cycle::{CycleState, Integrator};
use solver::model::{self, Model};
use solver::scene::{Friction, Motion, Scene, WearLaw};

use crate::bench::{BenchError, Row, measured, real};

pub(super) const MCCOLL: &str = include_str!("../../../server/examples/mccoll.json");
pub(super) const FUZZ_BUTTON: &str = include_str!("../../../server/examples/fuzz_button.json");

/// Target numbers of unknowns of both bodies for the condensation.
const CONDENSED: [f64; 3] = [5e3, 20e3, 50e3];
/// Numbers of nodes in contact for the increments.
const ACTIVE: [u32; 3] = [20, 50, 150];
/// The same in partial slip.
const IN_PARTIAL_SLIP: [u32; 5] = [160, 320, 640, 1_280, 2_000];
/// Hertz half-width of the cylinder of `mccoll.json` under 120 N/mm, mm.
const HERTZ_120: f64 = 0.0913;
/// Hertz half-width of `mccoll.json`, mm, from which element sizes are derived.
const HERTZ: f64 = 0.03586;
/// Contact elements, mm, and numbers of cycles of the scaling cases.
const ELEMENTS: [f64; 3] = [0.02, 0.01, 0.005];
const CYCLES: [u64; 3] = [2_000, 6_000, 18_000];

/// A case: its name and its measurement.
pub(super) type Case = (&'static str, fn() -> Result<Vec<Row>, BenchError>);

/// All cases, in the order of the table.
pub(super) fn all() -> Vec<Case> {
    vec![
        ("condensation", condensations),
        ("increments", increments),
        ("increments in partial slip", increments_in_partial_slip),
        ("friction cycle", friction_cycle),
        ("mccoll.json at the reference's resolution", reference),
        ("mccoll.json, draft", || mccoll("draft", 0.1)),
        ("mccoll.json, standard", || mccoll("standard", 0.02)),
        ("mccoll.json, fine", || mccoll("fine", 0.003)),
        ("fuzz_button.json, draft", || fuzz_button("draft", 0.1)),
        ("fuzz_button.json, standard", || {
            fuzz_button("standard", 0.02)
        }),
        ("fuzz_button.json, fine: minutes", || {
            fuzz_button("fine", 0.003)
        }),
        ("10 000 matings, draft", || matings("draft", 0.1)),
        ("10 000 matings, standard", || matings("standard", 0.02)),
        ("scaling with elements", scaling_with_elements),
        ("scaling with cycles", scaling_with_cycles),
    ]
}

/// The cylinder of docs/guide/accuracy.md: R = 6 mm on a block of 12 x 6 mm, 185 N/mm, mu = 0.8,
/// +-25 um, no wear, elements of 10 um.
pub(super) const CYLINDER: &str = r#"{
  "system": {"kind": "cylinder_on_flat", "radius_mm": 6.0, "flat_length_mm": 12.0, "flat_height_mm": 6.0},
  "materials": {
    "slider": {"youngs_modulus_mpa": 200000, "poisson_ratio": 0.3},
    "receptacle": {"youngs_modulus_mpa": 200000, "poisson_ratio": 0.3}
  },
  "interface": {
    "friction": {"law": "coulomb", "coefficient": 0.8},
    "wear": {"slider": null, "receptacle": null}
  },
  "load": {"kind": "line_force", "n_per_mm": 185},
  "motion": {"kind": "reciprocating", "waveform": "triangle", "amplitude_mm": 0.025, "frequency_hz": 20, "drive": "slider_top"},
  "cycles": 1,
  "accuracy": {"preset": "standard", "overrides": {"contact_element_mm": 0.01, "increments_per_cycle": 32}}
}"#;

/// A memory card's contacts, a wipe of 1.5 mm.
const MATINGS: &str = r#"{
  "system": {"kind": "sd_card"},
  "motion": {"kind": "insertion", "wipe_mm": 1.5},
  "cycles": 10000
}"#;

/// Returns a scene with changed settings.
pub(super) fn scene(spec: &str, change: impl FnOnce(&mut Scene)) -> Result<Scene, BenchError> {
    Ok(resolved(spec, change)?.scene)
}

/// Returns a specification whose scene has changed settings.
fn resolved(spec: &str, change: impl FnOnce(&mut Scene)) -> Result<Resolved, BenchError> {
    let mut resolved = spec::read(spec.as_bytes())?;
    resolved.scene.accuracy.estimate_errors = false;
    change(&mut resolved.scene);
    Ok(resolved)
}

/// Fixes the settings that are otherwise chosen from the tolerance.
fn fix(scene: &mut Scene, element_mm: f64, increments: u32, jump: u64) {
    scene.accuracy.contact_element_mm = Some(element_mm);
    scene.accuracy.increments_per_cycle = Some(increments);
    scene.accuracy.cycle_jump = Some(jump);
}

fn build(scene: &Scene) -> Result<Model, SolveError> {
    Ok(model::build(scene, &solver::effects::plan(scene))?)
}

/// Builds and condenses a scene; with the processor seconds of both.
pub(super) fn set_up(scene: &Scene) -> Result<(f64, (Model, Condensed)), SolveError> {
    measured(3, || {
        let model = build(scene)?;
        let condensed = condensation::condense(&model, 1)?;
        Ok((model, condensed))
    })
}

fn row(what: impl Into<String>, size: String, cpu_s: f64) -> Row {
    Row {
        what: what.into(),
        size,
        cpu_s,
    }
}

fn condensations() -> Result<Vec<Row>, BenchError> {
    let condensation = |target: f64| {
        let model = build(&sized(target)?)?;
        let condense = || condensation::condense(&model, 1).map_err(SolveError::from);
        let (cpu_s, _) = measured(3, condense)?;
        let bodies = &model.bodies;
        let surface = 2 * (bodies.slider.contact_x().len() + bodies.receptacle.contact_x().len());
        let size = format!("{} DOF, {surface} of them on the surfaces", dofs(&model));
        Ok(row("condensation of two bodies", size, cpu_s))
    };
    CONDENSED.into_iter().map(condensation).collect()
}

/// Returns McColl's scene with about so many unknowns: bisects the element size.
fn sized(target: f64) -> Result<Scene, BenchError> {
    let (mut fine, mut coarse) = (1e-3_f64, 1e-1_f64);
    let at = |element: f64| {
        scene(MCCOLL, |scene| {
            scene.accuracy.contact_element_mm = Some(element);
        })
    };
    for _ in 0..12 {
        let middle = (fine * coarse).sqrt();
        let is_too_fine = !build(&at(middle)?).is_ok_and(|model| real(dofs(&model)) <= target);
        *(if is_too_fine { &mut fine } else { &mut coarse }) = middle;
    }
    at(coarse)
}

fn increments() -> Result<Vec<Row>, BenchError> {
    let increment = |active: u32| {
        let scene = scene(MCCOLL, |scene| {
            fix(scene, 2.0 * HERTZ / f64::from(active), 40, 1);
            // Few cycles keep the scar, and so the mesh, as small as the contact.
            scene.cycles = 10;
        })?;
        let (_, cycle_s, increments) = time_cycle(&scene)?;
        let size = format!("{active} nodes in contact");
        let what = "contact increment with wear of both sides";
        Ok(row(what, size, cycle_s / increments))
    };
    ACTIVE.into_iter().map(increment).collect()
}

/// A cylinder of 6 mm under 120 N/mm that wears the flat, +-1.2 um: four fifths of its contact stick.
fn increments_in_partial_slip() -> Result<Vec<Row>, BenchError> {
    let increment = |active: u32| {
        let scene = scene(MCCOLL, |scene| {
            fix(scene, 2.0 * HERTZ_120 / f64::from(active), 20, 2);
            scene.cycles = 10;
            scene.load_n_per_mm = 120.0;
            scene.friction = Friction::Coulomb { coefficient: 0.6 };
            scene.motion = Motion::Reciprocating {
                amplitude_mm: 0.0012,
                period_s: 1.0,
            };
            scene.slider.wear = None;
            scene.receptacle.wear = Some(WearLaw::Archard {
                k_over_h_per_mpa: 3e-6,
            });
        })?;
        let (_, cycle_s, increments) = time_cycle(&scene)?;
        let size = format!("{active} nodes in contact");
        Ok(row(
            "contact increment in partial slip",
            size,
            cycle_s / increments,
        ))
    };
    IN_PARTIAL_SLIP.into_iter().map(increment).collect()
}

/// Returns the seconds of the set-up and of one cycle, and the increments of the cycle.
fn time_cycle(scene: &Scene) -> Result<(f64, f64, f64), SolveError> {
    let (setup_s, (model, condensed)) = set_up(scene)?;
    let operators = &condensed.operators;
    let mut increments = 0;
    let mut best = f64::INFINITY;
    for _ in 0..3 {
        let mut state = CycleState::start(operators, model.interface.slave);
        let mut integrator = Integrator::new(scene, &model, operators);
        integrator.apply_load(&mut state)?;
        integrator.initial_quarter(&mut state)?;
        let before = state.work.increments;
        // Short of its stop, so that the loop has no points besides the increments.
        let (cycle_s, _) = measured(1, || integrator.compute_cycle(&mut state, 2, true))?;
        best = best.min(cycle_s);
        increments = state.work.increments - before;
    }
    Ok((setup_s, best, real(increments)))
}

fn friction_cycle() -> Result<Vec<Row>, BenchError> {
    let scene = scene(CYLINDER, |_| {})?;
    let (setup_s, cycle_s, increments) = time_cycle(&scene)?;
    let (mesh, cycle) = ("elements of 10 um", format!("{increments} increments"));
    Ok(vec![
        row("cylinder at 185 N/mm: set-up", mesh.to_owned(), setup_s),
        row("the same: one friction cycle", cycle, cycle_s),
    ])
}

fn solved(what: impl Into<String>, size: &str, case: &Resolved) -> Result<Row, BenchError> {
    let summary = solve::run(case.into(), &mut |_| ControlFlow::Continue(()))?;
    let size = format!(
        "{size}{} elements, {} computed cycles, {} increments",
        summary.accuracy.contact_elements,
        summary.accuracy.computed_cycles,
        summary.accuracy.increments,
    );
    Ok(row(what, size, summary.cost.cpu_s))
}

fn reference() -> Result<Vec<Row>, BenchError> {
    let case = resolved(MCCOLL, |scene| fix(scene, 0.01, 40, 100))?;
    let size = "10 um, 40 increments, jump 100: ";
    let what = "mccoll.json at the reference's resolution";
    Ok(vec![solved(what, size, &case)?])
}

fn mccoll(preset: &str, tolerance: f64) -> Result<Vec<Row>, BenchError> {
    at_preset("mccoll.json", MCCOLL, preset, tolerance)
}

fn fuzz_button(preset: &str, tolerance: f64) -> Result<Vec<Row>, BenchError> {
    at_preset("fuzz_button.json", FUZZ_BUTTON, preset, tolerance)
}

fn matings(preset: &str, tolerance: f64) -> Result<Vec<Row>, BenchError> {
    at_preset("10 000 matings", MATINGS, preset, tolerance)
}

fn at_preset(name: &str, spec: &str, preset: &str, tolerance: f64) -> Result<Vec<Row>, BenchError> {
    let case = resolved(spec, |scene| scene.accuracy.tolerance = tolerance)?;
    Ok(vec![solved(format!("{name}, {preset}"), "", &case)?])
}

fn scaling_with_elements() -> Result<Vec<Row>, BenchError> {
    let row = |element: f64| {
        let case = scaled(element, 100, 6_000)?;
        let size = format!("{} um: ", 1e3 * element);
        solved("scaling with elements", &size, &case)
    };
    ELEMENTS.into_iter().map(row).collect()
}

fn scaling_with_cycles() -> Result<Vec<Row>, BenchError> {
    let row = |cycles: u64| {
        let case = scaled(0.02, 20, cycles)?;
        solved("scaling with cycles", &format!("{cycles} cycles: "), &case)
    };
    CYCLES.into_iter().map(row).collect()
}

/// Returns McColl's specification without snapshots.
fn scaled(element_mm: f64, jump: u64, cycles: u64) -> Result<Resolved, BenchError> {
    resolved(MCCOLL, |scene| {
        fix(scene, element_mm, 40, jump);
        scene.cycles = cycles;
        scene.output.snapshots_at_cycles = Vec::new();
    })
}

fn dofs(model: &Model) -> usize {
    model.bodies.slider.dofs() + model.bodies.receptacle.dofs()
}

#[test]
fn a_friction_cycle_has_32_increments() {
    let scene = scene(CYLINDER, |_| {}).expect("the specification is sound");
    let (setup_s, cycle_s, increments) = time_cycle(&scene).expect("it can be solved");
    assert!(setup_s > 0.0 && cycle_s > 0.0);
    assert!((increments - 32.0).abs() < 1e-9, "{increments}");
}

#[test]
fn meshes_of_the_condensation_have_the_target_size() {
    for target in CONDENSED {
        let scene = sized(target).expect("a size is found");
        let dofs = real(dofs(&build(&scene).expect("it can be meshed")));
        assert!(
            (0.8..=1.0).contains(&(dofs / target)),
            "{dofs} for {target}"
        );
    }
}
