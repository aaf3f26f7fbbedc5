//! Slurm: workers as tasks of job arrays.
//!
//! The workers that are submitted or run are read from Slurm's queue by the name of the jobs. Only submissions that are not listed there yet are
//! remembered; tasks name theirs by a comment.

use std::collections::HashSet;
use std::path::PathBuf;
use std::process::{Output, Stdio};
use std::time::{Duration, Instant};

use tokio::io::AsyncWriteExt;
use tokio::process::Command;
use tokio::time::timeout;

use crate::placement::submissions::Submissions;

/// Time between SIGTERM and the end of a worker at its time limit: its solves write a last checkpoint.
const WARNING: Duration = Duration::from_mins(1);
/// Most tasks of a job array: Slurm's own default (`MaxArraySize` of 1001, which is beyond the largest number).
const LONGEST_ARRAY: u64 = 1_000;
/// Longest time that Slurm may take to answer: its programs wait for a controller that is away.
const LONGEST_ANSWER: Duration = Duration::from_mins(1);
/// States of tasks that count as workers, and of those that have failed; Slurm lists ended ones for some minutes.
const PRESENT: [&str; 5] = [
    "PENDING",
    "CONFIGURING",
    "RUNNING",
    "SUSPENDED",
    "COMPLETING",
];
const FAILED: [&str; 4] = ["FAILED", "BOOT_FAIL", "NODE_FAIL", "OUT_OF_MEMORY"];

/// Why Slurm did not do what was asked.
#[derive(Debug, thiserror::Error)]
pub enum SlurmError {
    /// A program of it cannot be run.
    #[error("cannot run {program}: {cause}")]
    Run {
        /// The program.
        program: &'static str,
        /// The system's error.
        cause: std::io::Error,
    },
    /// A program of it has failed.
    #[error("{program} failed: {said}")]
    Failed {
        /// The program.
        program: &'static str,
        /// Standard error.
        said: String,
    },
    /// A program of it does not answer.
    #[error("{program} has not answered for {} s", LONGEST_ANSWER.as_secs())]
    Silent {
        /// The program.
        program: &'static str,
    },
}

/// Workers as Slurm is to run them.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct SlurmWorkers {
    /// Name of the jobs.
    pub name: String,
    /// Program and arguments.
    pub command: Vec<String>,
    /// Processors of each.
    pub processors: u64,
    /// Memory of each, MB.
    pub memory_mb: u64,
    /// Time limit of each, minutes.
    pub minutes: u64,
    /// Folder of their logs; none are written where absent.
    pub logs: Option<PathBuf>,
    /// Further options of `sbatch`.
    pub options: Vec<String>,
}

/// Tasks that Slurm lists.
#[derive(Debug, Default, PartialEq, Eq)]
pub struct Tasks {
    /// Number of those that wait or run.
    pub present: u64,
    /// Ids of those that have failed within some minutes.
    pub failed: HashSet<String>,
    /// Keys of the submissions of all of them, also of those that have ended within some minutes.
    pub submissions: HashSet<String>,
}

impl Tasks {
    /// Of lines with state, id and comment.
    fn of(listed: &str) -> Self {
        let mut tasks = Self::default();
        for line in listed.lines() {
            let mut words = line.split_whitespace();
            let (Some(state), Some(id)) = (words.next(), words.next()) else {
                continue;
            };
            if FAILED.contains(&state) {
                tasks.failed.insert(id.to_owned());
            } else if PRESENT.contains(&state) {
                tasks.present += 1;
            }
            tasks.submissions.extend(words.next().map(str::to_owned));
        }
        tasks
    }
}

impl SlurmWorkers {
    /// The script of a task. It becomes the worker itself, which so gets the signals.
    pub fn script(&self) -> String {
        let log = match &self.logs {
            Some(folder) => {
                // Slurm replaces what follows a per cent sign.
                let folder = folder.display().to_string().replace('%', "%%");
                format!("\"{folder}/%x-%A_%a.log\"")
            }
            None => "/dev/null".to_owned(),
        };
        let mut options = vec![
            format!("--job-name={}", self.name),
            "--ntasks=1".to_owned(),
            format!("--cpus-per-task={}", self.processors),
            format!("--time={}", self.minutes),
            format!("--signal=B:TERM@{}", WARNING.as_secs()),
            // Jobs of a worker that ends return to the service, which gives them to others.
            "--no-requeue".to_owned(),
            format!("--output={log}"),
            format!("--mem={}M", self.memory_mb),
        ];
        options.extend(self.options.iter().cloned());
        let options = options.iter().map(|option| format!("#SBATCH {option}\n"));
        let command: Vec<String> = self.command.iter().map(|word| quoted(word)).collect();
        format!(
            "#!/bin/sh\n{}exec {}\n",
            options.collect::<String>(),
            command.join(" ")
        )
    }

