//! Lists of jobs.

use api::job::{Job, JobOverview};
use api::service::LabelInUse;
use sqlx::sqlite::SqliteRow;
use sqlx::{QueryBuilder, Sqlite, SqlitePool};

use crate::clock::now_ms;
use crate::store::document::document;
use crate::store::job_ids::{first_created_at, first_created_before};
use crate::store::overview::overview;
use crate::store::sqlite::SqliteStore;
use crate::store::sqlite::selects::{LIFE_CYCLES, select, select_overview};
use crate::store::{Filter, OrderKey, StoreError};

impl SqliteStore {
    pub(in crate::store) async fn list(&self, filter: &Filter) -> Result<Vec<Job>, StoreError> {
        let query = filtered(select(), filter);
        let rows = fetch(query, &self.readers).await?;
        rows.iter().map(|row| document(&self.local, row)).collect()
    }

    pub(in crate::store) async fn list_short(
        &self,
        filter: &Filter,
    ) -> Result<Vec<JobOverview>, StoreError> {
        let query = filtered(select_overview(), filter);
        let rows = fetch(query, &self.readers).await?;
        rows.iter().map(|row| overview(&self.local, row)).collect()
    }

    pub(in crate::store) async fn count(&self, filter: &Filter) -> Result<u64, StoreError> {
        let mut query = QueryBuilder::new("SELECT count(*) FROM jobs");
        push_conditions(&mut query, filter);
        let count: i64 = query.build_query_scalar().fetch_one(&self.readers).await?;
        Ok(u64::try_from(count).unwrap_or(0))
    }

    pub(in crate::store) async fn labels(&self, most: u32) -> Result<Vec<LabelInUse>, StoreError> {
        let sql = "SELECT key, value, count(*) FROM labels GROUP BY key, value ORDER BY key, 3 DESC, value LIMIT ?";
        let rows: Vec<(String, String, i64)> = sqlx::query_as(sql)
            .bind(most)
            .fetch_all(&self.readers)
            .await?;
        let rows = rows.into_iter().map(|(key, value, jobs)| LabelInUse {
            key,
            value,
            jobs: u64::try_from(jobs).unwrap_or(0),
        });
        Ok(rows.collect())
    }
}

async fn fetch(
    mut query: QueryBuilder<Sqlite>,
    readers: &SqlitePool,
) -> Result<Vec<SqliteRow>, sqlx::Error> {
    query.build().fetch_all(readers).await
}

/// Completes a query of jobs by the conditions, the order and the limits of a filter.
fn filtered(mut query: QueryBuilder<Sqlite>, filter: &Filter) -> QueryBuilder<Sqlite> {
    push_conditions(&mut query, filter);
    if let Some(before) = filter.before {
        query.push(" AND id < ").push_bind(before.to_string());
    }
    query.push(" ORDER BY ");
    push_order_key(&mut query, filter.order.key);
    query.push(if filter.order.descending {
        " DESC NULLS LAST"
    } else {
        " ASC NULLS LAST"
    });
    if filter.order.key != OrderKey::Created {
        query.push(", id DESC");
    }
    query.push(" LIMIT ").push_bind(filter.limit);
    query.push(" OFFSET ").push_bind(filter.skipped);
    query
}

/// Appends what jobs are ordered by; ids are ordered by their time of creation.
fn push_order_key(query: &mut QueryBuilder<Sqlite>, key: OrderKey) {
    let expression = match key {
        OrderKey::Created => "id",
        OrderKey::Name => "lower(spec ->> '$.name')",
        OrderKey::System => "system",
        OrderKey::Status => "status",
        OrderKey::Progress => "progress ->> '$.fraction'",
        OrderKey::Wear => {
            "max(summary ->> '$.receptacle.max_depth_mm', summary ->> '$.slider.max_depth_mm')"
        }
        OrderKey::Life => LIFE_CYCLES,
        OrderKey::Duration => {
            query.push("coalesce(finished_at, ").push_bind(now_ms());
            ") - started_at"
        }
    };
    query.push(expression);
}

fn push_conditions(query: &mut QueryBuilder<Sqlite>, filter: &Filter) {
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
        let first = first_created_at(from).to_string();
        query.push(" AND id >= ").push_bind(first);
    }
    if let Some(before) = filter.created_before {
        query.push(" AND created_at < ").push_bind(before);
        let end = first_created_before(before).to_string();
        query.push(" AND id < ").push_bind(end);
    }
    if let Some(sweep) = filter.sweep {
        query.push(" AND sweep_id = ").push_bind(sweep.to_string());
    }
    if let Some(text) = &filter.text {
        // SQLite's `lower` knows ASCII alone: other letters are compared as they are.
        let text = text.to_ascii_lowercase();
        query
            .push(" AND (instr(lower(coalesce(spec ->> '$.name', '')), ")
            .push_bind(text.clone())
            .push(") OR instr(id, ")
            .push_bind(text.clone())
            .push(") OR id IN (SELECT job_id FROM labels WHERE instr(lower(value), ")
            .push_bind(text)
            .push(")))");
    }
}
