//! `fretwear solve SPEC [--out DIR]`: no server; progress on standard error, tables or the summary on standard output.

use std::io::IsTerminal;
use std::ops::ControlFlow;
use std::process::ExitCode;

use api::job::Outcome;
use api::results::{Snapshot, Summary};
use indicatif::ProgressBar;
use solver::record::CycleReport;

use crate::cli::arguments::SolveArguments;
use crate::cli::figures::rounded;
use crate::cli::runtime::processors;
use crate::cli::summary::Format;
use crate::cli::terminal::{Ended, bar, failed, unusable, write_err};
use crate::cli::{specification, summary};
use crate::estimate::Estimate;
use crate::estimate::machine::{CalibrationCache, cache_file};
use crate::export::documents::{Document, Results};
use crate::export::files;
use crate::solve;
use crate::solve::{ChildMessage, Failure};
use crate::spec::Resolved;

/// An hour, s: in a terminal, a solve that is expected to take more processor time is confirmed first.
const HOUR_S: f64 = 3_600.0;
/// A minute, s: in a terminal, the expected processor time of a solve that takes more is stated first.
const MINUTE_S: f64 = 60.0;

pub(super) fn run(arguments: &SolveArguments) -> Ended {
    let (out, format) = (arguments.out.as_deref(), Format::json_if(arguments.json));
    let mut resolved = specification::resolved_for(&arguments.spec, out)?;
    if is_interactive() {
        announce(&resolved, arguments.yes)?;
    }
    resolved.scene.threads = processors();
    let mut recorded = Recorded::default();
    let solved = solve(&resolved, &mut recorded);
    if let Some(folder) = out {
        let results = Results {
            spec: &resolved.spec,
            summary: solved.as_ref().ok(),
            rows: &recorded.rows,
            snapshots: &recorded.snapshots,
        };
        if let Err(error) = files::write(folder, &results, &recorded.fields) {
            if let Ok(summary) = &solved {
                // The command fails in any case.
                let _ = report(&resolved, summary, format);
            }
            return Err(failed(error));
        }
    }
    report(&resolved, &solved.map_err(failed)?, format)
}

/// Checks whether standard input and standard error are terminals: a user waits for the solve, and no script.
fn is_interactive() -> bool {
    std::io::stdin().is_terminal() && std::io::stderr().is_terminal()
}

/// States the expected processor time of a solve on this machine where a user would wait for it; refuses one of more than an hour that is
/// not confirmed.
fn announce(resolved: &Resolved, is_confirmed: bool) -> Ended {
    let cache = CalibrationCache::open(cache_file());
    let plan = Estimate::of(resolved).plan(resolved, cache.get_or_measure());
    let [seconds, most] =
        ["cpu_s", "cpu_s_most"].map(|name| plan.estimates.get(name).copied().unwrap_or_default());
    let (from, to) = (duration(seconds), duration(most));
    let expected =
        format!("the solve is expected to take {from} to {to} of processor time on this machine");
    if seconds > HOUR_S && !is_confirmed {
        return Err(unusable(format_args!("{expected}; start it with --yes")));
    }
    if seconds > MINUTE_S {
        write_err(format_args!("fretwear: {expected}"));
    }
    Ok(())
}

fn duration(seconds: f64) -> String {
    if seconds > HOUR_S {
        format!("{} h", rounded(seconds / HOUR_S))
    } else {
        format!("{} min", rounded(seconds / MINUTE_S))
    }
}

#[derive(Default)]
struct Recorded {
    rows: Vec<CycleReport>,
    snapshots: Vec<Snapshot>,
    fields: Vec<Document>,
}

fn solve(resolved: &Resolved, recorded: &mut Recorded) -> Result<Summary, Failure> {
    let bar = bar(resolved.scene.cycles);
    let solved = solve::run(resolved.into(), &mut |line| {
        record(line, recorded, &bar);
        ControlFlow::Continue(())
    });
    bar.finish_and_clear();
    solved
}

fn record(line: ChildMessage, recorded: &mut Recorded, bar: &ProgressBar) {
    match line {
        ChildMessage::Phase(phase) => bar.set_message(phase.as_str()),
        ChildMessage::Cycle(row) => {
            bar.set_position(row.cycle);
            recorded.rows.push(*row);
        }
        ChildMessage::Snapshot(snapshot) => recorded.snapshots.push(*snapshot),
        ChildMessage::Fields(file) => recorded.fields.push(file),
        ChildMessage::Restarted(cause) => {
            bar.println(format!("the run restarts at cycle 0: {cause}"));
            *recorded = Recorded::default();
        }
        ChildMessage::Ready
        | ChildMessage::File(_)
        | ChildMessage::Refined(_)
        | ChildMessage::Checkpoint(_)
        | ChildMessage::Summary(_)
        | ChildMessage::Failed(_)
        | ChildMessage::Stopped => {}
    }
}

fn report(resolved: &Resolved, summary: &Summary, format: Format) -> Ended {
    summary::write(&resolved.spec, summary, format, &resolved.warnings)?;
    if summary.outcome == Outcome::Stopped {
        write_err("fretwear: the run was stopped");
        return Err(ExitCode::FAILURE);
    }
    Ok(())
}
