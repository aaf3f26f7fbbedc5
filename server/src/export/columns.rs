//! The columns of a wear history under their headers: common to its tables (CSV, Parquet) and to thinning.

use solver::record::{LineColumns, Record};

/// The values of a column.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Values<'a> {
    /// Counts.
    Counts(&'a [u64]),
    /// Quantities.
    Numbers(&'a [f64]),
}

/// The columns in order.
pub fn of(record: &Record) -> Vec<(String, Values<'_>)> {
    let located = [
        ("cycle", Values::Counts(&record.cycle)),
        ("jump", Values::Counts(&record.jump)),
        (
            "sliding_distance_mm",
            Values::Numbers(&record.sliding_distance_mm),
        ),
    ];
    let located = located.map(|(name, values)| (name.to_owned(), values));
    let channels = record
        .columns
        .iter()
        .map(|column| (column.header(), Values::Numbers(&column.values)));
    let line = record.line.iter().flat_map(LineColumns::named);
    let line = line.map(|(name, values)| (name, Values::Numbers(values)));
    located.into_iter().chain(channels).chain(line).collect()
}
