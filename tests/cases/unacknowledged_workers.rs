//! Requirement: a submission that Slurm accepts without saying so, or lists late, is not repeated: there are never more workers than
//! `--most`. Slurm is two scripts here.

use std::os::unix::fs::PermissionsExt;
use std::path::Path;
use std::process::{Command, Stdio};
use std::time::{Duration, Instant};

use tests::Server;
use tests::program::binary;

/// Workers at a time.
const MOST: usize = 2;
/// Looks at the queue before it lists what was accepted, and after which the test ends.
const LATE: usize = 4;
const LOOKS: usize = 7;
/// Timeout of a wait; no measure of speed.
const PATIENCE: Duration = Duration::from_mins(2);

/// Accepts all tasks of an array, and then ends as it is told.
const SBATCH: &str = r#"#!/bin/sh
for word in "$@"; do
    case "$word" in
        --array=1-*) tasks=${word#--array=1-} ;;
        --comment=*) key=${word#--comment=} ;;
    esac
done
cat > /dev/null
task=1
while [ "$task" -le "$tasks" ]; do
    echo "PENDING 7_$task $key" >> accepted
    task=$((task + 1))
done
ANSWER
"#;
const SQUEUE: &str = r#"#!/bin/sh
echo >> looks
if [ "$(wc -l < looks)" -gt LATE ]; then cat accepted; fi
"#;

fn write_program(folder: &Path, name: &str, text: &str) {
    let path = folder.join(name);
    std::fs::write(&path, text).expect("a script can be written");
    let executable = std::fs::Permissions::from_mode(0o755);
    std::fs::set_permissions(&path, executable).expect("a mode");
}

fn lines(path: &Path) -> usize {
    std::fs::read_to_string(path).map_or(0, |text| text.lines().count())
}

/// Workers that a pilot has submitted to a cluster whose `sbatch` ends so, when it has looked a few times.
async fn submitted(server: &Server, answer: &str) -> usize {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let place = folder.path();
    write_program(place, "sbatch", &SBATCH.replace("ANSWER", answer));
    write_program(place, "squeue", &SQUEUE.replace("LATE", &LATE.to_string()));
    let paths = std::env::var("PATH").expect("a path");
    let mut pilot = Command::new(binary())
        .args(["pilot", "slurm", "--every-s", "1", "--server", &server.base])
        .args(["--most", &MOST.to_string()])
        .current_dir(place)
        .env("PATH", format!("{}:{paths}", place.display()))
        .stderr(Stdio::null())
        .spawn()
        .expect("a pilot");
    let start = Instant::now();
    while lines(&place.join("looks")) < LOOKS {
        assert!(start.elapsed() < PATIENCE, "the pilot looks");
        tokio::time::sleep(Duration::from_millis(50)).await;
    }
    pilot.kill().expect("it runs");
    pilot.wait().expect("it was started");
    lines(&place.join("accepted"))
}

#[tokio::test]
async fn a_submission_that_is_not_acknowledged_or_listed_late_is_not_repeated() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start_with(folder.path(), &["--workers", "0"]);
    for _ in 0..2 * MOST {
        let spec = r#"{"system":{"kind":"fuzz_button"},"cycles":20000}"#;
        let (status, job) = server.submit(spec).await;
        assert_eq!(status, 202, "{job}");
    }
    let timed_out = "echo 'sbatch: error: Batch job submission failed: Socket timed out on send/recv operation' >&2; exit 1";
    for answer in [timed_out, "echo 7"] {
        let workers = submitted(&server, answer).await;
        assert!((1..=MOST).contains(&workers), "{workers} after {answer}");
    }
}
