//! Events of attempts.

use uuid::Uuid;

use super::dialect::Connection;
use super::queries::insert_event;
use crate::store::StoreError;
use crate::store::rows::attempt_event;

/// Appends the event of a new attempt, which starts at a cycle.
pub(in super::super) async fn insert_attempt_event(
    connection: &mut Connection,
    id: Uuid,
    seq: i64,
    attempt: u32,
    from_cycle: u64,
) -> Result<(), StoreError> {
    let data = attempt_event(attempt, from_cycle)?;
    insert_event(connection, id, seq, "attempt", &data).await
}
