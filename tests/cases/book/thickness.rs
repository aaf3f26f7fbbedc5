//! The figures of the tutorial are those that its specification gives.

use serde_json::Value;
use tests::{fretwear, fretwear_reading, spec};

fn page(path: &str) -> String {
    std::fs::read_to_string(super::house().join(path)).expect("the page is there")
}

#[test]
fn the_figures_in_the_text_are_those_that_the_commands_print() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let path = spec("memory_card.json").display().to_string();
    let run = |command: &str| fretwear(folder.path(), &[command, &path]).stdout;
    let (plan, solved) = (run("plan"), run("solve"));
    let (page, readme) = (page("docs/tutorial/thickness.md"), page("README.md"));
    for (printed, figures) in [
        (&plan, &["9.86", "2.42", "7.44"][..]),
        (&solved, &["932337", "319235", "1.295", "fail", "99.98"]),
    ] {
        for figure in figures {
            assert!(printed.contains(figure), "{figure}: {printed}");
            assert!(page.replace(' ', "").contains(figure), "{figure}");
        }
    }
    // The row of the preset's thickness is what the front page names.
    assert!(page.contains("| 0.76 | 1.29 | 0.44 |"), "{page}");
    assert!(readme.contains("1.29 h") && readme.contains("0.44 h"));
}

#[test]
fn the_specification_of_the_page_is_the_committed_one() {
    let committed = std::fs::read_to_string(spec("memory_card.json")).expect("a specification");
    let committed: Value = serde_json::from_str(&committed).expect("JSON");
    let page = page("docs/tutorial/thickness.md");
    let shown: Value = serde_json::from_str(super::blocks(&page, "json")[0]).expect("JSON");
    assert_eq!(shown, committed);
    let sweep = std::fs::read_to_string(spec("gold_thickness.json")).expect("a sweep");
    let sweep: Value = serde_json::from_str(&sweep).expect("JSON");
    assert_eq!(sweep["base"], committed);
    let mut unnamed = committed;
    unnamed.as_object_mut().expect("an object").remove("name");
    let readme = self::page("README.md");
    let shown: Value = serde_json::from_str(super::blocks(&readme, "json")[0]).expect("JSON");
    assert_eq!(shown, unnamed);
}

#[test]
fn the_table_of_thicknesses_is_what_the_specification_gives() {
    let page = page("docs/tutorial/thickness.md");
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
        let ratio = format!("{:.3} of it", connector_h / median_h);
        assert!(page.contains(&ratio), "{ratio}");
        let found = [median_h, connector_h];
        let shown = found.map(|hours| format!("{hours:.2}"));
        assert_eq!(shown, [1, 2].map(|at| format!("{:.2}", cells[at])), "{row}");
        count += 1;
    }
    assert_eq!(count, 5);
}
