//! Lists of jobs.

use api::job::Job;

use crate::store::sqlite::document::{document, select};
use crate::store::{Filter, Store, StoreError};

impl Store {
    /// Returns the jobs that pass a filter, newest first.
    ///
    /// # Errors
    /// [`StoreError`] if the database fails.
    pub async fn list(&self, filter: &Filter) -> Result<Vec<Job>, StoreError> {
        let mut query = select();
        query.push(" WHERE 1");
        if !filter.statuses.is_empty() {
            query.push(" AND status IN (");
            let mut list = query.separated(", ");
            for status in &filter.statuses {
                list.push_bind(status.as_str());
            }
            query.push(")");
        }
        if let Some(system) = &filter.system {
            query.push(" AND system = ").push_bind(system);
        }
        for (key, value) in &filter.labels {
            query
                .push(" AND id IN (SELECT job_id FROM labels WHERE key = ")
                .push_bind(key)
                .push(" AND value = ")
                .push_bind(value)
                .push(")");
        }
        if let Some(from) = filter.created_from {
            query.push(" AND created_at >= ").push_bind(from);
        }
        if let Some(before) = filter.created_before {
            query.push(" AND created_at < ").push_bind(before);
        }
        if let Some(sweep) = filter.sweep {
            query
                .push(" AND id IN (SELECT job_id FROM sweep_jobs WHERE sweep_id = ")
                .push_bind(sweep.to_string())
                .push(")");
        }
        if let Some(before) = filter.before {
            query.push(" AND id < ").push_bind(before.to_string());
        }
        query
            .push(" ORDER BY id DESC LIMIT ")
            .push_bind(filter.limit);
        let rows = query.build().fetch_all(&self.readers).await?;
        rows.iter().map(|row| document(&self.disk, row)).collect()
    }
}
