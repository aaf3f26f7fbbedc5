//! Requirement: zero load is refused; a load so small that the wear of one node ends the contact is solved, and so is a
//! hundredfold load.
//! Source: contract.md (load); an unloaded spring, a contact at the end of its life, a press fit.
//! Naive: dividing by the load or by the contact width gives NaN; a contact lost for one iteration never returns.

use serde_json::json;
use server::spec::{self, Refused};

use super::invariants::hold;
use super::run::{Run, solve};
use super::specs::{AGREEMENT, cylinder};

fn under(n_per_mm: f64) -> Run {
    solve(&cylinder(json!({
        "load": {"kind": "line_force", "n_per_mm": n_per_mm},
        "cycles": 20,
        // A hundredfold load strains the contact by 3 %, beyond the limit of small strains.
        "effects": {"geometric_nonlinearity": "off"},
    })))
}

/// A contact without a load is refused before any computation, with the field and the limit.
#[test]
fn zero_load_is_refused_with_its_field() {
    let spec = cylinder(json!({"load": {"kind": "line_force", "n_per_mm": 0}}));
    let Err(Refused::Faults(faults)) = spec::read(spec.to_string().as_bytes()) else {
        panic!("a load of 0 is accepted");
    };
    assert_eq!(faults.len(), 1, "{faults:?}");
    assert_eq!(faults[0].pointer, "/load/n_per_mm");
}

#[test]
fn a_load_close_to_zero_wears_k_p_s() {
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
fn a_hundredfold_load_is_solved() {
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
