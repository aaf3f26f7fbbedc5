//! The results of a sweep as one table: a row per job, first its changes against the base, then the quantities of its summary.

use std::collections::BTreeSet;

use ::csv::Writer;
use api::job::Outcome;
use api::sweep::SweepRequest;
use serde_json::Value;

use crate::batch::error::EvaluateError;
use crate::export::csv::CsvError;
use crate::export::documents::DocumentError;
use crate::export::quantities::{self, Column};
use crate::store::{BatchJob, StoredBatch};

/// Returns the table as CSV; cells of jobs without a result are empty.
///
/// # Errors
/// [`EvaluateError::Write`] if the writer fails.
pub(in crate::batch) fn csv(batch: &StoredBatch) -> Result<Vec<u8>, EvaluateError> {
    // Also where none of its jobs is in this part.
    let request: Option<SweepRequest> = batch
        .request
        .as_deref()
        .and_then(|request| serde_json::from_str(request).ok());
    let grid = request.and_then(|request| request.grid).unwrap_or_default();
    let pointers = pointers(&batch.jobs).chain(grid.keys()).collect();
    Ok(write(&pointers, &batch.jobs, true).map_err(DocumentError::from)?)
}

/// Returns further rows of a table whose jobs all change the same fields.
///
/// # Errors
/// [`EvaluateError::Write`] if the writer fails.
pub(in crate::batch) fn rows(jobs: &[BatchJob]) -> Result<Vec<u8>, EvaluateError> {
    let pointers = pointers(jobs).collect();
    Ok(write(&pointers, jobs, false).map_err(DocumentError::from)?)
}

fn pointers(jobs: &[BatchJob]) -> impl Iterator<Item = &String> {
    jobs.iter().flat_map(|job| job.overrides.keys())
}

fn write(
    pointers: &BTreeSet<&String>,
    jobs: &[BatchJob],
    with_header: bool,
) -> Result<Vec<u8>, CsvError> {
    let mut header = vec!["job".to_owned(), "status".to_owned(), "outcome".to_owned()];
    header.extend(pointers.iter().map(|pointer| harmless(pointer)));
    header.extend(quantities::columns(None).iter().map(Column::header));
    let mut writer = Writer::from_writer(Vec::new());
    if with_header {
        writer.write_record(header)?;
    }
    for job in jobs {
        let outcome = job.outcome.map(Outcome::as_str).unwrap_or_default();
        let mut cells = vec![job.id.to_string()];
        cells.extend([job.status.as_str(), outcome].map(str::to_owned));
        let overrides = pointers.iter().map(|pointer| job.overrides.get(*pointer));
        cells.extend(overrides.map(|value| value.map(cell).unwrap_or_default()));
        let columns = quantities::columns(job.summary.as_ref());
        let values = columns.iter().map(|column| column.value);
        cells.extend(values.map(|value| value.map_or_else(String::new, |value| value.to_string())));
        writer.write_record(cells)?;
    }
    writer
        .into_inner()
        .map_err(|error| CsvError(error.to_string()))
}

fn cell(value: &Value) -> String {
    match value {
        Value::String(text) => harmless(text),
        Value::Number(number) => number.to_string(),
        other => harmless(&other.to_string()),
    }
}

/// Returns a client's text as a cell that no spreadsheet executes: one that begins like a formula gets an apostrophe.
fn harmless(text: &str) -> String {
    if text.starts_with(['=', '+', '-', '@', '\t', '\r', '\n']) {
        format!("'{text}")
    } else {
        text.to_owned()
    }
}

#[cfg(test)]
mod tests {
    use api::job::Status;
    use api::sweep::Changes;
    use serde_json::json;

    use super::*;

    #[test]
    fn texts_of_clients_are_not_written_as_formulas() {
        let overrides = Changes::from([
            ("/name".to_owned(), json!("=cmd|'/c calc'!A1")),
            ("/load/n".to_owned(), json!(-0.5)),
            ("@x".to_owned(), json!(["=1"])),
        ]);
        let job = BatchJob {
            id: uuid::Uuid::nil(),
            position: 0,
            overrides,
            status: Status::Queued,
            status_reason: None,
            outcome: None,
            summary: None,
            profile: None,
        };
        let jobs = [job];
        let table = write(&pointers(&jobs).collect(), &jobs, true).expect("a table");
        let text = String::from_utf8(table).expect("text");
        let lines: Vec<&str> = text.lines().collect();
        assert!(
            lines[0].starts_with("job,status,outcome,/load/n,/name,'@x,cycles_done,"),
            "{text}"
        );
        assert!(
            lines[1].starts_with(
                "00000000-0000-0000-0000-000000000000,queued,,-0.5,'=cmd|'/c calc'!A1,"
            ),
            "{text}"
        );
        assert!(lines[1].ends_with(",,,,,,,,,,,,"), "{text}");
    }
}
