//! The main job: the fuzz-button specification, submitted over HTTP, solved, streamed back.
//!
//! Requirement: `fretwear demo --exit` ends with 0 and a table of worn depth by cycle and station; where the contact
//! is on the flat floor of the groove the depth grows by 2 (k/H) P' = 26.17 nm a cycle, and the worn area equals
//! (k/H) times the accumulated integral of p |slip|. docs/tutorial/demo.md shows lines of that table.

use serde_json::Value;
use tests::{Server, fretwear, spec};

/// 2 (k/H) P' with k = 0.011, H = 427 MPa and P' = 10 MPa over 0.0508 mm, mm a cycle.
const FLAT_FLOOR: f64 = 2.0 * 0.011 / 427.0 * 0.508;

/// The cells of a line of a table; its cycle without the space between thousands.
fn cells(line: &str) -> Vec<String> {
    let inside = line.trim_matches('|').split('|');
    let mut cells: Vec<String> = inside.map(|cell| cell.trim().to_owned()).collect();
    cells[0] = cells[0].replace(' ', "");
    cells
}

/// The table whose head begins with the words, its head first.
fn table(text: &str, head: &str) -> Vec<Vec<String>> {
    let lines = text.lines().skip_while(|line| !line.starts_with(head));
    lines
        .take_while(|line| line.starts_with('|'))
        .filter(|line| !line.contains("--"))
        .map(cells)
        .collect()
}

#[test]
fn the_demo_solves_its_job_and_prints_the_table_of_the_book() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let ran = fretwear(folder.path(), &["demo", "--exit"]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let printed = table(&ran.stdout, "| cycle |");
    let row = |cycle: &str| -> &Vec<String> {
        let row = printed.iter().find(|row| row[0] == cycle);
        row.unwrap_or_else(|| panic!("no cycle {cycle} in {}", ran.stdout))
    };
    // The table's last column is the growth in the middle since the row above, nm a cycle.
    for cycle in ["1", "150"] {
        let growth: f64 = row(cycle).last().expect("cells").parse().expect("a number");
        let off = growth / (1e6 * FLAT_FLOOR) - 1.0;
        assert!(off.abs() < 0.01, "cycle {cycle}: {off}");
    }

    let path = concat!(env!("CARGO_MANIFEST_DIR"), "/../docs/tutorial/demo.md");
    let readme = std::fs::read_to_string(path).expect("the page can be read");
    let told = table(&readme, "| cycle | x = ");
    assert!(told.len() > 3, "{told:?}");
    for (place, head) in told[0].iter().enumerate().skip(1) {
        let head = head.trim_start_matches("x = ");
        let is_told = |name: &String| name.trim_end_matches(" mm") == head.trim_end_matches(" mm");
        let column = printed[0].iter().position(is_told);
        let column = column.unwrap_or_else(|| panic!("no column {head} in {:?}", printed[0]));
        for line in &told[1..] {
            let digits = line[place].split('.').nth(1).map_or(0, str::len);
            let number: f64 = row(&line[0])[column].parse().expect("a number");
            assert_eq!(
                line[place],
                format!("{number:.digits$}"),
                "{line:?}, {head}"
            );
        }
    }
}

#[tokio::test]
async fn the_job_wears_the_flat_floor_by_two_passes_a_cycle() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let body = std::fs::read(spec("fuzz_button.json")).expect("the specification is there");
    let (status, job) = server.submit(body).await;
    assert_eq!(status, 202, "{job}");
    let id = job["id"].as_str().expect("a job has an id").to_owned();
    let job = server
        .job_when(&id, |job| job["finished_at"].is_string())
        .await;
    assert_eq!(
        (&job["status"], &job["outcome"]),
        (&"succeeded".into(), &"completed".into())
    );

    let (_, history) = server
        .get(&format!("/v1/jobs/{id}/results/wear-history"))
        .await;
    let numbers = |value: &Value| -> Vec<f64> {
        value
            .as_array()
            .into_iter()
            .flatten()
            .filter_map(Value::as_f64)
            .collect()
    };
    let cycles = numbers(&history["cycle"]);
    let stations = history["stations"]
        .as_array()
        .expect("stations were requested");
    let middle = stations
        .iter()
        .find(|station| station["x_mm"] == 0.0)
        .expect("x = 0 is one");
    let depth = numbers(&middle["depth_mm"]);
    assert_eq!(cycles.len(), depth.len());
    let at = |cycle: f64| {
        let row = cycles.iter().position(|c| (c - cycle).abs() < 0.5);
        depth[row.expect("the cycle was requested")]
    };
    assert!((at(1.0) / FLAT_FLOOR - 1.0).abs() < 0.01);
    assert!(((at(150.0) - at(1.0)) / 149.0 / FLAT_FLOOR - 1.0).abs() < 0.01);
    let residual = job["summary"]["checks"]["worn_area"]
        .as_f64()
        .expect("it is checked");
    assert!(residual < 1e-9, "{residual}");
    assert!((cycles[cycles.len() - 1] - 2000.0).abs() < 0.5);
}
