//! Checkpoints as bytes: what the engine offers and what the run has cost so far, in a compact form that keeps every bit.

use std::cell::Cell;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::time::{Duration, Instant};

use api::results::Cost;
use base64::Engine as _;
use base64::prelude::BASE64_STANDARD;
use serde::{Deserialize, Deserializer, Serialize, Serializer};
use solver::checkpoint::Checkpoint;

/// Raised whenever the fields of a checkpoint or the bits that follow from them change: an older one is then not gone on
/// from.
const FORMAT: u32 = 4;

/// A run between two cycles, as it is kept.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Saved {
    /// What the run has cost so far.
    pub cost: Cost,
    /// The engine's part.
    pub run: Checkpoint,
}

/// A checkpoint on its way to the supervisor.
#[derive(Debug, Clone, PartialEq, Eq, Serialize, Deserialize)]
pub struct Encoded {
    /// Its cycle.
    pub cycle: u64,
    /// A [`Saved`], encoded.
    #[serde(serialize_with = "to_base64", deserialize_with = "from_base64")]
    pub state: Vec<u8>,
}

/// Why bytes are not a checkpoint.
#[derive(Debug, Clone, PartialEq, Eq, thiserror::Error)]
pub enum Unreadable {
    /// It was written by another version.
    #[error("it has format {found}, this is format {FORMAT}")]
    Format {
        /// Its format.
        found: u32,
    },
    /// It is cut off or garbled.
    #[error("it cannot be decoded: {0}")]
    Garbled(#[from] postcard::Error),
}

impl Saved {
    /// As bytes.
    ///
    /// # Errors
    /// If there is no memory for them.
    pub fn encode(&self) -> Result<Vec<u8>, Unreadable> {
        let head = postcard::to_stdvec(&FORMAT)?;
        Ok(postcard::to_extend(self, head)?)
    }

    /// From bytes.
    ///
    /// # Errors
    /// [`Unreadable`] if they are no checkpoint of this version.
    pub fn decode(bytes: &[u8]) -> Result<Self, Unreadable> {
        let (found, rest) = postcard::take_from_bytes::<u32>(bytes)?;
        if found != FORMAT {
            return Err(Unreadable::Format { found });
        }
        Ok(postcard::from_bytes(rest)?)
    }
}

/// When a run's checkpoints are told, and whether it is asked to stop at the next one.
#[derive(Debug, Clone, Default)]
pub struct Keeping {
    every: Option<Duration>,
    stop: Arc<AtomicBool>,
    last: Cell<Option<Instant>>,
}

impl Keeping {
    /// Checkpoints are told this often; the run stops at the next one once `stop` is set.
    pub fn new(every: Duration, stop: Arc<AtomicBool>) -> Self {
        Self {
            every: Some(every),
            stop,
            last: Cell::new(Some(Instant::now())),
        }
    }

    /// Whether the run is asked to stop.
    pub(super) fn stops(&self) -> bool {
        self.stop.load(Ordering::Relaxed)
    }

    /// Whether a checkpoint is due; it counts as told then.
    pub(super) fn is_due(&self) -> bool {
        let Some(every) = self.every else {
            return false;
        };
        let due = self.stops() || self.last.get().is_none_or(|last| last.elapsed() >= every);
        if due {
            self.last.set(Some(Instant::now()));
        }
        due
    }
}

fn to_base64<S: Serializer>(bytes: &[u8], serializer: S) -> Result<S::Ok, S::Error> {
    serializer.serialize_str(&BASE64_STANDARD.encode(bytes))
}

fn from_base64<'de, D: Deserializer<'de>>(deserializer: D) -> Result<Vec<u8>, D::Error> {
    let text = String::deserialize(deserializer)?;
    BASE64_STANDARD
        .decode(text)
        .map_err(serde::de::Error::custom)
}

#[cfg(test)]
mod tests {
    use std::ops::ControlFlow;

    use solver::observer::{Event, Observer};

    use super::*;
    use crate::spec;

    #[derive(Default)]
    struct Last(Option<Checkpoint>);

    impl Observer for Last {
        fn on(&mut self, event: Event<'_>) -> ControlFlow<()> {
            if let Event::Checkpoint(checkpoint) = event {
                self.0 = Some(checkpoint.clone());
            }
            ControlFlow::Continue(())
        }
    }

    fn saved() -> Saved {
        let text = br#"{"system":{"kind":"fuzz_button"},"cycles":3,"accuracy":{"preset":"draft"}}"#;
        let resolved = spec::read(text).expect("accepted");
        let mut last = Last::default();
        solver::run::solve(&resolved.scene, &mut last).expect("solved");
        Saved {
            cost: Cost::default(),
            run: last.0.expect("a checkpoint"),
        }
    }

    #[test]
    fn a_checkpoint_is_the_same_after_writing_and_reading() {
        let saved = saved();
        let bytes = saved.encode().expect("bytes");
        let read = Saved::decode(&bytes).expect("a checkpoint");
        // Equality of texts, which tell 0 from -0.
        assert_eq!(format!("{saved:?}"), format!("{read:?}"));
        let line = Encoded {
            cycle: 2,
            state: bytes,
        };
        let text = serde_json::to_string(&line).expect("JSON");
        assert_eq!(
            serde_json::from_str::<Encoded>(&text).expect("a line"),
            line
        );
    }

    #[test]
    fn other_formats_and_cut_off_bytes_are_refused() {
        let mut bytes = saved().encode().expect("bytes");
        for length in [0, 1, 10, bytes.len() - 1] {
            assert!(
                matches!(Saved::decode(&bytes[..length]), Err(Unreadable::Garbled(_))),
                "{length}"
            );
        }
        bytes[0] += 1;
        assert_eq!(
            Saved::decode(&bytes),
            Err(Unreadable::Format { found: FORMAT + 1 })
        );
    }

    #[test]
    fn checkpoints_are_told_when_they_are_due_and_at_once_when_the_run_is_to_stop() {
        assert!(!Keeping::default().is_due());
        let stop = Arc::new(AtomicBool::new(false));
        let rarely = Keeping::new(Duration::from_hours(1), Arc::clone(&stop));
        assert!(!rarely.is_due());
        stop.store(true, Ordering::Relaxed);
        assert!(rarely.is_due() && rarely.stops());
        let always = Keeping::new(Duration::ZERO, Arc::default());
        assert!(always.is_due() && always.is_due() && !always.stops());
    }
}
