//! The cases of the benchmark.

use std::ops::ControlFlow;

use solver::SolveError;
use solver::condensation::{self, Condensed};
use solver::cycle::{CycleState, Integrator};
use solver::model::{self, Model};
use solver::scene::Scene;

use crate::bench::{BenchError, Row, measured};
use crate::solve;
use crate::spec;

pub(super) const MCCOLL: &str = include_str!("../../examples/mccoll.json");
pub(super) const FUZZ_BUTTON: &str = include_str!("../../examples/fuzz_button.json");

/// Target numbers of unknowns of both bodies for the condensation.
const CONDENSED: [f64; 3] = [5e3, 20e3, 50e3];
/// Numbers of nodes in contact for the increments.
const ACTIVE: [u32; 3] = [20, 50, 150];
/// Hertz half-width of `mccoll.json`, mm, from which element sizes are derived.
const HERTZ: f64 = 0.03586;
/// Contact elements, mm, and numbers of cycles of the scaling cases.
const ELEMENTS: [f64; 3] = [0.02, 0.01, 0.005];
const CYCLES: [u64; 3] = [2_000, 6_000, 18_000];

/// A case: its name and its measurement.
pub type Case = (&'static str, fn() -> Result<Vec<Row>, BenchError>);

/// All cases, in the order of the table.
pub fn all() -> Vec<Case> {
    vec![
        ("condensation", condensations),
        ("increments", increments),
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
        ("scaling with elements", scaling_with_elements),
        ("scaling with cycles", scaling_with_cycles),
    ]
}

/// The cylinder of *Other codes on the same work* (README.md): R = 6 mm on a block of 12 x 6 mm, 185 N/mm, mu = 0.8, +-25 um, no
/// wear, elements of 10 um.
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

/// Returns a scene with changed settings.
pub(super) fn scene(spec: &str, change: impl FnOnce(&mut Scene)) -> Result<Scene, BenchError> {
    let mut scene = spec::read(spec.as_bytes())?.scene;
    change(&mut scene);
    Ok(scene)
}

fn condensed(scene: &Scene) -> Result<(Model, Condensed), SolveError> {
    let model = model::build(scene, &solver::effects::plan(scene))?;
    let condensed = condensation::condense(&model)?;
    Ok((model, condensed))
}

fn condensations() -> Result<Vec<Row>, BenchError> {
    let mut rows = Vec::new();
    for target in CONDENSED {
        let scene = sized(target)?;
        let model =
            model::build(&scene, &solver::effects::plan(&scene)).map_err(SolveError::from)?;
        let (cpu_s, _) =
            measured(3, || condensation::condense(&model)).map_err(SolveError::from)?;
        let surface =
            2 * (model.bodies.slider.contact_x().len() + model.bodies.receptacle.contact_x().len());
        let dofs = model.bodies.slider.dofs() + model.bodies.receptacle.dofs();
        rows.push(Row {
            what: "condensation of two bodies".to_owned(),
            size: format!("{dofs} DOF, {surface} of them on the surfaces"),
            cpu_s,
        });
    }
    Ok(rows)
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
        let scene = at(middle)?;
        let too_many = match model::build(&scene, &solver::effects::plan(&scene)) {
            Ok(model) => {
                count(model.bodies.slider.dofs() + model.bodies.receptacle.dofs()) > target
            }
            Err(_) => true,
        };
        *(if too_many { &mut fine } else { &mut coarse }) = middle;
    }
    at(coarse)
}

fn increments() -> Result<Vec<Row>, BenchError> {
    let mut rows = Vec::new();
    for active in ACTIVE {
        let scene = scene(MCCOLL, |scene| {
            scene.accuracy.contact_element_mm = Some(2.0 * HERTZ / f64::from(active));
            scene.accuracy.increments_per_cycle = Some(40);
            scene.accuracy.cycle_jump = Some(1);
            // Few cycles keep the scar, and so the mesh, as small as the contact.
            scene.cycles = 10;
        })?;
        let (_, cycle_s, increments) = time_cycle(&scene)?;
        rows.push(Row {
            what: "contact increment with wear of both sides".to_owned(),
            size: format!("{active} nodes in contact"),
            cpu_s: cycle_s / increments,
        });
    }
    Ok(rows)
}

