//! Lists of jobs.

use api::job::{Job, JobOverview};
use api::service::LabelInUse;
use sqlx::{AssertSqlSafe, QueryBuilder};
use uuid::Uuid;

use super::dialect::{
    COLLATION, Engine, EngineStore, JOIN_IN_ORDER, LEAST, LIFE_CYCLES, NAME, PROGRESS, SEARCH,
    STORES_NUL, StoredId, WEAR, read_id, stored_id,
};
use super::selects::{self, DOCUMENT};
use crate::store::document::document;
use crate::store::job_ids::{first_created_at, first_created_before};
use crate::store::list_order::{ORDER_VALUE, OrderKind, place};
use crate::store::overview::overview;
use crate::store::{Filter, ListPlace, Listed, OrderKey, OrderValue, StoreError};

impl EngineStore {
    pub(in crate::store) async fn list(
        &self,
        filter: &Filter,
    ) -> Result<Vec<Listed<Job>>, StoreError> {
        let mut query = listing(DOCUMENT, filter);
        let rows = query.build().fetch_all(&self.readers).await?;
        let listed = |row: &_| {
            Ok(Listed {
                job: document(&self.process, row)?,
                place: place(row, filter.order.key)?,
            })
        };
        rows.iter().map(listed).collect()
    }

    pub(in crate::store) async fn list_short(
        &self,
        filter: &Filter,
    ) -> Result<Vec<Listed<JobOverview>>, StoreError> {
        let mut query = listing(&selects::overview(), filter);
        let rows = query.build().fetch_all(&self.readers).await?;
        let listed = |row: &_| {
            Ok(Listed {
                job: overview(&self.process, row)?,
                place: place(row, filter.order.key)?,
            })
        };
        rows.iter().map(listed).collect()
    }

    /// Ids of the jobs that pass a filter in the order by creation.
    pub(super) async fn ids(&self, filter: &Filter) -> Result<Vec<Uuid>, StoreError> {
        let mut query = listing("id", filter);
        let ids: Vec<StoredId> = query.build_query_scalar().fetch_all(&self.readers).await?;
        Ok(ids.into_iter().map(read_id).collect())
    }

    pub(in crate::store) async fn count(&self, filter: &Filter) -> Result<u64, StoreError> {
        let mut query = QueryBuilder::new("SELECT count(*) FROM jobs");
        push_conditions(&mut query, filter);
        let count: i64 = query.build_query_scalar().fetch_one(&self.readers).await?;
        Ok(u64::try_from(count).unwrap_or(0))
    }

