//! Lists of jobs.

use api::job::{Job, JobOverview};
use api::service::LabelInUse;
use sqlx::{Postgres, QueryBuilder};

use crate::store::document::document;
use crate::store::job_ids::{first_created_at, first_created_before};
use crate::store::overview::overview;
use crate::store::postgres::PostgresStore;
use crate::store::postgres::selects::{LIFE_CYCLES, select, select_overview};
use crate::store::{Filter, OrderKey, StoreError};

impl PostgresStore {
    pub(in crate::store) async fn list(&self, filter: &Filter) -> Result<Vec<Job>, StoreError> {
        let mut query = filtered(select(), filter);
        let rows = query.build().fetch_all(&self.readers).await?;
        rows.iter().map(|row| document(&self.local, row)).collect()
    }

    pub(in crate::store) async fn list_short(
        &self,
        filter: &Filter,
    ) -> Result<Vec<JobOverview>, StoreError> {
        let mut query = filtered(select_overview(), filter);
        let rows = query.build().fetch_all(&self.readers).await?;
        rows.iter().map(|row| overview(&self.local, row)).collect()
    }

    pub(in crate::store) async fn count(&self, filter: &Filter) -> Result<u64, StoreError> {
        let mut query = QueryBuilder::new("SELECT count(*) FROM jobs");
        push_conditions(&mut query, filter);
        let count: i64 = query.build_query_scalar().fetch_one(&self.readers).await?;
        Ok(u64::try_from(count).unwrap_or(0))
    }

    pub(in crate::store) async fn labels(&self, most: u32) -> Result<Vec<LabelInUse>, StoreError> {
        let rows: Vec<(String, String, i64)> = sqlx::query_as(
            "SELECT key, value, count(*) FROM labels GROUP BY key, value \
             ORDER BY key COLLATE \"C\", 3 DESC, value COLLATE \"C\" LIMIT $1",
        )
        .bind(i64::from(most))
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

/// Completes a query of jobs by the conditions, the order and the limits of a filter.
fn filtered(mut query: QueryBuilder<Postgres>, filter: &Filter) -> QueryBuilder<Postgres> {
    push_conditions(&mut query, filter);
    if let Some(before) = filter.before {
        query.push(" AND id < ").push_bind(before);
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
    query.push(" LIMIT ").push_bind(i64::from(filter.limit));
    query.push(" OFFSET ").push_bind(i64::from(filter.skipped));
    query
}

/// Appends what jobs are ordered by; ids are ordered by their time of creation.
fn push_order_key(query: &mut QueryBuilder<Postgres>, key: OrderKey) {
    let expression = match key {
        OrderKey::Created => "id",
        OrderKey::Name => "lower((spec::json ->> 'name') COLLATE \"C\")",
        OrderKey::System => "system COLLATE \"C\"",
        OrderKey::Status => "status COLLATE \"C\"",
        OrderKey::Progress => "(progress::json ->> 'fraction')::float8",
        OrderKey::Wear => {
            "GREATEST((summary::json #>> '{receptacle,max_depth_mm}')::float8, (summary::json #>> '{slider,max_depth_mm}')::float8)"
        }
        OrderKey::Life => LIFE_CYCLES,
        OrderKey::Duration => "coalesce(finished_at, fretwear_now()) - started_at",
    };
    query.push(expression);
}

fn push_conditions(query: &mut QueryBuilder<Postgres>, filter: &Filter) {
    // No text of the database has the character U+0000, and none can be compared with one that has.
    query.push(if has_nul(filter) {
        " WHERE false"
    } else {
        " WHERE true"
    });
    if has_nul(filter) {
        return;
    }
    if !filter.statuses.is_empty() {
        query.push(" AND status IN (");
        let mut list = query.separated(", ");
        for status in &filter.statuses {
            list.push_bind(status.as_str());
        }
        query.push(")");
    }
    if let Some(system) = &filter.system {
        query.push(" AND system = ").push_bind(system.clone());
    }
    for (key, value) in &filter.labels {
        query
            .push(" AND id IN (SELECT job_id FROM labels WHERE key = ")
            .push_bind(key.clone())
            .push(" AND value = ")
            .push_bind(value.clone())
            .push(")");
    }
    if let Some(from) = filter.created_from {
        query.push(" AND created_at >= ").push_bind(from);
        query.push(" AND id >= ").push_bind(first_created_at(from));
    }
    if let Some(before) = filter.created_before {
        query.push(" AND created_at < ").push_bind(before);
        query
            .push(" AND id < ")
            .push_bind(first_created_before(before));
    }
    if let Some(sweep) = filter.sweep {
        query.push(" AND sweep_id = ").push_bind(sweep);
    }
    if let Some(text) = &filter.text {
        // In the collation "C", `lower` knows ASCII alone: other letters are compared as they are.
        let text = text.to_ascii_lowercase();
        query
            .push(" AND (strpos(lower(coalesce(spec::json ->> 'name', '') COLLATE \"C\"), ")
            .push_bind(text.clone())
            .push(") > 0 OR strpos(id::text, ")
            .push_bind(text.clone())
            .push(") > 0 OR id IN (SELECT job_id FROM labels WHERE strpos(lower(value COLLATE \"C\"), ")
            .push_bind(text)
            .push(") > 0))");
    }
}

/// Whether a filter has the character U+0000.
fn has_nul(filter: &Filter) -> bool {
    let texts = filter.system.iter().chain(&filter.text);
    let labels = filter.labels.iter().flat_map(|(key, value)| [key, value]);
    texts.chain(labels).any(|text| text.contains('\0'))
}
