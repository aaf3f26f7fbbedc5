//! Collects the lines of a solving process into updates, and decides which of them become events.
//!
//! All rows of the wear history are stored, but an event is only made every half per cent of the cycles or every few
//! seconds, so that the stream of a long job has some hundred events.

use std::time::{Duration, Instant};

use api::job::{Phase, Progress, Stage};
use jiff::Timestamp;
use solver::record::CycleReport;

use crate::estimate::foreseen::Foreseen;
use crate::number::real;
use crate::solve::ChildMessage;
use crate::store::{EventName, JobUpdate, NewContent, NewFile};
use crate::worker::computed::Computed;
use crate::worker::remaining::RemainingTime;

/// Smallest fraction of the cycles between two events.
const EVENT_FRACTION: f64 = 0.005;
/// Shortest time between two events.
const EVENT_PAUSE: Duration = Duration::from_millis(100);
/// Longest time between two events while something changes.
const EVENT_WAIT: Duration = Duration::from_secs(5);
/// Largest number of rows in an update.
const ROW_LIMIT: usize = 1000;
/// Largest length of the lines in an update, bytes; snapshots and checkpoints are long.
const BYTE_LIMIT: usize = 16 << 20;

/// Lines that are not stored yet.
#[derive(Debug)]
pub(super) struct UpdateBuffer {
    progress: Progress,
    update: JobUpdate,
    /// Everything since cycle 0; `None` where it is not, or too long.
    computed: Option<Computed>,
    /// Length of the lines in `update`.
    bytes: usize,
    /// Number of the update that was taken last.
    number: i64,
    /// The update that could not be recorded, or perhaps was and its answer was lost: it is repeated as it is.
    unrecorded: Option<JobUpdate>,
    /// Length of the lines in the update that was taken last.
    taken_bytes: usize,
    newest: Option<CycleReport>,
    started: Instant,
    remaining: RemainingTime,
    last_event: Option<(Instant, f64)>,
    /// True if the last event was in the phase of the companions, which has no cycles and so no progress.
    in_companions: bool,
}

impl UpdateBuffer {
    /// A buffer for a job with this number of cycles that starts after `from_cycle`, of which this is foreseen.
    pub(super) fn new(cycles: u64, from_cycle: u64, foreseen: Foreseen) -> Self {
        Self::with(cycles, from_cycle, RemainingTime::new(foreseen, from_cycle))
    }

    fn with(cycles: u64, from_cycle: u64, remaining: RemainingTime) -> Self {
        Self {
            progress: Progress {
                cycle: from_cycle,
                cycles,
                fraction: fraction(from_cycle, cycles),
                updated_at: Some(Timestamp::now().to_string()),
                ..Progress::default()
            },
            update: JobUpdate::default(),
            computed: (from_cycle == 0).then(Computed::default),
            bytes: 0,
            number: 0,
            unrecorded: None,
            taken_bytes: 0,
            newest: None,
            started: Instant::now(),
            remaining,
            last_event: None,
            in_companions: false,
        }
    }

    /// Discards everything, also what could not be recorded; the run starts at cycle 0, for this reason. Returns the number of this write.
    pub(super) fn restart(&mut self, reason: String) -> i64 {
        let number = self.next_number();
        let mut remaining = std::mem::take(&mut self.remaining);
        remaining.again(self.elapsed_s());
        *self = Self {
            number,
            started: self.started,
            ..Self::with(self.progress.cycles, 0, remaining)
        };
        self.progress.reason = Some(reason);
        number
    }

    /// Returns the number of the next write.
    pub(super) fn next_number(&mut self) -> i64 {
        self.number += 1;
        self.number
    }

    /// Adds a line that is not the last one.
    pub(super) fn push(&mut self, line: ChildMessage, bytes: usize) {
        self.bytes = self.bytes.saturating_add(bytes);
        self.progress.updated_at = Some(Timestamp::now().to_string());
        match line {
            ChildMessage::Phase(phase) => {
                if phase == Phase::Companions {
                    self.remaining.companions(self.elapsed_s());
                }
                self.progress.phase = Some(phase);
                self.progress.stage = Some(stage(self.progress.stage, phase));
            }
            ChildMessage::Refined(errors) => {
                self.progress.stage = Some(Stage::Refined);
                self.progress.reason = Some(errors);
            }
            ChildMessage::Cycle(row) => {
                self.remaining.computed(row.cycle, self.elapsed_s());
                self.progress.cycle = row.cycle;
                self.progress.fraction = fraction(row.cycle, self.progress.cycles);
                let computed = self.computed.take();
                self.computed = computed.and_then(|computed| computed.with_row(&row, bytes));
                self.update.rows.push((*row).clone());
                self.newest = Some(*row);
            }
            ChildMessage::Snapshot(snapshot) => {
                let computed = self.computed.take();
                self.computed = computed.and_then(|held| held.with_snapshot(&snapshot, bytes));
                self.update.snapshots.push(*snapshot);
            }
            ChildMessage::File(file) => self.update.files.push(NewFile {
                file,
                content: NewContent::Folder,
            }),
            ChildMessage::Checkpoint(checkpoint) => self.update.checkpoint = Some(checkpoint),
            ChildMessage::Ready
            | ChildMessage::Fields(_)
            | ChildMessage::Restarted(_)
            | ChildMessage::Summary(_)
            | ChildMessage::Failed(_)
            | ChildMessage::Stopped => {}
        }
    }

