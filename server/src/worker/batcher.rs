//! Gathers a solving process's lines into batches, and decides which of them become events.
//!
//! All rows of the wear history are stored, but an event is only made every half per cent of the work or every few
//! seconds: a stream of a long job stays a stream of hundreds of events.

use std::time::{Duration, Instant};

use api::job::Progress;
use jiff::Timestamp;
use solver::record::CycleReport;

use crate::solve::Line;
use crate::solve::checkpoint::Encoded;
use crate::store::{Batch, NewCheckpoint, NewFile};

/// Share of the work between two events.
const EVENT_SHARE: f64 = 0.005;
/// Shortest time between two events.
const EVENT_PAUSE: Duration = Duration::from_millis(100);
/// Longest time between two events while something changes.
const EVENT_WAIT: Duration = Duration::from_secs(5);
/// Rows kept back at most.
const ROW_LIMIT: usize = 1000;
/// And bytes of lines, which snapshots and checkpoints make long.
const BYTE_LIMIT: usize = 16 << 20;

/// Lines on their way to the store.
#[derive(Debug)]
pub(super) struct Batcher {
    progress: Progress,
    from_cycle: u64,
    batch: Batch,
    /// Length of the lines in it.
    bytes: usize,
    /// The same of the batch that was taken last, should it be given back.
    in_hand: usize,
    newest: Option<CycleReport>,
    started: Instant,
    last_event: Option<(Instant, f64)>,
    dirty: bool,
}

impl Batcher {
    /// For a job of so many cycles that goes on from one of them.
    pub(super) fn new(cycles: u64, from_cycle: u64) -> Self {
        Self {
            progress: Progress {
                cycle: from_cycle,
                cycles,
                fraction: fraction(from_cycle, cycles),
                updated_at: Some(Timestamp::now().to_string()),
                ..Progress::default()
            },
            from_cycle,
            batch: Batch::default(),
            bytes: 0,
            in_hand: 0,
            newest: None,
            started: Instant::now(),
            last_event: None,
            dirty: false,
        }
    }

    /// Starts again from the beginning.
    pub(super) fn begin_anew(&mut self) {
        *self = Self::new(self.progress.cycles, 0);
    }

    /// Takes a line of so many bytes that does not end the job.
    pub(super) fn take(&mut self, line: Line, bytes: usize) {
        self.dirty = true;
        self.bytes = self.bytes.saturating_add(bytes);
        self.progress.updated_at = Some(Timestamp::now().to_string());
        match line {
            Line::Phase(phase) => self.progress.phase = Some(phase),
            Line::Cycle(row) => {
                self.progress.cycle = row.cycle;
                self.progress.fraction = fraction(row.cycle, self.progress.cycles);
                self.batch.rows.push(row.clone());
                self.newest = Some(row);
            }
            Line::Snapshot(snapshot) => self.batch.snapshots.push(*snapshot),
            Line::Kept(file) => self.batch.files.push(NewFile {
                file,
                content: None,
            }),
            Line::Checkpoint(Encoded { cycle, state }) => {
                self.batch.checkpoint = Some(NewCheckpoint { cycle, state });
            }
            Line::Fields(_)
            | Line::Anew(_)
            | Line::Summary(_)
            | Line::Failed(_)
            | Line::Stopped => {}
        }
    }

    /// Whether there is something to write.
    pub(super) fn is_dirty(&self) -> bool {
        self.dirty
    }

    /// Whether so much has gathered that it should be written at once.
    pub(super) fn is_full(&self) -> bool {
        self.batch.rows.len() >= ROW_LIMIT || self.bytes >= BYTE_LIMIT
    }

    /// What has gathered; with events if they are due, or if this is the `last` batch.
    pub(super) fn batch(&mut self, last: bool) -> Batch {
        self.dirty = false;
        self.in_hand = std::mem::take(&mut self.bytes);
        self.progress.eta_s = self.eta_s();
        let mut batch = std::mem::take(&mut self.batch);
        batch.progress = self.progress.clone();
        if last || self.event_due() {
            self.last_event = Some((Instant::now(), self.progress.fraction));
            batch.events.extend(self.events());
        }
        batch
    }

    /// Takes back a batch that the store did not take, before what has gathered since.
    pub(super) fn give_back(&mut self, refused: Batch) {
        let newer = std::mem::replace(&mut self.batch, refused);
        self.batch.rows.extend(newer.rows);
        self.batch.snapshots.extend(newer.snapshots);
        self.batch.files.extend(newer.files);
        self.batch.events.extend(newer.events);
        self.batch.checkpoint = newer.checkpoint.or(self.batch.checkpoint.take());
        self.bytes = self.bytes.saturating_add(std::mem::take(&mut self.in_hand));
        self.dirty = true;
    }

