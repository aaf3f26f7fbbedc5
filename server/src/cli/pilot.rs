//! `fretwear pilot slurm`: workers on a cluster as long as there is work for them.

use std::collections::HashSet;
use std::path::{Path, PathBuf};
use std::process::ExitCode;
use std::time::{Duration, Instant};

use api::service::Demand;
use clap::{Args, Subcommand};

use crate::cli::arguments::EmployerOptions;
use crate::cli::runtime::block_on;
use crate::cli::signals::until_signal;
use crate::cli::terminal::{Ended, failed, write_out};
use crate::client::Client;
use crate::placement::slurm::{SlurmError, SlurmWorkers, Tasks};
use crate::placement::submissions::Submissions;
use crate::placement::{Backoff, Fleet};

/// Default memory of a worker for each of its slots, MB. Arbitrary: solves need 20 to 350 MB by their plans.
const SLOT_MEMORY_MB: u64 = 2_000;
/// Time for last checkpoints, s: within the 30 s that Slurm waits by default (`KillWait`) before it kills a cancelled task.
const GRACE_S: u64 = 20;

/// Engines that start workers.
#[derive(Debug, Subcommand)]
pub(super) enum Engine {
    /// Keep job arrays of `fretwear work --until-idle` submitted to Slurm; the service and all files must be reachable from its nodes.
    Slurm(SlurmArguments),
}

#[derive(Debug, Args)]
pub(super) struct SlurmArguments {
    #[command(flatten)]
    service: EmployerOptions,
    /// Most workers that wait and run at a time.
    #[arg(long, env = "FRETWEAR_MOST", default_value_t = 50, value_parser = clap::value_parser!(u64).range(1..=100_000))]
    most: u64,
    /// Jobs that each worker solves at once, and its processors.
    #[arg(long, env = "FRETWEAR_SLOTS", default_value_t = 1, value_parser = clap::value_parser!(u64).range(1..=256))]
    slots: u64,
    /// Memory of each worker, four fifths of it for the estimated memory of its solves; 2000 for each slot unless given.
    #[arg(long, env = "FRETWEAR_MEMORY_MB", value_parser = clap::value_parser!(u64).range(100..))]
    memory_mb: Option<u64>,
    /// Time limit of each worker, minutes; its jobs continue from their checkpoints in another one.
    #[arg(long, env = "FRETWEAR_MINUTES", default_value_t = 240, value_parser = clap::value_parser!(u64).range(5..))]
    minutes: u64,
    /// Folder for the logs of the workers; they write none unless given.
    #[arg(long, env = "FRETWEAR_LOGS")]
    logs: Option<PathBuf>,
    /// Name of the jobs, by which they are found in the queue of Slurm.
    #[arg(long, env = "FRETWEAR_JOB_NAME", default_value = "fretwear", value_parser = job_name)]
    job_name: String,
    /// A further option of `sbatch`, such as --partition=long; may be repeated.
    #[arg(long = "sbatch", value_name = "OPTION", allow_hyphen_values = true)]
    sbatch: Vec<String>,
    /// Interval between two looks at the demand, s.
    #[arg(long, env = "FRETWEAR_EVERY_S", default_value_t = 15, value_parser = clap::value_parser!(u64).range(1..))]
    every_s: u64,
    /// End when no job waits or runs at the service.
    #[arg(long, env = "FRETWEAR_UNTIL_IDLE")]
    until_idle: bool,
    /// Write the script that would be submitted to standard output, and end.
    #[arg(long)]
    print: bool,
}

pub(super) fn run(engine: &Engine) -> Ended {
    let Engine::Slurm(arguments) = engine;
    let workers = arguments.workers()?;
    if arguments.print {
        return write_out(workers.script().trim_end());
    }
    let client = arguments.service.client()?;
    block_on(async {
        tokio::select! {
            ended = pilot(arguments, &client, &workers) => ended,
            // Workers that were submitted end by themselves when there is nothing to do.
            signal = until_signal() => signal.map_err(failed),
        }
    })?
}

