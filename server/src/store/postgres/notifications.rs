//! Notifications of changes between the processes that serve a database. They are not sent in the transactions that make the changes: a
//! notification in a transaction holds a lock through its commit, so that commits would follow each other. Notifications can be missed
//! while nobody listens: after each connection all jobs are taken for changed, and the queue for not empty.

use std::collections::BTreeSet;
use std::sync::Arc;
use std::time::Duration;

use sqlx::postgres::{PgListener, PgPool};
use tokio::sync::mpsc::UnboundedReceiver;
use tokio::sync::{Notify, broadcast};
use tokio::time::sleep;
use uuid::Uuid;

use crate::store::StoreError;
use crate::store::changes::ANY_JOB;
use crate::store::process_state::Notification;

const CHANNEL: &str = "fretwear_changes";
/// Interval in which changes are collected into notifications.
const INTERVAL: Duration = Duration::from_millis(100);
/// Changes in a notification: its text has at most 8 000 bytes, an id 37.
const MOST: usize = 200;
/// Text that stands for waiting jobs.
const WAITING: &str = "waiting";
/// Time before another connection is tried.
const PAUSE: Duration = Duration::from_secs(1);

/// Sends the changes of this process until the store is closed.
pub(super) async fn notify(
    pool: PgPool,
    sender: Uuid,
    mut notifications: UnboundedReceiver<Notification>,
) {
    while let Some(first) = notifications.recv().await {
        sleep(INTERVAL).await;
        let mut changes = BTreeSet::from([first]);
        while let Ok(next) = notifications.try_recv() {
            changes.insert(next);
        }
        let changes: Vec<_> = changes.into_iter().map(text).collect();
        for some in changes.chunks(MOST) {
            let notified = sqlx::query("SELECT pg_notify($1, $2)")
                .bind(CHANNEL)
                .bind(format!("{sender} {}", some.join(" ")))
                .execute(&pool)
                .await;
            if let Err(error) = notified {
                tracing::debug!(%error, "other processes were not notified of changes");
            }
        }
    }
}

/// Receives the changes of other processes until the store is closed.
pub(super) async fn hear(
    pool: PgPool,
    sender: Uuid,
    changes: broadcast::Sender<Uuid>,
    waiting: Arc<Notify>,
) {
    loop {
        if let Err(error) = listen(&pool, sender, &changes, &waiting).await {
            tracing::warn!(%error, "lost the LISTEN connection; polling");
        }
        sleep(PAUSE).await;
    }
}

async fn listen(
    pool: &PgPool,
    sender: Uuid,
    changes: &broadcast::Sender<Uuid>,
    waiting: &Notify,
) -> Result<(), StoreError> {
    let mut listener = PgListener::connect_with(pool).await?;
    listener.listen(CHANNEL).await?;
    missed(changes, waiting);
    loop {
        let Some(notification) = listener.try_recv().await? else {
            // The connection was lost, and there is another one.
            missed(changes, waiting);
            continue;
        };
        let Some((from, text)) = notification.payload().split_once(' ') else {
            continue;
        };
        if from == sender.to_string() {
            continue;
        }
        for change in text.split(' ') {
            if change == WAITING {
                waiting.notify_one();
            } else if let Ok(id) = change.parse() {
                // Without a subscriber this is not an error.
                let _ = changes.send(id);
            }
        }
    }
}

/// Notifies all subscribers and idle workers, because any job may have changed.
fn missed(changes: &broadcast::Sender<Uuid>, waiting: &Notify) {
    // Without a subscriber this is not an error.
    let _ = changes.send(ANY_JOB);
    waiting.notify_waiters();
    waiting.notify_one();
}

fn text(notification: Notification) -> String {
    match notification {
        Notification::Waiting => WAITING.to_owned(),
        Notification::Changed(id) => id.to_string(),
    }
}
