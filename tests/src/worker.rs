//! A remote worker: `fretwear work`.

use std::path::Path;
use std::process::{Child, Command, Stdio};

use nix::sys::signal::{Signal, kill};
use nix::unistd::Pid;

use crate::Server;
use crate::program::binary;

/// A process with workers for a service, killed when it is dropped.
#[derive(Debug)]
pub struct RemoteWorker {
    child: Child,
}

impl RemoteWorker {
    /// Starts one slot for a service, with further options.
    ///
    /// # Panics
    /// If it cannot be started.
    pub fn start(folder: &Path, server: &str, options: &[&str]) -> Self {
        Self::start_by(&[], folder, server, options)
    }

    /// The same by another program, such as one that runs it in a network of its own, with arguments before those of the worker.
    ///
    /// # Panics
    /// If it cannot be started.
    pub fn start_by(by: &[&str], folder: &Path, server: &str, options: &[&str]) -> Self {
        let mut command = match by {
            [program, arguments @ ..] => {
                let mut command = Command::new(program);
                command.args(arguments).arg(binary());
                command
            }
            [] => Command::new(binary()),
        };
        let child = command
            .args(["work", "--server", server, "--slots", "1", "--scratch"])
            .arg(folder)
            .args(options)
            .env("RUST_LOG", "info")
            .stderr(Stdio::null())
            .spawn();
        Self {
            child: child.expect("the worker can be started"),
        }
    }

    /// Sends a signal to the worker alone, not to its children.
    ///
    /// # Panics
    /// If it has already ended.
    pub fn signal(&self, signal: Signal) {
        let id = i32::try_from(self.child.id()).expect("process ids are small");
        kill(Pid::from_raw(id), signal).expect("the worker is there");
    }

    /// Waits for the worker to end; returns its exit code.
    ///
    /// # Panics
    /// If it cannot be waited for.
    pub fn wait(mut self) -> Option<i32> {
        self.child.wait().expect("it can be waited for").code()
    }
}

impl Drop for RemoteWorker {
    fn drop(&mut self) {
        // The process may have ended.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}

impl Server {
    /// Starts a service that solves nothing itself.
    ///
    /// # Panics
    /// If it does not start.
    pub fn without_workers(folder: &Path, options: &[&str]) -> Self {
        Self::start_with(folder, &[&["--workers", "0"], options].concat())
    }
}
