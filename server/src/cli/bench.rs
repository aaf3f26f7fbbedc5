//! `fretwear bench`: processor time of the engine on this machine.

use comfy_table::Table;

use crate::bench;
use crate::bench::against;
use crate::bench::against::Comparison;
use crate::bench::predictions;
use crate::bench::predictions::{Pair, Prediction};
use crate::bench::{BenchError, Row};
use crate::cli::arguments::BenchArguments;
use crate::cli::terminal::{Ended, failed, write_err, write_out};
use crate::estimate::machine;
use crate::export::markdown;
use crate::program;

pub(super) fn run(arguments: &BenchArguments) -> Ended {
    if arguments.predictions {
        return write_out(compare(&arguments.tolerances).map_err(failed)?);
    }
    if arguments.against.is_some() {
        return against_ccx(&arguments.elements_um);
    }
    let mut table = markdown::table(["case", "size", "CPU"], 2);
    for (name, case) in bench::all() {
        write_err(format_args!("fretwear: {name}"));
        let measured = case().map_err(|error| failed(format_args!("{name}: {error}")))?;
        for Row { what, size, cpu_s } in measured {
            write_err(format_args!("  {what}, {size}: {}", time(cpu_s)));
            table.add_row([what, size, time(cpu_s)]);
        }
    }
    write_out(table)
}

fn time(seconds: f64) -> String {
    if seconds < 0.1 {
        format!("{:.2} ms", 1e3 * seconds)
    } else {
        format!("{seconds:.2} s")
    }
}

/// Compares with CalculiX; prints that the comparison is skipped where it is not installed.
fn against_ccx(elements_um: &[f64]) -> Ended {
    if !against::is_installed() {
        return write_out("skipped: ccx (CalculiX) is not installed here");
    }
    let header = [
        "element, um",
        "nodes",
        "fretwear: set-up + cycle, s",
        "ccx, s",
        "ratio",
        "largest |Q|/(mu P), fretwear / ccx",
    ];
    let mut table = markdown::table(header, 0);
    for element in elements_um {
        write_err(format_args!("fretwear: elements of {element} um"));
        table.add_row(row(&against::ccx(*element).map_err(failed)?));
    }
    write_out(table)?;
    let [ours, theirs] = against::TOLERANCES;
    write_out(
        "Processor seconds, one thread each, one after the other on this machine. Tolerances:",
    )?;
    write_out(format_args!("fretwear: {ours}; ccx: {theirs}."))
}

/// Compares estimates of plans with measurements, with a calibration of its own.
fn compare(tolerances: &[f64]) -> Result<Table, BenchError> {
    write_err("fretwear: measuring the machine");
    let figures = machine::measure()?;
    let mut table: Option<Table> = None;
    for tolerance in tolerances {
        for scene in predictions::scenes()? {
            write_err(format_args!(
                "fretwear: {} at {} %",
                scene.0,
                100.0 * tolerance
            ));
            let prediction = predictions::compare(&program::own(), &figures, &scene, *tolerance)?;
            table
                .get_or_insert_with(|| markdown::table(header(&prediction), 1))
                .add_row(cells(&prediction));
        }
    }
    Ok(table.unwrap_or_default())
}

fn header(prediction: &Prediction) -> Vec<String> {
    let names = prediction.pairs.iter().map(|pair| pair.what);
    let all = ["scene", "tolerance"].into_iter().chain(names);
    all.map(str::to_owned).collect()
}

/// Cells of a prediction: expected / measured = ratio.
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
