//! `fretwear bench`: what the engine does in how much time on this machine.

use std::process::ExitCode;

use comfy_table::{CellAlignment, Table};

use super::BenchArguments;
use super::terminal::{failed, say, tell};
use crate::bench::predictions::{self, Pair, Prediction};
use crate::bench::{self, BenchError, Row};
use crate::machine;
use crate::study::StudyError;

pub(super) fn run(arguments: &BenchArguments) -> ExitCode {
    if arguments.predictions {
        return match compare(&arguments.tolerances) {
            Ok(table) => {
                say(table);
                ExitCode::SUCCESS
            }
            Err(error) => failed(error),
        };
    }
    let mut rows = Vec::new();
    for (name, case) in bench::all() {
        tell(format_args!("fretwear: {name}"));
        match case() {
            Ok(measured) => rows.extend(measured),
            Err(error) => return failed(format_args!("{name}: {error}")),
        }
    }
    say(table(&rows));
    ExitCode::SUCCESS
}

fn table(rows: &[Row]) -> Table {
    let mut table = Table::new();
    table.load_style(comfy_table::presets::ASCII_MARKDOWN);
    table.set_header(["case", "size", "CPU"]);
    for row in rows {
        table.add_row([row.what.clone(), row.size.clone(), time(row.cpu_s)]);
    }
    if let Some(column) = table.column_mut(2) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    table
}

fn time(seconds: f64) -> String {
    if seconds < 0.1 {
        format!("{:.2} ms", 1e3 * seconds)
    } else {
        format!("{seconds:.2} s")
    }
}

/// What plans expect beside what solves take, with a calibration of its own.
fn compare(tolerances: &[f64]) -> Result<Table, BenchError> {
    tell("fretwear: measuring the machine");
    let figures = machine::measure()?;
    let program = std::env::current_exe().map_err(StudyError::from)?;
    let mut table = Table::new();
    table.load_style(comfy_table::presets::ASCII_MARKDOWN);
    for tolerance in tolerances {
        for scene in predictions::scenes()? {
            tell(format_args!(
                "fretwear: {} at {} %",
                scene.0,
                100.0 * tolerance
            ));
            let prediction = predictions::compare(&program, &figures, &scene, *tolerance)?;
            if table.header().is_none() {
                table.set_header(header(&prediction));
            }
            table.add_row(cells(&prediction));
        }
    }
    for column in table.column_iter_mut().skip(1) {
        column.set_cell_alignment(CellAlignment::Right);
    }
    Ok(table)
}

fn header(prediction: &Prediction) -> Vec<String> {
    let names = prediction.pairs.iter().map(|pair| pair.what.to_owned());
    ["scene", "tolerance"]
        .map(str::to_owned)
        .into_iter()
        .chain(names)
        .collect()
}

/// Expected / measured = ratio.
fn cells(prediction: &Prediction) -> Vec<String> {
    let figure = |value: f64| {
        if value < 10.0 {
            format!("{value:.2}")
        } else {
            format!("{value:.0}")
        }
    };
    let pair = |pair: &Pair| {
        let [expected, measured] = [pair.expected, pair.measured].map(figure);
        format!("{expected} / {measured} = {:.2}", pair.ratio())
    };
    let first = [
        prediction.scene.clone(),
        format!("{} %", 100.0 * prediction.tolerance),
    ];
    first
        .into_iter()
        .chain(prediction.pairs.iter().map(pair))
        .collect()
}
