//! Requirement: no load wears nothing, a load so small that one node's wear ends the contact goes through, and so does
//! a hundredfold load.
//! Source: contract.md (load); an unloaded spring, a contact at the end of its life, a press fit.
//! Naive: dividing by the load or by the contact width gives NaN; contact that is lost for an instant never returns.

use serde_json::json;

use super::invariants::hold;
use super::run::{Run, solve};
use super::specs::{cylinder, fuzz_button};

fn under(n_per_mm: f64) -> Run {
    solve(&cylinder(
        json!({"load": {"kind": "line_force", "n_per_mm": n_per_mm}, "cycles": 20}),
    ))
}

#[test]
fn without_a_load_nothing_touches_and_nothing_wears() {
    for run in [
        under(0.0),
        solve(&fuzz_button(
            json!({"load": {"kind": "pressure", "mpa": 0}}),
        )),
    ] {
        hold(&run);
        let last = &run.summary().last;
        assert_eq!(last.cycle, run.scene.cycles);
        assert!(run.depth() == 0.0 && last.peak_pressure_mpa == 0.0);
        assert!(last.contact_half_width_mm == 0.0 && last.dissipated_energy_mj_per_mm == 0.0);
    }
}

#[test]
fn a_load_that_barely_touches_wears_its_share() {
    let run = solve(&cylinder(json!({
        "load": {"n_per_mm": 1e-6},
        "motion": {"amplitude_mm": 2e-4},
        "cycles": 20,
    })));
    hold(&run);
    assert!(
        (run.area_ratio() - 1.0).abs() < 0.01,
        "{}",
        run.area_ratio()
    );
}

/// A hundredfold load has a tenfold contact, in which the stroke of 25 um is a partial slip.
#[test]
fn a_hundredfold_load_goes_through() {
    let (one, hundred) = (under(18.5), under(1850.0));
    hold(&hundred);
    let [one_peak, hundred_peak] =
        [&one, &hundred].map(|run| run.summary().initial.peak_pressure_mpa);
    assert!(
        (hundred_peak / one_peak / 10.0 - 1.0).abs() < 0.05,
        "{hundred_peak}"
    );
    assert!(hundred.area_ratio() < one.area_ratio());
}
