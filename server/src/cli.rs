//! The command line.

mod access;
mod arguments;
mod backup;
mod calibrate;
mod child;
mod client;
mod demo;
mod destination;
mod export;
mod figures;
mod listen;
mod log;
mod options;
mod pilot;
mod plan;
mod probe;
mod runtime;
mod serve;
mod signals;
mod solve;
mod specification;
mod study;
mod summary;
mod table;
mod terminal;
mod work;

use std::path::PathBuf;
use std::process::ExitCode;

use arguments::{
    CalibrateArguments, DATABASE, LogFormat, ServeArguments, SolveArguments, WorkArguments,
};
use clap::{CommandFactory, Parser, Subcommand};
use listen::ListenAddress;

use crate::worker::protocol::PROGRAM;

/// First line of `--help`.
const ABOUT: &str = "Wear of electrical contacts under vibration, by finite elements: on the command line and over HTTP";

#[derive(Debug, Parser)]
#[command(name = "fretwear", version = PROGRAM, about = ABOUT)]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Debug, Subcommand)]
enum Command {
    /// Solve jobs that are submitted over HTTP.
    Serve(ServeArguments),
    /// Solve jobs of a remote service.
    Work(WorkArguments),
    /// Start workers on a cluster as long as a service has work for them.
    Pilot {
        #[command(subcommand)]
        engine: pilot::Engine,
    },
    /// Solve one specification here, without a server.
    Solve(SolveArguments),
    /// Show what would be simulated and why.
    Plan {
        /// The specification, JSON; `-` is standard input.
        spec: PathBuf,
        /// Write the document as JSON instead of tables.
        #[arg(long)]
        json: bool,
    },
    /// Solve one specification at many accuracies, and show the cost and error of each.
    Study {
        /// The specification, JSON; `-` is standard input.
        spec: PathBuf,
        /// Write table, picture and figures as files into this folder.
        #[arg(long)]
        out: Option<PathBuf>,
        /// Budget of all runs together, processor seconds.
        #[arg(long, default_value_t = crate::batch::accuracy::BUDGET_S)]
        budget_s: f64,
        /// Write the study as JSON instead of a table.
        #[arg(long)]
        json: bool,
    },
    /// Find the wear coefficients that a rated number of cycles implies.
    Calibrate(CalibrateArguments),
    /// Write the model as an input deck for another code to standard output.
    Export {
        /// The specification, JSON; `-` is standard input.
        spec: PathBuf,
        /// Format: `inp` is read by Abaqus and CalculiX.
        #[arg(long, value_enum, default_value = "inp")]
        format: DeckFormat,
        /// Cycle of the worn surfaces; 0 is unworn.
        #[arg(long, default_value_t = 0)]
        cycle: u64,
    },
    /// Start a service in a new folder, solve the fuzz-button job with it and show its wear.
    Demo {
        /// Exit when the job has ended instead of continuing to serve.
        #[arg(long)]
        exit: bool,
        /// Address to listen on; port 0 is any free port.
        #[arg(long, default_value = "127.0.0.1:0", value_parser = ListenAddress::resolve)]
        listen: ListenAddress,
    },
    /// Check whether a service is ready; the exit code is 0 if it is.
    Probe {
        /// Address of the service, as it was started with; there is no default, because another service may listen there.
        #[arg(long, env = "FRETWEAR_LISTEN", value_parser = ListenAddress::resolve)]
        listen: ListenAddress,
        /// The service has a certificate: HTTPS, whatever names the certificate has.
        #[arg(long, env = "FRETWEAR_TLS_CERTIFICATE")]
        tls_certificate: Option<PathBuf>,
    },
    /// Copy a database, also while it is served, and its files into a new folder, and verify the copy.
    Backup {
        /// The folder.
        into: PathBuf,
        /// The database.
        #[arg(long, env = "FRETWEAR_DATABASE", default_value = DATABASE, hide_env_values = true)]
        database: String,
    },
    /// Read all results of a database, also while it is served, and compare their checksums.
    Verify {
        /// The database.
        #[arg(long, env = "FRETWEAR_DATABASE", default_value = DATABASE, hide_env_values = true)]
        database: String,
        /// With PostgreSQL, where large results are that are no objects: in the folder of this name with `.results` behind it.
        #[arg(long, env = "FRETWEAR_FILES", default_value = "fretwear")]
        files: PathBuf,
        /// The store of objects that results were moved to.
        #[arg(long, env = "FRETWEAR_OBJECTS")]
        objects: Option<String>,
    },
    /// Verify a backup and copy it to a database that does not exist yet.
    Restore {
        /// The folder of the backup.
        from: PathBuf,
        /// The database.
        #[arg(long, env = "FRETWEAR_DATABASE", default_value = DATABASE, hide_env_values = true)]
        database: String,
    },
    #[command(flatten)]
    Client(client::ClientCommand),
    /// Write a script for the completion of commands and options in a shell to standard output.
    Completions {
        /// The shell.
        shell: clap_complete::Shell,
    },
    /// Write the description of the HTTP interface (OpenAPI 3.1) to standard output.
    Openapi,
}