    /// Returns `true` if there is something to write.
    pub(super) fn is_dirty(&self) -> bool {
        self.bytes > 0 || self.unrecorded.is_some()
    }

    /// Returns `true` if a limit is reached, so that the update should be written at once.
    pub(super) fn is_full(&self) -> bool {
        let bytes = match self.unrecorded {
            Some(_) => self.bytes.saturating_add(self.taken_bytes),
            None => self.bytes,
        };
        self.update.rows.len() >= ROW_LIMIT || bytes >= BYTE_LIMIT
    }

    /// Takes the next update: the one that was not recorded, or else the present one, with events if they are due.
    pub(super) fn take(&mut self) -> JobUpdate {
        match self.unrecorded.take() {
            Some(update) => update,
            None => self.take_present(false),
        }
    }

    /// Takes everything that was computed since cycle 0; `None` if the store knows more.
    pub(super) fn take_computed(&mut self) -> Option<Computed> {
        self.computed.take()
    }

    /// Takes everything for the end of the attempt, with events.
    pub(super) fn take_all(&mut self) -> Vec<JobUpdate> {
        let mut updates = Vec::from_iter(self.unrecorded.take());
        updates.push(self.take_present(true));
        updates
    }

    fn take_present(&mut self, is_last: bool) -> JobUpdate {
        self.taken_bytes = std::mem::take(&mut self.bytes);
        // After the end of an attempt nothing is left, or nothing is known of what is left.
        let remaining = self.remaining.remaining(self.elapsed_s());
        let remaining = remaining.filter(|_| !is_last);
        self.progress.eta_s = remaining.map(|left| left.likely_s);
        self.progress.eta_most_s = remaining.map(|left| left.most_s);
        let mut update = std::mem::take(&mut self.update);
        update.number = self.next_number();
        update.progress = self.progress.clone();
        if is_last || self.event_due() {
            self.last_event = Some((Instant::now(), self.progress.fraction));
            self.in_companions = self.runs_companions();
            update.events.extend(self.events());
        }
        update
    }

    /// Puts back the update that was taken last, because it could not be recorded.
    pub(super) fn put_back(&mut self, update: JobUpdate) {
        self.unrecorded = Some(update);
    }

    fn events(&mut self) -> Vec<(EventName, String)> {
        // Serializing numbers and texts does not fail; if it did, the event would be omitted.
        let progress = serde_json::to_string(&self.progress).ok();
        let newest = self.newest.take();
        let cycle = newest.and_then(|row| serde_json::to_string(&row).ok());
        let events = [(EventName::Progress, progress), (EventName::Cycle, cycle)];
        let with_data = |(name, data): (_, Option<String>)| Some((name, data?));
        events.into_iter().filter_map(with_data).collect()
    }

    fn event_due(&self) -> bool {
        let Some((at, fraction)) = self.last_event else {
            return true;
        };
        let waited = at.elapsed();
        waited >= EVENT_WAIT
            || (self.runs_companions() && !self.in_companions)
            || (waited >= EVENT_PAUSE && self.progress.fraction >= fraction + EVENT_FRACTION)
    }

    fn runs_companions(&self) -> bool {
        self.progress.phase == Some(Phase::Companions)
    }

    fn elapsed_s(&self) -> f64 {
        self.started.elapsed().as_secs_f64()
    }
}

/// The stage in a phase. Meshes are made again while a run is solved, and every phase of the finer run is part of its stage.
fn stage(present: Option<Stage>, phase: Phase) -> Stage {
    match (present, phase) {
        (Some(Stage::Refined), _) => Stage::Refined,
        (_, Phase::Companions) => Stage::Companions,
        (None | Some(Stage::Meshing), Phase::Mesh | Phase::Condense) => Stage::Meshing,
        _ => Stage::Solving,
    }
}

fn fraction(cycle: u64, cycles: u64) -> f64 {
    if cycles == 0 {
        0.0
    } else {
        (real(cycle) / real(cycles)).min(1.0)
    }
}

#[cfg(test)]
mod tests;
