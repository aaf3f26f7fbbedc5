//! The architecture that docs/architecture.md states: which crate, which folder and which file may depend on which.
//!
//! The crates are compared with what cargo reports, the folders and files with what their sources name
//! (`sources` says precisely what counts). Each rule is a sentence of that page; a test fails with that sentence and
//! with the lines that contradict it.

mod cycles;
mod resolution;
mod rules;
mod sources;
mod surface;
mod tests;
mod violations;

use std::path::Path;

use cargo_metadata::MetadataCommand;

use sources::Sources;

/// Crate, and the crates of this workspace that it depends on (dev-dependencies included).
const CRATE_DEPENDENCIES: [(&str, &[&str]); 4] = [
    ("api", &[]),
    ("server", &["api", "solver"]),
    ("solver", &[]),
    ("tests", &["api", "server", "solver"]),
];

/// Crates that the engine must not depend on: async, JSON, SQL, clocks, logs. (`serde` itself writes nothing: it only
/// names the fields of a checkpoint.)
const NOT_IN_SOLVER: [&str; 5] = ["serde_json", "sqlx", "tokio", "tracing", "jiff"];

#[test]
fn crates_depend_only_on_what_the_table_allows() {
    let metadata = MetadataCommand::new()
        .no_deps()
        .exec()
        .expect("cargo describes the workspace");
    let names: Vec<&str> = CRATE_DEPENDENCIES.iter().map(|(name, _)| *name).collect();
    for (name, allowed) in CRATE_DEPENDENCIES {
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
        assert_eq!(edges, allowed, "{name}");
        if name == "solver" {
            let foreign = |dependency: &&str| NOT_IN_SOLVER.contains(dependency);
            let names = package
                .dependencies
                .iter()
                .map(|dependency| dependency.name.as_str());
            assert_eq!(names.filter(|name| foreign(name)).count(), 0);
        }
    }
    assert_eq!(metadata.workspace_members.len(), CRATE_DEPENDENCIES.len());
}

#[test]
fn folders_and_files_depend_only_on_what_the_rules_allow() {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR"));
    let workspace = tests.parent().expect("the workspace");
    let sources = ["api", "solver", "server"].map(|name| Sources::read(workspace, name));
    let mut found = violations::violations(&sources);
    found.extend(sources.iter().flat_map(cycles::between_files));
    found.extend(sources.iter().flat_map(cycles::between_folders));
    let found: Vec<String> = found.iter().map(ToString::to_string).collect();
    assert!(found.is_empty(), "\n\n{}\n", found.join("\n\n"));
}

#[test]
fn what_the_engine_makes_public_is_used_by_another_crate() {
    let tests = Path::new(env!("CARGO_MANIFEST_DIR"));
    let workspace = tests.parent().expect("the workspace");
    let unused = surface::unused(workspace, "solver/src", &surface::USERS);
    assert!(unused.is_empty(), "\n\n{}\n", unused.join("\n"));
}
