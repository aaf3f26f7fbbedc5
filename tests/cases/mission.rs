//! Requirement: a mission of different motions has one history, names the life of the contact in it, and which motion has worn it.

use serde_json::{Value, json};
use tests::{Server, fretwear, spec};

/// Some weeks of the SD card's mission, at a coarse tolerance, with layers a twelfth as thick.
fn weeks() -> Value {
    let text = std::fs::read(spec("sd_card_ten_years.json")).expect("the specification is there");
    let mut spec: Value = serde_json::from_slice(&text).expect("JSON");
    spec["accuracy"] = json!({"preset": "draft", "estimate_errors": false});
    spec["repeat"] = json!(12);
    for side in ["slider", "receptacle"] {
        for layer in spec["plating"][side].as_array_mut().expect("layers") {
            let thickness = number(&layer["thickness_um"]);
            layer["thickness_um"] = json!(thickness / 12.0);
        }
    }
    spec
}

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

#[tokio::test]
async fn a_mission_names_its_life_and_what_each_block_has_worn() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let job = server.ended(&weeks()).await;
    assert_eq!(job["status"], "succeeded", "{job}");
    let summary = &job["summary"];
    assert_eq!(summary["cycles_done"], 12 * (4 + 2_000 + 7), "{summary}");

    let planned = job["plan"]["mission"].as_array().expect("blocks");
    let done = summary["mission"].as_array().expect("blocks");
    let names: Vec<_> = done.iter().map(|block| block["name"].clone()).collect();
    assert_eq!(names, ["matings", "rides", "days"]);
    for (planned, done) in planned.iter().zip(done) {
        for field in ["cycles", "amplitude_mm", "motion"] {
            assert_eq!(planned[field], done[field], "{field}");
        }
        let (distance, hours) = ("sliding_distance_mm", "duration_h");
        for field in [distance, hours] {
            let (planned, done) = (number(&planned[field]), number(&done[field]));
            assert!(
                (planned - done).abs() <= 1e-9 * planned,
                "{field}: {planned} {done}"
            );
        }
    }
    // The arms take up the expansion of the days.
    assert_eq!(done[2]["motion"]["sticks"], true);
    assert_eq!(done[2]["receptacle"]["worn_area_mm2"], 0.0);
    for side in ["slider", "receptacle"] {
        for share in ["share", "share_of_deepest"] {
            let sum: f64 = done.iter().map(|block| number(&block[side][share])).sum();
            assert!((sum - 1.0).abs() < 1e-9, "{side} {share}: {sum}");
        }
        let areas: f64 = done
            .iter()
            .map(|block| number(&block[side]["worn_area_mm2"]))
            .sum();
        assert!((areas / number(&summary[side]["worn_area_mm2"]) - 1.0).abs() < 1e-9);
    }
    // The wipe passes over the middle of the pad in few cycles; the tip has it in each.
    let deepest = |side: &str| number(&done[0][side]["share_of_deepest"]);
    assert!(deepest("slider") > deepest("receptacle"));

    let life = summary["life"].as_array().expect("a list");
    let reached: Vec<_> = life
        .iter()
        .filter(|entry| entry["status"] == "reached")
        .collect();
    assert!(!reached.is_empty(), "{life:?}");
    for entry in reached {
        let weeks = number(&entry["cycles"]) / 2_011.0;
        assert!(
            (number(&entry["repetitions"]) - weeks).abs() < 1e-9,
            "{entry}"
        );
        assert!(
            number(&entry["duration_h"]) > 6.0 * weeks.floor(),
            "{entry}"
        );
    }
    let id = job["id"].as_str().expect("an id");
    let (_, history) = server
        .get(&format!("/v1/jobs/{id}/results/wear-history"))
        .await;
    let cycles = history["cycle"].as_array().expect("cycles");
    assert!(cycles.last() == Some(&summary["cycles_done"]), "{cycles:?}");
}

#[test]
fn the_plan_of_a_mission_is_a_table_of_its_blocks() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    std::fs::write(folder.path().join("weeks.json"), weeks().to_string()).expect("a file");
    let plan = fretwear(folder.path(), &["plan", "weeks.json"]);
    for line in ["| matings |", "| rides   |", "the contact does not slip"] {
        assert!(plan.stdout.contains(line), "{}", plan.stdout);
    }
    let refused = json!({
        "system": {"kind": "sd_card"}, "cycles": 5,
        "mission": [{"motion": {"kind": "continuous", "distance_mm": 3}}]
    });
    std::fs::write(folder.path().join("refused.json"), refused.to_string()).expect("a file");
    let refused = fretwear(folder.path(), &["plan", "refused.json"]);
    assert_eq!(refused.code, Some(2));
    for pointer in ["/cycles", "/mission/0/motion/kind"] {
        assert!(refused.stderr.contains(pointer), "{}", refused.stderr);
    }
}

/// Mixed cycles wear as those in order where many of them are done, and all of them are.
#[test]
fn a_mixed_mission_does_all_of_its_cycles() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let run = |order: &str| -> Value {
        let mut spec = weeks();
        spec["order"] = json!(order);
        std::fs::write(folder.path().join("weeks.json"), spec.to_string()).expect("a file");
        let ran = fretwear(folder.path(), &["solve", "weeks.json", "--json"]);
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        serde_json::from_str(&ran.stdout).expect("a summary")
    };
    let (mixed, in_order) = (run("mixed"), run("in_order"));
    assert_eq!(mixed["cycles_done"], in_order["cycles_done"]);
    let blocks = |summary: &Value| {
        let done = summary["mission"].as_array().expect("blocks");
        let cycles: Vec<_> = done.iter().map(|block| block["cycles"].clone()).collect();
        cycles
    };
    assert_eq!(blocks(&mixed), blocks(&in_order));
    for side in ["slider", "receptacle"] {
        let area = |summary: &Value| number(&summary[side]["worn_area_mm2"]);
        let ratio = area(&mixed) / area(&in_order);
        // The tolerance of a draft.
        assert!((ratio - 1.0).abs() < 0.1, "{side}: {ratio}");
    }
}
