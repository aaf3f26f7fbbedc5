//! Requirement: `fretwear pilot slurm` keeps workers on a cluster as long as a service has work for them: everything that waits is solved,
//! a task that is cancelled costs no attempt, and nothing is left on the cluster.
//!
//! The long form prints the running jobs over time, and draws them in `target/slurm-sweep.svg`:
//!
//!     FRETWEAR_SLURM_JOBS=10000 cargo test --release -p tests --test cases slurm -- --nocapture

use std::path::Path;
use std::process::Command;
use std::time::{Duration, Instant};

use serde_json::{Value, json};
use tests::{Server, Slurm, binary};

/// A job of some 0.1 s.
const SPEC: &str = r#"{"system":{"kind":"cylinder_on_flat"},"cycles":20,"accuracy":{"preset":"draft"},
    "load":{"kind":"line_force","n_per_mm":18.5}}"#;
/// Timeout of a wait; no measure of speed.
const PATIENCE: Duration = Duration::from_mins(4);
/// Workers at a time.
const MOST: &str = "6";

/// A pilot of a service on a cluster, until nothing waits or runs.
fn pilot(server: &Server, slurm: &Slurm) -> Command {
    let mut command = slurm.command(&binary().display().to_string());
    command.args(["pilot", "slurm", "--until-idle", "--every-s", "1"]);
    command.args(["--server", &server.base, "--most", MOST]);
    command
}

/// Waits until no task is there.
async fn emptied(slurm: &Slurm) {
    let start = Instant::now();
    while !slurm.lines("squeue", &["-h"]).is_empty() {
        assert!(start.elapsed() < PATIENCE, "tasks end");
        tokio::time::sleep(Duration::from_millis(50)).await;
    }
}

#[tokio::test]
#[cfg_attr(
    not(has_slurm),
    ignore = "needs the programs of Slurm and MUNGE, and to be root"
)]
async fn a_cluster_solves_what_waits_and_is_left_empty() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let slurm = Slurm::start(folder.path());
    let server = Server::without_workers(folder.path(), &[]);
    let mut ids = Vec::new();
    // One is long enough to be cancelled while it runs.
    for spec in [r#"{"system":{"kind":"fuzz_button"},"cycles":20000}"#]
        .into_iter()
        .chain([SPEC; 12])
    {
        let (status, job) = server.submit(spec).await;
        assert_eq!(status, 202, "{job}");
        ids.push(job["id"].as_str().expect("an id").to_owned());
    }
    let mut first = pilot(&server, &slurm).spawn().expect("a pilot");
    let computes = |job: &Value| job["progress"]["cycle"].as_u64() > Some(0);
    server.job_when(&ids[0], computes).await;
    // A killed pilot submits no other workers.
    first.kill().expect("it runs");
    first.wait().expect("it was started");
    slurm.lines("scancel", &["--full", "--name", "fretwear"]);
    emptied(&slurm).await;
    let (_, job) = server.get(&format!("/v1/jobs/{}", ids[0])).await;
    let (status, attempts) = (&job["status"], &job["attempts"]);
    assert_eq!(
        (status, attempts),
        (&json!("queued"), &json!(0)),
        "a cancelled task costs no attempt: {job}"
    );
    let mut running = pilot(&server, &slurm).spawn().expect("a pilot");
    let (status, _) = server.post(&format!("/v1/jobs/{}/cancel", ids[0])).await;
    assert_eq!(status, 202);
    for id in &ids[1..] {
        let job = server
            .job_when(id, |job| job["finished_at"].is_string())
            .await;
        assert_eq!(
            (&job["status"], &job["attempts"]),
            (&json!("succeeded"), &json!(1)),
            "{job}"
        );
    }
    assert!(running.wait().expect("the pilot ends").success());
    emptied(&slurm).await;
}

