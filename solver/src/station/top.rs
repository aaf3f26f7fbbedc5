//! The top that carries the sections: one increment of all stations.
//!
//! Under an even load each section is solved alone. Under a rigid top the common height v follows from
//!   r(v) = sum_j w_j P_j(v + g_j) - F + K (v_0 - v) = 0
//! by Newton's method with dr/dv = sum_j w_j dP_j/dv - K, K the stiffness of a spring that applies F. Under a given height a section's contact is linear in its pressures and the height as
//! long as its active set stays, so that the predictor p + dp/dv dv is mostly its solution, and few iterations are needed. r falls with
//! v: a step that leaves the interval in which its sign changes is replaced by a bisection, which also finds a contact that no section has.

use super::coupling::Coupling;
use super::height::{Height, HeightSolution};
use super::section::Station;
use super::side_by_side::for_each;
use crate::along_line::SectionsIncrement;
use crate::contact::ContactError;
use crate::scene::Top;

/// Imbalance over the force at which the height has converged: far below any tolerance. 1e-7 takes a tenth more solves of the thesis' ring.
pub(super) const BALANCED: f64 = 1e-5;

/// Most iterations for the height. Arbitrary: 2 to 6 are needed.
pub(super) const MOST_ITERATIONS: usize = 40;

/// Height over the lowest known one by which the search for an upper bound begins, over the length of a contact's indentation.
const FIRST_STEP: f64 = 1.0;

/// Why an increment of all stations has no solution.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) enum Unsolved {
    /// A section has none.
    Section {
        /// Number.
        station: usize,
        /// Why.
        source: ContactError,
    },
    /// No height carries the force.
    Height {
        /// Force of the last iteration, N.
        found_n: f64,
        /// Iterations.
        iterations: usize,
    },
}

/// The carrier of the sections.
#[derive(Debug)]
pub(super) struct Carrier {
    pub(super) top: Top,
    /// Coupling of the sections; `None` where each is solved alone at the common height.
    pub(super) coupling: Option<Coupling>,
    pub(super) force_n: f64,
    /// Stiffness of the spring that applies the force to a rigid top, N/mm.
    pub(super) spring_n_per_mm: f64,
}

impl Carrier {
    /// Solves an increment of all stations and makes it part of their states; returns the number of iterations.
    ///
    /// # Errors
    /// [`Unsolved`]; the states are then those before.
    pub(super) fn advance(
        &self,
        stations: &mut [Station],
        height: &mut Height,
        increment: SectionsIncrement,
    ) -> Result<usize, Unsolved> {
        let iterations = match self.top {
            Top::Even => {
                solve(stations, |_, station| station.solve(increment, None, None))?;
                1
            }
            Top::Rigid | Top::Pressure => {
                let found = match &self.coupling {
                    Some(coupling) => {
                        if height.reference.is_none() {
                            let alone = self.common_height(stations, height, increment)?;
                            height.mm = alone.mm;
                        }
                        self.coupled_heights(coupling, stations, height, increment)?
                    }
                    None => self.common_height(stations, height, increment)?,
                };
                let iterations = found.iterations;
                height.take(found, increment.cycles);
                iterations
            }
        };
        for station in stations {
            station.accept();
        }
        Ok(iterations)
    }

    /// The force that acts on the stations now, N.
    pub(super) fn present_n(&self, stations: &[Station], height: &Height) -> f64 {
        match self.top {
            Top::Even => stations
                .iter()
                .map(|station| station.place.weight_mm * station.load())
                .sum(),
            Top::Rigid | Top::Pressure => self.force_at(height, height.mm),
        }
    }

    /// Force on a rigid top at a height, which a spring reduces as the top sinks, N.
    pub(super) fn force_at(&self, last: &Height, mm: f64) -> f64 {
        let sunk = last.reference.map_or(0.0, |reference| reference - mm);
        self.force_n - self.spring_n_per_mm * sunk
    }

    /// The height that carries the force, and the number of iterations.
    pub(super) fn common_height(
        &self,
        stations: &mut [Station],
        last: &Height,
        increment: SectionsIncrement,
    ) -> Result<HeightSolution, Unsolved> {
        let mut v = last.predicted(increment.cycles);
        let (mut low, mut high) = (f64::NEG_INFINITY, f64::INFINITY);
        let (mut raised, mut found_n, mut beyond) = (None, 0.0, 0.0);
        for iteration in 1..=MOST_ITERATIONS {
            solve(stations, |_, station| {
                station.solve(increment, Some(v + station.place.raised_mm), raised)
            })?;
            let (mut force, mut per_height) = (0.0, 0.0);
            for station in stations.iter() {
                force += station.place.weight_mm * station.attempt.line_load;
                per_height += station.place.weight_mm * station.attempt.load_per_height;
            }
            found_n = force;
            let imbalance = force - self.force_at(last, v);
            per_height -= last.reference.map_or(0.0, |_| self.spring_n_per_mm);
            if imbalance.abs() <= BALANCED * self.force_n {
                return Ok(HeightSolution {
                    mm: v,
                    lifts: Vec::new(),
                    imbalance: imbalance.abs() / self.force_n,
                    iterations: iteration,
                });
            }
            if imbalance > 0.0 {
                low = v;
            } else {
                high = v;
            }
            let next = v - imbalance / per_height;
            let next = if per_height < 0.0 && next > low && next < high {
                next
            } else if low.is_finite() && high.is_finite() {
                0.5 * (low + high)
            } else {
                // Twice as far each time, downward from a height at which nothing touches.
                beyond = 2.0 * beyond + FIRST_STEP * indentation(stations);
                if low.is_finite() {
                    low + beyond
                } else {
                    high - beyond
                }
            };
            raised = Some(next - v);
            v = next;
        }
        Err(Unsolved::Height {
            found_n,
            iterations: MOST_ITERATIONS,
        })
    }
}

pub(super) fn solve(
    stations: &mut [Station],
    work: impl Fn(usize, &mut Station) -> Result<(), ContactError> + Sync + Send,
) -> Result<(), Unsolved> {
    for_each(stations, work).map_err(|(station, source)| Unsolved::Section { station, source })
}

/// Largest indentation of the sections in their last increment, mm.
pub(super) fn indentation(stations: &[Station]) -> f64 {
    let indentations = stations
        .iter()
        .map(|station| station.state.contact.indentation);
    indentations.fold(f64::MIN_POSITIVE, f64::max)
}
