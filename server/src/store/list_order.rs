//! Orders of lists of jobs, and the places of jobs in them.

use serde::{Deserialize, Serialize};
use uuid::Uuid;

use crate::store::StoreError;
use crate::store::rows::StoredRow;

/// Column of the value that a job is ordered by.
pub(in crate::store) const ORDER_VALUE: &str = "order_value";

/// Order of a list; among equals, and among those without a value, the newest first.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub struct Order {
    /// Quantity that the jobs are ordered by.
    pub key: OrderKey,
    /// The largest value comes first; jobs without one come last in either direction.
    pub descending: bool,
}

impl Default for Order {
    fn default() -> Self {
        Self {
            key: OrderKey::Created,
            descending: true,
        }
    }
}

/// Quantity that a list is ordered by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum OrderKey {
    /// Time of submission.
    Created,
    /// Name, whatever the case of ASCII letters.
    Name,
    /// Kind of system.
    System,
    /// Status, by its name.
    Status,
    /// Part of the cycles that is done.
    Progress,
    /// Deepest wear of both sides.
    Wear,
    /// Cycles until the first criterion of life was reached.
    Life,
    /// Time from the first claim to the end, or to [`crate::store::Filter::as_of_ms`].
    Duration,
}

/// A listed job, with its place.
#[derive(Debug, Clone, PartialEq)]
pub struct Listed<T> {
    /// The job.
    pub job: T,
    /// Place of the job in the order.
    pub place: ListPlace,
}

/// The place of a job in the order of a list.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct ListPlace {
    /// The job.
    pub id: Uuid,
    /// Value of the quantity; none where the job has no value.
    pub value: Option<OrderValue>,
}

/// A value that jobs are ordered by.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
#[serde(untagged)]
pub enum OrderValue {
    /// A number.
    Number(f64),
    /// A text.
    Text(String),
}

/// Kinds of values that jobs are ordered by.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::store) enum OrderKind {
    /// None but the id.
    Id,
    Number,
    Text,
}

impl OrderKey {
    pub(in crate::store) fn kind(self) -> OrderKind {
        match self {
            Self::Created => OrderKind::Id,
            Self::Name | Self::System | Self::Status => OrderKind::Text,
            Self::Progress | Self::Wear | Self::Life | Self::Duration => OrderKind::Number,
        }
    }

    /// Checks whether jobs in this order can have a place: one that a client sends may be of another order.
    pub fn has(self, place: &ListPlace) -> bool {
        match (&place.value, self.kind()) {
            (None, _) => true,
            (Some(OrderValue::Number(_)), kind) => kind == OrderKind::Number,
            // A database compares no text with U+0000.
            (Some(OrderValue::Text(text)), kind) => kind == OrderKind::Text && !text.contains('\0'),
        }
    }
}

/// Reads the place of a job in an order from its row.
pub(in crate::store) fn place(
    row: &impl StoredRow,
    key: OrderKey,
) -> Result<ListPlace, StoreError> {
    let value = match key.kind() {
        OrderKind::Id => None,
        OrderKind::Number => row.value::<Option<_>>(ORDER_VALUE)?.map(OrderValue::Number),
        OrderKind::Text => row.value::<Option<_>>(ORDER_VALUE)?.map(OrderValue::Text),
    };
    Ok(ListPlace {
        id: row.id("id")?,
        value,
    })
}
