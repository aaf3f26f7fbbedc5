//! Workers whose solving processes do not start: the fault of the machine, not of the jobs.

use std::fs::Permissions;

use futures_util::future::join_all;

use super::*;
use crate::solve::Failure;

/// A way in which a program does not start, and what the status reason of the job says of it.
struct Fault {
    cause: &'static str,
    harm: fn(&Path),
}

const FAULTS: [Fault; 7] = [
    Fault {
        cause: "No such file or directory",
        harm: |_| (),
    },
    Fault {
        cause: "Permission denied",
        harm: |folder| {
            write_program(folder, "exit 0");
            let program = folder.join(PROGRAM);
            std::fs::set_permissions(program, Permissions::from_mode(0o644)).expect("a program");
        },
    },
    Fault {
        cause: "Exec format error",
        harm: |folder| {
            let program = folder.join(PROGRAM);
            std::fs::write(&program, [0; 64]).expect("a file");
            std::fs::set_permissions(program, Permissions::from_mode(0o755)).expect("a program");
        },
    },
    Fault {
        cause: "ended with code 127: libfretwear.so: cannot open shared object file",
        harm: |folder| {
            let fail = "echo 'libfretwear.so: cannot open shared object file' >&2; exit 127";
            write_program(folder, fail);
        },
    },
    Fault {
        cause: "ended with code 0",
        harm: |folder| write_program(folder, "exit 0"),
    },
    Fault {
        cause: "was killed",
        harm: |folder| write_program(folder, "kill -9 $$"),
    },
    Fault {
        cause: "cannot be read",
        harm: |folder| write_program(folder, "echo another program; exec sleep 60"),
    },
];

/// Runs a worker with a fault until its job is in the queue again, and then with a program that starts.
async fn repaired(fault: &Fault) {
    let folder = TempDir::new().expect("a temporary folder");
    (fault.harm)(folder.path());
    let scripted = Scripted::in_folder(folder, None).await;
    let has_cause = |text: Option<&str>| text.is_some_and(|text| text.contains(fault.cause));
    let is_back = |job: &Job| has_cause(job.status_reason.as_deref());
    let job = scripted.job_when(is_back).await;
    assert_eq!((job.status, job.attempts), (Status::Queued, 0), "{job:?}");
    assert!(
        has_cause(scripted.health.failing().as_deref()),
        "{}",
        fault.cause
    );
    let failed = ChildMessage::Failed(Failure {
        outcome: Outcome::NotConverged,
        reason: "as the test asked for".to_owned(),
    });
    let failed = serde_json::to_string(&failed).expect("a line");
    write_program(scripted.folder.path(), &format!("{READY}\necho '{failed}'"));
    let job = scripted.ended().await;
    let reason = job.status_reason.as_deref();
    assert_eq!((job.attempts, reason), (1, Some("as the test asked for")));
    assert_eq!(scripted.health.failing(), None);
    scripted.stop().await;
}

#[tokio::test]
async fn a_process_that_does_not_start_costs_no_attempt_and_its_worker_goes_on_once_it_does() {
    join_all(FAULTS.iter().map(repaired)).await;
}
