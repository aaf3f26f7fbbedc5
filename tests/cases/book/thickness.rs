//! The figures of the tutorial are those that its specification gives.

use serde_json::Value;
use tests::{fretwear, fretwear_reading, spec};

#[test]
fn the_table_of_thicknesses_is_what_the_specification_gives() {
    let page = std::fs::read_to_string(super::house().join("docs/tutorial/thickness.md"));
    let page = page.expect("the page is there");
    let rows = page
        .lines()
        .skip_while(|line| !line.starts_with("| gold, um |"));
    let rows = rows.skip(2).take_while(|line| line.starts_with('|'));
    let folder = tempfile::tempdir().expect("a folder can be made");
    let path = spec("memory_card.json").display().to_string();
    let plan = fretwear(folder.path(), &["plan", "--json", &path]);
    let plan: Value = serde_json::from_str(&plan.stdout).expect("a plan");
    let mut count = 0;
    for row in rows {
        let cells: Vec<f64> = row
            .split('|')
            .filter_map(|cell| cell.trim().parse().ok())
            .collect();
        let mut changed = plan["spec"].clone();
        for side in ["slider", "receptacle"] {
            changed["plating"][side][0]["thickness_um"] = cells[0].into();
        }
        let arguments = ["solve", "-", "--json"];
        let ran = fretwear_reading(folder.path(), &arguments, &changed.to_string());
        assert_eq!(ran.code, Some(0), "{}", ran.stderr);
        let summary: Value = serde_json::from_str(&ran.stdout).expect("a summary");
        let lives = summary["life"].as_array().expect("lives");
        let first = lives.iter().find(|life| life["status"] == "reached");
        let first = first.expect("the nickel is exposed");
        let median_h = first["duration_h"].as_f64().expect("hours");
        let band = &first["band"];
        let share = |name: &str| band[name].as_f64().expect("cycles");
        let connector_h = median_h * share("first_of_contacts_b10") / share("b50");
        let found = [median_h, connector_h];
        let shown = found.map(|hours| format!("{hours:.2}"));
        assert_eq!(shown, [1, 2].map(|at| format!("{:.2}", cells[at])), "{row}");
        count += 1;
    }
    assert_eq!(count, 5);
}
