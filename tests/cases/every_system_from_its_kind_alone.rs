//! Requirement: each system solves from `{"system": {"kind": ..}}` alone to a plausible result; this case prints the
//! table of docs/guide/systems.md.

use serde_json::{Value, json};
use tests::fretwear;

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

#[test]
fn every_kind_ends_with_a_scar_of_its_load_and_sliding_distance() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    println!(
        "| system | cycles | peak, MPa | half-width, um | tip's depth, nm | its flat's half-width, um | pad's depth, nm | its scar's half-width, um | area / (k P s) |"
    );
    for kind in ["fuzz_button", "sd_card", "dimm", "zif", "cylinder_on_flat"] {
        let spec = json!({"system": {"kind": kind}}).to_string();
        std::fs::write(folder.path().join("spec.json"), spec).expect("a file can be written");
        let ran = fretwear(folder.path(), &["solve", "spec.json", "--json"]);
        assert_eq!(ran.code, Some(0), "{kind}: {}", ran.stderr);
        let summary: Value = serde_json::from_str(&ran.stdout).expect("the summary is JSON");
        let (initial, block, tip) = (
            &summary["initial"],
            &summary["receptacle"],
            &summary["slider"],
        );
        let area = number(&block["worn_area_mm2"]) / number(&block["ideal_area_mm2"]);
        println!(
            "| `{kind}` | {} | {:.0} | {:.2} | {:.1} | {:.2} | {:.1} | {:.1} | {area:.3} |",
            summary["cycles_done"],
            number(&initial["peak_pressure_mpa"]),
            1e3 * number(&initial["contact_half_width_mm"]),
            1e6 * number(&tip["max_depth_mm"]),
            1e3 * number(&tip["scar_half_width_mm"]),
            1e6 * number(&block["max_depth_mm"]),
            1e3 * number(&block["scar_half_width_mm"]),
        );
        assert_eq!(summary["outcome"], "completed", "{kind}");
        // The bench geometry has a cylinder that does not wear.
        let wears = kind != "cylinder_on_flat";
        assert_eq!(number(&tip["max_depth_mm"]) > 0.0, wears, "{kind}");
        let life = summary["life"].as_array().expect("a list");
        assert_eq!(life.len(), if wears { 4 } else { 0 }, "{kind}");
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
