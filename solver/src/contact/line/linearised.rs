//! Contact at one position of the slider on surfaces of given depths, without wear in the solve: linear in the depths for a set of
//! closed nodes.
//!
//! With the pressures p of the closed nodes, the height v and the gaps g of the undeformed bodies at height 0,
//!   K p + (1 + sag) v = -g on closed nodes,  f . p - spring v = load,
//! where K holds the responses of the gaps and f the vertical forces per pressure, friction included where it acts. The inverse of
//! this system gives pressures and height on any depths for the same closed nodes, and the change T of the pressures per change of
//! the gaps. The set follows from the signs of pressures and gaps, as in Newton's method for an increment (`active_set`).

mod doses;
mod state;
mod unknowns;
mod update;

use super::active_window::widened;
use super::error::ContactError;
use super::friction::{self, Coefficient};
use super::geometry::{Geometry, Setting};
use super::mortar;
use super::pair::{Pair, Surfaces, WarmStart};
use super::problem::{Iterate, Problem, mean_slope};
use super::rate_contrast::NextWorn;
use super::response::Response;
use super::status::Status;
use super::unknown::Unknown;
use super::work::Work;
use crate::linear::Inverse;
use crate::linear::vector::{add_scaled, dot, vectorized};
use crate::number::count;
pub(crate) use unknowns::DoseUnknowns;

/// Position of the slider in a pass.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct PassPosition {
    /// Displacement of the slider, mm.
    pub(crate) slider_x: f64,
    /// Direction of the pass, 1 or -1.
    pub(crate) direction: f64,
    /// Height of the loaded, unworn contact, the reference of a spring, mm.
    pub(crate) reference_height: f64,
}

/// Contact at a position, linearised for a set of closed nodes. Buffers are reused.
#[derive(Default)]
pub(crate) struct LinearisedContact {
    geometry: Geometry,
    response: Response,
    /// Pressures, statuses and gaps of the window, and the height.
    iterate: Iterate,
    /// Closed nodes of the window that the inverse belongs to.
    closed: Vec<usize>,
    inverse: Inverse,
    /// Vertical force of the pressures of all nodes of the window, mm.
    force: Vec<f64>,
    rhs: Vec<f64>,
    solution: Vec<f64>,
    window: (usize, usize),
    /// Rise of the slider over its displacement: the mean slope under the pressures of its start.
    climb: f64,
    /// True if the inverse is that of the closed nodes.
    is_factored: bool,
    pub(crate) work: Work,
}

/// Place of a contact: what does not change while depths do.
#[derive(Clone, Copy)]
pub(crate) struct Place<'a> {
    pub(crate) pair: &'a Pair<'a>,
    /// Surfaces with the depths that the window is chosen for; their slopes are those of all depths.
    pub(crate) surfaces: Surfaces<'a>,
    pub(crate) position: PassPosition,
    /// Wear of the master's nodes that comes next, by which they share paths.
    pub(crate) next: NextWorn<'a>,
}

impl Place<'_> {
    fn setting(&self) -> Setting {
        let interface = &self.pair.interface;
        let (spring, slider_x) = (interface.spring, self.position.slider_x);
        Setting {
            slider_x,
            pairing_x: slider_x,
            load: interface.load - spring * self.position.reference_height,
            spring,
            indentation: 0.0,
        }
    }

    fn covered(&self) -> (usize, usize) {
        mortar::covered(self.pair, self.position.slider_x)
    }
}

impl LinearisedContact {
    /// Places the contact with the closed nodes of a start.
    ///
    /// # Errors
    /// [`ContactError`] if the slider has left the receptacle, or the contact has outgrown its zones.
    pub(crate) fn place(
        &mut self,
        place: Place<'_>,
        start: WarmStart<'_>,
    ) -> Result<(), ContactError> {
        let covered = place.covered();
        let first = start.first.max(covered.0);
        let end = (start.first + start.status.len()).min(covered.1);
        if first >= end {
            return Err(no_equilibrium(place));
        }
        self.assemble(place, widened((first, end), covered))?;
        let offset = self.window.0;
        let it = &mut self.iterate;
        for node in first..end {
            if start.status[node - start.first] != Status::Open {
                it.status[node - offset] = Status::slip(place.position.direction);
            }
            it.pressure[node - offset] = start.pressure[node - start.first];
        }
        it.height = 0.0;
        let widths = &place.pair.slave().widths[self.window.0..self.window.1];
        self.climb = mean_slope(&it.pressure, widths, &self.geometry.slopes.interface);
        Ok(())
    }

    /// Slip of a node of the window over the displacement: a slider that rises by m per displacement slips by 1 + m s on the slope s.
    fn slip(&self, node: usize) -> f64 {
        1.0 + self.climb * self.geometry.slopes.interface[node]
    }

    /// Couples the nodes of a window; all of them are open.
    fn assemble(&mut self, place: Place<'_>, window: (usize, usize)) -> Result<(), ContactError> {
        let Place {
            pair,
            surfaces,
            next,
            ..
        } = place;
        self.window = window;
        let nodes = window.0..window.1;
        self.geometry
            .place_where_worn(pair, &surfaces, place.setting(), nodes.clone(), next);
        self.response.reset(nodes.len(), false);
        let it = &mut self.iterate;
        it.status.clear();
        it.status.resize(nodes.len(), Status::Open);
        for values in [&mut it.pressure, &mut it.shear, &mut it.slip, &mut it.along] {
            values.clear();
            values.resize(nodes.len(), 0.0);
        }
        self.is_factored = false;
        self.measure(place)
    }

