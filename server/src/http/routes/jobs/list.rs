//! `GET /v1/jobs`: jobs, newest first or in another order.

use std::ops::RangeInclusive;

use api::job::{JobList, ListedJob};
use axum::Json;
use axum::extract::State;
use serde::{Deserialize, Serialize};
use utoipa::{IntoParams, ToSchema};

use crate::http::app::App;
use crate::http::extract::Params;
use crate::http::paging::{Page, PageError};
use crate::http::problem::{ProblemResponse, ProblemType, RouteError};
use crate::http::routes::jobs::filter::{FILTERS, FilterError, FilterQuery, filter_among};
use crate::store::{Filter, ListPlace, Listed, Order, OrderKey};
use crate::text::shortened;

/// Times that a page token can hold, ms since 1970: differences of them are numbers of every database.
const TIMES_MS: RangeInclusive<i64> = 0..=1 << 53;
/// Error of a query parameter.
#[derive(Debug, thiserror::Error)]
pub(crate) enum ListError {
    /// A parameter of the filter is not valid.
    #[error(transparent)]
    Filter(#[from] FilterError),
    /// Not a parameter.
    #[error("`{0}` is not a parameter; parameters are {1}")]
    Unknown(String, String),
    /// Not a view.
    #[error("`{0}` is not a view; views are short and full")]
    View(String),
    /// Not an order.
    #[error("`{0}` is not an order; orders are {1}, each with a - in front for the largest first")]
    Order(String, String),
    /// Neither true nor false.
    #[error("`total` is true or false, not `{0}`")]
    Total(String),
}

impl RouteError for ListError {
    const TYPE: ProblemType = ProblemType::INVALID_QUERY;
}

/// Names of the further parameters of a list.
const PAGES: &str = "sort, total, view, limit and page_token";

/// Orders by the names of the parameter `sort`.
const ORDERS: [(&str, OrderKey); 8] = [
    ("created", OrderKey::Created),
    ("name", OrderKey::Name),
    ("system", OrderKey::System),
    ("status", OrderKey::Status),
    ("progress", OrderKey::Progress),
    ("wear", OrderKey::Wear),
    ("life", OrderKey::Life),
    ("duration", OrderKey::Duration),
];

/// Order and page of a list.
#[derive(Debug, Default, IntoParams)]
#[into_params(parameter_in = Query)]
#[expect(
    dead_code,
    reason = "only describes the parameters, which are parsed one by one because labels repeat"
)]
pub(crate) struct PageQuery {
    /// Order of the jobs, the smallest value first, or with a `-` in front the largest: `created`, `name`, `system`, `status`, `progress`,
    /// `wear` (the deeper one of both sides), `life` (cycles until the first criterion) or `duration`; `-created` by default. Jobs without a value come last. A page
    /// begins behind the last job of the one before: only a job whose own value changes between two pages can be listed twice or not at all.
    #[param(pattern = "^-?(created|name|system|status|progress|wear|life|duration)$")]
    sort: Option<String>,
    /// True to count the jobs of all pages.
    total: Option<bool>,
    /// `short` (default), or `full` with specification, plan and summary.
    #[param(inline)]
    view: Option<View>,
    /// Maximum number of jobs of the page.
    #[param(minimum = 1, maximum = 500)]
    limit: Option<u32>,
    /// `next_page_token` of the previous page, with the same filters.
    page_token: Option<String>,
}

/// How much of each job a list contains.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, ToSchema)]
#[schema(rename_all = "snake_case")]
pub(crate) enum View {
    /// Status, progress and key figures.
    #[default]
    Short,
    /// The job documents.
    Full,
}

/// Place of the last job of a page.
#[derive(Debug, Serialize, Deserialize)]
struct JobPlace {
    place: ListPlace,
    /// Time until which durations are counted.
    as_of_ms: i64,
}

/// A parsed query.
#[derive(Debug, Default)]
struct ParsedQuery<'a> {
    filter: Filter,
    view: View,
    total: bool,
    limit: Option<&'a str>,
    token: Option<&'a str>,
}

/// Jobs, newest first.
#[utoipa::path(
    get,
    path = "/v1/jobs",
    tag = "jobs",
    params(FilterQuery, PageQuery),
    responses(
        (status = 200, description = "A page of jobs", body = JobList),
    )
)]
pub(crate) async fn list(
    State(app): State<App>,
    Params(pairs): Params<Vec<(String, String)>>,
) -> Result<Json<JobList>, ProblemResponse> {
    let ParsedQuery {
        mut filter,
        view,
        total,
        limit,
        token,
    } = parse(&pairs)?;
    let page = Page::<JobPlace>::parse(&format!("{filter:?}"), limit, token)?;
    let total = if total {
        Some(app.store.count(&filter).await?)
    } else {
        None
    };
    if let Some(JobPlace { place, as_of_ms }) = page.after() {
        if !filter.order.key.has(place) || !TIMES_MS.contains(as_of_ms) {
            return Err(PageError::Token.into());
        }
        (filter.after, filter.as_of_ms) = (Some(place.clone()), *as_of_ms);
    } else if filter.order.key == OrderKey::Duration {
        filter.as_of_ms = app.store.present_ms().await?;
    }
    filter.limit = page.query_limit();
    let mut jobs: Vec<Listed<ListedJob>> = match view {
        View::Short => {
            let jobs = app.store.list_short(&filter).await?.into_iter();
            jobs.map(|Listed { job, place }| Listed {
                job: ListedJob::Short(Box::new(job)),
                place,
            })
            .collect()
        }
        View::Full => {
            let jobs = app.store.list(&filter).await?.into_iter();
            jobs.map(|Listed { job, place }| Listed {
                job: ListedJob::Full(Box::new(job)),
                place,
            })
            .collect()
        }
    };
    let next_page_token = page.truncate(&mut jobs, |job| JobPlace {
        place: job.place.clone(),
        as_of_ms: filter.as_of_ms,
    })?;
    Ok(Json(JobList {
        jobs: jobs.into_iter().map(|listed| listed.job).collect(),
        next_page_token,
        total,
    }))
}

/// Parses the query into filter, limit and page token.
fn parse(pairs: &[(String, String)]) -> Result<ParsedQuery<'_>, ListError> {
    let mut query = ParsedQuery::default();
    let others = filter_among(pairs, &mut query.filter)?;
    for (name, value) in others {
        match name {
            "sort" => query.filter.order = order(value)?,
            "total" => {
                let total = value.parse();
                query.total = total.map_err(|_| ListError::Total(shortened(value)))?;
            }
            "view" => query.view = self::view(value)?,
            "limit" => query.limit = Some(value),
            "page_token" => query.token = Some(value),
            _ => {
                let known = format!("{}, {PAGES}", FILTERS.replace(" and", ","));
                return Err(ListError::Unknown(shortened(name), known));
            }
        }
    }
    Ok(query)
}

fn order(name: &str) -> Result<Order, ListError> {
    let (key, descending) = match name.strip_prefix('-') {
        Some(key) => (key, true),
        None => (name, false),
    };
    let found = ORDERS.iter().find(|(known, _)| *known == key);
    let Some(&(_, key)) = found else {
        let names = ORDERS.map(|(known, _)| known).join(", ");
        return Err(ListError::Order(shortened(name), names));
    };
    Ok(Order { key, descending })
}

fn view(name: &str) -> Result<View, ListError> {
    match name {
        "short" => Ok(View::Short),
        "full" => Ok(View::Full),
        _ => Err(ListError::View(shortened(name))),
    }
}

#[cfg(test)]
mod tests;
