//! A remote service as a job source, over HTTP.

mod heartbeat;
mod options;

use std::path::PathBuf;
use std::sync::Arc;
use std::time::Duration;

use api::job::Status;
use api::problem::Problem;
use api::service::Demand;
use serde::Serialize;
use serde::de::DeserializeOwned;
use tokio_util::task::AbortOnDropHandle;

use super::{JobSource, JobSourceError};
use crate::client::{Client, ClientError};
use crate::groups::{Groups, Pending};
use crate::metrics::Busy;
use crate::solve::checkpoint::EncodedCheckpoint;
use crate::store::{
    Claim, ClaimRequest, End, JobUpdate, Lease, LeaseState, NewFile, Write, WriteKind,
};
use crate::worker::protocol::{ClaimBody, PROGRAM, RestartBody, Taken, WriteAnswer};

use heartbeat::{Leases, beat, held};

pub use options::RemoteOptions;

/// Where writes are sent.
const WRITES: &str = "/v1/worker/writes";

/// Why a write has no answer to a request of several.
#[derive(Debug, Clone)]
enum NotSent {
    /// The write is to be sent alone.
    Alone,
    /// The service was not reached, and would not be by a request with one of them.
    Unreachable { url: String, cause: String },
}

/// A remote service.
#[derive(Debug)]
pub struct Remote {
    options: RemoteOptions,
    leases: Leases,
    /// Name of this machine.
    host: String,
    /// Quick writes that are sent together.
    writes: Groups<Arc<Write>, Result<WriteAnswer, NotSent>>,
    _heartbeat: AbortOnDropHandle<()>,
}

impl Remote {
    /// The service for a process with workers. Until it is dropped, all leases are renewed, and the health of the workers is reported. Needs a
    /// tokio runtime.
    pub fn new(options: RemoteOptions) -> Self {
        let leases = Leases::default();
        let beating = beat(options.clone(), Arc::clone(&leases));
        let heartbeat = tokio::spawn(beating);
        Self {
            options,
            leases,
            host: host(),
            writes: Groups::default(),
            _heartbeat: AbortOnDropHandle::new(heartbeat),
        }
    }

    async fn post<T: DeserializeOwned>(
        &self,
        path: &str,
        body: &impl Serialize,
    ) -> Result<T, JobSourceError> {
        Ok(self.options.client.post(path, body).await?)
    }

    /// Sends a write, together with others that are sent at the same time if it is quick.
    async fn write(&self, write: Write) -> Result<WriteAnswer, JobSourceError> {
        let write = Arc::new(write);
        if is_quick(&write) {
            let send = |group| send_together(self.options.client.clone(), group);
            match self.writes.ask(Arc::clone(&write), send).await {
                Some(Ok(answer)) => return Ok(answer),
                Some(Err(NotSent::Unreachable { url, cause })) => {
                    return Err(ClientError::Unreachable { url, cause }.into());
                }
                Some(Err(NotSent::Alone)) | None => {}
            }
        }
        let answers: [WriteAnswer; 1] = self.post(WRITES, &[&*write]).await?;
        let [answer] = answers;
        Ok(answer)
    }

    /// Sends the files of an update, which count once it is written; the update with where they are.
    async fn put_files(
        &self,
        lease: Lease,
        update: &JobUpdate,
    ) -> Result<JobUpdate, JobSourceError> {
        let (Lease { job, number }, mut update) = (lease, update.clone());
        for NewFile { file, content } in update.largest_files_first() {
            let path = format!("/v1/worker/files/{job}/{number}/{}", file.name);
            let sent = self.folder(lease).join(&file.name);
            let taken: Taken = self.options.client.put_file(&path, &sent, file).await?;
            *content = taken.content;
        }
        Ok(update)
    }

    /// Notes the state of a lease that the service has answered with.
    fn answered(&self, lease: Lease, state: LeaseState) -> LeaseState {
        held(&self.leases).insert(lease, state);
        state
    }
}

impl JobSource for Remote {
    const WAITS_FOR_DISK: bool = false;

    async fn claim(&self, request: &ClaimRequest) -> Result<Vec<Claim>, JobSourceError> {
        let body = ClaimBody {
            program: PROGRAM.to_owned(),
            host: self.host.clone(),
            slots: self.options.slots,
            request: *request,
            wait: self.options.wait,
        };
        let claims: Vec<Claim> = self.post("/v1/worker/claims", &body).await?;
        let fresh = LeaseState::Held {
            cancel_requested: false,
        };
        held(&self.leases).extend(claims.iter().map(|claim| (Lease::from(claim), fresh)));
        Ok(claims)
    }

    async fn job_waiting(&self) {
        // A claim waits for a job itself; the next one follows after a pause, also if the service answers at once.
        std::future::pending::<()>().await;
    }

    async fn renew(&self, lease: Lease, _length: Duration) -> Result<LeaseState, JobSourceError> {
        self.lease_state(lease).await
    }

