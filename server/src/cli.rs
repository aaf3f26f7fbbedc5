//! The command line.

mod access;
mod backup;
mod bench;
mod child;
mod demo;
mod export;
mod options;
mod plan;
mod probe;
mod serve;
mod solve;
mod study;
mod table;
mod terminal;

use std::io::IsTerminal;
use std::net::SocketAddr;
use std::path::PathBuf;
use std::process::ExitCode;

use crate::bench::{against, predictions};
use access::AccessOptions;
use clap::{Parser, Subcommand};
use tracing_subscriber::EnvFilter;

use options::WorkOptions;

/// Exit code of a refused specification.
const REFUSED: u8 = 2;

/// Where a service listens unless told otherwise.
const LISTEN: &str = "127.0.0.1:8080";
/// The database unless another is named.
const DATABASE: &str = "sqlite://fretwear.db";

/// What `--help` begins with.
const ABOUT: &str = "Wear of electrical contacts under vibration, by finite elements: on the command line and over HTTP";

#[derive(Debug, Parser)]
#[command(name = "fretwear", version, about = ABOUT)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Serve studies over HTTP.
    Serve(ServeArguments),
    /// Solve one specification here, without a server.
    Solve {
        /// The specification, JSON.
        spec: PathBuf,
        /// Write summary, resolved specification and results as files into this folder.
        #[arg(long)]
        out: Option<PathBuf>,
    },
    /// Tell what would be simulated and why.
    Plan {
        /// The specification, JSON.
        spec: PathBuf,
    },
    /// Solve one specification at many accuracies, and show what each costs and how far off it is.
    Study {
        /// The specification, JSON.
        spec: PathBuf,
        /// Write table, picture and figures as files into this folder.
        #[arg(long)]
        out: Option<PathBuf>,
        /// Processor seconds that all runs together should take.
        #[arg(long, default_value_t = crate::batch::accuracy::BUDGET_S)]
        budget_s: f64,
    },
    /// Write the model as an input deck for another code to standard output.
    Export {
        /// The specification, JSON.
        spec: PathBuf,
        /// Which code: `inp` is read by Abaqus and CalculiX.
        #[arg(long, value_enum, default_value = "inp")]
        format: DeckFormat,
        /// The cycle whose worn surfaces the model has; 0 is unworn.
        #[arg(long, default_value_t = 0)]
        cycle: u64,
    },
    /// Measure the engine on this machine.
    Bench(BenchArguments),
    /// Start a service in a fresh folder, run the fuzz-button study through it and show its wear.
    Demo {
        /// End when the study has ended instead of serving on.
        #[arg(long)]
        exit: bool,
        /// Where to listen; a free port unless one is named.
        #[arg(long, default_value = "127.0.0.1:0")]
        listen: SocketAddr,
    },
    /// Tell by the exit code whether the service that listens there can work.
    Probe {
        /// Where it listens.
        #[arg(long, env = "FRETWEAR_LISTEN", default_value = LISTEN)]
        listen: SocketAddr,
    },
    /// Copy a database, which may be served meanwhile, and its files into a new folder, and verify the copy.
    Backup {
        /// The folder.
        into: PathBuf,
        /// The database.
        #[arg(long, env = "FRETWEAR_DATABASE", default_value = DATABASE)]
        database: String,
    },
    /// Verify a backup and copy it to where a database is to be; nothing is overwritten.
    Restore {
        /// The folder of the backup.
        from: PathBuf,
        /// The database.
        #[arg(long, env = "FRETWEAR_DATABASE", default_value = DATABASE)]
        database: String,
    },
    /// Write the description of the HTTP interface (OpenAPI 3.1) to standard output.
    Openapi,
    /// Solve the specification on standard input, as a service's child process.
    #[command(hide = true)]
    SolveChild(ChildArguments),
}

/// Formats of a deck.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum DeckFormat {
    /// Abaqus and CalculiX.
    Inp,
}

