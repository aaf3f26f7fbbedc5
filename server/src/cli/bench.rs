//! `fretwear bench`: what the engine does in how much time on this machine.

use std::process::ExitCode;

use comfy_table::{CellAlignment, Table};

use crate::batch::accuracy::StudyError;
use crate::bench;
use crate::bench::against;
use crate::bench::against::Comparison;
use crate::bench::predictions;
use crate::bench::predictions::{Pair, Prediction};
use crate::bench::{BenchError, Row};
use crate::cli::BenchArguments;
use crate::cli::terminal::{failed, say, tell};
use crate::estimate::machine;

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
    if arguments.against.is_some() {
        return against_ccx(&arguments.elements_um);
    }
    let mut rows = Vec::new();
    for (name, case) in bench::all() {
        tell(format_args!("fretwear: {name}"));
        match case() {
            Ok(measured) => {
                for row in &measured {
                    tell(format_args!(
                        "  {}, {}: {}",
                        row.what,
                        row.size,
                        time(row.cpu_s)
                    ));
                }
                rows.extend(measured);
            }
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

/// Both codes, one table; visibly skipped where the other one is absent.
fn against_ccx(elements_um: &[f64]) -> ExitCode {
    if !against::is_installed() {
        say("skipped: ccx (CalculiX) is not installed here");
        return ExitCode::SUCCESS;
    }
    let mut table = Table::new();
    table.load_style(comfy_table::presets::ASCII_MARKDOWN);
    table.set_header([
        "element, um",
        "nodes",
        "fretwear: set-up + cycle, s",
        "ccx, s",
        "ratio",
        "largest |Q|/(mu P), fretwear / ccx",
    ]);
    for element in elements_um {
        tell(format_args!("fretwear: elements of {element} um"));
        let compared = match against::ccx(*element) {
            Ok(compared) => compared,
            Err(error) => return failed(error),
        };
        table.add_row(row(&compared));
    }
    for column in table.column_iter_mut() {
        column.set_cell_alignment(CellAlignment::Right);
    }
    say(table);
    let [ours, theirs] = against::TOLERANCES;
    say(format_args!(
        "Processor seconds, one thread each, one after the other on this machine. Tolerances:"
    ));
    say(format_args!("fretwear: {ours}; ccx: {theirs}."));
    ExitCode::SUCCESS
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

fn row(compared: &Comparison) -> [String; 6] {
    let [setup_s, cycle_s] = compared.ours_s;
    let (theirs, ratio) = match &compared.theirs_s {
        Ok(seconds) => (
            format!("{seconds:.1}"),
            format!("{:.0}", seconds / (setup_s + cycle_s)),
        ),
        Err(reason) => (reason.clone(), "-".to_owned()),
    };
    let [ours_use, theirs_use] = compared.friction_use;
    [
        compared.element_um.to_string(),
        compared.nodes.to_string(),
        format!("{setup_s:.3} + {cycle_s:.3}"),
        theirs,
        ratio,
        format!("{ours_use:.4} / {theirs_use:.4}"),
    ]
}
