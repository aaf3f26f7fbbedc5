//! `POST /v1/worker/writes`: updates and ends of attempts.

use std::collections::HashMap;

use axum::Json;
use axum::extract::State;
use futures_util::future::join_all;
use uuid::Uuid;

use crate::http::app::App;
use crate::http::problem::{ProblemResponse, ProblemType};
use crate::http::worker_body::WorkerBody;
use crate::store::block::EncodedBlock;
use crate::store::{Store, Write, WriteKind};
use crate::worker::Employer;
use crate::worker::protocol::{MOST_WRITES, WriteAnswer, lease_length};

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
    let mut jobs: HashMap<Uuid, Vec<(usize, Write)>> = HashMap::new();
    for (number, write) in writes.into_iter().enumerate() {
        let job = jobs.entry(write.lease.job).or_default();
        job.push((number, write));
    }
    let of_jobs = jobs.into_values();
    let done = join_all(of_jobs.map(|writes| one_after_the_other(&app.store, writes))).await;
    let mut answers = done.concat();
    answers.sort_by_key(|(number, _)| *number);
    let answers = answers.into_iter().map(|(_, answer)| answer);
    Ok(Json(answers.collect()))
}

/// Does the writes of a job.
async fn one_after_the_other(
    store: &Store,
    writes: Vec<(usize, Write)>,
) -> Vec<(usize, WriteAnswer)> {
    let mut answers = Vec::with_capacity(writes.len());
    for (number, write) in writes {
        // Summaries make it too large for the stack of a task.
        let answer = Box::pin(one(store, write)).await;
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

    use serde_json::{Value, json};

    use crate::http::tests::Service;
    use crate::queue::Transition;
    use crate::store::tests::{end, update};
    use crate::store::{Claim, JobUpdate, Lease, Write, WriteKind};
    use crate::worker::protocol::MOST_WRITES;

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
