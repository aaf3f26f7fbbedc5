//! `POST /v1/worker/writes`: updates and ends of attempts.

use std::collections::HashMap;
use std::sync::Arc;
use std::time::Duration;

use axum::extract::State;
use axum::{Extension, Json};
use futures_util::future::join_all;
use tokio::time::{Instant, timeout_at};
use uuid::Uuid;

use crate::http::app::App;
use crate::http::problem::{ProblemResponse, ProblemType};
use crate::http::worker_access::WorkerToken;
use crate::http::worker_body::WorkerBody;
use crate::queue::Transition;
use crate::store::{LeaseState, Store, UpdateFault, Write, WriteKind};
use crate::worker::JobSource;
use crate::worker::protocol::{MOST_WRITES, WriteAnswer, lease_length};

/// Longest time that the writes of several jobs wait for the slowest of them.
const LONGEST: Duration = Duration::from_secs(5);

/// Records updates whose files were sent before, ends jobs or returns them to the queue. Each write has its own answer; those of one job are
/// done one after the other.
pub(crate) async fn write(
    State(app): State<App>,
    Extension(token): Extension<WorkerToken>,
    WorkerBody(writes): WorkerBody<Vec<Write>>,
) -> Result<Json<Vec<WriteAnswer>>, ProblemResponse> {
    if writes.len() > MOST_WRITES {
        let detail = format!("{} writes, {MOST_WRITES} at most", writes.len());
        return Err(ProblemType::UNREADABLE_BODY.with_detail(detail));
    }
    let leases = writes.iter().map(|write| write.lease);
    let owned = token.owned(&app.store, leases).await?;
    let mut all: Vec<_> = writes.iter().map(|write| lost(&write.kind)).collect();
    let own = writes.into_iter().enumerate();
    let (numbers, own): (Vec<_>, Vec<_>) = own
        .filter(|(_, write)| owned.contains(&write.lease))
        .unzip();
    let done = answers(&app.store, own, LONGEST).await;
    for (number, answer) in numbers.into_iter().zip(done) {
        all[number] = answer;
    }
    Ok(Json(all))
}

/// The answer to a write under a lease that was lost.
fn lost(kind: &WriteKind) -> WriteAnswer {
    match kind {
        WriteKind::Renew(_) => WriteAnswer::Lease(LeaseState::Lost),
        WriteKind::End(_) => WriteAnswer::Status(None),
    }
}

/// Does writes. Where there is more than one job, what takes longer is not waited for.
async fn answers(store: &Arc<Store>, writes: Vec<Write>, longest: Duration) -> Vec<WriteAnswer> {
    let count = writes.len();
    let mut jobs: HashMap<Uuid, Vec<(usize, Write)>> = HashMap::new();
    for (number, write) in writes.into_iter().enumerate() {
        let job = jobs.entry(write.lease.job).or_default();
        job.push((number, write));
    }
    let until = (jobs.len() > 1).then(|| Instant::now() + longest);
    // Also after a panic; then it has no answer alone either.
    let unanswered = if until.is_some() {
        WriteAnswer::Pending
    } else {
        let problem = ProblemType::INTERNAL.with_detail("the write was interrupted");
        WriteAnswer::Problem(problem.document())
    };
    // In tasks of their own: subscribers of a job are notified even if the worker has disconnected meanwhile.
    let tasks: Vec<_> = jobs
        .into_values()
        .map(|writes| tokio::spawn(one_after_the_other(Arc::clone(store), writes)))
        .collect();
    let done = tasks.into_iter().map(async |task| match until {
        Some(until) => timeout_at(until, task).await.ok()?.ok(),
        None => task.await.ok(),
    });
    let mut answers = vec![unanswered; count];
    let done = join_all(done).await.into_iter().flatten();
    for (number, answer) in done.flatten() {
        answers[number] = answer;
    }
    answers
}

/// Does the writes of a job.
async fn one_after_the_other(
    store: Arc<Store>,
    writes: Vec<(usize, Write)>,
) -> Vec<(usize, WriteAnswer)> {
    let mut answers = Vec::with_capacity(writes.len());
    for (number, write) in writes {
        // Summaries make it too large for the stack of a task.
        let answer = Box::pin(one(&store, write)).await;
        let problem = |problem: ProblemResponse| WriteAnswer::Problem(problem.document());
        answers.push((number, answer.unwrap_or_else(problem)));
    }
    answers
}