/// Submits workers as long as there is work for more than there are.
async fn pilot(arguments: &SlurmArguments, client: &Client, workers: &SlurmWorkers) -> Ended {
    let fleet = Fleet {
        most: arguments.most,
        slots: arguments.slots,
    };
    let every = Duration::from_secs(arguments.every_s);
    let mut starts = Starts {
        backoff: Backoff::new(every),
        failed: HashSet::new(),
        submissions: Submissions::default(),
    };
    loop {
        match client.demand().await {
            Ok(demand) if arguments.until_idle && demand.queued + demand.running == 0 => {
                return Ok(());
            }
            Ok(demand) => {
                if let Err(error) = starts.place(fleet, workers, &demand).await {
                    let unlisted = starts.submissions.unlisted();
                    tracing::warn!(%error, unlisted, "no workers were submitted, or it is not known whether they were");
                }
            }
            Err(error) if error.is_rejected() => return Err(failed(error)),
            Err(error) => tracing::warn!(%error, "request for the demand failed"),
        }
        tokio::time::sleep(every).await;
    }
}

/// Starts of workers.
struct Starts {
    backoff: Backoff,
    /// Tasks that had failed at the last look.
    failed: HashSet<String>,
    submissions: Submissions,
}

impl Starts {
    /// Submits workers if fewer are there than a demand is enough for.
    async fn place(
        &mut self,
        fleet: Fleet,
        workers: &SlurmWorkers,
        demand: &Demand,
    ) -> Result<(), SlurmError> {
        let Tasks {
            present,
            failed,
            submissions,
        } = workers.tasks().await?;
        self.submissions.listed(&submissions, Instant::now());
        let unlisted = self.submissions.unlisted();
        let others = failed.difference(&self.failed).count();
        self.failed = failed;
        let before = self.backoff.fruitless();
        let wait = self
            .backoff
            .observe(u64::try_from(others).unwrap_or(u64::MAX));
        if self.backoff.fruitless() > before {
            tracing::warn!(
                tasks = others,
                again_in_s = wait.as_secs(),
                "workers have failed; their logs (--logs) say why"
            );
        }
        let missing = fleet.wanted(demand).saturating_sub(present + unlisted);
        if missing == 0 || !wait.is_zero() {
            return Ok(());
        }
        self.backoff.started(missing);
        workers.submit(missing, &mut self.submissions).await?;
        tracing::info!(
            submitted = missing,
            present,
            unlisted,
            queued = demand.queued,
            running = demand.running,
            "workers submitted"
        );
        Ok(())
    }
}

/// A name that needs no quotes in a script.
fn job_name(text: &str) -> Result<String, String> {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_.".contains(c);
    if text.is_empty() || !text.chars().all(is_plain) {
        return Err("a name has letters, digits, `-`, `_` and `.`".to_owned());
    }
    Ok(text.to_owned())
}

impl SlurmArguments {
    /// The workers that are submitted; they start in another folder.
    fn workers(&self) -> Result<SlurmWorkers, ExitCode> {
        let absolute = |path: &Path| std::path::absolute(path).map_err(failed);
        let program = std::env::current_exe().map_err(failed)?;
        let mut command = vec![program.display().to_string()];
        let mut add = |words: &[&str]| command.extend(words.iter().map(|word| (*word).to_owned()));
        let EmployerOptions {
            server,
            token_file,
            ca,
        } = &self.service;
        add(&["work", "--server", server]);
        for (option, path) in [("--token-file", token_file), ("--ca", ca)] {
            if let Some(path) = path {
                add(&[option, &absolute(path)?.display().to_string()]);
            }
        }
        add(&["--slots", &self.slots.to_string()]);
        let memory_mb = self.memory_mb.unwrap_or(SLOT_MEMORY_MB * self.slots);
        add(&["--memory-mb", &(memory_mb / 5 * 4).to_string()]);
        add(&["--grace-s", &GRACE_S.to_string(), "--until-idle"]);
        Ok(SlurmWorkers {
            name: self.job_name.clone(),
            command,
            processors: self.slots,
            memory_mb,
            minutes: self.minutes,
            logs: self.logs.as_deref().map(absolute).transpose()?,
            options: self.sbatch.clone(),
        })
    }
}