    /// Measures the gaps of the window on the depths of the place.
    fn measure(&mut self, place: Place<'_>) -> Result<(), ContactError> {
        let Place { pair, surfaces, .. } = place;
        let (begin, stop) = self.geometry.coupling.master_range;
        let nodes = self.window.0..self.window.1;
        let zones = pair.zones_of(place.position.slider_x, nodes, begin..stop)?;
        self.geometry
            .measure(pair, zones, &surfaces, place.setting());
        Ok(())
    }

    /// Solves for the pressures of the closed nodes on the depths of the place, of either sign.
    ///
    /// # Errors
    /// [`ContactError`] if the closed nodes have no equilibrium.
    pub(crate) fn solve(&mut self, place: Place<'_>) -> Result<(), ContactError> {
        self.measure(place)?;
        if !self.is_factored {
            self.factor(place)?;
        }
        let (geometry, it) = (&self.geometry, &mut self.iterate);
        self.rhs.clear();
        self.rhs
            .extend(self.closed.iter().map(|i| -geometry.gap[*i]));
        let load = place.setting().load / place.pair.interface.modulus;
        self.rhs.push(load);
        let (inverse, solution) = (self.inverse.inverse(), &mut self.solution);
        solution.clear();
        solution.resize(self.rhs.len(), 0.0);
        vectorized(
            #[inline(always)]
            || {
                for (column, value) in self.rhs.iter().enumerate() {
                    add_scaled(solution, *value, inverse.column(column));
                }
            },
        );
        it.pressure.fill(0.0);
        for (node, pressure) in self.closed.iter().zip(&solution[..]) {
            it.pressure[*node] = *pressure;
        }
        it.height = solution[self.closed.len()];
        if it.height.is_finite() {
            Ok(())
        } else {
            Err(no_equilibrium(place))
        }
    }

    /// Inverts the system of the closed nodes.
    fn factor(&mut self, place: Place<'_>) -> Result<(), ContactError> {
        let statuses = self.iterate.status.iter().enumerate();
        self.closed.clear();
        self.closed.extend(
            statuses
                .filter(|(_, status)| **status != Status::Open)
                .map(|(i, _)| i),
        );
        self.respond(place)?;
        let modulus = place.pair.interface.modulus;
        let n = self.closed.len();
        let (geometry, response, force) = (&self.geometry, &self.response, &self.force);
        let matrix = self.inverse.matrix(n + 1);
        let status = Status::slip(place.position.direction);
        for (j, node) in self.closed.iter().enumerate() {
            let (gap, _) = response.column(Unknown::Pressure(*node, status));
            let column = matrix.column_mut(j);
            for (entry, i) in column.iter_mut().zip(&self.closed) {
                *entry = gap[*i];
            }
            column[n] = force[*node] / modulus;
        }
        let column = matrix.column_mut(n);
        for (entry, i) in column.iter_mut().zip(&self.closed) {
            *entry = 1.0 + geometry.sag[*i];
        }
        column[n] = -place.setting().spring / modulus;
        self.work.factorizations += 1;
        self.work.unknowns += count(n + 1);
        self.work.response_entries += std::mem::take(&mut self.response.entries);
        self.is_factored = true;
        if n > 0 && self.inverse.invert() {
            Ok(())
        } else {
            Err(no_equilibrium(place))
        }
    }

    /// Computes the responses to the pressures of the closed nodes, and the vertical forces of all.
    fn respond(&mut self, place: Place<'_>) -> Result<(), ContactError> {
        let Place {
            pair,
            surfaces,
            position,
            ..
        } = place;
        let nodes = self.window.0..self.window.1;
        let geometry = &self.geometry;
        let (begin, stop) = geometry.coupling.master_range;
        let zones = pair.zones_of(position.slider_x, nodes.clone(), begin..stop)?;
        let coefficient = Coefficient::of(pair, &surfaces, &[], &[]);
        let setting = place.setting();
        let problem = Problem {
            pair,
            zones,
            coupling: &geometry.coupling,
            gap: &geometry.gap,
            width: &pair.slave().widths[nodes],
            slope: &geometry.slopes.interface,
            master_slope: &geometry.slopes.master,
            friction: friction::acting(&pair.interface, coefficient, position.direction),
            tracks_slip: false,
            load: setting.load,
            spring: setting.spring,
            sag: &geometry.sag,
            fixed_slip: &[],
            wears: false,
            travel: 0.0,
            first_load: false,
            step: position.direction,
            along: &[],
            height: None,
        };
        for node in &self.closed {
            let unknown = Unknown::pressure(&problem, *node);
            self.response.compute(&problem, unknown);
        }
        self.force.clear();
        let forces = (0..problem.gap.len()).map(|node| {
            let unknown = Unknown::pressure(&problem, node);
            unknown.force(&problem)[1]
        });
        self.force.extend(forces);
        Ok(())
    }

    /// Largest indentation of the last solution whose signs were evaluated, mm.
    pub(crate) fn indentation(&self) -> f64 {
        self.iterate.indentation
    }

    /// |sum of vertical forces - load| over the load on the unworn contact.
    pub(crate) fn imbalance(&self, place: Place<'_>) -> f64 {
        let Setting { load, spring, .. } = place.setting();
        let forces = dot(&self.force, &self.iterate.pressure);
        (forces - spring * self.iterate.height - load).abs() / place.pair.interface.load
    }
}

fn no_equilibrium(place: Place<'_>) -> ContactError {
    ContactError::NoEquilibrium {
        slider_x_mm: place.position.slider_x,
        active: 0,
    }
}
