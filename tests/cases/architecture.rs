//! Which crate may know which: the table of the house, against what cargo says.

use cargo_metadata::MetadataCommand;

/// Crate, and the crates of this workspace that it knows (test-only edges included).
const KNOWS: [(&str, &[&str]); 4] = [
    ("api", &[]),
    ("server", &["api", "solver"]),
    ("solver", &[]),
    ("tests", &["server", "solver"]),
];

/// Crates that the engine must not know, whoever brings them: async, JSON, SQL, clocks, logs. (`serde` itself writes nothing:
/// it only names the fields of a checkpoint.)
const NOT_IN_SOLVER: [&str; 5] = ["serde_json", "sqlx", "tokio", "tracing", "jiff"];

#[test]
fn crates_know_only_what_the_table_allows() {
    let metadata = MetadataCommand::new()
        .no_deps()
        .exec()
        .expect("cargo describes the workspace");
    let names: Vec<&str> = KNOWS.iter().map(|(name, _)| *name).collect();
    for (name, known) in KNOWS {
        let found = metadata
            .packages
            .iter()
            .find(|package| package.name.as_str() == name);
        let package = found.expect("the table names the workspace's crates");
        let mut edges: Vec<&str> = package
            .dependencies
            .iter()
            .map(|dependency| dependency.name.as_str())
            .filter(|dependency| names.contains(dependency))
            .collect();
        edges.sort_unstable();
        edges.dedup();
        assert_eq!(edges, known, "{name}");
        if name == "solver" {
            let foreign = |dependency: &&str| NOT_IN_SOLVER.contains(dependency);
            let names = package
                .dependencies
                .iter()
                .map(|dependency| dependency.name.as_str());
            assert_eq!(names.filter(|name| foreign(name)).count(), 0);
        }
    }
    assert_eq!(metadata.workspace_members.len(), KNOWS.len());
}
