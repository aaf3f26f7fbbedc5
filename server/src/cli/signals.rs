//! Signals that ask the process to end.

use std::io;

use tokio::signal::unix::{Signal, SignalKind, signal};

/// Signals that are waited for.
pub(super) struct Signals {
    interrupt: Signal,
    terminate: Signal,
    /// None where it is ignored, as `nohup` asks for.
    hangup: Option<Signal>,
}

/// Request of a signal.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(super) enum Asked {
    /// The end: SIGINT (Ctrl-C) or SIGTERM.
    End,
    /// SIGHUP: the terminal was closed, or configuration is to be read again.
    Hangup,
}

impl Signals {
    pub(super) fn new() -> io::Result<Self> {
        // To wait for an ignored signal would end that it is ignored.
        let hangup = !is_hangup_ignored()?;
        Ok(Self {
            interrupt: signal(SignalKind::interrupt())?,
            terminate: signal(SignalKind::terminate())?,
            hangup: hangup.then(|| signal(SignalKind::hangup())).transpose()?,
        })
    }

    pub(super) async fn next(&mut self) -> Asked {
        let hangup = async {
            match &mut self.hangup {
                Some(hangup) => hangup.recv().await,
                None => std::future::pending().await,
            }
        };
        tokio::select! {
            _ = self.interrupt.recv() => Asked::End,
            _ = self.terminate.recv() => Asked::End,
            _ = hangup => Asked::Hangup,
        }
    }
}

/// Ends at SIGINT (Ctrl-C), SIGTERM or SIGHUP. Signals are waited for from the call on, not from the first poll.
pub(super) fn until_signal() -> impl Future<Output = io::Result<()>> {
    let signals = Signals::new();
    async {
        signals?.next().await;
        Ok(())
    }
}

/// Checks whether this process was started with SIGHUP ignored.
fn is_hangup_ignored() -> io::Result<bool> {
    let status = std::fs::read_to_string("/proc/self/status")?;
    Ok(ignored(&status).is_some_and(|signals| signals & 1 != 0))
}

/// The ignored signals in the status of a process (proc(5)): SIGHUP is the lowest bit.
fn ignored(status: &str) -> Option<u64> {
    let mask = status
        .lines()
        .find_map(|line| line.strip_prefix("SigIgn:"))?;
    u64::from_str_radix(mask.trim(), 16).ok()
}

#[cfg(test)]
mod tests {
    use nix::sys::signal::{Signal, raise};

    use super::*;

    #[tokio::test]
    async fn a_signal_before_the_first_poll_is_not_lost() {
        let signal = until_signal();
        raise(Signal::SIGTERM).expect("a signal");
        signal.await.expect("no error");
    }

    #[test]
    fn the_mask_of_ignored_signals_is_read() {
        let status = "Name:\tfretwear\nSigBlk:\t0000000000000000\nSigIgn:\t0000000000001001\n";
        assert_eq!(ignored(status), Some(0x1001));
        assert_eq!(ignored("Name:\tfretwear\n"), None);
    }
}
