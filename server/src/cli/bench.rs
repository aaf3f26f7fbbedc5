//! `fretwear bench`: what the engine does in how much time on this machine.

use std::process::ExitCode;

use comfy_table::{CellAlignment, Table};

use super::terminal::{failed, say, tell};
use crate::bench::{self, Row};

pub(super) fn run() -> ExitCode {
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
