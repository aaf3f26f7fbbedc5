//! Requests that share a transaction. A commit waits some milliseconds for the disk; requests that arrive meanwhile are written
//! together by the next one, and each is answered only after its own.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tokio::sync::oneshot;

use crate::store::StoreError;

/// Largest number of requests in a transaction; bounds how long other writes wait.
const LIMIT: usize = 64;

/// Requests that wait for a transaction.
#[derive(Debug)]
pub(in crate::store) struct Groups<Q, A> {
    pending: Mutex<Vec<Pending<Q, A>>>,
    turn: Arc<tokio::sync::Mutex<()>>,
}

/// A request, and where its answer goes.
#[derive(Debug)]
pub(in crate::store) struct Pending<Q, A> {
    pub(in crate::store) request: Q,
    answer: oneshot::Sender<Result<A, StoreError>>,
}

impl<Q, A> Pending<Q, A> {
    /// Whether nobody waits for the answer any more.
    pub(in crate::store) fn is_given_up(&self) -> bool {
        self.answer.is_closed()
    }

    /// Answers the request. The client may have disconnected: what is written is written all the same.
    pub(in crate::store) fn answer(self, answer: Result<A, StoreError>) {
        let _ = self.answer.send(answer);
    }
}

impl<Q, A> Default for Groups<Q, A> {
    fn default() -> Self {
        Self {
            pending: Mutex::default(),
            turn: Arc::default(),
        }
    }
}

impl<Q: Send + 'static, A: Send + 'static> Groups<Q, A> {
    /// Asks together with others that ask at the same time; `write` writes a group and answers each of its requests.
    pub(in crate::store) async fn ask<F>(
        &self,
        request: Q,
        write: impl Fn(Vec<Pending<Q, A>>) -> F,
    ) -> Result<A, StoreError>
    where
        F: Future<Output = ()> + Send + 'static,
    {
        let (answer, mut answered) = oneshot::channel();
        self.pending().push(Pending { request, answer });
        loop {
            let turn = Arc::clone(&self.turn).lock_owned().await;
            match answered.try_recv() {
                Ok(answer) => return answer,
                Err(oneshot::error::TryRecvError::Closed) => return Err(StoreError::Unwritten),
                Err(oneshot::error::TryRecvError::Empty) => {}
            }
            // In a task of its own, which keeps the turn: a client that disconnects must not cancel the requests of others.
            let write = write(self.take());
            let writing = tokio::spawn(async move {
                write.await;
                drop(turn);
            });
            writing.await.map_err(|_| StoreError::Unwritten)?;
        }
    }

    fn pending(&self) -> MutexGuard<'_, Vec<Pending<Q, A>>> {
        let pending = self.pending.lock();
        pending.unwrap_or_else(PoisonError::into_inner)
    }

    fn take(&self) -> Vec<Pending<Q, A>> {
        let mut pending = self.pending();
        // A client that has disconnected got no answer, so what it asked for must not be done later.
        pending.retain(|pending| !pending.is_given_up());
        let count = pending.len().min(LIMIT);
        pending.drain(..count).collect()
    }
}
