//! Result documents as CSV: one header line with the units in the names, then numbers only.

use ::csv::Writer;
use api::results::{Loop, Pressure, Profile};
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

/// Writes a header and rows of as many cells.
fn write<R>(
    header: impl IntoIterator<Item = impl AsRef<[u8]>>,
    rows: impl Iterator<Item = R>,
) -> Result<Vec<u8>, CsvError>
where
    R: IntoIterator<Item = String>,
{
    let mut writer = Writer::from_writer(Vec::new());
    writer.write_record(header)?;
    for row in rows {
        writer.write_record(row)?;
    }
    writer
        .into_inner()
        .map_err(|error| CsvError(error.to_string()))
}

/// The wear history, one line per computed cycle.
///
/// # Errors
/// [`CsvError`] if the writer fails.
pub fn wear_history(record: &Record) -> Result<Vec<u8>, CsvError> {
    let (header, columns): (Vec<_>, Vec<_>) = columns::of(record).into_iter().unzip();
    let cells = |row: usize| {
        columns.iter().map(move |values| match values {
            Values::Counts(counts) => counts[row].to_string(),
            Values::Numbers(numbers) => numbers[row].to_string(),
        })
    };
    write(header, (0..record.cycle.len()).map(cells))
}

/// A profile: side, position, worn depth.
///
/// # Errors
/// [`CsvError`] if the writer fails.
pub fn profile(profile: &Profile) -> Result<Vec<u8>, CsvError> {
    let sides = [
        ("receptacle", &profile.receptacle),
        ("slider", &profile.slider),
    ];
    let rows = sides.into_iter().flat_map(|(side, surface)| {
        let points = surface.x_mm.iter().zip(&surface.depth_mm);
        points.map(move |(x, depth)| [side.to_owned(), x.to_string(), depth.to_string()])
    });
    write(["side", "x_mm", "depth_mm"], rows)
}

/// Tractions: phase, displacement of the slider, position on the receptacle, pressure, shear.
///
/// # Errors
/// [`CsvError`] if the writer fails.
pub fn pressure(pressure: &Pressure) -> Result<Vec<u8>, CsvError> {
    let rows = pressure.positions.iter().flat_map(|at| {
        let tractions = at.pressure_mpa.iter().zip(&at.shear_mpa);
        at.x_mm.iter().zip(tractions).map(|(x, (p, q))| {
            let phase = at.phase.as_str().to_owned();
            let [slider_x, x, p, q] = [at.slider_x_mm, *x, *p, *q].map(|value| value.to_string());
            [phase, slider_x, x, p, q]
        })
    });
    let header = ["phase", "slider_x_mm", "x_mm", "pressure_mpa", "shear_mpa"];
    write(header, rows)
}

/// A friction loop: displacement, force per mm, and that of the whole contact where it is not a section.
///
/// # Errors
/// [`CsvError`] if the writer fails.
pub fn friction_loop(friction_loop: &Loop) -> Result<Vec<u8>, CsvError> {
    let whole = &friction_loop.tangential_force_n;
    let whole = (!whole.is_empty()).then_some(("tangential_force_n", whole));
    let columns = [
        ("displacement_mm", &friction_loop.displacement_mm),
        (
            "tangential_force_n_per_mm",
            &friction_loop.tangential_force_n_per_mm,
        ),
    ];
    let (header, columns): (Vec<_>, Vec<_>) = columns.into_iter().chain(whole).unzip();
    let rows = friction_loop.displacement_mm.len();
    let cells = |row: usize| columns.iter().map(move |values| values[row].to_string());
    write(header, (0..rows).map(cells))
}

/// A study, one line per run; values that a run does not have are empty cells.
///
/// # Errors
/// [`CsvError`] if the writer fails.
pub fn study(study: &Study) -> Result<Vec<u8>, CsvError> {
    type Cell = fn(&StudyRun) -> String;
    fn number(value: Option<f64>) -> String {
        value.map_or_else(String::new, |value| value.to_string())
    }
    fn error(run: &StudyRun, of: fn(&Errors) -> f64) -> String {
        number(run.errors.as_ref().map(of))
    }
    let columns: [(&str, Cell); 15] = [
        ("tolerance", |run| number(run.tolerance)),
        ("contact_element_mm", |run| {
            run.contact_element_mm.to_string()
        }),
        ("contact_elements", |run| run.contact_elements.to_string()),
        ("increments_per_cycle", |run| {
            run.increments_per_cycle.to_string()
        }),
        ("cycle_jump", |run| run.cycle_jump.to_string()),
        ("stations", |run| number(run.stations.map(f64::from))),
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
    let rows = study
        .runs
        .iter()
        .map(|run| columns.map(|(_, cell)| cell(run)));
    write(columns.map(|(header, _)| header), rows)
}