    /// The workers that Slurm lists.
    ///
    /// # Errors
    /// [`SlurmError`].
    pub async fn tasks(&self) -> Result<Tasks, SlurmError> {
        let mut command = Command::new("squeue");
        command.args(["--me", "--noheader", "--array", "--format=%T %i %k"]);
        command.args(["--name", &self.name, "--states=all"]);
        let output = finished("squeue", command, "").await?;
        Ok(Tasks::of(&String::from_utf8_lossy(&output.stdout)))
    }

    /// Submits so many workers as job arrays, each of which is noted.
    ///
    /// # Errors
    /// [`SlurmError`]; some may have been submitted, which is noted, too.
    pub async fn submit(
        &self,
        mut workers: u64,
        submissions: &mut Submissions,
    ) -> Result<(), SlurmError> {
        while workers > 0 {
            let tasks = workers.min(LONGEST_ARRAY);
            let key = submissions.begin(tasks, Instant::now());
            let mut command = Command::new("sbatch");
            command.args(["--parsable", &format!("--array=1-{tasks}")]);
            command.arg(format!("--comment={key}"));
            let submitted = finished("sbatch", command, &self.script()).await;
            if let Err(SlurmError::Run { .. }) = submitted {
                submissions.not_sent(&key);
            }
            submitted?;
            workers -= tasks;
        }
        Ok(())
    }
}

/// Runs a program to its end. One that does not answer, or for which nobody waits any more, is killed.
async fn finished(
    program: &'static str,
    mut command: Command,
    input: &str,
) -> Result<Output, SlurmError> {
    let run = |cause| SlurmError::Run { program, cause };
    let spawned = command
        .stdin(Stdio::piped())
        .stdout(Stdio::piped())
        .stderr(Stdio::piped())
        .kill_on_drop(true)
        .spawn();
    let mut child = spawned.map_err(run)?;
    let answer = async {
        if let Some(mut stdin) = child.stdin.take() {
            // A program that has ended without reading says why.
            let _ = stdin.write_all(input.as_bytes()).await;
        }
        child.wait_with_output().await
    };
    let answered = timeout(LONGEST_ANSWER, answer).await;
    let output = answered
        .map_err(|_| SlurmError::Silent { program })?
        .map_err(run)?;
    if output.status.success() {
        return Ok(output);
    }
    let said = String::from_utf8_lossy(&output.stderr).trim().to_owned();
    Err(SlurmError::Failed { program, said })
}

/// A word as a shell reads it.
fn quoted(word: &str) -> String {
    let is_plain = |c: char| c.is_ascii_alphanumeric() || "-_./:=,@%+".contains(c);
    if !word.is_empty() && word.chars().all(is_plain) {
        return word.to_owned();
    }
    format!("'{}'", word.replace('\'', r"'\''"))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn failed_and_ended_tasks_are_no_workers() {
        let listed = "RUNNING 7_1 a\nPENDING 7_2 a\nFAILED 7_3 a\nNODE_FAIL 8 b\nCOMPLETING 9_1 c\n\
            CANCELLED 10_1 d\nCOMPLETED 11 \n";
        let tasks = Tasks {
            present: 3,
            failed: ["7_3", "8"].map(str::to_owned).into(),
            submissions: ["a", "b", "c", "d"].map(str::to_owned).into(),
        };
        assert_eq!(Tasks::of(listed), tasks);
        assert_eq!(Tasks::of(""), Tasks::default());
    }

    #[test]
    fn the_script_becomes_the_worker() {
        let command = [
            "/opt/fret wear/fretwear",
            "work",
            "--server",
            "https://a:1",
            "it's",
        ];
        let workers = SlurmWorkers {
            name: "fretwear".to_owned(),
            command: command.map(str::to_owned).to_vec(),
            processors: 16,
            memory_mb: 32_000,
            minutes: 240,
            logs: Some(PathBuf::from("/scratch/100% logs")),
            options: vec!["--partition=long".to_owned()],
        };
        let expected = "#!/bin/sh\n\
            #SBATCH --job-name=fretwear\n\
            #SBATCH --ntasks=1\n\
            #SBATCH --cpus-per-task=16\n\
            #SBATCH --time=240\n\
            #SBATCH --signal=B:TERM@60\n\
            #SBATCH --no-requeue\n\
            #SBATCH --output=\"/scratch/100%% logs/%x-%A_%a.log\"\n\
            #SBATCH --mem=32000M\n\
            #SBATCH --partition=long\n\
            exec '/opt/fret wear/fretwear' work --server https://a:1 'it'\\''s'\n";
        assert_eq!(workers.script(), expected);
    }
}
