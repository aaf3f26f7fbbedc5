//! A Slurm cluster of three nodes on this machine, each a process with ports of its own, in a folder; ended when it goes out of scope.

use std::fmt::Write;
use std::net::TcpListener;
use std::path::{Path, PathBuf};
use std::process::{Child, Command, Output, Stdio};
use std::time::{Duration, Instant};

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;

/// Number of nodes.
const NODES: usize = 3;
/// Timeout of the start; no measure of speed.
const PATIENCE: Duration = Duration::from_mins(2);

/// A Slurm cluster.
#[derive(Debug)]
pub struct Slurm {
    daemons: Vec<Child>,
    configuration: PathBuf,
}

impl Slurm {
    /// Starts one in a folder. Needs the programs of Slurm and MUNGE, and to be root.
    ///
    /// # Panics
    /// If it does not start.
    pub fn start(folder: &Path) -> Self {
        let folder = folder.join("slurm");
        for part in ["state", "spool"] {
            std::fs::create_dir_all(folder.join(part)).expect("a folder");
        }
        let configuration = folder.join("slurm.conf");
        std::fs::write(&configuration, configured(&folder)).expect("written");
        let mut cluster = Self {
            daemons: Vec::new(),
            configuration,
        };
        cluster.authenticate(&folder);
        cluster.run("slurmctld", &["-D"]);
        for node in 1..=NODES {
            cluster.run("slurmd", &["-D", "-N", &format!("n{node}")]);
        }
        let start = Instant::now();
        while cluster.idle_nodes() < NODES {
            assert!(start.elapsed() < PATIENCE, "the nodes are there");
            std::thread::sleep(Duration::from_millis(50));
        }
        cluster
    }

    /// A command with the environment of this cluster.
    pub fn command(&self, program: &str) -> Command {
        let mut command = Command::new(program);
        command.env("SLURM_CONF", &self.configuration);
        command
    }

    /// Runs a program of Slurm to its end; returns the lines of its output.
    ///
    /// # Panics
    /// If it fails.
    pub fn lines(&self, program: &str, arguments: &[&str]) -> Vec<String> {
        let output = self.output(program, arguments);
        assert!(output.status.success(), "{program}: {output:?}");
        let text = String::from_utf8_lossy(&output.stdout);
        text.lines().map(str::to_owned).collect()
    }

    fn output(&self, program: &str, arguments: &[&str]) -> Output {
        let output = self.command(program).args(arguments).output();
        output.expect("the program can be run")
    }

    fn idle_nodes(&self) -> usize {
        let output = self.output("sinfo", &["-h", "-N", "-t", "idle", "-o", "%N"]);
        String::from_utf8_lossy(&output.stdout).lines().count()
    }

    fn run(&mut self, program: &str, arguments: &[&str]) {
        let mut command = self.command(program);
        command.args(arguments).arg("-f").arg(&self.configuration);
        self.spawn(command);
    }

    fn spawn(&mut self, mut command: Command) {
        let spawned = command
            .stdin(Stdio::null())
            .stdout(Stdio::null())
            .stderr(Stdio::null())
            .spawn();
        self.daemons.push(spawned.expect("a daemon can be started"));
    }

    /// Starts the daemon that the others prove to each other with who they are.
    fn authenticate(&mut self, folder: &Path) {
        let key: Vec<u8> = (0..=255).collect();
        std::fs::write(folder.join("key"), key).expect("written");
        let mut command = Command::new("munged");
        command.args(["--foreground", "--force"]);
        for (option, file) in [
            ("--key-file", "key"),
            ("--socket", "munge.socket"),
            ("--pid-file", "munged.pid"),
            ("--log-file", "munged.log"),
            ("--seed-file", "munged.seed"),
        ] {
            let path = folder.join(file);
            command.arg(format!("{option}={}", path.display()));
        }
        self.spawn(command);
        let start = Instant::now();
        while !folder.join("munge.socket").exists() {
            assert!(start.elapsed() < PATIENCE, "munged listens");
            std::thread::sleep(Duration::from_millis(20));
        }
    }
}

impl Drop for Slurm {
    fn drop(&mut self) {
        // Tasks first: their processes are not children of this one.
        let _ = self.output("scancel", &["--full", "--user", "root"]);
        let start = Instant::now();
        while !self.output("squeue", &["-h"]).stdout.is_empty() && start.elapsed() < PATIENCE {
            std::thread::sleep(Duration::from_millis(50));
        }
        for daemon in self.daemons.iter_mut().rev() {
            if let Ok(id) = i32::try_from(daemon.id()) {
                // The daemon may have ended.
                let _ = kill(Pid::from_raw(id), Signal::SIGTERM);
            }
            let _ = daemon.wait();
        }
    }
}

/// The configuration of a cluster in a folder.
fn configured(folder: &Path) -> String {
    let free: Vec<TcpListener> = (0..=NODES)
        .map(|_| TcpListener::bind("127.0.0.1:0").expect("a free port"))
        .collect();
    let port = |number: usize| free[number].local_addr().expect("an address").port();
    let host = nix::unistd::gethostname().expect("a name");
    let host = host.to_string_lossy();
    let in_folder = |name: &str| folder.join(name).display().to_string();
    let mut text = format!(
        "ClusterName=fretwear\n\
         SlurmctldHost={host}(127.0.0.1)\n\
         SlurmUser=root\n\
         AuthType=auth/munge\n\
         AuthInfo=socket={}\n\
         StateSaveLocation={}\n\
         SlurmdSpoolDir={}\n\
         SlurmctldPidFile={}\n\
         SlurmdPidFile={}\n\
         SlurmctldLogFile={}\n\
         SlurmdLogFile={}\n\
         SlurmctldPort={}\n",
        in_folder("munge.socket"),
        in_folder("state"),
        in_folder("spool/%n"),
        in_folder("slurmctld.pid"),
        in_folder("slurmd.%n.pid"),
        in_folder("slurmctld.log"),
        in_folder("slurmd.%n.log"),
        port(0),
    );
    // Accounting and control groups are off, and tasks start at once.
    text.push_str(
        "ProctrackType=proctrack/linuxproc\n\
         TaskPlugin=task/none\n\
         JobAcctGatherType=jobacct_gather/none\n\
         AccountingStorageType=accounting_storage/none\n\
         JobCompType=jobcomp/none\n\
         MpiDefault=none\n\
         ReturnToService=2\n\
         SelectType=select/cons_tres\n\
         SelectTypeParameters=CR_CPU\n\
         SchedulerType=sched/backfill\n\
         SchedulerParameters=bf_interval=2,sched_min_interval=0,batch_sched_delay=0,defer\n\
         SlurmdParameters=config_overrides\n\
         KillWait=10\n",
    );
    for node in 1..=NODES {
        let port = port(node);
        // Writing to a text cannot fail.
        let _ = writeln!(
            text,
            "NodeName=n{node} NodeHostname={host} NodeAddr=127.0.0.1 Port={port} CPUs=4 RealMemory=4000 State=UNKNOWN"
        );
    }
    text.push_str("PartitionName=main Nodes=n[1-3] Default=YES MaxTime=INFINITE State=UP\n");
    text
}