/// Workers that fail, here because of their program, are submitted less and less often, and the pilot reports it.
#[tokio::test]
#[cfg_attr(
    not(has_slurm),
    ignore = "needs the programs of Slurm and MUNGE, and to be root"
)]
async fn a_pilot_slows_down_when_its_workers_fail() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let slurm = Slurm::start(folder.path());
    let server = Server::without_workers(folder.path(), &[]);
    let program = folder.path().join("fretwear");
    std::fs::copy(binary(), &program).expect("the program can be copied");
    let log = folder.path().join("pilot.log");
    let mut command = slurm.command(&program.display().to_string());
    command.args(["pilot", "slurm", "--every-s", "1"]);
    command.args(["--server", &server.base, "--most", MOST]);
    let said = std::fs::File::create(&log).expect("a log can be made");
    let mut pilot = command.stderr(said).spawn().expect("a pilot");
    // The pilot runs; workers would start what is at its path now.
    std::fs::remove_file(&program).expect("it is there");
    let failing = std::fs::File::create(&program).expect("it can be written");
    let executable = std::os::unix::fs::PermissionsExt::from_mode(0o755);
    failing.set_permissions(executable).expect("it is ours");
    std::fs::write(&program, "#!/bin/sh\nexit 1\n").expect("it can be written");
    let (status, job) = server.submit(SPEC).await;
    assert_eq!(status, 202, "{job}");
    let start = Instant::now();
    let said = loop {
        let said = std::fs::read_to_string(&log).expect("a log");
        if said.matches("workers have failed").count() > 2 {
            break said;
        }
        assert!(start.elapsed() < PATIENCE, "the pilot says it: {said}");
        tokio::time::sleep(Duration::from_millis(50)).await;
    };
    // One start for each warning, and pauses of two, four and eight looks.
    let warnings: Vec<_> = said.split("workers have failed").take(3).collect();
    for before in warnings {
        assert_eq!(before.matches("workers submitted").count(), 1, "{said}");
    }
    for pause in [2, 4, 8] {
        assert!(said.contains(&format!("again_in_s={pause}")), "{said}");
    }
    pilot.kill().expect("it runs");
    pilot.wait().expect("it was started");
    emptied(&slurm).await;
    let (_, job) = server
        .get(&format!("/v1/jobs/{}", job["id"].as_str().expect("an id")))
        .await;
    let (status, attempts) = (&job["status"], &job["attempts"]);
    assert_eq!((status, attempts), (&json!("queued"), &json!(0)), "{job}");
}

#[tokio::test]
#[cfg_attr(
    not(has_slurm),
    ignore = "needs the programs of Slurm and MUNGE, and to be root"
)]
async fn a_sweep_is_solved_on_three_nodes() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let asked = std::env::var("FRETWEAR_SLURM_JOBS").ok();
    let is_long = asked.is_some();
    let jobs: usize = asked.map_or(24, |jobs| jobs.parse().expect("a number"));
    let slurm = Slurm::start(folder.path());
    let server = Server::without_workers(folder.path(), &[]);
    let base: Value = serde_json::from_str(SPEC).expect("JSON");
    let loads: Vec<f64> = (0..jobs)
        .map(|number| 10.0 + 1e-3 * f64::from(u32::try_from(number).expect("small")))
        .collect();
    let sweep = json!({"base": base, "grid": {"/load/n_per_mm": loads}});
    let (status, answer) = server.post_json("/v1/sweeps", &sweep).await;
    assert_eq!(status, 202, "{answer}");
    let began = Instant::now();
    let mut samples = Vec::new();
    let mut running = pilot(&server, &slurm).spawn().expect("a pilot");
    while running.try_wait().expect("a pilot").is_none() {
        let (_, service) = server.get("/v1/service").await;
        let sample = [
            began.elapsed().as_secs_f64(),
            service["jobs"]["running"].as_f64().expect("a number"),
        ];
        println!("{:.1} s: jobs {}", sample[0], service["jobs"]);
        samples.push(sample);
        tokio::time::sleep(Duration::from_millis(500)).await;
    }
    if is_long {
        let picture = Path::new(env!("CARGO_MANIFEST_DIR")).join("../target/slurm-sweep.svg");
        std::fs::write(picture, drawn(&samples)).expect("written");
    }
    emptied(&slurm).await;
    let (_, listed) = server
        .get("/v1/jobs?status=succeeded&limit=1&total=true")
        .await;
    assert_eq!(listed["total"], jobs, "{listed}");
}

/// Running jobs over time, as a drawing.
fn drawn(samples: &[[f64; 2]]) -> String {
    let largest = |of: usize| {
        samples
            .iter()
            .fold(1.0, |most: f64, sample| most.max(sample[of]))
    };
    let (seconds, jobs) = (largest(0), largest(1));
    let points: Vec<String> = samples
        .iter()
        .map(|[at, running]| {
            format!(
                "{:.1},{:.1}",
                50.0 + 540.0 * at / seconds,
                170.0 - 150.0 * running / jobs
            )
        })
        .collect();
    format!(
        r##"<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 610 210" font-family="sans-serif" font-size="12" fill="#555">
<text x="4" y="14">running jobs</text><text x="20" y="26">{jobs}</text><text x="30" y="174">0</text>
<text x="50" y="188">0</text><text x="540" y="188">{seconds:.0} s</text>
<path d="M50,20V170H590" fill="none" stroke="#999"/>
<polyline points="{}" fill="none" stroke="#0969da" stroke-width="1.5"/>
</svg>
"##,
        points.join(" ")
    )
}
