//! Requirement: wipes of a millimetre and more are solved: a contact of 5 um travels over hundreds of times its width.
//! Source: insertion of cards and modules; `sd_card` at 0.4 mm and `dimm` at 1.2 mm of amplitude.
//! Naive: a mesh that is fine along the whole travel has thousands of surface nodes, whose dense response does not fit into
//! memory; a coarser one does not see the contact.

use serde_json::{Value, json};

use super::invariants::hold;
use super::run::{Run, solve};
use super::specs::AGREEMENT;

const RATE: f64 = 0.004 / 1700.0;

fn wipe(kind: &str, amplitude_mm: f64, slider: &Value) -> Run {
    solve(&json!({
        "system": {"kind": kind},
        "plating": {"slider": [], "receptacle": []},
        "interface": {"wear": {"slider": slider, "receptacle": {"law": "archard", "k_over_h_per_mpa": RATE}}},
        "motion": {"kind": "reciprocating", "amplitude_mm": amplitude_mm},
        "cycles": 4,
        "accuracy": {"preset": "draft"},
    }))
}

/// In the middle of the travel each pass wears k P off the pad, whatever the mesh.
#[test]
fn a_wipe_wears_the_floor_by_each_pass() {
    for (kind, amplitude_mm) in [("sd_card", 0.4), ("sd_card", 0.98), ("dimm", 1.2)] {
        let run = wipe(kind, amplitude_mm, &Value::Null);
        hold(&run);
        let expected = 2.0 * 4.0 * RATE * run.scene.load_n_per_mm;
        let last = run.snapshots.last().expect("the end is recorded");
        let (x, depth) = (&last.receptacle.x_mm, &last.receptacle.depth_mm);
        let inner = x.iter().zip(depth);
        let inner = inner.filter(|(x, _)| x.abs() < 0.9 * amplitude_mm);
        let off: Vec<f64> = inner.map(|(_, depth)| depth / expected - 1.0).collect();
        let (sum, count) = off.iter().fold((0.0, 0.0), |(s, n), d| (s + d, n + 1.0));
        let mean: f64 = sum / count;
        let worst = off.iter().fold(0.0, |m: f64, d| m.max(d.abs()));
        println!(
            "{kind}, {amplitude_mm} mm: floor off k P a pass by {mean:+.1e}, {worst:.1e} at its worst place"
        );
        assert!(mean.abs() < AGREEMENT && worst < run.scene.accuracy.tolerance);
    }
}

/// The slider's flat carries P/(2 b), b = (3 R W / 2)^(1/3).
#[test]
fn a_slider_wears_flat_on_a_wipe() {
    let law = json!({"law": "archard", "k_over_h_per_mpa": 20.0 * RATE});
    let run = wipe("sd_card", 0.4, &law);
    hold(&run);
    let worn = run.summary().last.slider;
    let half_width = (1.5 * run.scene.slider.shape.radius_mm * worn.worn_area_mm2).cbrt();
    let depth = half_width.powi(2) / (2.0 * run.scene.slider.shape.radius_mm);
    println!(
        "sd_card: flat {:.3} of the segment's depth",
        worn.max_depth_mm / depth
    );
    assert!((worn.max_depth_mm / depth - 1.0).abs() < AGREEMENT);
}
