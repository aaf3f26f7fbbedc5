//! Increments of a computed cycle: all stations take the same ones, and halve them together.

use super::section::{Increment, Station};
use super::top::{Carrier, Height, Unsolved};
use crate::cycle::WarmStarts;
use crate::cycle::step_control::RETRY;
use crate::number::real;
use crate::schedule::step::Step;

/// Work of a run.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Work {
    /// Increments of all stations together.
    pub(super) increments: usize,
    /// Iterations for the common height.
    pub(super) iterations: usize,
}

/// The stations on their carrier, with the slider at a place.
pub(super) struct Line {
    pub(super) carrier: Carrier,
    pub(super) stations: Vec<Station>,
    pub(super) height: Height,
    /// Displacement of the slider, mm.
    pub(super) slider_x: f64,
    pub(super) work: Work,
}

impl Line {
    /// Takes steps, each of which stands for so many cycles.
    ///
    /// # Errors
    /// The number of halvings and [`Unsolved`].
    pub(super) fn slide(&mut self, steps: &[Step], cycles: f64) -> Result<(), (u32, Unsolved)> {
        let mut starts = vec![WarmStarts::default(); self.stations.len()];
        let (mut half_widths, mut touching) =
            (vec![0.0; self.stations.len()], vec![0; self.stations.len()]);
        for station in &mut self.stations {
            station.update_slopes();
        }
        for (number, step) in steps.iter().enumerate() {
            let increment = Increment {
                from: self.slider_x,
                to: step.slider_x,
                cycles,
                lemke: false,
                like: (cycles > 0.0).then_some((number, steps.len())),
            };
            self.halve_and_retry(increment, 0)?;
            for (j, station) in self.stations.iter().enumerate() {
                starts[j].push(&station.state.contact);
                let half_width = station.half_width();
                if half_width > 0.0 {
                    half_widths[j] += half_width;
                    touching[j] += 1;
                }
            }
        }
        for (j, station) in self.stations.iter_mut().enumerate() {
            if cycles > 0.0 {
                station.state.warm_starts = std::mem::take(&mut starts[j]);
                if touching[j] > 0 {
                    station.state.mean_half_width = half_widths[j] / real(touching[j]);
                }
            }
        }
        Ok(())
    }

    /// Takes an increment, in halves if it fails as a whole.
    pub(super) fn halve_and_retry(
        &mut self,
        increment: Increment,
        halvings: u32,
    ) -> Result<(), (u32, Unsolved)> {
        let increment = Increment {
            lemke: increment.lemke || halvings >= RETRY.lemke_from,
            ..increment
        };
        let error = match self
            .carrier
            .advance(&mut self.stations, &mut self.height, increment)
        {
            Ok(iterations) => {
                self.slider_x = increment.to;
                self.work.increments += 1;
                self.work.iterations += iterations;
                return Ok(());
            }
            Err(error) => error,
        };
        if halvings == RETRY.halvings || error.station_to_widen().is_some() {
            return Err((halvings, error));
        }
        let middle = 0.5 * (increment.from + increment.to);
        let halves = [(increment.from, middle), (middle, increment.to)];
        for (from, to) in halves {
            let half = Increment {
                from,
                to,
                like: None,
                ..increment
            };
            self.halve_and_retry(half, halvings + 1)?;
        }
        Ok(())
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
