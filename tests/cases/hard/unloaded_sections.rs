//! Requirement: sections of a tilted or a crowned line that do not touch carry nothing, and touch later as the others wear.
//! Source: three_d.md 8; a spring of 0.8 mm under 0.5 N. A tilt is that of its mirror image.
//! Naive: a section without contact has a singular matrix or a negative load; a code that places sections about the one that touches first
//! divides by the length of nothing where that is an end of the line, or counts its sections twice.

use serde_json::{Value, json};
use solver::record::CycleReport;

use super::invariants::across::hold;
use super::run::{Run, solve};
use super::specs::spring;

const FORCE: f64 = 0.5;
const WIDTH: f64 = 0.8;

fn line(model: &Value, changes: Value) -> Run {
    let mut line = json!({"dimension": "line", "width_mm": WIDTH});
    for (name, value) in model.as_object().expect("fields") {
        line[name] = value.clone();
    }
    let run = solve(&spring(line, changes));
    hold(&run);
    run
}

fn loads(report: &CycleReport) -> Vec<f64> {
    let stations = report.stations.iter();
    stations.map(|station| station.line_load_n_per_mm).collect()
}

/// The force of all sections, N.
fn carried(report: &CycleReport) -> f64 {
    let stations = report.stations.iter();
    stations
        .map(|station| station.weight_mm * station.line_load_n_per_mm)
        .sum()
}

/// The ends that rise by 0.8 um never touch: the approach is 0.1 um.
#[test]
fn a_tilted_line_rests_on_its_lower_end() {
    for top in ["rigid", "even"] {
        let [up, down] = [1.0, -1.0].map(|tilt| {
            let run = line(&json!({"tilt_mrad": tilt, "top": top}), json!({}));
            let length: f64 = run.reports[0].stations.iter().map(|at| at.weight_mm).sum();
            assert!(
                (length / WIDTH - 1.0).abs() < 1e-9,
                "{top}, {tilt}: {length} mm"
            );
            assert!((carried(&run.reports[0]) / FORCE - 1.0).abs() < 1e-4);
            run
        });
        let (up_loads, mut down_loads) = (loads(&up.reports[0]), loads(&down.reports[0]));
        down_loads.reverse();
        let most = up_loads.iter().fold(0.0, |most: f64, load| most.max(*load));
        for (one, other) in up_loads.iter().zip(&down_loads) {
            // To the balance of the forces.
            assert!(
                (one - other).abs() < 1e-4 * most,
                "{up_loads:?} {down_loads:?}"
            );
        }
        if top == "rigid" {
            let last = up_loads.last().expect("sections");
            assert!(*last <= 0.0 && up_loads[0] > 0.0, "{up_loads:?}");
        }
        let volumes = [&up, &down].map(|run| run.summary().last.receptacle.worn_volume_mm3);
        let [one, other] = volumes.map(|volume| volume.expect("a volume"));
        assert!((one / other - 1.0).abs() < 1e-4, "{one} {other}");
    }
}

/// Of 0.8 mm less than 2 um touch.
#[test]
fn the_steepest_tilt_rests_on_its_edge() {
    for tilt in [100.0, -100.0] {
        let run = line(
            &json!({"tilt_mrad": tilt}),
            json!({"cycles": 20, "load": {"n": 0.002}}),
        );
        let at_once = loads(&run.reports[0]);
        assert!(at_once.iter().filter(|load| **load > 0.0).count() < at_once.len() / 2);
    }
}

/// A hundredfold wear takes the end into contact that the crown lifts by 0.08 um.
#[test]
fn an_end_that_a_crown_lifts_touches_as_the_middle_is_worn() {
    let wear = json!({"law": "archard", "k_over_h_per_mpa": 5.9e-7});
    let changes = json!({"interface": {"wear": {"receptacle": wear}}, "cycles": 1000});
    let run = line(&json!({"crown_radius_mm": 1000}), changes);
    let (first, last) = (loads(&run.reports[0]), loads(&run.summary().last));
    let end = first.len() - 1;
    assert!(first[end] <= 0.0, "{first:?}");
    assert!(last[end] > 0.5 * FORCE / WIDTH, "{last:?}");
}
