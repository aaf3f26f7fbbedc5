//! Arguments of the commands with many options.

use std::path::PathBuf;
use std::process::ExitCode;

use api::spec::{Criterion, EnumValue, Part};

use crate::cli::access::{AccessOptions, TlsOptions, token_in};
use crate::cli::listen::ListenAddress;
use crate::cli::options::{SolveOptions, WorkOptions};
use crate::cli::terminal::failed;
use crate::client::Client;
use crate::rating;

/// Default address of a service.
pub(super) const LISTEN: &str = "127.0.0.1:8080";
/// Default database.
pub(super) const DATABASE: &str = "sqlite://fretwear.db";

#[derive(Debug, clap::Args)]
pub(super) struct ServeArguments {
    /// Address to listen on; must be a loopback address unless there is an access token.
    #[arg(long, env = "FRETWEAR_LISTEN", default_value = LISTEN, value_parser = ListenAddress::resolve)]
    pub(super) listen: ListenAddress,
    #[command(flatten)]
    pub(super) access: AccessOptions,
    #[command(flatten)]
    pub(super) tls: TlsOptions,
    /// The database: sqlite://PATH, which one service serves, or postgres://USER@HOST/NAME, which several services serve. A password
    /// belongs into the variable or into ~/.pgpass, because other users of the machine see the command.
    #[arg(
        long,
        env = "FRETWEAR_DATABASE",
        default_value = DATABASE,
        hide_env_values = true
    )]
    pub(super) database: String,
    /// Where large results are with a PostgreSQL database: in the folder PATH.results, which all its services share unless they have --objects. Those of a SQLite
    /// database are beside it.
    #[arg(
        long,
        env = "FRETWEAR_FILES",
        value_name = "PATH",
        default_value = "fretwear"
    )]
    pub(super) files: PathBuf,
    /// A store of objects that results of succeeded jobs are moved to: s3://BUCKET/PREFIX, with endpoint, region and keys of the
    /// environment (AWS_ENDPOINT_URL, AWS_REGION, AWS_ACCESS_KEY_ID, ..), or file:///PATH; they stay in the database unless given.
    #[arg(long, env = "FRETWEAR_OBJECTS")]
    pub(super) objects: Option<String>,
    /// Format of the log on standard error.
    #[arg(long, env = "FRETWEAR_LOG", value_enum, default_value = "text")]
    pub(super) log: LogFormat,
    #[command(flatten)]
    pub(super) work: WorkOptions,
}

/// The service that workers work for.
#[derive(Debug, clap::Args)]
pub(super) struct EmployerOptions {
    /// Address of the service.
    #[arg(long, env = "FRETWEAR_SERVER")]
    pub(super) server: String,
    /// File with a token for workers, as `fretwear worker-token` makes one; none is needed for a service without access token.
    #[arg(long, env = "FRETWEAR_WORKER_TOKEN_FILE")]
    pub(super) token_file: Option<PathBuf>,
    /// File with the certificates of the authorities to trust (PEM), instead of those of the system.
    #[arg(long, env = "FRETWEAR_CA")]
    pub(super) ca: Option<PathBuf>,
}

#[derive(Debug, clap::Args)]
pub(super) struct WorkArguments {
    #[command(flatten)]
    pub(super) service: EmployerOptions,
    /// Folder in which a solve writes its files until they are sent; that of the system for temporary files unless given.
    #[arg(long, env = "FRETWEAR_SCRATCH")]
    pub(super) scratch: Option<PathBuf>,
    /// Format of the log on standard error.
    #[arg(long, env = "FRETWEAR_LOG", value_enum, default_value = "text")]
    pub(super) log: LogFormat,
    #[command(flatten)]
    pub(super) work: SolveOptions,
}

impl EmployerOptions {
    /// A client of the service with the token for workers.
    pub(super) fn client(&self) -> Result<Client, ExitCode> {
        let token = self.token_file.as_deref().map(token_in);
        let token = token.transpose().map_err(failed)?;
        let token = token.as_deref().map(str::trim);
        Client::new(&self.server, token, self.ca.as_deref()).map_err(failed)
    }
}

/// Formats of the log.
#[derive(Debug, Clone, Copy, PartialEq, Eq, clap::ValueEnum)]
pub(super) enum LogFormat {
    /// Text for people.
    Text,
    /// One JSON object per line.
    Json,
}

#[derive(Debug, clap::Args)]
pub(super) struct SolveArguments {
    /// The specification, JSON; `-` is standard input.
    pub(super) spec: PathBuf,
    /// Write summary, resolved specification and results as files into this folder.
    #[arg(long)]
    pub(super) out: Option<PathBuf>,
    /// Write the summary as JSON instead of tables.
    #[arg(long)]
    pub(super) json: bool,
    /// Start a solve that is expected to take more than an hour; only asked for in a terminal.
    #[arg(long)]
    pub(super) yes: bool,
}

#[derive(Debug, clap::Args)]
pub(super) struct CalibrateArguments {
    /// The specification, JSON, `-` is standard input; the ratios of its wear coefficients are kept.
    pub(super) spec: PathBuf,
    /// The rated cycles.
    #[arg(long, value_parser = clap::value_parser!(u64).range(rating::RATED_CYCLES))]
    pub(super) rated_cycles: u64,
    /// Criterion that ends the life: a kind, such as `base_metal`, or one as in `life.criteria`, such as
    /// '{"kind": "worn_depth", "mm": 0.001}'.
    #[arg(long, value_parser = criterion)]
    pub(super) criterion: Criterion,
    /// The part; either where absent.
    #[arg(long, value_parser = side)]
    pub(super) side: Option<EnumValue<Part>>,
    /// Part of the contacts that may have failed after the rated cycles, by the scatter of `life`.
    #[arg(long, default_value_t = 0.5, value_parser = part)]
    pub(super) failing: f64,
    /// Write the specification with these coefficients into this file.
    #[arg(long)]
    pub(super) out: Option<PathBuf>,
    /// Write the document as JSON instead of a table.
    #[arg(long)]
    pub(super) json: bool,
}

/// Reads a criterion, or its kind alone.
fn criterion(text: &str) -> Result<Criterion, serde_json::Error> {
    if text.trim_start().starts_with('{') {
        serde_json::from_str(text)
    } else {
        serde_json::from_value(serde_json::json!({ "kind": text }))
    }
}

fn side(text: &str) -> Result<EnumValue<Part>, serde_json::Error> {
    serde_json::from_value(text.into())
}

/// Reads a part of all contacts.
fn part(text: &str) -> Result<f64, String> {
    let part: f64 = text.parse().map_err(|_| "not a number".to_owned())?;
    if rating::FAILING.contains(&part) {
        Ok(part)
    } else {
        Err(format!(
            "outside {} to {}",
            rating::FAILING.start(),
            rating::FAILING.end()
        ))
    }
}

/// Arguments of a solving process.
#[derive(Debug, clap::Parser)]
pub(super) struct ChildArguments {
    /// Folder for its files.
    pub(super) folder: PathBuf,
    /// Interval of checkpoints.
    #[arg(long)]
    pub(super) checkpoint_every_ms: u64,
    /// Threads that the solve is to keep busy; results do not depend on it.
    #[arg(long, default_value_t = 1)]
    pub(super) threads: usize,
    /// Limit of writable memory.
    #[arg(long)]
    pub(super) memory_limit_mb: Option<u64>,
    /// Wait while the disk is full; without it, the process ends.
    #[arg(long)]
    pub(super) waits_for_disk: bool,
}
