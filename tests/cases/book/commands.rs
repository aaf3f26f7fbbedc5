//! The curl lines of a page work unchanged, one after the other, against a service.

use std::path::Path;
use std::process::Command;

use tests::Server;

/// The address that the book uses.
const ADDRESS: &str = "http://127.0.0.1:8080";

/// Command lines, without their comments.
fn commands(page: &str) -> Vec<String> {
    page.lines()
        .filter_map(|line| line.strip_prefix("    curl "))
        .map(|rest| {
            format!(
                "curl {}",
                rest.split("  #").next().unwrap_or_default().trim()
            )
        })
        .collect()
}

/// Ids from earlier answers.
#[derive(Default)]
struct Known {
    job: String,
    sweep: String,
    study: String,
}

/// Runs a command as a shell does; errors of the service end it with a code.
fn run(folder: &Path, base: &str, known: &Known, command: &str) -> (Option<i32>, String) {
    let strict = r#"curl() { command curl -sS --fail-with-body --max-time 200 "$@"; }"#;
    let Known { job, sweep, study } = known;
    let command = command.replace(ADDRESS, base);
    let script = format!("{strict}\nID={job}\nSWEEP={sweep}\nSTUDY={study}\n{command}");
    let output = Command::new("bash")
        .args(["-c", &script])
        .current_dir(folder)
        .output()
        .expect("bash can be started");
    let answer = String::from_utf8_lossy(&output.stdout).into_owned();
    (
        output.status.code(),
        answer + &String::from_utf8_lossy(&output.stderr),
    )
}

#[tokio::test]
#[cfg_attr(not(has_curl), ignore = "needs curl")]
async fn the_curl_lines_of_the_tutorials_work() {
    for page in ["docs/tutorial/using.md", "docs/tutorial/thickness.md"] {
        check(page).await;
    }
}

async fn check(page: &str) {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start(folder.path());
    let house = Path::new(env!("CARGO_MANIFEST_DIR")).join("..");
    let page = std::fs::read_to_string(house.join(page)).expect("the page is there");
    let commands = commands(&page);
    // Commands write files where they run, so they run elsewhere, beside the specifications that they name.
    let specs = folder.path().join("tests");
    std::fs::create_dir(&specs).expect("a folder can be made");
    std::os::unix::fs::symlink(house.join("tests/specs"), specs.join("specs"))
        .expect("a link can be made");
    assert!(commands.len() >= 2, "{commands:?}");
    let mut known = Known::default();
    for command in &commands {
        if command.contains("DELETE") {
            server
                .batch_ended(&format!("/v1/sweeps/{}", known.sweep))
                .await;
        }
        let (code, answer) = run(folder.path(), &server.base, &known, command);
        assert_eq!(code, Some(0), "{command}\n{answer}");
        if let Some(location) = answer
            .lines()
            .find_map(|line| line.strip_prefix("location: /v1/jobs/"))
        {
            location.trim().clone_into(&mut known.job);
        }
        for (path, id) in [
            ("/v1/sweeps", &mut known.sweep),
            ("/v1/studies", &mut known.study),
        ] {
            if command.contains("--json") && command.ends_with(path) {
                let answer: serde_json::Value = serde_json::from_str(&answer).expect("JSON");
                answer["id"].as_str().expect("an id").clone_into(id);
            }
        }
        if command.contains("/events") {
            assert!(answer.contains("event: done"), "{answer}");
        }
    }
}
