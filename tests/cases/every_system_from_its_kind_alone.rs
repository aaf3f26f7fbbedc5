//! Requirement: each system solves from `{"system": {"kind": ..}}` alone to a plausible result; this case prints the
//! README's table of systems.

use serde_json::{Value, json};
use tests::fretwear;

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

#[test]
fn every_kind_ends_with_a_scar_of_its_load_and_sliding_distance() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    println!(
        "| system | cycles | peak, MPa | half-width, um | depth, um | scar half-width, um | area / (k P s) |"
    );
    for kind in ["fuzz_button", "sd_card", "dimm", "zif", "cylinder_on_flat"] {
        let spec = json!({"system": {"kind": kind}}).to_string();
        std::fs::write(folder.path().join("spec.json"), spec).expect("a file can be written");
        let ran = fretwear(folder.path(), &["solve", "spec.json"]);
        assert_eq!(ran.code, Some(0), "{kind}: {}", ran.stderr);
        let summary: Value = serde_json::from_str(&ran.stdout).expect("the summary is JSON");
        let (initial, block) = (&summary["initial"], &summary["receptacle"]);
        let area = number(&block["worn_area_mm2"]) / number(&block["ideal_area_mm2"]);
        println!(
            "| `{kind}` | {} | {:.0} | {:.2} | {:.3} | {:.1} | {area:.3} |",
            summary["cycles_done"],
            number(&initial["peak_pressure_mpa"]),
            1e3 * number(&initial["contact_half_width_mm"]),
            1e3 * number(&block["max_depth_mm"]),
            1e3 * number(&block["scar_half_width_mm"]),
        );
        assert_eq!(summary["outcome"], "completed", "{kind}");
        // Below 1 since sticking places do not wear; above 1 since a contact on the walls of a groove carries more than the load.
        assert!((0.9..1.1).contains(&area), "{kind}: {area}");
        for check in [
            "force_balance",
            "worn_area",
            "complementarity",
            "friction_cone",
        ] {
            assert!(number(&summary["checks"][check]) < 1e-8, "{kind}: {check}");
        }
    }
}
