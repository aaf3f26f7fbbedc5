//! Columns of rows, by their names.

use sqlx::Row as _;
use uuid::Uuid;

use super::dialect::{Row, StoredId, read_id};
use crate::store::StoreError;
use crate::store::rows::{StoredRow, StoredValue};

impl StoredRow for Row {
    fn id(&self, column: &str) -> Result<Uuid, StoreError> {
        Ok(read_id(self.try_get(column)?))
    }

    fn optional_id(&self, column: &str) -> Result<Option<Uuid>, StoreError> {
        let id: Option<StoredId> = self.try_get(column)?;
        Ok(id.map(read_id))
    }

    fn value<T: StoredValue>(&self, column: &str) -> Result<T, StoreError> {
        Ok(self.try_get(column)?)
    }
}