    /// As of the last heartbeat of all jobs. A service that is not reached may have given the job to another worker, or may be back
    /// before the lease ends; the solve continues, and the fence decides.
    async fn lease_state(&self, lease: Lease) -> Result<LeaseState, JobSourceError> {
        let state = held(&self.leases).get(&lease).copied();
        Ok(state.unwrap_or(LeaseState::Lost))
    }

    async fn checkpoint(&self, lease: Lease) -> Result<Option<EncodedCheckpoint>, JobSourceError> {
        let Lease { job, number } = lease;
        let path = format!("/v1/worker/checkpoints/{job}/{number}");
        Ok(self.options.client.get_once(&path).await?)
    }

    async fn record(
        &self,
        lease: Lease,
        update: &JobUpdate,
        length: Duration,
    ) -> Result<LeaseState, JobSourceError> {
        let update = match self.put_files(lease, update).await {
            Err(JobSourceError::Remote(error)) if error.is_of_type("/problems/lease-lost") => {
                return Ok(self.answered(lease, LeaseState::Lost));
            }
            sent => sent?,
        };
        let write = Write {
            lease,
            update,
            kind: WriteKind::Renew(length),
        };
        match self.write(write).await? {
            WriteAnswer::Lease(state) => Ok(self.answered(lease, state)),
            answer => Err(unexpected(answer)),
        }
    }

    async fn restart(&self, lease: Lease, number: i64) -> Result<LeaseState, JobSourceError> {
        let body = RestartBody { lease, number };
        let state = self.post("/v1/worker/restarts", &body).await?;
        Ok(self.answered(lease, state))
    }

    async fn finish(
        &self,
        lease: Lease,
        update: &JobUpdate,
        end: &End,
    ) -> Result<Option<Status>, JobSourceError> {
        let update = match self.put_files(lease, update).await {
            // An end whose answer was lost has ended the lease.
            Err(JobSourceError::Remote(error)) if error.is_of_type("/problems/lease-lost") => {
                update.clone()
            }
            sent => sent?,
        };
        let write = Write {
            lease,
            update,
            kind: WriteKind::End(Box::new(end.clone())),
        };
        match self.write(write).await? {
            WriteAnswer::Status(status) => {
                self.abandon(lease);
                Ok(status)
            }
            answer => Err(unexpected(answer)),
        }
    }

    fn abandon(&self, lease: Lease) {
        held(&self.leases).remove(&lease);
        // There is none if the solve has written no files.
        let _ = fs_err::remove_dir_all(self.folder(lease));
    }

    fn folder(&self, lease: Lease) -> PathBuf {
        let attempt = format!("{}-{}", lease.job, lease.number);
        self.options.scratch.join(attempt)
    }

    fn busy(&self) -> Option<Busy> {
        None
    }

    async fn demand(&self) -> Result<Demand, JobSourceError> {
        Ok(self.options.client.demand().await?)
    }
}

/// Returns `true` if a write is sent together with others: it is small, and the service need not make the documents of a job for it.
fn is_quick(write: &Write) -> bool {
    let is_made = matches!(write.kind, WriteKind::Renew(_)) || write.update.block.is_some();
    is_made && write.update.is_small()
}

/// Sends writes in one request. If the service refuses it, each is sent alone.
async fn send_together(
    client: Client,
    group: Vec<Pending<Arc<Write>, Result<WriteAnswer, NotSent>>>,
) {
    let writes: Vec<&Write> = group.iter().map(|pending| &*pending.request).collect();
    let sent = client.post::<Vec<WriteAnswer>>(WRITES, &writes).await;
    let (answers, otherwise) = match sent {
        Ok(answers) => (answers, NotSent::Alone),
        Err(ClientError::Unreachable { url, cause }) => {
            (Vec::new(), NotSent::Unreachable { url, cause })
        }
        Err(error) => {
            tracing::warn!(%error, writes = writes.len(), "writes were not sent together");
            (Vec::new(), NotSent::Alone)
        }
    };
    let mut answers = answers.into_iter();
    for pending in group {
        pending.answer(match answers.next() {
            Some(WriteAnswer::Pending) => Err(NotSent::Alone),
            Some(answer) => Ok(answer),
            None => Err(otherwise.clone()),
        });
    }
}

/// The error of a write that was not done.
fn unexpected(answer: WriteAnswer) -> JobSourceError {
    match answer {
        WriteAnswer::Problem(problem) => ClientError::of(problem).into(),
        other => ClientError::of(Problem {
            kind: "about:blank".to_owned(),
            title: format!("an answer to another write: {other:?}"),
            status: 500,
            detail: None,
            faults: Vec::new(),
        })
        .into(),
    }
}

/// Name of this machine; empty where it has none.
fn host() -> String {
    let name = nix::unistd::gethostname();
    name.ok()
        .and_then(|name| name.into_string().ok())
        .unwrap_or_default()
}
