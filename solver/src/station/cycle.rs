//! Increments of a computed cycle: all stations take the same ones, and halve them together.

use super::height::Height;
use super::section::{Increment, Station};
use super::state::{CommonLineState, StationState};
use super::top::{Carrier, Unsolved};
use crate::along_line::{LineRecord, PositionContacts};
use crate::cycle::retry::{FailedIncrement, IncrementError, RETRY, RetryPolicy, halve_and_retry};
use crate::cycle::{IncrementNumber, WarmStarts};
use crate::number::real;
use crate::schedule::replay::ReplayPlan;
use crate::schedule::step::{Position, Step};

/// Sections repeat a solve from the last contact themselves.
const SECTIONS_RETRY: RetryPolicy = RetryPolicy {
    from_last_contact: false,
    ..RETRY
};

/// The stations on their carrier, with the slider at a place.
pub(super) struct Line {
    pub(super) carrier: Carrier,
    pub(super) stations: Vec<Station>,
    pub(super) common: CommonLineState,
}

/// A copy of what increments change.
pub(super) struct SavedLine {
    pub(super) stations: Vec<StationState>,
    height: Height,
    /// Displacement of the slider, mm.
    slider_x: f64,
}

impl Line {
    /// Takes the steps of a cycle, each of which stands for so many cycles, with replays of single ones.
    ///
    /// # Errors
    /// [`FailedIncrement`].
    pub(super) fn slide(
        &mut self,
        steps: &[Step],
        cycles: f64,
        replays: &ReplayPlan,
    ) -> Result<LineRecord, FailedIncrement<Unsolved>> {
        let count = self.stations.len();
        let mut starts = vec![WarmStarts::default(); count];
        let (mut half_widths, mut touching) = (vec![0.0; count], vec![0; count]);
        let (mut record, mut replayed) = (LineRecord::default(), Vec::new());
        for station in &mut self.stations {
            station.update_slopes();
        }
        for (number, step) in steps.iter().enumerate() {
            for &(_, end) in replays.spans.iter().filter(|span| span.0 == number) {
                replayed.extend(self.replay(&steps[number..=end], replays));
            }
            let start = IncrementNumber {
                number,
                count: steps.len(),
            };
            self.retried(Increment {
                cycles,
                start: (cycles > 0.0).then_some(start),
                ..Increment::new(self.common.slider_x, step.slider_x)
            })?;
            for (j, station) in self.stations.iter().enumerate() {
                starts[j].push(&station.state.contact);
                let half_width = station.half_width();
                if half_width > 0.0 {
                    half_widths[j] += half_width;
                    touching[j] += 1;
                }
            }
            record.push(step.slider_x, self.tangential_force_n(), self.length_mm());
            if let Some(position) = step.at {
                let contacts = PositionContacts::take(&mut replayed, position);
                let contacts = contacts.unwrap_or_else(|| self.contacts_at(position));
                let worst = &mut self.common.imbalance;
                *worst = worst.max(contacts.imbalance);
                record.positions.push(contacts);
            }
        }
        if cycles > 0.0 {
            for (j, station) in self.stations.iter_mut().enumerate() {
                station.state.warm_starts = std::mem::take(&mut starts[j]);
                if touching[j] > 0 {
                    station.state.mean_half_width = half_widths[j] / real(touching[j]);
                }
            }
        }
        Ok(record)
    }

    /// The contacts at the end of steps that wear as a single cycle, from a copy of the state; nothing where one has no solution.
    fn replay(&mut self, steps: &[Step], plan: &ReplayPlan) -> Option<PositionContacts> {
        let before = self.snapshot();
        let last = steps.last()?;
        let position = last.at?;
        let direction = (last.slider_x - self.common.slider_x).signum();
        let smoothing = plan.smoothing(last.slider_x, direction);
        let lead_in = steps.iter().map(|step| (step.slider_x, 1));
        let mut parts = lead_in.chain(smoothing);
        let replayed = parts.all(|(to, count)| self.replay_to(to, count));
        let contacts = replayed.then(|| self.contacts_at(position));
        let (increments, iterations) = (self.common.increments, self.common.iterations);
        self.restore(&before);
        (self.common.increments, self.common.iterations) = (increments, iterations);
        contacts
    }

    /// Slides to a place in equal parts with the wear of a single cycle; returns whether all have a solution.
    fn replay_to(&mut self, to: f64, parts: usize) -> bool {
        Increment::parts(self.common.slider_x, to, parts).all(|part| self.retried(part).is_ok())
    }

    /// Takes an increment, in halves if it fails as a whole.
    fn retried(&mut self, increment: Increment) -> Result<(), FailedIncrement<Unsolved>> {
        halve_and_retry(increment, SECTIONS_RETRY, |increment| {
            let common = &mut self.common;
            let iterations =
                self.carrier
                    .advance(&mut self.stations, &mut common.height, increment)?;
            common.slider_x = increment.to;
            common.increments += 1;
            common.iterations += iterations;
            Ok(())
        })
    }

    /// The contacts of the present increment.
    pub(super) fn contacts_at(&mut self, position: Position) -> PositionContacts {
        let stations = self.stations.iter_mut();
        let forces =
            stations.map(|station| station.place.weight_mm * station.force_with_present_normals());
        let force_n: f64 = forces.sum();
        let expected_n = self.carrier.present_n(&self.stations, &self.common.height);
        let stations = self.stations.iter();
        PositionContacts {
            position,
            slider_x: self.common.slider_x,
            contacts: stations
                .clone()
                .map(|station| station.state.contact.clone())
                .collect(),
            found: stations.map(Station::present).collect(),
            imbalance: (force_n - expected_n).abs() / self.carrier.force_n,
        }
    }

    /// Force of the slider on the receptacle along the motion, N.
    fn tangential_force_n(&self) -> f64 {
        let stations = self.stations.iter();
        stations
            .map(|station| station.place.weight_mm * station.force_along_motion())
            .sum()
    }

    /// Length of the line, mm.
    pub(super) fn length_mm(&self) -> f64 {
        let stations = self.stations.iter();
        stations.map(|station| station.place.weight_mm).sum()
    }

    /// A copy of what increments change.
    pub(super) fn snapshot(&self) -> SavedLine {
        let states = self.stations.iter().map(|station| station.state.clone());
        SavedLine {
            stations: states.collect(),
            height: self.common.height.clone(),
            slider_x: self.common.slider_x,
        }
    }

    /// Goes back to a copy, with the jump controls and the work as they are.
    pub(super) fn restore(&mut self, before: &SavedLine) {
        for (station, state) in self.stations.iter_mut().zip(&before.stations) {
            let jump = std::mem::take(&mut station.state.jump);
            station.state = StationState {
                jump,
                work: station.state.work,
                ..state.clone()
            };
        }
        self.common.height = before.height.clone();
        self.common.slider_x = before.slider_x;
    }
}

impl IncrementError for Unsolved {
    fn needs_wider_zones(&self) -> bool {
        self.station_to_widen().is_some()
    }
}

impl Unsolved {
    /// The station whose contact has outgrown its zones, if that is why.
    pub(super) fn station_to_widen(self) -> Option<usize> {
        match self {
            Self::Section { station, source } if source.needs_wider_zones() => Some(station),
            _ => None,
        }
    }
}
