//! `POST /v1/worker/writes`: updates and ends of attempts.

use std::collections::HashMap;
use std::sync::Arc;
use std::time::Duration;

use axum::Json;
use axum::extract::State;
use futures_util::future::join_all;
use tokio::time::{Instant, timeout_at};
use uuid::Uuid;

use crate::http::app::App;
use crate::http::problem::{ProblemResponse, ProblemType};
use crate::http::worker_body::WorkerBody;
use crate::queue::Transition;
use crate::store::block::EncodedBlock;
use crate::store::{Store, Write, WriteKind};
use crate::worker::Employer;
use crate::worker::protocol::{MOST_WRITES, WriteAnswer, lease_length};

/// Longest time that the writes of several jobs wait for the slowest of them.
const LONGEST: Duration = Duration::from_secs(5);

/// Records updates whose files were sent before, ends jobs or returns them to the queue. Each write has its own answer; those of one job are
/// done one after the other.
pub(crate) async fn write(
    State(app): State<App>,
    WorkerBody(writes): WorkerBody<Vec<Write>>,
) -> Result<Json<Vec<WriteAnswer>>, ProblemResponse> {
    if writes.len() > MOST_WRITES {
        let detail = format!("{} writes, {MOST_WRITES} at most", writes.len());
        return Err(ProblemType::UNREADABLE_BODY.with_detail(detail));
    }
    Ok(Json(answers(&app.store, writes, LONGEST).await))
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
    // In tasks of their own: who watches a job learns of a change also if the worker has gone meanwhile.
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
            let length = lease_length(length);
            WriteAnswer::Lease(Employer::record(store, lease, &update, length).await?)
        }
        WriteKind::End(end) => {
            if matches!(end.transition, Transition::Claim | Transition::Retry) {
                let detail = format!("/kind/end/transition: {:?} ends no attempt", end.transition);
                return Err(ProblemType::UNREADABLE_BODY.with_detail(detail));
            }
            if let Some(Err(cause)) = update.block.as_ref().map(EncodedBlock::check) {
                let detail = format!("/update/block: {cause}");
                return Err(ProblemType::UNREADABLE_BODY.with_detail(detail));
            }
            WriteAnswer::Status(Employer::finish(store, lease, &update, &end).await?)
        }
    })
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
