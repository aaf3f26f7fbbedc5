//! `GET /v1/histories`: columns of the histories of several jobs, for charts that show many of them.

use api::results::{Columns, Histories, JobHistory};
use axum::Json;
use axum::extract::State;
use futures_util::{StreamExt, TryStreamExt, stream};
use serde::Deserialize;
use solver::record::{CycleReport, Record};
use utoipa::IntoParams;
use uuid::Uuid;

use crate::export::columns::{self, Values};
use crate::export::thin;
use crate::http::app::App;
use crate::http::extract::Params;
use crate::http::problem::{ProblemResponse, ProblemType, RouteError};
use crate::http::routes::results::max_points;
use crate::number::real;
use crate::text::shortened;

/// Most jobs of an answer.
const MOST_JOBS: usize = 100;
/// Histories that are read at the same time: those in a store of objects are far away. Arbitrary.
const READS: usize = 8;
/// Most columns of each.
const MOST_COLUMNS: usize = 20;
/// Rows of a job without `max_points`.
const DEFAULT_POINTS: usize = 1000;
/// Most numbers of an answer: 16 MB, and some as many as text.
const MOST_NUMBERS: usize = 2_000_000;

/// Error of a query parameter.
#[derive(Debug, thiserror::Error)]
enum HistoriesError {
    /// Not an id.
    #[error("`{0}` is not the id of a job")]
    Id(String),
    /// No job or too many.
    #[error("an answer holds 1 to {MOST_JOBS} jobs, not {0}")]
    Jobs(usize),
    /// No column or too many.
    #[error("an answer holds 1 to {MOST_COLUMNS} columns, not {0}")]
    Columns(usize),
    /// More numbers than an answer holds.
    #[error(
        "an answer holds {MOST_NUMBERS} numbers, not {jobs} jobs of {columns} columns with {points} rows: ask for fewer"
    )]
    Numbers {
        jobs: usize,
        columns: usize,
        points: usize,
    },
    /// A column of none of the jobs.
    #[error("no history has a column `{0}`; columns are {1}")]
    Unknown(String, String),
}

impl RouteError for HistoriesError {
    const TYPE: ProblemType = ProblemType::INVALID_QUERY;
}

/// Jobs and columns.
#[derive(Debug, Clone, Deserialize, IntoParams)]
#[into_params(parameter_in = Query)]
#[serde(deny_unknown_fields)]
pub(crate) struct HistoriesQuery {
    /// Identifiers of 1 to 100 jobs, separated by commas.
    jobs: String,
    /// Names of 1 to 20 columns of the CSV table, separated by commas.
    columns: String,
    /// Maximum number of rows of each job, 1 000 by default; extrema of these columns are preserved. An answer holds 2 000 000 numbers.
    #[param(minimum = 16, maximum = 100_000)]
    max_points: Option<usize>,
}

/// Columns of the histories of several jobs so far.
#[utoipa::path(
    get,
    path = "/v1/histories",
    tag = "results",
    params(HistoriesQuery),
    responses((status = 200, description = "The columns", body = Histories))
)]
pub(crate) async fn histories(
    State(app): State<App>,
    Params(query): Params<HistoriesQuery>,
) -> Result<Json<Histories>, ProblemResponse> {
    max_points::check(query.max_points)?;
    let ids = ids(&query.jobs)?;
    let names = names(&query.columns)?;
    let points = query.max_points.unwrap_or(DEFAULT_POINTS);
    let (jobs, columns) = (ids.len(), names.len());
    if jobs * columns * points > MOST_NUMBERS {
        let error = HistoriesError::Numbers {
            jobs,
            columns,
            points,
        };
        return Err(error.into());
    }
    let (mut histories, mut known) = (Vec::with_capacity(ids.len()), Vec::new());
    let read = stream::iter(ids).map(|id| history(&app, id, &names, points));
    let mut read = std::pin::pin!(read.buffered(READS));
    while let Some(found) = read.try_next().await? {
        let Some((history, all)) = found else {
            continue;
        };
        known.extend(all);
        histories.push(history);
    }
    let unknown = names.iter().find(|name| !known.contains(name));
    if let Some(name) = unknown.filter(|_| !known.is_empty()) {
        known.sort();
        known.dedup();
        return Err(HistoriesError::Unknown(shortened(name), known.join(", ")).into());
    }
    Ok(Json(Histories { histories }))
}

