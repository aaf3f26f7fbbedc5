//! Requirement: extruded bodies are a job like any other, with their node planes as sections, and their exported deck is solved by
//! CalculiX to the same pressures.

use serde_json::{Value, json};
use solver::extruded::{ExtrudedScene, run};
use std::ops::ControlFlow;
use tests::{Server, calculix, fretwear, spec};

/// A cylinder on a flat between free ends, 0.2 mm wide, with a stroke that hardly moves it; bodies of 17 half-widths, so that CalculiX takes
/// seconds.
const CYLINDER: &str = r#"{
  "system": {"kind": "cylinder_on_flat", "flat_length_mm": 0.6, "flat_height_mm": 0.6, "slider_half_width_mm": 0.3, "slider_height_mm": 0.6},
  "model": {"dimension": "extruded", "width_mm": 0.2, "layers": 2},
  "interface": {"friction": {"law": "frictionless"}},
  "load": {"kind": "line_force", "n_per_mm": 18.5},
  "motion": {"kind": "reciprocating", "amplitude_mm": 1e-5},
  "accuracy": {"preset": "draft", "overrides": {"contact_element_mm": 0.005}}
}"#;

fn number(value: &Value) -> f64 {
    value.as_f64().expect("a number")
}

#[tokio::test]
async fn the_source_s_extruded_wire_is_a_job_with_node_planes() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let text = std::fs::read(spec("fuzz_button_extruded.json")).expect("it is there");
    let mut wire: Value = serde_json::from_slice(&text).expect("JSON");
    wire["cycles"] = json!(40);
    wire["accuracy"] = json!({"preset": "draft"});
    wire["output"] = json!({"stations_mm": [0.0], "snapshots_at_cycles": [10, 40]});
    let job = server.ended(&wire).await;
    let id = job["id"].as_str().expect("a job has an id").to_owned();
    assert_eq!(job["outcome"], "completed", "{job}");
    let summary = &job["summary"];
    let planes = summary["stations"].as_array().expect("node planes");
    assert_eq!(planes.len(), 2);
    // 2 k P' a cycle but for the first ones, whatever the ends; the width shares the force.
    let sunk = 40.0 * 2.0 * 0.011 / 427.0 * 0.508;
    for plane in planes {
        let depth = number(&plane["receptacle"]["max_depth_mm"]);
        assert!((depth / sunk - 1.0).abs() < 0.05, "{depth} {sunk}");
    }
    assert!((number(&planes[0]["z_mm"]) - 0.005_29).abs() < 1e-12);
    let force = number(&summary["extent"]["load_n"]);
    assert!((force - 0.508 * 0.010_58).abs() < 1e-9, "{force}");
    let results = format!("/v1/jobs/{id}/results");
    let end = server
        .get_in_the_end(&format!("{results}/profile?cycle=40&station=0"))
        .await
        .1;
    let middle = server.get(&format!("{results}/profile?cycle=40")).await.1;
    assert_ne!(end["receptacle"], middle["receptacle"]);
    let last = server
        .get(&format!("{results}/profile?cycle=40&station=1"))
        .await
        .1;
    assert_eq!(last["receptacle"], middle["receptacle"]);
}

/// The first step of a deck with the slider's top lowered by an approach in mm, because CalculiX does not find the first contact under a load.
fn lowered(deck: &str, approach_mm: f64) -> String {
    let second = deck.rfind("*STEP").expect("it has two steps");
    let (before, load) = deck[..second].split_once("*CLOAD\n").expect("a load");
    let (load, after) = load.split_once('\n').expect("further lines");
    let node = load.split(',').next().expect("the control node");
    let before = before.replace("0.05, 1., 1e-6, 0.25", "0.1, 1., 1e-6, 0.1");
    format!(
        "{before}*BOUNDARY\n{node}, 2, 2, {:.6e}\n{after}",
        -approach_mm
    )
}

/// Pressures of all node planes under our approach, relative to the peak, but for the last three nodes at the edges, where the penalty of CalculiX
/// alternates: the elements are twice as long as those of the plane deck.
#[test]
#[cfg_attr(not(has_ccx), ignore = "needs the program ccx of CalculiX")]
fn pressures_of_all_planes_agree_with_calculix() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let scene = server::spec::read(CYLINDER.as_bytes())
        .expect("the specification is sound")
        .scene;
    let mut bodies = ExtrudedScene::of(&scene).expect("it is extruded");
    bodies.section.cycles = 0;
    let ours = run(&bodies, |_| ControlFlow::Continue(())).expect("it can be solved");
    let deck = calculix::deck(folder.path(), CYLINDER);
    calculix::run(folder.path(), &lowered(&deck, ours.approach_mm));
    let theirs = calculix::placed_pressures(folder.path());
    let peak = ours.pressures_mpa.iter().flatten();
    let peak = peak.fold(0.0, |m: f64, p| m.max(*p));
    let half_width = ours.initial.stations[0].half_width_mm;
    let z = bodies.planes().z().to_vec();
    let nodes = &ours.profiles[0].x_mm.receptacle;
    let (mut compared, mut largest) = (0, 0.0_f64);
    for (node, x) in nodes.iter().enumerate() {
        if x.abs() > 0.55 * half_width {
            continue;
        }
        let [end, middle] = [0, 1].map(|plane: usize| {
            let place = (calculix::nanometres(*x), calculix::nanometres(z[plane]));
            *theirs.get(&place).expect("the same node")
        });
        // CalculiX's pressures are linear along z; ours are nodal forces over the lengths of the planes.
        let lumped = [(2.0 * end + middle) / 3.0, (end + 2.0 * middle) / 3.0];
        for (own, theirs) in ours.pressures_mpa.iter().zip(lumped) {
            largest = largest.max((own[node] - theirs).abs() / peak);
            compared += 1;
        }
    }
    println!("extruded against CalculiX: {compared} nodes within {largest:.4} of the peak");
    assert!(compared > 15, "{compared} nodes");
    assert!(largest < 0.02, "{largest}");
}

