//! Requirement: a plated contact answers after how many cycles each layer is through, on which side first, and how sure that
//! is; `fretwear calibrate` gives the coefficients with which it lasts as long as it is rated for.

use std::path::Path;

use serde_json::{Value, json};
use tests::{Server, fretwear, spec};

/// The SD card with both sides plated, at a coarse tolerance.
fn plated() -> Value {
    let text = std::fs::read(spec("sd_card_plated.json")).expect("the specification is there");
    let mut spec: Value = serde_json::from_slice(&text).expect("JSON");
    spec["accuracy"] = json!({"preset": "draft"});
    spec["life"]["target_cycles"] = json!(TARGET);
    spec
}

/// Cycles that its connectors have to last, which its tips do not.
const TARGET: u64 = 9_000;

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

/// The entry of a life for a side and a kind.
fn entry<'a>(summary: &'a Value, side: &str, kind: &str) -> &'a Value {
    let mut entries = summary["life"].as_array().expect("a list").iter();
    let entry = entries.find(|entry| entry["side"] == side && entry["criterion"]["kind"] == kind);
    entry.expect("the criterion is there")
}

#[tokio::test]
async fn a_plated_contact_names_its_life_and_its_exposed_layers() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let job = server.ended(&plated()).await;
    let id = job["id"].as_str().expect("a job has an id").to_owned();
    assert_eq!(job["outcome"], "stop_condition", "{job}");
    let mut effects = job["plan"]["effects"].as_array().expect("a list").iter();
    let plating = effects.find(|effect| effect["effect"] == "plating");
    assert_eq!(plating.expect("it is decided")["decision"], "simulated");

    let summary = &job["summary"];
    let done = number(&summary["cycles_done"]);
    // The tip, which rubs on the same place all the time, is through before the pad.
    let base = entry(summary, "slider", "base_metal");
    let nickel = entry(summary, "slider", "first_exposure");
    assert_eq!(
        (&base["status"], &nickel["status"]),
        (&"reached".into(), &"reached".into())
    );
    assert!(number(&nickel["cycles"]) < 0.5 * number(&base["cycles"]));
    assert!((done - number(&base["cycles"])).abs() <= 1.0, "{base}");
    let pad = entry(summary, "receptacle", "first_exposure");
    assert_eq!(
        (&pad["status"], &pad["verdict"]),
        (&"not_reached".into(), &"undecided".into())
    );
    assert!(number(&pad["value"]) < number(&pad["limit"]));
    // A coefficient of variation of 0.5, nine contacts.
    let share = |name: &str| number(&base["band"][name]) / number(&base["cycles"]);
    for (name, expected) in [
        ("b10", 0.54587),
        ("b50", 1.0),
        ("b90", 1.83195),
        ("first_of_contacts_b10", 0.34240),
    ] {
        assert!((share(name) - expected).abs() < 1e-5, "{name}: {base}");
    }
    // Of nine contacts the first one lasts 0.34240 of the median in 90 %, 0.23591 in 99 % of all connectors.
    let shares = base["at_reliability"].as_array().expect("a list");
    for (at, [share, contact, connector]) in shares
        .iter()
        .zip([[0.9, 0.54587, 0.34240], [0.99, 0.33323, 0.23591]])
    {
        let over_median = |name: &str| number(&at[name]) / number(&base["cycles"]);
        assert!((number(&at["share"]) - share).abs() < 1e-12, "{at}");
        assert!((over_median("cycles") - contact).abs() < 1e-5, "{at}");
        assert!(
            (over_median("of_contacts") - connector).abs() < 1e-5,
            "{at}"
        );
    }
    let failed = number(&base["share_failed_at_target"]);
    let connectors = 1.0 - (1.0 - failed).powi(9);
    assert!((number(&base["connectors_failed_at_target"]) - connectors).abs() < 1e-9);
    assert_eq!(base["verdict"], "fail", "{base}");

    let (_, history) = server
        .get(&format!("/v1/jobs/{id}/results/wear-history"))
        .await;
    let exposed = history["exposed"].as_array().expect("a list");
    let of_slider: Vec<&Value> = exposed
        .iter()
        .filter(|layer| layer["side"] == "slider")
        .collect();
    let last = |layer: &Value| {
        let lengths = layer["length_mm"].as_array().expect("a list");
        number(lengths.last().expect("a row"))
    };
    let [nickel, base] = of_slider[..] else {
        panic!("nickel and the base: {exposed:?}");
    };
    let (nickel, base) = (last(nickel), last(base));
    assert!(nickel > base, "{nickel} {base}");
}