#[derive(Debug, clap::Args)]
struct ServeArguments {
    /// Where to listen; a loopback address unless there is an access token.
    #[arg(long, env = "FRETWEAR_LISTEN", default_value = LISTEN)]
    listen: SocketAddr,
    #[command(flatten)]
    access: AccessOptions,
    /// The database.
    #[arg(long, env = "FRETWEAR_DATABASE", default_value = DATABASE)]
    database: String,
    /// How the log on standard error is written.
    #[arg(long, env = "FRETWEAR_LOG", value_enum, default_value = "text")]
    log: LogFormat,
    #[command(flatten)]
    work: WorkOptions,
}

/// Forms of the log.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum LogFormat {
    /// For people.
    Text,
    /// A JSON object a line.
    Json,
}

/// Codes to compare with.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum OtherCode {
    /// CalculiX.
    Ccx,
}

#[derive(Debug, clap::Args)]
struct BenchArguments {
    /// Compare what plans expect with what solves take instead, on all systems and both published scenes.
    #[arg(long)]
    predictions: bool,
    /// Compare with another code on the same work instead: a friction cycle on the same meshes.
    #[arg(long, value_enum, conflicts_with = "predictions")]
    against: Option<OtherCode>,
    /// With contact elements of these sizes, um.
    #[arg(long, value_delimiter = ',', requires = "against", default_values_t = against::ELEMENTS_UM)]
    elements_um: Vec<f64>,
    /// At these tolerances.
    #[arg(long, value_delimiter = ',', requires = "predictions", default_values_t = predictions::TOLERANCES)]
    tolerances: Vec<f64>,
}

#[derive(Debug, clap::Args)]
struct ChildArguments {
    /// Where its files go.
    folder: PathBuf,
    /// How often a checkpoint is told.
    #[arg(long)]
    checkpoint_every_ms: u64,
    /// Most memory that may be written to.
    #[arg(long)]
    memory_limit_mb: Option<u64>,
}

/// Runs the command that was asked for.
pub fn main() -> ExitCode {
    let arguments = Arguments::parse();
    match arguments.command {
        Command::Serve(serve) => {
            log("info", serve.log);
            serve::run(serve)
        }
        Command::Solve { spec, out } => {
            log("warn", LogFormat::Text);
            solve::run(&spec, out.as_deref())
        }
        Command::Plan { spec } => {
            log("warn", LogFormat::Text);
            plan::run(&spec)
        }
        Command::Study {
            spec,
            out,
            budget_s,
        } => {
            log("warn", LogFormat::Text);
            study::run(&spec, out.as_deref(), budget_s)
        }
        Command::Export {
            spec,
            format: DeckFormat::Inp,
            cycle,
        } => {
            log("warn", LogFormat::Text);
            export::run(&spec, cycle)
        }
        Command::Bench(arguments) => {
            log("warn", LogFormat::Text);
            bench::run(&arguments)
        }
        Command::Demo { exit, listen } => {
            log("warn", LogFormat::Text);
            demo::run(listen, exit)
        }
        Command::Probe { listen } => probe::run(listen),
        Command::Backup { into, database } => backup::run(&database, &into),
        Command::Restore { from, database } => backup::run_restore(&from, &database),
        Command::SolveChild(arguments) => child::run(&arguments),
        Command::Openapi => {
            terminal::say(crate::http::openapi::text().trim_end());
            ExitCode::SUCCESS
        }
    }
}

/// Logs go to standard error; `RUST_LOG` changes how much is told.
fn log(level: &str, format: LogFormat) {
    let filter = EnvFilter::try_from_default_env().unwrap_or_else(|_| EnvFilter::new(level));
    let builder = tracing_subscriber::fmt()
        .with_env_filter(filter)
        .with_ansi(std::io::stderr().is_terminal())
        .with_writer(std::io::stderr);
    match format {
        LogFormat::Text => builder.init(),
        LogFormat::Json => builder.json().init(),
    }
}

fn workers(named: Option<u16>) -> usize {
    named.map_or_else(
        || std::thread::available_parallelism().map_or(1, usize::from),
        usize::from,
    )
}

fn runtime() -> std::io::Result<tokio::runtime::Runtime> {
    tokio::runtime::Builder::new_multi_thread()
        .enable_all()
        .build()
}

#[cfg(test)]
mod tests;
