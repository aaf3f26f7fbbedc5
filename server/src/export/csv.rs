//! Result documents as CSV: one header line with the units in the names, then numbers only.

use ::csv::Writer;
use api::results::{Loop, Pressure, Profile, SlidePosition};
use api::study::{Errors, Study, StudyRun};
use solver::record::Record;

use crate::export::columns;
use crate::export::columns::Values;

/// A table could not be written as CSV.
#[derive(Debug, thiserror::Error)]
#[error("writing CSV: {0}")]
pub struct CsvError(pub(crate) String);

impl From<::csv::Error> for CsvError {
    fn from(error: ::csv::Error) -> Self {
        Self(error.to_string())
    }
}

type Table = Vec<(String, Vec<String>)>;

fn write(table: &Table) -> Result<Vec<u8>, CsvError> {
    let mut writer = Writer::from_writer(Vec::new());
    writer.write_record(table.iter().map(|(header, _)| header))?;
    let rows = table
        .iter()
        .map(|(_, column)| column.len())
        .min()
        .unwrap_or(0);
    for row in 0..rows {
        writer.write_record(table.iter().map(|(_, column)| &column[row]))?;
    }
    writer
        .into_inner()
        .map_err(|error| CsvError(error.to_string()))
}

fn numbers<T: ToString>(header: impl Into<String>, values: &[T]) -> (String, Vec<String>) {
    (
        header.into(),
        values.iter().map(ToString::to_string).collect(),
    )
}

/// The wear history, one line per computed cycle.
///
/// # Errors
/// [`CsvError`] if the writer fails.
pub fn wear_history(record: &Record) -> Result<Vec<u8>, CsvError> {
    let table = columns::of(record)
        .into_iter()
        .map(|(header, values)| match values {
            Values::Counts(counts) => numbers(header, counts),
            Values::Numbers(values) => numbers(header, values),
        })
        .collect();
    write(&table)
}

/// A profile: side, position, worn depth.
///
/// # Errors
/// [`CsvError`] if the writer fails.
pub fn profile(profile: &Profile) -> Result<Vec<u8>, CsvError> {
    let (mut sides, mut x_mm, mut depth_mm) = (Vec::new(), Vec::new(), Vec::new());
    for (side, surface) in [
        ("receptacle", &profile.receptacle),
        ("slider", &profile.slider),
    ] {
        for (x, depth) in surface.x_mm.iter().zip(&surface.depth_mm) {
            sides.push(side);
            x_mm.push(*x);
            depth_mm.push(*depth);
        }
    }
    write(&vec![
        numbers("side", &sides),
        numbers("x_mm", &x_mm),
        numbers("depth_mm", &depth_mm),
    ])
}

/// Tractions: phase, displacement of the slider, position on the receptacle, pressure, shear.
///
/// # Errors
/// [`CsvError`] if the writer fails.
pub fn pressure(pressure: &Pressure) -> Result<Vec<u8>, CsvError> {
    let mut table: Table = ["phase", "slider_x_mm", "x_mm", "pressure_mpa", "shear_mpa"]
        .map(|header| (header.to_owned(), Vec::new()))
        .to_vec();
    for position in &pressure.positions {
        for ((x, p), q) in position
            .x_mm
            .iter()
            .zip(&position.pressure_mpa)
            .zip(&position.shear_mpa)
        {
            let cells = [
                phase_name(position.phase).to_owned(),
                position.slider_x_mm.to_string(),
                x.to_string(),
                p.to_string(),
                q.to_string(),
            ];
            for ((_, column), cell) in table.iter_mut().zip(cells) {
                column.push(cell);
            }
        }
    }
    write(&table)
}

/// A friction loop: displacement, force.
///
/// # Errors
/// [`CsvError`] if the writer fails.
pub fn friction_loop(friction_loop: &Loop) -> Result<Vec<u8>, CsvError> {
    write(&vec![
        numbers("displacement_mm", &friction_loop.displacement_mm),
        numbers(
            "tangential_force_n_per_mm",
            &friction_loop.tangential_force_n_per_mm,
        ),
    ])
}

/// A study, one line per run; values that a run does not have are empty cells.
///
/// # Errors
/// [`CsvError`] if the writer fails.
pub fn study(study: &Study) -> Result<Vec<u8>, CsvError> {
    type Cell = fn(&StudyRun) -> String;
    fn error(run: &StudyRun, of: fn(&Errors) -> f64) -> String {
        let error = run.errors.as_ref().map(of);
        error.map_or_else(String::new, |error| error.to_string())
    }
    let columns: [(&str, Cell); 14] = [
        ("tolerance", |run| {
            let tolerance = run.tolerance;
            tolerance.map_or_else(String::new, |tolerance| tolerance.to_string())
        }),
        ("contact_element_mm", |run| {
            run.contact_element_mm.to_string()
        }),
        ("contact_elements", |run| run.contact_elements.to_string()),
        ("increments_per_cycle", |run| {
            run.increments_per_cycle.to_string()
        }),
        ("cycle_jump", |run| run.cycle_jump.to_string()),
        ("depth_error", |run| error(run, |errors| errors.depth)),
        ("width_error", |run| error(run, |errors| errors.width)),
        ("peak_pressure_error", |run| {
            error(run, |errors| errors.peak_pressure)
        }),
        ("area_error", |run| error(run, |errors| errors.area)),
        ("below_doubt", |run| run.below_uncertainty.join(" ")),
        ("cpu_s", |run| run.cpu_s.to_string()),
        ("peak_memory_mb", |run| run.peak_memory_mb.to_string()),
        ("on_front", |run| run.on_front.to_string()),
        ("failure", |run| run.failure.clone().unwrap_or_default()),
    ];
    let column =
        |(header, cell): (&str, Cell)| (header.to_owned(), study.runs.iter().map(cell).collect());
    write(&columns.into_iter().map(column).collect())
}

fn phase_name(phase: SlidePosition) -> &'static str {
    match phase {
        SlidePosition::Neutral => "neutral",
        SlidePosition::Rightmost => "rightmost",
        SlidePosition::Leftmost => "leftmost",
    }
}