/// Formats of a deck.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
enum DeckFormat {
    /// Abaqus and CalculiX.
    Inp,
}

/// Runs the command of the arguments.
pub fn main() -> ExitCode {
    if let Err(cause) = runtime::report_large_files() {
        return terminal::failed(cause);
    }
    let ended = match child::arguments() {
        Some(arguments) => child::run(&arguments),
        None => run(Arguments::parse().command),
    };
    ended.err().unwrap_or(ExitCode::SUCCESS)
}

fn run(command: Command) -> terminal::Ended {
    let _log = match &command {
        Command::Serve(serve) => {
            log::log_panics();
            Some(log::start("info", serve.log))
        }
        Command::Work(work) => {
            log::log_panics();
            Some(log::start("info", work.log))
        }
        Command::Pilot { .. } => Some(log::start("info", LogFormat::Text)),
        Command::Probe { .. }
        | Command::Backup { .. }
        | Command::Verify { .. }
        | Command::Restore { .. }
        | Command::Openapi => None,
        _ => Some(log::start("warn", LogFormat::Text)),
    };
    match command {
        Command::Serve(serve) => serve::run(serve),
        Command::Work(work) => work::run(&work),
        Command::Pilot { engine } => pilot::run(&engine),
        Command::Solve(arguments) => solve::run(&arguments),
        Command::Plan { spec, json } => plan::run(&spec, json),
        Command::Study {
            spec,
            out,
            budget_s,
            json,
        } => study::run(&spec, out.as_deref(), budget_s, json),
        Command::Calibrate(arguments) => calibrate::run(&arguments),
        Command::Export {
            spec,
            format: DeckFormat::Inp,
            cycle,
        } => export::run(&spec, cycle),
        Command::Demo { exit, listen } => demo::run(listen.address, exit),
        Command::Probe {
            listen,
            tls_certificate,
        } => probe::run(listen.address, tls_certificate.is_some()),
        Command::Backup { into, database } => backup::run(&database, &into),
        Command::Verify {
            database,
            files,
            objects,
        } => backup::run_verify(&database, &files, objects.as_deref()),
        Command::Restore { from, database } => backup::run_restore(&from, &database),
        Command::Client(command) => client::run(command),
        Command::Completions { shell } => completions(shell),
        Command::Openapi => terminal::write_out(crate::http::openapi::text().trim_end()),
    }
}

fn completions(shell: clap_complete::Shell) -> terminal::Ended {
    let mut script = Vec::new();
    clap_complete::generate(shell, &mut Arguments::command(), "fretwear", &mut script);
    terminal::write_out(String::from_utf8_lossy(&script).trim_end())
}

#[cfg(test)]
mod tests;