    fn events(&mut self) -> Vec<(&'static str, String)> {
        // Plain numbers and texts always become JSON; were it not so, the event would be left out.
        let progress = serde_json::to_string(&self.progress)
            .ok()
            .map(|data| ("progress", data));
        let cycle = self
            .newest
            .take()
            .and_then(|row| serde_json::to_string(&row).ok())
            .map(|data| ("cycle", data));
        progress.into_iter().chain(cycle).collect()
    }

    fn event_due(&self) -> bool {
        let Some((at, fraction)) = self.last_event else {
            return true;
        };
        let waited = at.elapsed();
        waited >= EVENT_WAIT
            || (waited >= EVENT_PAUSE && self.progress.fraction >= fraction + EVENT_SHARE)
    }

    fn eta_s(&self) -> Option<f64> {
        let done = self.progress.fraction;
        let here = done - fraction(self.from_cycle, self.progress.cycles);
        (here > 0.0).then(|| self.started.elapsed().as_secs_f64() * (1.0 - done) / here)
    }
}

#[expect(clippy::cast_precision_loss, reason = "cycles stay below 1e9")]
fn fraction(cycle: u64, cycles: u64) -> f64 {
    if cycles == 0 {
        0.0
    } else {
        (cycle as f64 / cycles as f64).min(1.0)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn row(cycle: u64) -> Line {
        Line::Cycle(CycleReport {
            cycle,
            jump: 1,
            ..CycleReport::default()
        })
    }

    #[test]
    fn every_row_is_stored_but_few_become_events() {
        let mut batcher = Batcher::new(2000, 0);
        let (mut rows, mut events) = (0, 0);
        for cycle in 0..=2000 {
            batcher.take(row(cycle), 100);
            let batch = batcher.batch(false);
            rows += batch.rows.len();
            events += batch.events.len();
        }
        assert_eq!(rows, 2001);
        assert!(events < 900, "{events}");
        assert!(!batcher.is_dirty());
    }

    #[test]
    fn a_batch_that_was_refused_goes_into_the_next_one_in_order() {
        let mut batcher = Batcher::new(10, 0);
        batcher.take(row(1), 100);
        let refused = batcher.batch(false);
        assert_eq!(refused.events.len(), 2);
        batcher.take(row(2), 100);
        batcher.give_back(refused);
        assert!(batcher.is_dirty());
        let next = batcher.batch(true);
        let cycles: Vec<u64> = next.rows.iter().map(|row| row.cycle).collect();
        assert_eq!(cycles, [1, 2]);
        let names: Vec<_> = next.events.iter().map(|event| event.0).collect();
        assert_eq!(names, ["progress", "cycle", "progress", "cycle"]);
        assert!(batcher.batch(false).rows.is_empty());
    }

    #[test]
    fn the_last_batch_tells_where_it_ended() {
        let mut batcher = Batcher::new(10, 0);
        batcher.take(row(1), 100);
        batcher.batch(false);
        batcher.take(row(10), 100);
        let batch = batcher.batch(true);
        assert!((batch.progress.fraction - 1.0).abs() < 1e-15);
        assert_eq!(
            batch.events.iter().map(|event| event.0).collect::<Vec<_>>(),
            ["progress", "cycle"]
        );
    }

    #[test]
    fn the_newest_checkpoint_goes_with_the_rows_before_it() {
        let checkpoint = |cycle| {
            Line::Checkpoint(Encoded {
                cycle,
                state: Vec::new(),
            })
        };
        let mut batcher = Batcher::new(10, 3);
        assert!((batcher.batch(false).progress.fraction - 0.3).abs() < 1e-15);
        batcher.take(row(4), 100);
        batcher.take(checkpoint(4), 100);
        let refused = batcher.batch(false);
        batcher.give_back(refused);
        batcher.take(row(5), 100);
        assert_eq!(batcher.batch(false).checkpoint.map(|c| c.cycle), Some(4));
        batcher.take(checkpoint(5), 100);
        let refused = batcher.batch(false);
        batcher.take(checkpoint(6), 100);
        batcher.give_back(refused);
        assert_eq!(batcher.batch(false).checkpoint.map(|c| c.cycle), Some(6));
    }

    #[test]
    fn long_lines_fill_a_batch_before_many_rows_do() {
        let mut batcher = Batcher::new(10, 0);
        batcher.take(row(1), BYTE_LIMIT - 1);
        assert!(!batcher.is_full());
        batcher.take(row(2), 1);
        assert!(batcher.is_full());
        let refused = batcher.batch(false);
        assert!(!batcher.is_full());
        batcher.give_back(refused);
        assert!(batcher.is_full());
    }
}
