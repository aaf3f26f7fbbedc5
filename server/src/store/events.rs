//! Pages of events.

use std::collections::BTreeMap;

use serde_json::value::RawValue;

use crate::store::{StoreError, StoredEvent};

/// Largest number of events in an answer.
pub(in crate::store) const PAGE: i64 = 500;

/// An event, with the summary of its job in the last one of a job that has succeeded: it is stored once.
pub(in crate::store) fn with_summary(
    (seq, name, data, summary): (i64, String, String, Option<String>),
) -> Result<StoredEvent, StoreError> {
    let Some(summary) = summary else {
        return Ok(StoredEvent { seq, name, data });
    };
    let mut document: BTreeMap<String, Box<RawValue>> = serde_json::from_str(&data)?;
    let succeeded = document.get("status").map(|status| status.get()) == Some(r#""succeeded""#);
    let data = if succeeded {
        document.insert("summary".to_owned(), RawValue::from_string(summary)?);
        serde_json::to_string(&document)?
    } else {
        data
    };
    Ok(StoredEvent { seq, name, data })
}

/// Returns `true` if the stored events after one are all: numbers have no gaps, so that those before were moved to an object.
pub(in crate::store) fn is_whole(stored: &[StoredEvent], after: i64) -> bool {
    stored.first().is_none_or(|first| first.seq == after + 1)
}

/// A page of the events after one: those that were moved, and the stored ones.
pub(in crate::store) fn page(
    mut moved: Vec<StoredEvent>,
    stored: Vec<StoredEvent>,
    after: i64,
) -> Vec<StoredEvent> {
    moved.retain(|event| event.seq > after);
    moved.extend(stored);
    moved.truncate(usize::try_from(PAGE).unwrap_or(usize::MAX));
    moved
}
