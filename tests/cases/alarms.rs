//! Requirement: the alarms for Prometheus name metrics that the service has, and are raised when they should be, not before.

use std::collections::BTreeSet;
use std::path::Path;
use std::process::Command;

use tests::Server;

/// Folder of the rules.
const FOLDER: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../docker/prometheus");

/// Names of the service's metrics in a text.
fn metrics(text: &str) -> BTreeSet<&str> {
    let words = text.split(|c: char| !c.is_ascii_alphanumeric() && c != '_');
    words.filter(|word| word.starts_with("fretwear_")).collect()
}

#[tokio::test]
async fn alarms_name_metrics_of_the_service() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::without_workers(folder.path(), &[]);
    let (_, known) = server.get("/metrics").await;
    let known = metrics(known.as_str().expect("a text"));
    for file in ["alerts.yaml", "alerts_test.yaml"] {
        let rules = std::fs::read_to_string(Path::new(FOLDER).join(file)).expect("rules");
        let named = metrics(&rules);
        assert!(named.len() >= 7, "{named:?}");
        let unknown: Vec<_> = named.difference(&known).collect();
        assert!(unknown.is_empty(), "{file}: {unknown:?}");
    }
}

#[test]
#[cfg_attr(not(has_promtool), ignore = "needs the program promtool")]
fn alarms_are_raised_when_they_should_be() {
    for arguments in [["check", "alerts.yaml"], ["test", "alerts_test.yaml"]] {
        let mut promtool = Command::new("promtool");
        promtool.args([arguments[0], "rules", arguments[1]]);
        let ran = promtool.current_dir(FOLDER).output().expect("promtool");
        let said = String::from_utf8_lossy(&ran.stdout);
        assert!(ran.status.success(), "{said}");
        assert!(said.contains("SUCCESS"), "{said}");
    }
}