#[test]
fn a_worn_deck_has_the_depths_of_each_plane() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let text = r#"{"system":{"kind":"fuzz_button"},"model":{"preset":"source_extruded"},"accuracy":{"preset":"draft"},"cycles":3}"#;
    std::fs::write(folder.path().join("wire.json"), text).expect("a file can be written");
    let deck = |cycle: &str| {
        let deck = fretwear(
            folder.path(),
            &["export", "wire.json", "--format", "inp", "--cycle", cycle],
        );
        assert_eq!(deck.code, Some(0), "{}", deck.stderr);
        deck.stdout
    };
    let (unworn, worn) = (deck("0"), deck("3"));
    assert!(unworn.contains("TYPE=C3D8I"));
    assert_eq!(unworn.lines().count(), worn.lines().count());
    assert_ne!(unworn, worn);
}

mod night {
    #[test]
    #[ignore = "night: takes a quarter of an hour"]
    fn a_memory_cards_spring_in_all_models() {
        super::springs_wear_alike_in_all_models();
    }
}

/// The table of `docs/guide/extruded.md`: the spring of a memory card in all models, one after the other, for 2 000 cycles and until its gold is through.
fn springs_wear_alike_in_all_models() {
    let extruded =
        json!({"dimension": "extruded", "width_mm": 0.8, "layers": 4, "layer_growth": 3});
    let straight = json!({"dimension": "line", "width_mm": 0.8});
    let crown = json!({"dimension": "line", "width_mm": 0.8, "crown_radius_mm": 10});
    let point = json!({"dimension": "point", "radius_z_mm": 10});
    let found = [
        ("plane strain", json!({"dimension": "plane_strain"})),
        ("extruded, four layers, free ends", extruded),
        ("line, straight", straight),
        ("line, crown of 10 mm", crown),
        ("point, crown of 10 mm", point),
        ("point, ball", json!({"dimension": "point"})),
    ]
    .map(|(name, model)| {
        let short = solved_spring(&model, Some(2000));
        let depth = |side: &str| 1e6 * number(&short[side]["max_depth_mm"]);
        let worn = solved_spring(&model, None);
        let life = number(&worn["life"][0]["cycles"]);
        println!(
            "{name}: unworn peak {:.0} MPa, tip {:.1} nm, pad {:.1} nm, {:.1} s; through after {life:.0} cycles, {:.1} s",
            number(&short["initial"]["peak_pressure_mpa"]),
            depth("slider"),
            depth("receptacle"),
            number(&short["cost"]["cpu_s"]),
            number(&worn["cost"]["cpu_s"]),
        );
        (depth("slider"), life)
    });
    let [plane, ends, straight, crown, point, _] = found;
    // Between free ends and along a straight line the wear is that of plane strain, and both models of a crown agree, within the 2 % that
    // runs are asked for.
    for (one, other) in [(ends, plane), (straight, plane), (crown, point)] {
        assert!((one.0 / other.0 - 1.0).abs() < 0.02, "{found:?}");
        assert!((one.1 / other.1 - 1.0).abs() < 0.02, "{found:?}");
    }
}

/// The summary of the spring in a model, after so many cycles or where its gold is through.
fn solved_spring(model: &Value, cycles: Option<u64>) -> Value {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let text = std::fs::read(spec("sd_card_crown.json")).expect("it is there");
    let mut spring: Value = serde_json::from_slice(&text).expect("JSON");
    spring["model"] = model.clone();
    if model["dimension"] == "plane_strain" {
        spring["load"]["width_mm"] = json!(0.8);
    }
    if let Some(cycles) = cycles {
        spring["cycles"] = json!(cycles);
        spring["stop"] = json!([]);
        spring["output"] = json!({"snapshots_at_cycles": [cycles]});
    }
    std::fs::write(folder.path().join("spring.json"), spring.to_string()).expect("a file");
    let ran = fretwear(folder.path(), &["solve", "spring.json", "--json"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    serde_json::from_str(&ran.stdout).expect("JSON")
}
