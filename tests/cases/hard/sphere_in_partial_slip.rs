//! Requirement: a sphere whose stroke is shorter than its contact slips in an annulus, wears there alone, and by no more than in gross slip.
//! Source: Mindlin 1949; a ball of 10 mm at amplitudes of 0.3 and 0.9 of that of gross slip.
//! Naive: the whole stroke wears everywhere, the stuck middle too.

use serde_json::json;

use super::invariants::across::hold;
use super::run::solve;

/// Hertz' and Mindlin's ball of steel under 100 N, mu = 0.6: all of it slips from 1.47e-3 mm on.
const GROSS_SLIP_MM: f64 = 1.5e-3;

#[test]
fn a_sphere_in_partial_slip_wears_in_an_annulus() {
    let mut volumes = Vec::new();
    for part in [0.3, 0.9] {
        let steel = json!({"youngs_modulus_mpa": 200_000, "poisson_ratio": 0.3});
        let run = solve(&json!({
            "system": {"kind": "cylinder_on_flat", "radius_mm": 10},
            "model": {"dimension": "point", "radius_z_mm": 10},
            "materials": {"slider": steel, "receptacle": steel},
            "interface": {
                "friction": {"law": "coulomb", "coefficient": 0.6},
                "wear": {"slider": null, "receptacle": {"law": "archard", "k_over_h_per_mpa": 1e-8}},
            },
            "load": {"kind": "force", "n": 100},
            "motion": {"kind": "reciprocating", "amplitude_mm": part * GROSS_SLIP_MM},
            "cycles": 100,
            "accuracy": {"preset": "draft"},
        }));
        hold(&run);
        let last = &run.summary().last.receptacle;
        let volume = last.worn_volume_mm3.expect("a volume");
        // k F s of gross slip.
        let whole = 1e-8 * 100.0 * 4.0 * part * GROSS_SLIP_MM * 100.0;
        assert!(
            volume > 0.0 && volume < 0.9 * whole,
            "{part}: {volume} {whole}"
        );
        volumes.push(volume / whole);
        let snapshot = run.snapshots.last().expect("the end");
        let depth = &snapshot.receptacle.depth_mm;
        let middle = depth[depth.len() / 2];
        let deepest = depth.iter().fold(0.0, |most: f64, depth| most.max(*depth));
        assert!(
            part > 0.5 || middle < 1e-3 * deepest,
            "{middle} of {deepest}"
        );
    }
    assert!(volumes[0] < volumes[1], "{volumes:?}");
}
