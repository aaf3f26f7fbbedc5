//! Requests that are done together: those that arrive while others are being done, in a transaction whose commit waits for the disk or by a
//! service far away, are done by the next one. Each is answered only after its own.

use std::sync::{Arc, Mutex, MutexGuard, PoisonError};

use tokio::sync::oneshot;

/// Largest number of requests at a time; bounds how long the others wait.
const LIMIT: usize = 64;

/// Requests that wait.
#[derive(Debug)]
pub(crate) struct Groups<Q, A> {
    pending: Mutex<Vec<Pending<Q, A>>>,
    turn: Arc<tokio::sync::Mutex<()>>,
}

/// A request, and where its answer goes.
#[derive(Debug)]
pub(crate) struct Pending<Q, A> {
    pub(crate) request: Q,
    answer: oneshot::Sender<A>,
}

impl<Q, A> Pending<Q, A> {
    /// Returns `true` if nobody waits for the answer any more.
    pub(crate) fn is_given_up(&self) -> bool {
        self.answer.is_closed()
    }

    /// Answers the request. The caller may have disconnected: the work is done all the same.
    pub(crate) fn answer(self, answer: A) {
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
    /// Asks together with others that ask at the same time; `answer_all` answers each request of a group. `None` if it has not.
    pub(crate) async fn ask<F>(
        &self,
        request: Q,
        answer_all: impl Fn(Vec<Pending<Q, A>>) -> F,
    ) -> Option<A>
    where
        F: Future<Output = ()> + Send + 'static,
    {
        let (answer, mut answered) = oneshot::channel();
        self.pending().push(Pending { request, answer });
        loop {
            // Who is answered in the turn of another needs none.
            let turn = tokio::select! {
                biased;
                answer = &mut answered => return answer.ok(),
                turn = Arc::clone(&self.turn).lock_owned() => turn,
            };
            // In a task of its own, which keeps the turn: who goes away must not cancel the requests of others.
            let answering = answer_all(self.take());
            let answering = tokio::spawn(async move {
                answering.await;
                drop(turn);
            });
            // After a panic it has answered nobody, which each learns from its own answer.
            let _ = answering.await;
        }
    }

    fn pending(&self) -> MutexGuard<'_, Vec<Pending<Q, A>>> {
        let pending = self.pending.lock();
        pending.unwrap_or_else(PoisonError::into_inner)
    }

    fn take(&self) -> Vec<Pending<Q, A>> {
        let mut pending = self.pending();
        // A caller that has disconnected got no answer, so its request must not be served later.
        pending.retain(|pending| !pending.is_given_up());
        let count = pending.len().min(LIMIT);
        pending.drain(..count).collect()
    }
}