/// Returns the seconds of the set-up and of one cycle, and the increments of the cycle.
fn time_cycle(scene: &Scene) -> Result<(f64, f64, f64), BenchError> {
    let (setup_s, (model, condensed)) = measured(3, || condensed(scene))?;
    let operators = &condensed.operators;
    let mut increments = 0;
    let mut best = f64::INFINITY;
    for _ in 0..3 {
        let mut state = CycleState::start(operators);
        let mut integrator = Integrator::new(scene, &model, operators);
        integrator
            .apply_load(&mut state)
            .map_err(SolveError::from)?;
        integrator
            .initial_quarter(&mut state)
            .map_err(SolveError::from)?;
        let before = state.increments;
        let (cycle_s, _) =
            measured(1, || integrator.compute_cycle(&mut state, 1)).map_err(SolveError::from)?;
        best = best.min(cycle_s);
        increments = state.increments - before;
    }
    let increments = f64::from(u32::try_from(increments).unwrap_or(u32::MAX));
    Ok((setup_s, best, increments))
}

fn friction_cycle() -> Result<Vec<Row>, BenchError> {
    let scene = scene(CYLINDER, |_| {})?;
    let (setup_s, cycle_s, increments) = time_cycle(&scene)?;
    let row = |what: &str, size: String, cpu_s| Row {
        what: what.to_owned(),
        size,
        cpu_s,
    };
    Ok(vec![
        row(
            "cylinder at 185 N/mm: set-up",
            "elements of 10 um".to_owned(),
            setup_s,
        ),
        row(
            "the same: one friction cycle",
            format!("{increments} increments"),
            cycle_s,
        ),
    ])
}

fn solved(
    what: impl Into<String>,
    size: impl Into<String>,
    scene: &Scene,
) -> Result<Row, BenchError> {
    let summary = solve::run(scene, &mut |_| ControlFlow::Continue(()))?;
    Ok(Row {
        what: what.into(),
        size: format!(
            "{}{} elements, {} computed cycles, {} increments",
            size.into(),
            summary.accuracy.contact_elements,
            summary.accuracy.computed_cycles,
            summary.accuracy.increments,
        ),
        cpu_s: summary.cost.cpu_s,
    })
}

fn reference() -> Result<Vec<Row>, BenchError> {
    let scene = scene(MCCOLL, |scene| {
        scene.accuracy.contact_element_mm = Some(0.01);
        scene.accuracy.increments_per_cycle = Some(40);
        scene.accuracy.cycle_jump = Some(100);
    })?;
    let size = "10 um, 40 increments, jump 100: ";
    Ok(vec![solved(
        "mccoll.json at the reference's resolution",
        size,
        &scene,
    )?])
}

fn mccoll(preset: &str, tolerance: f64) -> Result<Vec<Row>, BenchError> {
    at_preset("mccoll.json", MCCOLL, preset, tolerance)
}

fn fuzz_button(preset: &str, tolerance: f64) -> Result<Vec<Row>, BenchError> {
    at_preset("fuzz_button.json", FUZZ_BUTTON, preset, tolerance)
}

fn at_preset(name: &str, spec: &str, preset: &str, tolerance: f64) -> Result<Vec<Row>, BenchError> {
    let scene = scene(spec, |scene| scene.accuracy.tolerance = tolerance)?;
    Ok(vec![solved(format!("{name}, {preset}"), "", &scene)?])
}

fn scaling_with_elements() -> Result<Vec<Row>, BenchError> {
    let row = |element: f64| {
        let scene = scene(MCCOLL, |scene| {
            scene.accuracy.contact_element_mm = Some(element);
            scene.accuracy.increments_per_cycle = Some(40);
            scene.accuracy.cycle_jump = Some(100);
            scene.cycles = 6_000;
            scene.output.snapshots_at_cycles = Vec::new();
        })?;
        solved(
            "scaling with elements",
            format!("{} um: ", 1e3 * element),
            &scene,
        )
    };
    ELEMENTS.into_iter().map(row).collect()
}

fn scaling_with_cycles() -> Result<Vec<Row>, BenchError> {
    let row = |cycles: u64| {
        let scene = scene(MCCOLL, |scene| {
            scene.accuracy.contact_element_mm = Some(0.02);
            scene.accuracy.increments_per_cycle = Some(40);
            scene.accuracy.cycle_jump = Some(20);
            scene.cycles = cycles;
            scene.output.snapshots_at_cycles = Vec::new();
        })?;
        solved("scaling with cycles", format!("{cycles} cycles: "), &scene)
    };
    CYCLES.into_iter().map(row).collect()
}

fn count(dofs: usize) -> f64 {
    f64::from(u32::try_from(dofs).unwrap_or(u32::MAX))
}

#[cfg(test)]
mod tests {
    use super::*;

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
            let model =
                model::build(&scene, &solver::effects::plan(&scene)).expect("it can be meshed");
            let dofs = count(model.bodies.slider.dofs() + model.bodies.receptacle.dofs());
            assert!(
                (0.8..=1.0).contains(&(dofs / target)),
                "{dofs} for {target}"
            );
        }
    }
}