async fn one(store: &Store, write: Write) -> Result<WriteAnswer, ProblemResponse> {
    let Write {
        lease,
        update,
        kind,
    } = write;
    Ok(match kind {
        WriteKind::Renew(length) => {
            update.check().map_err(|cause| refused(&cause))?;
            let length = lease_length(length);
            WriteAnswer::Lease(JobSource::record(store, lease, &update, length).await?)
        }
        WriteKind::End(end) => {
            if matches!(end.transition, Transition::Claim | Transition::Retry) {
                let detail = format!("/kind/end/transition: {:?} ends no attempt", end.transition);
                return Err(ProblemType::UNREADABLE_BODY.with_detail(detail));
            }
            update.check().map_err(|cause| refused(&cause))?;
            WriteAnswer::Status(JobSource::finish(store, lease, &update, &end).await?)
        }
    })
}

/// The problem of an update that is not as a worker writes it.
fn refused(cause: &UpdateFault) -> ProblemResponse {
    ProblemType::UNREADABLE_BODY.with_detail(cause.to_string())
}

#[cfg(test)]
mod tests {
    use std::time::Duration;

    use api::job::Status;
    use serde_json::{Value, json};

    use super::answers;
    use crate::http::tests::Service;
    use crate::queue::Transition;
    use crate::store::tests::{end, update};
    use crate::store::{Claim, JobUpdate, Lease, Write, WriteKind};
    use crate::worker::protocol::{MOST_WRITES, WriteAnswer};

    const PATH: &str = "/v1/worker/writes";

    async fn claimed(service: &Service) -> Claim {
        service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        service.app.store.claim_next(i64::MAX).await.expect("a job")
    }

    fn numbered(number: i64) -> JobUpdate {
        JobUpdate {
            number,
            ..update(1)
        }
    }

    fn update_of(lease: Lease, number: i64) -> Write {
        Write {
            lease,
            update: numbered(number),
            kind: WriteKind::Renew(Duration::from_secs(30)),
        }
    }

    fn end_of(lease: Lease, number: i64) -> Write {
        Write {
            lease,
            update: numbered(number),
            kind: WriteKind::End(Box::new(end(Transition::Succeed))),
        }
    }

    #[tokio::test]
    async fn writes_that_take_long_are_answered_when_they_are_sent_alone() {
        let service = Service::new().await;
        let (first, second) = (claimed(&service).await, claimed(&service).await);
        let (first, second) = (Lease::from(&first), Lease::from(&second));
        let writes = [update_of(first, 1), end_of(second, 1), end_of(first, 2)];
        let all = answers(&service.app.store, writes.to_vec(), Duration::ZERO).await;
        assert_eq!(all, vec![WriteAnswer::Pending; 3]);
        // They are done nevertheless, once.
        let ended = WriteAnswer::Status(Some(Status::Succeeded));
        for write in [end_of(second, 1), end_of(first, 2)] {
            let job = write.lease.job;
            let alone = answers(&service.app.store, vec![write], Duration::ZERO).await;
            assert_eq!(alone, std::slice::from_ref(&ended));
            let events = service.app.store.events(job, 0).await.expect("events");
            let ends = events.iter().filter(|event| event.name == "done");
            assert_eq!(ends.count(), 1, "{events:?}");
        }
    }

    #[tokio::test]
    async fn ends_that_are_none_are_refused() {
        let service = Service::new().await;
        let lease = Lease::from(&claimed(&service).await);
        for transition in [Transition::Claim, Transition::Retry] {
            let write = Write {
                kind: WriteKind::End(Box::new(end(transition))),
                ..end_of(lease, 1)
            };
            let (status, answers) = post(&service, &[write]).await;
            let problem = &answers[0]["problem"];
            assert_eq!((status, &problem["status"]), (200, &json!(400)));
            let detail = problem["detail"].to_string();
            assert!(detail.contains("ends no attempt"), "{problem}");
        }
        let held = (
            200,
            json!([{"lease": {"held": {"cancel_requested": false}}}]),
        );
        assert_eq!(post(&service, &[update_of(lease, 1)]).await, held);
    }

