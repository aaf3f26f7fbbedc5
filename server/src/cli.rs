//! The command line.

mod child;
mod demo;
mod export;
mod plan;
mod serve;
mod solve;
mod table;
mod terminal;

use std::io::IsTerminal;
use std::net::SocketAddr;
use std::path::PathBuf;
use std::process::ExitCode;

use clap::{Parser, Subcommand};
use tracing_subscriber::EnvFilter;

/// Exit code of a refused specification.
const REFUSED: u8 = 2;

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
    /// Start a service in a fresh folder, run the fuzz-button study through it and show its wear.
    Demo {
        /// End when the study has ended instead of serving on.
        #[arg(long)]
        exit: bool,
        /// Where to listen; a free port unless one is named.
        #[arg(long, default_value = "127.0.0.1:0")]
        listen: SocketAddr,
    },
    /// Solve the specification on standard input, as a service's child process.
    #[command(hide = true)]
    SolveChild {
        /// Where its files go.
        folder: PathBuf,
    },
}

/// Formats of a deck.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum DeckFormat {
    /// Abaqus and CalculiX.
    Inp,
}

#[derive(Debug, clap::Args)]
struct ServeArguments {
    /// Where to listen; a loopback address.
    #[arg(long, env = "FRETWEAR_LISTEN", default_value = "127.0.0.1:8080")]
    listen: SocketAddr,
    /// The database.
    #[arg(
        long,
        env = "FRETWEAR_DATABASE",
        default_value = "sqlite://fretwear.db"
    )]
    database: String,
    /// Jobs solved at once; one a processor unless named.
    #[arg(long, env = "FRETWEAR_WORKERS", value_parser = clap::value_parser!(u16).range(1..=256))]
    workers: Option<u16>,
}

/// Runs the command that was asked for.
pub fn main() -> ExitCode {
    let arguments = Arguments::parse();
    match arguments.command {
        Command::Serve(serve) => {
            log("info");
            serve::run(serve.listen, serve.database, workers(serve.workers))
        }
        Command::Solve { spec, out } => {
            log("warn");
            solve::run(&spec, out.as_deref())
        }
        Command::Plan { spec } => {
            log("warn");
            plan::run(&spec)
        }
        Command::Export {
            spec,
            format: DeckFormat::Inp,
            cycle,
        } => {
            log("warn");
            export::run(&spec, cycle)
        }
        Command::Demo { exit, listen } => {
            log("warn");
            demo::run(listen, exit)
        }
        Command::SolveChild { folder } => child::run(&folder),
    }
}

/// Logs go to standard error; `RUST_LOG` changes how much is told.
fn log(level: &str) {
    let filter = EnvFilter::try_from_default_env().unwrap_or_else(|_| EnvFilter::new(level));
    tracing_subscriber::fmt()
        .with_env_filter(filter)
        .with_ansi(std::io::stderr().is_terminal())
        .with_writer(std::io::stderr)
        .init();
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
