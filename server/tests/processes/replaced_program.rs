//! Services whose program is replaced, or may not be executed any more.

use super::*;

/// A copy of the program in a folder, which may be changed.
fn copied_program(folder: &Path) -> PathBuf {
    let program = folder.join("fretwear");
    std::fs::copy(FRETWEAR, &program).expect("a copy");
    program
}

#[tokio::test]
async fn a_service_whose_program_is_replaced_solves_with_the_program_that_it_is() {
    let folder = folder();
    let program = copied_program(folder.path());
    let server = Server::start_program(&program, folder.path());
    let other = folder.path().join("other");
    std::fs::write(&other, "#!/bin/sh\nexit 1\n").expect("a file");
    std::fs::rename(other, &program).expect("replaced");
    let replaced = server.submit(&spec(2)).await;
    let job = server.until_ended(&replaced).await;
    assert_eq!(
        (&job["status"], &job["attempts"]),
        (&json!("succeeded"), &json!(1)),
        "{job}"
    );
    std::fs::remove_file(&program).expect("removed");
    let removed = server.submit(&spec(2)).await;
    let job = server.until_ended(&removed).await;
    assert_eq!(
        (&job["status"], &job["attempts"]),
        (&json!("succeeded"), &json!(1)),
        "{job}"
    );
}

#[tokio::test]
async fn a_service_that_may_not_execute_its_program_fails_no_job_and_is_not_ready_until_it_may() {
    let folder = folder();
    let program = copied_program(folder.path());
    let server = Server::start_program(&program, folder.path());
    let allow = |mode| {
        let permissions = std::fs::Permissions::from_mode(mode);
        std::fs::set_permissions(&program, permissions).expect("a mode");
    };
    allow(0o644);
    let mut ids = Vec::new();
    for _ in 0..5 {
        ids.push(server.submit(&spec(2)).await);
    }
    let says_why = |job: &Value| {
        let reason = job["status_reason"].as_str().unwrap_or_default();
        reason.contains("did not start: Permission denied")
    };
    server.until(&ids[0], says_why).await;
    let problem = server.get("/readyz").await;
    assert_eq!(problem["type"], "/problems/workers-failing", "{problem}");
    for id in &ids {
        let job = server.get(&format!("/v1/jobs/{id}")).await;
        assert!(
            ["queued", "running"].contains(&job["status"].as_str().expect("text")),
            "{job}"
        );
    }
    allow(0o755);
    for id in &ids {
        let job = server.until_ended(id).await;
        assert_eq!(
            (&job["status"], &job["attempts"]),
            (&json!("succeeded"), &json!(1)),
            "{job}"
        );
    }
    assert_eq!(server.get("/readyz").await["status"], "ready");
}
