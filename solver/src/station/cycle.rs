//! Increments of a computed cycle: all stations take the same ones, and halve them together.

use std::sync::Arc;

use super::height::Height;
use super::meshed::Section;
use super::scene::StationScene;
use super::section::Station;
use super::state::{CommonLineState, StationState};
use super::top::{Carrier, Unsolved};
use crate::along_line::{PositionContacts, Sections, SectionsIncrement};
use crate::contact::ContactState;
use crate::cycle::WarmStarts;
use crate::cycle::retry::{IncrementError, RETRY, RetryPolicy};
use crate::law::friction::contact::ContactFriction;
use crate::scene::Scene;
use crate::schedule::plan::Cycles;
use crate::schedule::step::Position;
use crate::threads::Threads;

/// A contact along a line in stations on their carrier.
pub(crate) struct LineContact {
    pub(super) scene: StationScene,
    /// The plane section under the mean line load.
    pub(super) plane: Scene,
    pub(super) unworn: Arc<Section>,
    pub(super) carrier: Carrier,
    pub(super) stations: Vec<Station>,
    pub(super) common: CommonLineState,
    pub(super) friction: ContactFriction,
    pub(super) threads: Arc<Threads>,
}

/// A copy of what increments change.
pub(crate) struct SavedLine {
    pub(super) stations: Vec<StationState>,
    height: Height,
    /// Displacement of the slider, mm.
    slider_x: f64,
}

impl Sections for LineContact {
    type Unsolved = Unsolved;
    type Saved = SavedLine;
    /// Sections repeat a solve from the last contact one by one.
    const RETRY: RetryPolicy = RetryPolicy {
        from_last_contact: false,
        ..RETRY
    };

    fn advance(&mut self, increment: SectionsIncrement) -> Result<(), Unsolved> {
        let common = &mut self.common;
        let iterations = self
            .carrier
            .advance(&mut self.stations, &mut common.height, increment)?;
        common.slider_x = increment.to;
        common.increments += 1;
        common.iterations += iterations;
        Ok(())
    }

    fn update_surfaces(&mut self, cycles: Cycles) {
        let friction = &self.friction;
        for station in &mut self.stations {
            station.update_surfaces(friction, cycles);
        }
    }

    fn save(&self) -> SavedLine {
        let states = self.stations.iter().map(|station| station.state.clone());
        SavedLine {
            stations: states.collect(),
            height: self.common.height.clone(),
            slider_x: self.common.slider_x,
        }
    }

    /// Increments of replays count.
    fn go_back(&mut self, before: &SavedLine) {
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

    fn slider_x(&self) -> f64 {
        self.common.slider_x
    }

    fn contacts(&self) -> impl Iterator<Item = &ContactState> {
        self.stations.iter().map(|station| &station.state.contact)
    }

    fn half_widths(&self) -> Vec<f64> {
        self.stations.iter().map(Station::half_width).collect()
    }

    fn tangential_force_n(&self) -> f64 {
        let stations = self.stations.iter();
        stations
            .map(|station| station.place.weight_mm * station.force_along_motion())
            .sum()
    }

    fn length_mm(&self) -> f64 {
        let stations = self.stations.iter();
        stations.map(|station| station.place.weight_mm).sum()
    }

    fn contacts_at(&mut self, position: Position) -> PositionContacts {
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
            friction: stations.clone().map(Station::coefficients).collect(),
            found: stations.map(Station::present).collect(),
            imbalance: (force_n - expected_n).abs() / self.carrier.force_n,
        }
    }

    fn worst_imbalance(&mut self) -> &mut f64 {
        &mut self.common.imbalance
    }

    fn end_cycle(&mut self, starts: Vec<WarmStarts>, half_widths_mm: Vec<Option<f64>>) {
        let left = starts.into_iter().zip(half_widths_mm);
        for (station, (starts, half_width)) in self.stations.iter_mut().zip(left) {
            let state = &mut station.state;
            state.warm_starts = starts;
            state.mean_half_width = half_width.unwrap_or(state.mean_half_width);
        }
    }
}

impl IncrementError for Unsolved {
    fn needs_wider_zones(&self) -> bool {
        matches!(self, Self::Section { source, .. } if source.needs_wider_zones())
    }
}