    pub(in crate::store) async fn labels(&self, most: u32) -> Result<Vec<LabelInUse>, StoreError> {
        let statement = format!(
            "SELECT key, value, count(*) FROM labels GROUP BY key, value \
             ORDER BY key{COLLATION}, 3 DESC, value{COLLATION} LIMIT $1"
        );
        let rows: Vec<(String, String, i64)> = sqlx::query_as(AssertSqlSafe(statement))
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

/// A query of columns of jobs by the conditions, the order and the limits of a filter, with what they are ordered by. The columns are read for
/// the page alone, whose ids are found first.
fn listing(columns: &str, filter: &Filter) -> QueryBuilder<Engine> {
    let has_value = filter.order.key.kind() != OrderKind::Id;
    let mut query = QueryBuilder::new(format!("SELECT {columns}"));
    if has_value {
        query.push(format!(", {ORDER_VALUE}"));
    }
    query.push(" FROM (");
    push_page(&mut query, filter);
    query.push(format!(") AS page {JOIN_IN_ORDER} jobs ON id = listed"));
    push_order(&mut query, filter, "id");
    query
}

/// Appends the ids of a page: the first jobs, or those behind a place. These have a value further on in the order of the filter or the same value and a smaller
/// id, or no value: two queries, of which the first one enters an index of the order at the value.
fn push_page(query: &mut QueryBuilder<Engine>, filter: &Filter) {
    let further = if filter.order.descending { " <" } else { " >" };
    let Some(ListPlace { id, value }) = &filter.after else {
        push_jobs(query, filter);
        return push_limit(query, filter);
    };
    let id = stored_id(*id);
    let Some(value) = value else {
        push_jobs(query, filter);
        if filter.order.key == OrderKey::Created {
            query.push(" AND id").push(further).push_bind(id);
        } else {
            query.push(" AND ");
            push_order_key(query, filter);
            query.push(" IS NULL AND id < ").push_bind(id);
        }
        return push_limit(query, filter);
    };
    query.push("SELECT * FROM (SELECT * FROM (");
    push_jobs(query, filter);
    query.push(" AND ");
    push_order_key(query, filter);
    query.push(further).push("= ");
    push_value(query, value);
    query.push(" AND (");
    push_order_key(query, filter);
    query.push(further).push(" ");
    push_value(query, value);
    query.push(" OR id < ").push_bind(id).push(")");
    push_limit(query, filter);
    query.push(") AS further UNION ALL SELECT * FROM (");
    push_jobs(query, filter);
    query.push(" AND ");
    push_order_key(query, filter);
    query.push(" IS NULL");
    push_limit(query, filter);
    query.push(") AS valueless) AS behind");
    push_order(query, filter, "listed");
    query.push(" LIMIT ").push_bind(i64::from(filter.limit));
}

/// Appends a query of the ids of the jobs that pass a filter, with what they are ordered by.
fn push_jobs(query: &mut QueryBuilder<Engine>, filter: &Filter) {
    query.push("SELECT id AS listed");
    let (before, after) = match filter.order.key.kind() {
        OrderKind::Id => ("", ""),
        OrderKind::Text => (", ", " AS "),
        OrderKind::Number => (", CAST(", " AS double precision) AS "),
    };
    if filter.order.key.kind() != OrderKind::Id {
        query.push(before);
        push_order_key(query, filter);
        query.push(after).push(ORDER_VALUE);
    }
    query.push(" FROM jobs");
    push_conditions(query, filter);
}

/// Appends the order by the key itself, which indexes know, and the limit of a filter.
fn push_limit(query: &mut QueryBuilder<Engine>, filter: &Filter) {
    query.push(" ORDER BY ");
    push_order_key(query, filter);
    push_direction(query, filter);
    if filter.order.key.kind() != OrderKind::Id {
        query.push(", id DESC");
    }
    query.push(" LIMIT ").push_bind(i64::from(filter.limit));
}

/// Appends the order by the column of the value and that of the id.
fn push_order(query: &mut QueryBuilder<Engine>, filter: &Filter, id: &str) {
    let has_value = filter.order.key.kind() != OrderKind::Id;
    query.push(" ORDER BY ");
    query.push(if has_value { ORDER_VALUE } else { id });
    push_direction(query, filter);
    if has_value {
        query.push(format!(", {id} DESC"));
    }
}

fn push_direction(query: &mut QueryBuilder<Engine>, filter: &Filter) {
    query.push(if filter.order.descending {
        " DESC NULLS LAST"
    } else {
        " ASC NULLS LAST"
    });
}

fn push_value(query: &mut QueryBuilder<Engine>, value: &OrderValue) {
    match value {
        OrderValue::Number(number) => query.push_bind(*number),
        OrderValue::Text(text) => query.push_bind(text.clone()),
    };
}

/// Appends what jobs are ordered by; ids are ordered by their time of creation.
fn push_order_key(query: &mut QueryBuilder<Engine>, filter: &Filter) {
    match filter.order.key {
        OrderKey::Created => query.push("id"),
        OrderKey::Name => query.push(NAME),
        OrderKey::System => query.push(format!("system{COLLATION}")),
        OrderKey::Status => query.push(format!("status{COLLATION}")),
        OrderKey::Progress => query.push(PROGRESS),
        OrderKey::Wear => query.push(WEAR),
        OrderKey::Life => query.push(LIFE_CYCLES),
        OrderKey::Duration => {
            // The same on all pages, also of jobs that start or end meanwhile.
            query
                .push("(CASE WHEN started_at <= ")
                .push_bind(filter.as_of_ms);
            query
                .push(format!(" THEN {LEAST}(coalesce(finished_at, "))
                .push_bind(filter.as_of_ms);
            query.push("), ").push_bind(filter.as_of_ms);
            query.push(") - started_at END)")
        }
    };
}

fn push_conditions(query: &mut QueryBuilder<Engine>, filter: &Filter) {
    if !STORES_NUL && has_nul(filter) {
        query.push(" WHERE false");
        return;
    }
    query.push(" WHERE true");
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
        query
            .push(" AND id >= ")
            .push_bind(stored_id(first_created_at(from)));
    }
    if let Some(before) = filter.created_before {
        query.push(" AND created_at < ").push_bind(before);
        query
            .push(" AND id < ")
            .push_bind(stored_id(first_created_before(before)));
    }
    if let Some(sweep) = filter.sweep {
        query.push(" AND sweep_id = ").push_bind(stored_id(sweep));
    }
    if let Some(text) = &filter.text {
        let text = text.to_ascii_lowercase();
        let [before_name, before_id, before_label, end] = SEARCH;
        query
            .push(before_name)
            .push_bind(text.clone())
            .push(before_id)
            .push_bind(text.clone())
            .push(before_label)
            .push_bind(text)
            .push(end);
    }
}

/// Returns `true` if a filter has the character U+0000.
fn has_nul(filter: &Filter) -> bool {
    let texts = filter.system.iter().chain(&filter.text);
    let labels = filter.labels.iter().flat_map(|(key, value)| [key, value]);
    texts.chain(labels).any(|text| text.contains('\0'))
}
