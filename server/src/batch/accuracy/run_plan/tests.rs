use api::problem::Fault;

use super::*;

fn machine() -> MachineFigures {
    MachineFigures {
        program: "test".to_owned(),
        increment_s: 2e-4,
        increment_power: 1.7,
        condensation_dof_s: 4e-7,
        condensation_surface_s: 7e-10,
    }
}

/// A specification that is read.
struct Sent {
    sent: Value,
    resolved: Resolved,
}

impl Sent {
    fn read(text: &str) -> Self {
        Self {
            sent: serde_json::from_str(text).expect("JSON"),
            resolved: spec::read(text.as_bytes()).expect("accepted"),
        }
    }

    fn base(&self) -> Base<'_> {
        Base {
            sent: &self.sent,
            resolved: &self.resolved,
        }
    }
}

fn run_plan(budget_s: f64) -> RunPlan {
    let scene = Sent::read(r#"{"system":{"kind":"cylinder_on_flat"},"cycles":300}"#);
    RunPlan::within(scene.base(), &machine(), budget_s, &|_| Ok(())).expect("a run plan")
}

#[test]
fn runs_fit_into_the_budget_and_a_larger_one_makes_more_and_finer_runs() {
    let (small, large) = (run_plan(8.0), run_plan(80.0));
    assert!(expected_s(&small) <= 8.0 && expected_s(&large) <= 80.0);
    assert!(large.runs.len() >= small.runs.len());
    assert!(large.left_out.len() <= small.left_out.len());
    let finest = |plan: &RunPlan| plan.grid.finest().contact_element_mm;
    assert!(finest(&large) <= finest(&small));
}

fn expected_s(plan: &RunPlan) -> f64 {
    plan.runs.iter().map(|run| run.expected_s).sum()
}

#[test]
fn the_coarsest_grid_loses_the_runs_that_do_not_fit() {
    let text =
        r#"{"system":{"kind":"dimm"},"cycles":1000000,"accuracy":{"overrides":{"cycle_jump":1}}}"#;
    let scene = Sent::read(text);
    let within = |budget_s| RunPlan::within(scene.base(), &machine(), budget_s, &|_| Ok(()));
    let plan = within(300.0).expect("some runs fit");
    assert!(expected_s(&plan) <= 300.0, "{}", expected_s(&plan));
    assert!(plan.left_out.len() > 9, "{:?}", plan.left_out);
    let none = within(0.01).map(|plan| plan.runs.len());
    assert!(matches!(none, Err(RunPlanError::TooExpensive { least_s, .. }) if least_s > 0.01));
}

#[test]
fn the_finest_run_of_a_grid_is_accepted() {
    let text = r#"{"system":{"kind":"cylinder_on_flat"},"cycles":300}"#;
    let scene = Sent::read(text);
    let most = 1.5 * Estimate::of(&scene.resolved).footprint.dofs;
    let accept = |run: &Estimate| {
        let fault = || Fault::new("/accuracy", format!("{} unknowns", run.footprint.dofs));
        let small = run.footprint.dofs <= most;
        small
            .then_some(())
            .ok_or_else(|| Refused::Faults(vec![fault()]))
    };
    let plan = RunPlan::within(scene.base(), &machine(), 8e4, &accept).expect("some runs");
    let finest = RunAccuracy::Fixed(plan.grid.finest());
    assert!(plan.runs.iter().any(|run| run.accuracy == finest));
    assert!(
        plan.runs
            .iter()
            .all(|run| run.estimate.footprint.dofs <= most)
    );
    let reported = |line: &String| line.starts_with("tolerance") && line.ends_with("unknowns");
    assert!(plan.left_out.iter().any(reported), "{:?}", plan.left_out);
    let refused = RunPlan::within(scene.base(), &machine(), 8e4, &|_| {
        Err(Refused::Faults(vec![Fault::new("/output", "too much")]))
    });
    assert!(matches!(refused, Err(RunPlanError::Refused(_))));
}

#[test]
fn a_grid_that_fits_but_cannot_be_meshed_is_made_coarser() {
    let text = r#"{"system":{"kind":"fuzz_button"},"accuracy":{"preset":"fine"}}"#;
    let scene = Sent::read(text);
    let plan = RunPlan::within(scene.base(), &machine(), 86_400.0, &|_| Ok(())).expect("some runs");
    let finest = RunAccuracy::Fixed(plan.grid.finest());
    assert!(plan.runs.iter().any(|run| run.accuracy == finest));
}

#[test]
fn sections_of_a_line_are_varied_and_bodies_of_a_width_keep_their_layers() {
    let plan = |model: &str| {
        let text = format!(
            r#"{{"system":{{"kind":"sd_card"}},"model":{model},"load":{{"kind":"force","n":0.5}},"cycles":300}}"#
        );
        let scene = Sent::read(&text);
        RunPlan::within(scene.base(), &machine(), 8e4, &|_| Ok(())).expect("some runs")
    };
    let line = plan(r#"{"dimension":"line","width_mm":0.8,"crown_radius_mm":10}"#);
    let levels = |run: &PlannedRun| match run.accuracy {
        RunAccuracy::Fixed(settings) => settings.stations,
        RunAccuracy::Tolerance(_) => None,
    };
    let levels: std::collections::BTreeSet<u32> = line.runs.iter().filter_map(levels).collect();
    let levels = Vec::from_iter(levels);
    assert_eq!(levels.len(), 3, "{levels:?}");
    assert_eq!(levels[2] - 1, 4 * (levels[0] - 1), "{levels:?}");
    assert!(
        line.left_out.iter().all(|line| line.contains("about")),
        "{:?}",
        line.left_out
    );
    let extruded = plan(r#"{"dimension":"extruded","width_mm":0.8}"#);
    let settings = extruded
        .runs
        .iter()
        .map(|run| run.accuracy.as_spec().overrides);
    assert!(
        settings
            .flatten()
            .all(|overrides| overrides.stations.is_none())
    );
}

#[test]
fn runs_differ_in_their_accuracy_alone() {
    let plan = run_plan(8.0);
    for run in &plan.runs {
        let spec = &run.resolved.spec;
        assert_eq!((spec.cycles, spec.output.fields), (Some(300), Some(false)));
        assert_eq!(spec.output.snapshots_at_cycles.as_deref(), Some(&[300][..]));
        match run.accuracy {
            RunAccuracy::Tolerance(tolerance) => {
                assert_eq!(spec.accuracy.tolerance, Some(tolerance));
            }
            RunAccuracy::Fixed(settings) => {
                let overrides = spec.accuracy.overrides.as_ref().expect("overrides");
                let element = overrides.contact_element_mm;
                assert_eq!(element, Some(settings.contact_element_mm));
            }
        }
    }
}

#[test]
fn values_that_the_base_leaves_to_their_defaults_are_not_given_by_a_run() {
    let of_kind = |kind: &str| format!(r#"{{"system":{{"kind":"{kind}"}},"cycles":30}}"#);
    for kind in ["dimm", "sd_card"] {
        let base = Sent::read(&of_kind(kind));
        let plan = RunPlan::within(base.base(), &machine(), 80.0, &|_| Ok(())).expect("some runs");
        for run in &plan.runs {
            let own = |pointer: &str| {
                ["/accuracy", "/output"]
                    .iter()
                    .any(|part| pointer.starts_with(part))
            };
            let of_spec = |spec: &api::spec::Spec| {
                let mut provenance = spec.provenance.clone();
                provenance.retain(|pointer, _| !own(pointer));
                provenance
            };
            assert_eq!(of_spec(&run.resolved.spec), of_spec(&base.resolved.spec));
            let read = spec::read(run.sent.as_bytes()).expect("accepted");
            assert_eq!(read, run.resolved);
        }
    }
}