#[test]
fn calibrated_coefficients_last_for_the_rated_cycles() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    std::fs::write(folder.path().join("spec.json"), plated().to_string()).expect("a file");
    let once = calibrated(folder.path(), "10000");
    // Twice the cycles by half the coefficients.
    let twice = calibrated(folder.path(), "20000");
    let ratio = number(&once["factor"]) / number(&twice["factor"]);
    assert!((ratio / 2.0 - 1.0).abs() < 0.1, "{ratio}");
    for coefficient in twice["coefficients"].as_array().expect("a list") {
        let scale = number(&coefficient["implied"]) / number(&coefficient["given"]);
        assert!((scale / number(&twice["factor"]) - 1.0).abs() < 1e-12);
    }
    assert_eq!(twice["coefficients"].as_array().map(Vec::len), Some(6));

    // The written specification lasts for as long, by a run of its own.
    let ran = fretwear(folder.path(), &["solve", "calibrated.json", "--json"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let summary: Value = serde_json::from_str(&ran.stdout).expect("a summary");
    let cycles = number(&entry(&summary, "slider", "base_metal")["cycles"]);
    assert!((cycles / 20_000.0 - 1.0).abs() < 0.1, "{cycles}");
}

/// Coefficients that are ten thousand times too small, a short run, and a median far beyond the rated cycles.
#[test]
fn a_calibration_depends_on_the_ratios_of_the_given_coefficients_alone() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let mut spec = plated();
    std::fs::write(folder.path().join("spec.json"), spec.to_string()).expect("a file");
    let rates = |document: &Value| -> Vec<f64> {
        let coefficients = document["coefficients"].as_array().expect("a list");
        coefficients
            .iter()
            .map(|coefficient| number(&coefficient["implied"]))
            .collect()
    };
    let expected = rates(&calibrated(folder.path(), "1000"));
    spec["cycles"] = json!(1_000);
    for side in ["slider", "receptacle"] {
        let scaled = |law: &mut Value| {
            law["k_over_h_per_mpa"] = json!(1e-4 * number(&law["k_over_h_per_mpa"]));
        };
        scaled(&mut spec["interface"]["wear"][side]);
        for layer in spec["plating"][side].as_array_mut().expect("layers") {
            scaled(&mut layer["wear"]);
        }
    }
    std::fs::write(folder.path().join("spec.json"), spec.to_string()).expect("a file");
    let found = rates(&calibrated(folder.path(), "1000"));
    assert_eq!(found.len(), expected.len());
    for (found, expected) in found.iter().zip(&expected) {
        assert!((found / expected - 1.0).abs() < 0.1, "{found} {expected}");
    }
    let arguments = [
        "calibrate",
        "spec.json",
        "--rated-cycles",
        "1000",
        "--criterion",
        "base_metal",
        "--failing",
        "0.000001",
        "--json",
    ];
    let ran = fretwear(folder.path(), &arguments);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let rare: Value = serde_json::from_str(&ran.stdout).expect("a document");
    // exp(4.7534 x 0.47238), the quantile of 1e-6 with a coefficient of variation of 0.5.
    let ratio = number(&rare["median_cycles"]) / 1_000.0;
    assert!((ratio / 9.444 - 1.0).abs() < 1e-3, "{ratio}");
}

/// The document of a calibration by a rating for base metal; the specification is written to `calibrated.json`.
fn calibrated(folder: &Path, cycles: &str) -> Value {
    let arguments = [
        "calibrate",
        "spec.json",
        "--rated-cycles",
        cycles,
        "--criterion",
        "base_metal",
        "--json",
        "--out",
        "calibrated.json",
    ];
    let ran = fretwear(folder, &arguments);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    serde_json::from_str(&ran.stdout).expect("a document")
}

#[test]
fn a_rating_that_cannot_be_read_is_refused_by_name() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    std::fs::write(folder.path().join("spec.json"), plated().to_string()).expect("a file");
    for (criterion, expected) in [
        ("first_exposure", "criterion/layer: missing"),
        ("base_metall", "did you mean `base_metal`?"),
        (r#"{"kind": "worn_depth", "mm": 0}"#, "criterion/mm"),
        (r#"{"kind": "resistance", "mohm": 10}"#, "criterion/kind"),
    ] {
        let arguments = [
            "calibrate",
            "spec.json",
            "--rated-cycles",
            "100",
            "--criterion",
            criterion,
        ];
        let ran = fretwear(folder.path(), &arguments);
        assert_eq!(ran.code, Some(2), "{criterion}: {}", ran.stderr);
        assert_eq!(ran.stderr.matches(expected).count(), 1, "{}", ran.stderr);
    }
}

#[tokio::test]
async fn a_continuous_contact_lives_by_its_distance() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let law = |rate: f64| json!({"law": "archard", "k_over_h_per_mpa": rate});
    let spec = json!({
        "system": {"kind": "cylinder_on_flat"},
        "motion": {"kind": "continuous", "distance_mm": 2_000.0},
        "plating": {"receptacle": [{"material": "hard_gold", "thickness_um": 2.0, "wear": law(1e-7)}]},
        "interface": {"wear": {"slider": null, "receptacle": law(4e-7)}},
        "accuracy": {"preset": "draft"}
    });
    let job = server.ended(&spec).await;
    let life = &job["summary"]["life"][0];
    assert_eq!(life["status"], "reached", "{life}");
    assert!(life["cycles"].is_null() && life["duration_h"].is_null());
    let distance = number(&life["sliding_distance_mm"]);
    assert!(distance > 0.0 && distance < 2_000.0, "{life}");
    let band = number(&life["band"]["b50"]) / distance;
    assert!((band - 1.0).abs() < 1e-12, "{life}");
}
