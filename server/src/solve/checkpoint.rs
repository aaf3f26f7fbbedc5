//! Checkpoints as bytes: the engine's state and the cost of the run so far, in a compact form that preserves every bit.

use std::cell::Cell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use api::results::Cost;
use serde::{Deserialize, Serialize};

/// Format number, raised whenever the fields of a checkpoint or the results computed from them change: runs do not
/// resume from an older format.
const FORMAT: u32 = 33;

/// The state of a run between two cycles.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Checkpoint {
    /// Cost of the run so far.
    pub cost: Cost,
    /// State of the engine.
    pub run: solver::checkpoint::Checkpoint,
}

/// An encoded checkpoint.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct EncodedCheckpoint {
    /// Cycle of the checkpoint.
    pub cycle: u64,
    /// A [`Checkpoint`], encoded.
    #[serde(with = "crate::json_bytes")]
    pub state: Vec<u8>,
}

/// Why bytes cannot be decoded as a checkpoint.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum CheckpointError {
    /// The checkpoint was written by another version of the program.
    #[error("it has format {found}, this is format {FORMAT}")]
    Format {
        /// Format number.
        found: u32,
    },
    /// The checkpoint is truncated or damaged.
    #[error("it cannot be decoded: {0}")]
    Damaged(#[from] postcard::Error),
}

impl Checkpoint {
    /// Encodes the checkpoint.
    ///
    /// # Errors
    /// [`CheckpointError`] if there is not enough memory.
    pub fn encode(&self) -> Result<Vec<u8>, CheckpointError> {
        let head = postcard::to_stdvec(&FORMAT)?;
        Ok(postcard::to_extend(self, head)?)
    }

    /// Decodes a checkpoint.
    ///
    /// # Errors
    /// [`CheckpointError`] if they are not a checkpoint of this version.
    pub fn decode(bytes: &[u8]) -> Result<Self, CheckpointError> {
        let (found, rest) = postcard::take_from_bytes::<u32>(bytes)?;
        if found != FORMAT {
            return Err(CheckpointError::Format { found });
        }
        Ok(postcard::from_bytes(rest)?)
    }
}

/// When a run emits checkpoints, and whether it stops at the next one.
#[derive(Debug, Clone, Default)]
pub struct CheckpointPolicy {
    /// Time between two checkpoints, and the time of the last one; none are emitted without it.
    interval: Option<(Duration, Cell<Instant>)>,
    stop: Arc<AtomicBool>,
}

impl CheckpointPolicy {
    /// A policy with this time between two checkpoints; the run stops at the next one once `stop` is set.
    pub fn new(interval: Duration, stop: Arc<AtomicBool>) -> Self {
        Self {
            interval: Some((interval, Cell::new(Instant::now()))),
            stop,
        }
    }

    /// Returns `true` if the run is asked to stop.
    pub(super) fn is_stopped(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// Returns `true` if a checkpoint is due; if so, the next interval starts.
    pub(super) fn is_due(&self) -> bool {
        let Some((interval, last)) = &self.interval else {
            return false;
        };
        let due = self.is_stopped() || last.get().elapsed() >= *interval;
        if due {
            last.set(Instant::now());
        }
        due
    }
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use solver::observer::{Event, Observer};

    use super::*;
    use crate::spec;

    #[derive(Default)]
    struct Last(Option<solver::checkpoint::Checkpoint>);

    impl Observer for Last {
        fn on(&mut self, event: Event<'_>) -> ControlFlow<()> {
            if let Event::Checkpoint(checkpoint) = event {
                self.0 = Some(checkpoint.checkpoint());
            }
            ControlFlow::Continue(())
        }
    }

    const SECTION: &str =
        r#"{"system":{"kind":"fuzz_button"},"cycles":3,"accuracy":{"preset":"draft"}}"#;
    const POINT: &str = r#"{"system":{"kind":"sd_card"},"model":{"dimension":"point"},"cycles":3}"#;

    fn checkpoint(text: &str) -> Checkpoint {
        let text = text.as_bytes();
        let resolved = spec::read(text).expect("accepted");
        let mut last = Last::default();
        solver::run::solve(&resolved.scene, &mut last).expect("solved");
        Checkpoint {
            cost: Cost::default(),
            run: last.0.expect("a checkpoint"),
        }
    }

    #[test]
    fn a_checkpoint_is_the_same_after_writing_and_reading() {
        let bytes = checkpoint(SECTION).encode().expect("bytes");
        for text in [SECTION, POINT] {
            let checkpoint = checkpoint(text);
            let read = Checkpoint::decode(&checkpoint.encode().expect("bytes"));
            let again = read.and_then(|read| read.encode());
            assert_eq!(again, checkpoint.encode(), "{text}");
        }
        let line = EncodedCheckpoint {
            cycle: 2,
            state: bytes,
        };
        let text = serde_json::to_string(&line).expect("JSON");
        assert_eq!(
            serde_json::from_str::<EncodedCheckpoint>(&text).expect("a line"),
            line
        );
    }

    #[test]
    fn other_formats_and_truncated_bytes_are_refused() {
        let mut bytes = checkpoint(SECTION).encode().expect("bytes");
        for length in [0, 1, 10, bytes.len() - 1] {
            assert!(
                matches!(
                    Checkpoint::decode(&bytes[..length]),
                    Err(CheckpointError::Damaged(_))
                ),
                "{length}"
            );
        }
        bytes[0] += 1;
        assert_eq!(
            Checkpoint::decode(&bytes),
            Err(CheckpointError::Format { found: FORMAT + 1 })
        );
    }

    #[test]
    fn checkpoints_are_due_after_the_interval_and_at_once_when_the_run_is_stopped() {
        assert!(!CheckpointPolicy::default().is_due());
        let stop = Arc::new(AtomicBool::new(false));
        let rarely = CheckpointPolicy::new(Duration::from_hours(1), Arc::clone(&stop));
        assert!(!rarely.is_due());
        stop.store(true, Ordering::Relaxed);
        assert!(rarely.is_due() && rarely.is_stopped());
        let always = CheckpointPolicy::new(Duration::ZERO, Arc::default());
        assert!(always.is_due() && always.is_due() && !always.is_stopped());
    }
}