/// The history of a job, and the names of all of its columns; `None` if there is no such job.
async fn history(
    app: &App,
    id: Uuid,
    names: &[String],
    points: usize,
) -> Result<Option<(JobHistory, Vec<String>)>, ProblemResponse> {
    let Some(job) = app.store.job(id).await? else {
        return Ok(None);
    };
    let stations = job.document.spec.output.stations_mm.unwrap_or_default();
    let rows = app.store.history(id).await?;
    // Thinning a long history blocks; other requests are served meanwhile.
    let chosen = names.to_vec();
    let chosen = move || of_job(&rows, &stations, &chosen, points);
    let (columns, all) = tokio::task::spawn_blocking(chosen).await?;
    Ok(Some((JobHistory { job: id, columns }, all)))
}

/// The chosen columns of a job, and the names of all of its columns.
fn of_job(
    rows: &[CycleReport],
    stations: &[f64],
    names: &[String],
    points: usize,
) -> (Columns, Vec<String>) {
    let record = Record::new(rows, stations);
    let all = columns::of(&record);
    let numbers = |values: &Values<'_>| match values {
        Values::Counts(counts) => counts.iter().map(|count| real(*count)).collect(),
        Values::Numbers(numbers) => numbers.to_vec(),
    };
    let chosen = names.iter().filter_map(|name| {
        let (_, values) = all.iter().find(|(known, _)| known == name)?;
        Some((name.clone(), numbers(values)))
    });
    let mut columns: Columns = chosen.collect();
    let mut cycles: Vec<f64> = record.cycle.iter().map(|cycle| real(*cycle)).collect();
    thin::curves(&mut cycles, columns.values_mut().collect(), points);
    (columns, all.into_iter().map(|(name, _)| name).collect())
}

fn ids(list: &str) -> Result<Vec<Uuid>, HistoriesError> {
    let ids: Vec<Uuid> = list
        .split(',')
        .map(|id| Uuid::parse_str(id).map_err(|_| HistoriesError::Id(shortened(id))))
        .collect::<Result<_, _>>()?;
    if ids.len() > MOST_JOBS {
        return Err(HistoriesError::Jobs(ids.len()));
    }
    Ok(ids)
}

fn names(list: &str) -> Result<Vec<String>, HistoriesError> {
    let names = list.split(',').filter(|name| !name.is_empty());
    let names: Vec<String> = names.map(str::to_owned).collect();
    if names.is_empty() || names.len() > MOST_COLUMNS {
        return Err(HistoriesError::Columns(names.len()));
    }
    Ok(names)
}

#[cfg(test)]
mod tests {
    use serde_json::json;

    use crate::http::tests::Service;

    #[tokio::test]
    async fn the_columns_of_each_job_are_returned() {
        let service = Service::new().await;
        let done = service.with_results().await;
        let empty = service.queued(r#"{"system":{"kind":"dimm"}}"#).await;
        let none = "00000000-0000-7000-8000-000000000000";
        let path =
            format!("/v1/histories?jobs={done},{none},{empty}&columns=cycle,peak_pressure_mpa");
        let (status, _, found) = service.get(&path).await;
        assert_eq!(status, 200, "{found}");
        let histories = found["histories"].as_array().expect("histories");
        assert_eq!(histories.len(), 2);
        assert_eq!(histories[0]["job"], json!(done));
        assert_eq!(histories[0]["columns"]["cycle"], json!([10.0, 20.0]));
        let pressures = histories[0]["columns"]["peak_pressure_mpa"].as_array();
        assert_eq!(pressures.map(Vec::len), Some(2));
        assert_eq!(histories[1]["columns"]["cycle"], json!([]));
    }

    #[tokio::test]
    async fn what_cannot_be_answered_is_refused_with_its_reason() {
        let service = Service::new().await;
        let id = service.with_results().await;
        for (query, reason) in [
            (
                "jobs=x&columns=cycle".to_owned(),
                "`x` is not the id of a job",
            ),
            (format!("jobs={id}&columns="), "1 to 20 columns, not 0"),
            (
                format!("jobs={id}&columns=cycles"),
                "no history has a column `cycles`",
            ),
            (
                format!("jobs={id}&columns=cycle&max_points=3"),
                "max_points is 3",
            ),
            (format!("jobs={id}"), "columns"),
            (
                format!(
                    "jobs={}&columns={}&max_points=100000",
                    [&id[..]; 3].join(","),
                    ["cycle"; 7].join(",")
                ),
                "2000000 numbers, not 3 jobs of 7 columns with 100000 rows",
            ),
        ] {
            let (status, _, problem) = service.get(&format!("/v1/histories?{query}")).await;
            assert_eq!(status, 400, "{query}");
            let detail = problem["detail"].as_str().expect("a detail");
            assert!(detail.contains(reason), "{detail}");
        }
    }
}
