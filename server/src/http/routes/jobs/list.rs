//! `GET /v1/jobs`: jobs, newest first or in another order.

use std::ops::RangeInclusive;

use api::job::{JobList, ListedJob, Status};
use api::spec::{StringEnum, SystemKind};
use axum::Json;
use axum::extract::State;
use jiff::Timestamp;
use serde::{Deserialize, Serialize};
use utoipa::{IntoParams, ToSchema};
use uuid::Uuid;

use crate::http::app::App;
use crate::http::extract::Params;
use crate::http::paging::{Page, PageError};
use crate::http::problem::{ProblemResponse, ProblemType, RouteError};
use crate::spec;
use crate::store::{Filter, ListPlace, Listed, Order, OrderKey};
use crate::text::shortened;

/// Times that a page token can hold, ms since 1970: differences of them are numbers of every database.
const TIMES_MS: RangeInclusive<i64> = 0..=1 << 53;
/// Maximum number of labels of a filter.
const MAX_LABELS: usize = 16;

/// Longest text that is searched for, characters.
const MAX_TEXT: usize = 200;

/// Error of a query parameter.
#[derive(Debug, thiserror::Error)]
pub(crate) enum ListError {
    /// Not a status.
    #[error("`{0}` is not a status; statuses are {1}")]
    Status(String, String),
    /// Not a parameter.
    #[error("`{0}` is not a parameter; parameters are {1}")]
    Unknown(String, String),
    /// Given twice.
    #[error("`{0}` is given twice")]
    Twice(String),
    /// Not a time.
    #[error("`{0}` is not a time such as 2026-01-31T12:00:00Z")]
    Time(String),
    /// Not the id of a sweep.
    #[error("`{0}` is not the id of a sweep")]
    Sweep(String),
    /// Not a kind of system.
    #[error("`{0}` is not a kind of system; kinds are {1}")]
    System(String, String),
    /// No text, or too long a one.
    #[error("a text has 1 to {MAX_TEXT} characters, not {0}")]
    Text(usize),
    /// Not a view.
    #[error("`{0}` is not a view; views are short and full")]
    View(String),
    /// Not an order.
    #[error("`{0}` is not an order; orders are {1}, each with a - in front for the largest first")]
    Order(String, String),
    /// Neither true nor false.
    #[error("`total` is true or false, not `{0}`")]
    Total(String),
    /// Too many labels.
    #[error("a filter can have {MAX_LABELS} labels, not {0}")]
    Labels(usize),
    /// Not a label.
    #[error("`{0}` is not a label such as key:value")]
    Label(String),
}

impl RouteError for ListError {
    const TYPE: ProblemType = ProblemType::INVALID_QUERY;
}

/// Names of the parameters of a filter.
pub(super) const FILTERS: &str =
    "status, system, label, created_from, created_before, sweep and text";
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

/// Filters; a job passes all of them.
#[derive(Debug, Default, IntoParams)]
#[into_params(parameter_in = Query)]
#[expect(
    dead_code,
    reason = "only describes the parameters, which are parsed one by one because labels repeat"
)]
pub(crate) struct FilterQuery {
    /// Any of these statuses, separated by commas.
    status: Option<String>,
    /// This kind of system.
    system: Option<SystemKind>,
    /// This label, as `key:value`; can be repeated, for jobs that have all of them.
    label: Option<Vec<String>>,
    /// Accepted at this time (RFC 3339) or later.
    created_from: Option<String>,
    /// Accepted before this time (RFC 3339).
    created_before: Option<String>,
    /// Jobs of this sweep.
    sweep: Option<Uuid>,
    /// In the name, the value of a label or the id, whatever the case of ASCII letters.
    #[param(min_length = 1, max_length = 200)]
    text: Option<String>,
}

/// Order and page of a list.
#[derive(Debug, Default, IntoParams)]
#[into_params(parameter_in = Query)]
#[expect(
    dead_code,
    reason = "only describes the parameters, which are parsed one by one because labels repeat"
)]
pub(crate) struct PageQuery {
    /// What the jobs are ordered by, the smallest first, or with a `-` in front the largest: `created`, `name`, `system`, `status`, `progress`,
    /// `wear` (the deeper one of both sides), `life` (cycles until the first criterion) or `duration`; `-created` by default. Jobs without a value come last. A page
    /// begins behind the last job of the one before: only a job whose own value changes between two pages can be listed twice or not at all.
    #[param(pattern = "^-?(created|name|system|status|progress|wear|life|duration)$")]
    sort: Option<String>,
    /// Whether the jobs of all pages are counted.
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

/// ListPlace of the last job of a page.
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

/// Parses the parameters that filter jobs; returns the others.
pub(super) fn filter_among<'a>(
    pairs: &'a [(String, String)],
    filter: &mut Filter,
) -> Result<Vec<(&'a str, &'a str)>, ListError> {
    let mut others = Vec::new();
    for (index, (name, value)) in pairs.iter().enumerate() {
        let twice = pairs[..index].iter().any(|(earlier, _)| earlier == name);
        if twice && name != "label" {
            return Err(ListError::Twice(shortened(name)));
        }
        match name.as_str() {
            "status" => filter.statuses = statuses(value)?,
            "system" => filter.system = Some(system(value)?),
            "label" => filter.labels.push(label(value)?),
            "created_from" => filter.created_from = Some(time(value)?),
            "created_before" => filter.created_before = Some(time(value)?),
            "sweep" => {
                let id = Uuid::parse_str(value);
                filter.sweep = Some(id.map_err(|_| ListError::Sweep(shortened(value)))?);
            }
            "text" => filter.text = Some(text(value)?),
            name => others.push((name, value.as_str())),
        }
    }
    if filter.labels.len() > MAX_LABELS {
        return Err(ListError::Labels(filter.labels.len()));
    }
    Ok(others)
}

fn text(value: &str) -> Result<String, ListError> {
    let length = value.chars().count();
    if length == 0 || length > MAX_TEXT {
        return Err(ListError::Text(length));
    }
    Ok(value.to_owned())
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

fn statuses(list: &str) -> Result<Vec<Status>, ListError> {
    let status = |name| {
        Status::from_name(name)
            .ok_or_else(|| ListError::Status(shortened(name), known::<Status>(name)))
    };
    list.split(',').map(status).collect()
}

fn system(name: &str) -> Result<String, ListError> {
    if SystemKind::NAMES.contains(&name) {
        return Ok(name.to_owned());
    }
    Err(ListError::System(
        shortened(name),
        known::<SystemKind>(name),
    ))
}

/// The names of an enum, and the one that was probably meant.
fn known<T: StringEnum>(name: &str) -> String {
    let meant = spec::did_you_mean(name, T::NAMES.iter().copied());
    T::NAMES.join(", ") + &meant
}

fn time(text: &str) -> Result<i64, ListError> {
    text.parse::<Timestamp>()
        .map(Timestamp::as_millisecond)
        .map_err(|_| ListError::Time(shortened(text)))
}

fn label(text: &str) -> Result<(String, String), ListError> {
    let (key, value) = text
        .split_once(':')
        .ok_or_else(|| ListError::Label(shortened(text)))?;
    Ok((key.to_owned(), value.to_owned()))
}

#[cfg(test)]
mod tests;
