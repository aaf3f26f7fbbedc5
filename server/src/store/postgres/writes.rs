//! Writes of workers under their leases: updates, and ends of jobs.
//!
//! Small ones that meet share a transaction, whose statements are over all of them. It leaves out jobs whose rows others have locked,
//! so that it waits for nobody; a write that was left out, is large, or whose transaction has failed, is written alone. The numbers of writes make a second one of
//! the same harmless.

use std::collections::HashSet;
use std::sync::Arc;

use tokio::time::timeout;

use crate::store::postgres::write::{Waiting, Written};
use crate::store::postgres::writer::{Locked, Writer};
use crate::store::postgres::{LONGEST_TURN, PostgresStore};
use crate::store::{StoreError, Write};

impl PostgresStore {
    /// Writes together with others, or alone.
    pub(super) async fn write(&self, write: Write) -> Result<Written, StoreError> {
        let writer = Writer {
            pool: self.writer.clone(),
            given: self.given_now(),
            attempt_limit: self.process.attempt_limit,
        };
        let write = Arc::new(write);
        if write.update.is_small() {
            let together = |group| write_together(writer.clone(), group);
            if let Some(Some(written)) = self.writes.ask(Arc::clone(&write), together).await {
                return Ok(written);
            }
        }
        let written = writer.write(&[&write], Locked::Wait).await?;
        let written = written.into_iter().flatten().next();
        Ok(written.unwrap_or(Written::LOST))
    }
}

async fn write_together(writer: Writer, mut group: Vec<Waiting>) {
    while !group.is_empty() {
        let (now, later) = first_of_each_job(group);
        let writes: Vec<&Write> = now.iter().map(|pending| &*pending.request).collect();
        let written = timeout(LONGEST_TURN, writer.write(&writes, Locked::Skip)).await;
        let written = match written {
            Ok(Ok(written)) => written,
            Ok(Err(error)) => {
                tracing::warn!(%error, writes = writes.len(), "writes failed together");
                Vec::new()
            }
            Err(_) => {
                tracing::warn!(
                    writes = writes.len(),
                    "writes had no answer within {LONGEST_TURN:?}"
                );
                Vec::new()
            }
        };
        let mut written = written.into_iter();
        for pending in now {
            pending.answer(written.next().flatten());
        }
        group = later;
    }
}

/// The first write of each job, and the others: a statement changes a row once.
fn first_of_each_job(group: Vec<Waiting>) -> (Vec<Waiting>, Vec<Waiting>) {
    let mut jobs = HashSet::new();
    let is_first = |pending: &Waiting| jobs.insert(pending.request.lease.job);
    group.into_iter().partition(is_first)
}