    async fn post(service: &Service, writes: &[Write]) -> (u16, Value) {
        let body = serde_json::to_string(writes).expect("JSON");
        let (status, _, answers) = service.post(PATH, &body).await;
        (status.as_u16(), answers)
    }

    /// An update with one file and one event, as JSON.
    fn with_file(name: &str, sha256: &str, event: &str) -> Value {
        let file = json!({"name": name, "cycle": null, "media_type": "text/csv", "bytes": 1, "sha256": sha256});
        let mut update = serde_json::to_value(numbered(1)).expect("JSON");
        update["files"] = json!([{"file": file, "content": "folder"}]);
        update["events"] = json!([["cycle", event]]);
        update
    }

    #[tokio::test]
    async fn an_update_with_a_name_that_leads_out_of_its_folder_or_other_nonsense_is_refused() {
        let service = Service::new().await;
        let lease = Lease::from(&claimed(&service).await);
        let digest = crate::export::files::sha256(b"1");
        let mut block = crate::store::block::Block::default();
        let file = crate::export::files::manifest_entry("../a.csv", None, "text/csv", b"1");
        assert!(block.push_document(&file, b"1"));
        let mut with_block = serde_json::to_value(numbered(1)).expect("JSON");
        with_block["block"] = serde_json::to_value(block.encode().expect("encoded")).expect("JSON");
        let mut cases = vec![
            (with_file("a.csv", "00", "{}"), "`00` is no SHA-256"),
            (
                with_file("a.csv", &digest, "1\nid: 7"),
                "is no JSON document of one line",
            ),
            (
                with_file("a.csv", &digest, "{}\n"),
                "is no JSON document of one line",
            ),
            (with_block, "`../a.csv` is no entry of a block"),
        ];
        let names = [
            "../../a.csv",
            "/etc/passwd",
            "..",
            "",
            "a/b",
            "a\\b",
            "a\nb",
            "a\0",
            "c:a",
        ];
        let named = names.map(|name| (with_file(name, &digest, "{}"), "is no plain file name"));
        cases.extend(named);
        cases.push((
            with_file(&"a".repeat(256), &digest, "{}"),
            "is no plain file name",
        ));
        for (update, detail) in cases {
            for kind in [
                json!({"renew": Duration::from_secs(9)}),
                json!({"end": end(Transition::Succeed)}),
            ] {
                let body = json!([{"lease": lease, "update": update, "kind": kind}]);
                let (_, _, answers) = service.post(PATH, &body.to_string()).await;
                let problem = &answers[0]["problem"];
                let found = problem["detail"].as_str().unwrap_or_default();
                assert!(
                    problem["status"] == 400 && found.contains(detail),
                    "{detail}: {answers}"
                );
            }
        }
        let held = (
            200,
            json!([{"lease": {"held": {"cancel_requested": false}}}]),
        );
        assert_eq!(post(&service, &[update_of(lease, 1)]).await, held);
    }

    #[tokio::test]
    async fn each_write_has_its_answer_and_those_of_a_job_are_done_in_their_order() {
        let service = Service::new().await;
        let (first, second) = (claimed(&service).await, claimed(&service).await);
        let lost = Lease {
            number: first.lease + 1,
            ..Lease::from(&first)
        };
        let (first, second) = (Lease::from(&first), Lease::from(&second));
        let writes = [
            update_of(first, 1),
            update_of(second, 1),
            end_of(first, 2),
            update_of(lost, 1),
            end_of(second, 2),
            update_of(second, 3),
        ];
        let held = json!({"lease": {"held": {"cancel_requested": false}}});
        let ended = json!({"status": "succeeded"});
        let is_lost = json!({"lease": "lost"});
        let expected = json!([held, held, ended, is_lost, ended, is_lost]);
        assert_eq!(post(&service, &writes).await, (200, expected));
    }

    #[tokio::test]
    async fn more_writes_than_a_request_may_have_are_refused() {
        let service = Service::new().await;
        let lease = Lease::from(&claimed(&service).await);
        let writes: Vec<_> = (1..)
            .map(|n| update_of(lease, n))
            .take(MOST_WRITES + 1)
            .collect();
        let (status, problem) = post(&service, &writes).await;
        assert_eq!(status, 400, "{problem}");
        assert!(
            problem["detail"]
                .to_string()
                .contains("257 writes, 256 at most"),
            "{problem}"
        );
    }
}
