//! Requirement: no load is refused, a load so small that one node's wear ends the contact goes through, and so does
//! a hundredfold load.
//! Source: contract.md (load); an unloaded spring, a contact at the end of its life, a press fit.
//! Naive: dividing by the load or by the contact width gives NaN; contact that is lost for an instant never returns.

use serde_json::json;
use server::spec::{self, Refused};

use super::invariants::hold;
use super::run::{Run, solve};
use super::specs::{AGREEMENT, cylinder};

fn under(n_per_mm: f64) -> Run {
    solve(&cylinder(json!({
        "load": {"kind": "line_force", "n_per_mm": n_per_mm},
        "cycles": 20,
        // A hundredfold load strains the contact by 3 %, beyond what small strains are good for.
        "effects": {"geometric_nonlinearity": "off"},
    })))
}

/// A contact without a load is no contact: it is refused before any work, with the field and the limit.
#[test]
fn no_load_is_refused_by_its_field() {
    let spec = cylinder(json!({"load": {"kind": "line_force", "n_per_mm": 0}}));
    let Err(Refused::Faults(faults)) = spec::read(spec.to_string().as_bytes()) else {
        panic!("a load of 0 is accepted");
    };
    assert_eq!(faults.len(), 1, "{faults:?}");
    assert_eq!(faults[0].pointer, "/load/n_per_mm");
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
        (hundred_peak / one_peak / 10.0 - 1.0).abs() < AGREEMENT,
        "{hundred_peak}"
    );
    assert!(hundred.area_ratio() < one.area_ratio());
}
