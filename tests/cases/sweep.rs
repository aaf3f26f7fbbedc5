//! Requirement: a parameter sweep creates one ordinary job for each combination, counts them by status, and its table has
//! a line for each with its parameters and its outcome; more load wears more.

use serde_json::json;
use tests::Server;

#[tokio::test]
async fn a_sweep_over_the_load_ends_in_one_table() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let request = json!({
        "name": "loads",
        "base": {"system": {"kind": "sd_card"}, "cycles": 10, "accuracy": {"preset": "draft"},
                 "life": {"criteria": [{"kind": "worn_depth", "mm": 2e-7}, {"kind": "worn_depth", "mm": 1e-7}]}},
        "grid": {"/load": [{"kind": "line_force", "n_per_mm": 0.2}, {"kind": "line_force", "n_per_mm": 0.4}],
                 "/interface/friction/coefficient": [0.2, 0.3]}
    });
    let (status, sweep) = server.post_json("/v1/sweeps", &request).await;
    assert_eq!(status, 202);
    let id = sweep["id"].as_str().expect("a sweep has an id");
    let sweep = server.batch_ended(&format!("/v1/sweeps/{id}")).await;
    assert_eq!(sweep["counts"]["succeeded"], 4, "{sweep}");

    let (status, table) = server.get(&format!("/v1/sweeps/{id}/outcomes")).await;
    assert_eq!(status, 200);
    let table = table.as_str().expect("CSV").to_owned();
    let mut lines = table.lines();
    let header: Vec<&str> = lines.next().expect("a header").split(',').collect();
    let depth = header
        .iter()
        .position(|name| *name == "receptacle_max_depth_mm");
    let lives: Vec<f64> = table
        .lines()
        .skip(1)
        .filter_map(|line| line.rsplit(',').next()?.parse().ok())
        .collect();
    // An override that is an object contains commas, so cells are counted from the end of the line.
    let from_end = header.len() - depth.expect("a column");
    let depths: Vec<f64> = lines
        .map(|line| {
            let cell = line.rsplit(',').nth(from_end - 1).expect("a cell");
            cell.parse().expect("a number")
        })
        .collect();
    assert_eq!(depths.len(), 4, "{table}");
    // The load varies slowest or fastest with the order of the pointers; friction hardly matters for wear.
    assert_eq!(header[3], "/interface/friction/coefficient");
    assert!(
        depths[1] > 1.5 * depths[0] && depths[3] > 1.5 * depths[2],
        "{table}"
    );
    // The last column is the first of both lives: the slider, narrow, is worn by 1e-7 mm before 2e-7 mm.
    assert_eq!(header.last(), Some(&"first_life_cycles"));
    assert_eq!(lives.len(), 4, "{table}");
    assert!(
        lives.iter().all(|life| (1.0..2.5).contains(life)),
        "{table}"
    );
    assert!(lives[1] < lives[0] && lives[3] < lives[2], "{table}");
}
