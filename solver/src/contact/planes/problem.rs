//! One increment over the coupled nodes of all planes: what does not depend on the tractions.
//!
//! Node i of plane k is number k n + i of the coupled ones, n in each plane.

use super::super::line::friction;
use super::super::line::local_slopes::LocalSlopes;
use super::super::line::mortar::Coupling;
use super::super::line::{ContactState, Pair, Surfaces};
use super::bodies::{Extruded, Slide};
use super::wear::PlanesWear;
use crate::condensation::PrismZone;
use crate::law::friction::Coefficients;
use crate::model::Tangential;
use crate::sides::Side;

/// The zones of both bodies in which a contact lies.
#[derive(Debug, Clone, Copy)]
pub(super) struct Zones<'a> {
    pub(super) slave: &'a PrismZone,
    pub(super) master: &'a PrismZone,
}

/// Geometry, friction and wear of an increment. Buffers are reused.
#[derive(Debug, Default)]
pub(super) struct Problem {
    /// The pairing, which all planes have.
    pub(super) coupling: Coupling,
    pub(super) wears: bool,
    /// True if nothing was loaded before.
    pub(super) first_load: bool,
    /// Gap of the worn bodies at height 0 under the far-face load, mm.
    pub(super) gap: Vec<f64>,
    /// Slopes of the interface and of the master's surface.
    pub(super) slope: Vec<f64>,
    pub(super) master_slope: Vec<f64>,
    /// Slip at height 0, mm.
    pub(super) fixed_slip: Vec<f64>,
    /// Line force on the slider (x, y) per pressure, mm.
    pub(super) force: Vec<[f64; 2]>,
    /// Share of each plane in the width.
    pub(super) shares: Vec<f64>,
    /// Direction of the imposed slip; 0 without one.
    pub(super) direction: f64,
    /// Mean line load that is asked for and that at height 0, N/mm, what the spring that applies it adds per height, N/mm per mm, and the contact
    /// modulus, MPa.
    pub(super) full_load: f64,
    pub(super) load: f64,
    pub(super) spring: f64,
    pub(super) modulus: f64,
    /// Change of the gaps per height: 1, and what the far-face load of the spring opens.
    pub(super) per_height: Vec<f64>,
    /// Coefficient of friction, -; the largest where places differ in it.
    pub(super) friction: f64,
    /// Coefficients at the coupled nodes where places differ in them, -.
    coefficients: Vec<f64>,
    coefficients_of_plane: Vec<f64>,
    slopes: LocalSlopes,
}

impl Problem {
    /// Assembles the increment over the nodes `first..end` of the slave, with its wear.
    pub(super) fn assemble(
        &mut self,
        bodies: &Extruded<'_>,
        surfaces: &[Surfaces<'_>],
        last: &[ContactState],
        to: Slide<'_>,
        (first, end): (usize, usize),
        worn: &mut PlanesWear,
    ) {
        let pair = &bodies.pair();
        let interface = &bodies.interface;
        self.coupling.integrate(pair, to.slider_x, first, end);
        let wear = interface.wear.map(|wear| wear.filter(|_| to.cycles > 0.0));
        self.wears = wear.slider.is_some() || wear.receptacle.is_some();
        worn.assemble(&self.coupling, pair, &wear, surfaces, to.cycles);
        let step = to.slider_x - last[0].slider_x;
        self.direction = if step == 0.0 { 0.0 } else { step.signum() };
        self.full_load = interface.load;
        self.first_load = last[0].reference_height.is_none();
        // Before the first load the spring has no reference height.
        let (spring, reference) = last[0]
            .reference_height
            .map_or((0.0, 0.0), |height| (interface.spring, height));
        (self.load, self.spring) = (interface.load - spring * reference, spring);
        self.modulus = interface.modulus;
        self.shares.clear();
        self.shares.extend_from_slice(bodies.shares);
        let height = last[0].height;
        for values in [
            &mut self.slope,
            &mut self.master_slope,
            &mut self.fixed_slip,
        ] {
            values.clear();
        }
        self.gap.clear();
        self.force.clear();
        let direction = match interface.tangential {
            Tangential::Omitted => 0.0,
            Tangential::ImposedSlip | Tangential::StickSlip => self.direction,
        };
        self.take_friction(pair, surfaces, to.slider_x);
        let widths = &pair.slave().widths[first..end];
        for (plane, surfaces) in surfaces.iter().enumerate() {
            self.slopes.assemble(pair, &self.coupling, surfaces);
            let slopes = &self.slopes.interface;
            self.slope.extend_from_slice(slopes);
            self.master_slope.extend_from_slice(&self.slopes.master);
            self.fixed_slip
                .extend(slopes.iter().map(|s| step - s * height));
            // p N - q T over the width of the node, with N = (-s, 1), T = (1, s) and q = mu p in the direction of the slip.
            let friction = coefficients(self.friction, &self.coefficients, plane, widths.len());
            let forces = slopes.iter().zip(widths).enumerate();
            self.force.extend(forces.map(|(node, (slope, width))| {
                let tangential = -(direction * friction.at(node)) * width;
                [tangential - slope * width, width + slope * tangential]
            }));
            self.measure(pair, surfaces);
        }
    }

    /// Takes the coefficients of friction of all planes.
    fn take_friction(&mut self, pair: &Pair<'_>, surfaces: &[Surfaces<'_>], slider_x: f64) {
        self.friction = pair.interface.friction;
        self.coefficients.clear();
        let nodes = self.coupling.first..self.coupling.end;
        for surfaces in surfaces {
            let of_plane = &mut self.coefficients_of_plane;
            friction::interpolate(pair, surfaces, slider_x, nodes.clone(), of_plane);
            self.coefficients.extend_from_slice(of_plane);
        }
    }

    /// Coefficients of friction at the coupled nodes of a plane.
    pub(super) fn coefficients(&self, plane: usize) -> Coefficients<'_> {
        coefficients(self.friction, &self.coefficients, plane, self.nodes())
    }

    /// Appends the gaps of a plane.
    fn measure(&mut self, pair: &Pair<'_>, surfaces: &Surfaces<'_>) {
        let slave = pair.interface.slave;
        let (own, other) = (surfaces.depth.of(slave), surfaces.depth.of(slave.other()));
        let coupling = &self.coupling;
        for i in coupling.first..coupling.end {
            let (from, weights) = coupling.dual_row(i);
            let worn = weights.iter().zip(&other[from..]);
            let worn: f64 = worn.map(|(weight, depth)| weight * depth).sum();
            self.gap
                .push(coupling.gap[i - coupling.first] + own[i] + worn);
        }
    }

    /// Adds the gaps that the slider opens by its far-face load.
    pub(super) fn sag(&mut self, zones: Zones<'_>, slave: Side) {
        let coupling = &self.coupling;
        self.per_height.clear();
        for k in 0..self.shares.len() {
            for i in coupling.first..coupling.end {
                let at = k * coupling.len() + i - coupling.first;
                let slope = self.master_slope[at];
                let moved_by = |zone: &PrismZone, j: usize| {
                    let [x, y] = zone.under_load(k, j);
                    y - slope * x
                };
                let moved = match slave {
                    Side::Slider => moved_by(zones.slave, i),
                    Side::Receptacle => {
                        let (from, weights) = coupling.dual_row(i);
                        let nodes = (from..).zip(weights);
                        nodes
                            .map(|(j, weight)| weight * moved_by(zones.master, j))
                            .sum()
                    }
                };
                self.gap[at] += self.load * moved;
                self.per_height.push(1.0 + self.spring * moved);
            }
        }
    }

    /// Writes the forces on the slider of a plane's pressures to the nodes of both bodies, which had none.
    pub(super) fn write_forces(
        &self,
        plane: usize,
        pressure: &[f64],
        slave: Side,
        next: &mut ContactState,
    ) {
        let (coupling, n) = (&self.coupling, self.nodes());
        let per_pressure = self.force[plane * n..(plane + 1) * n].iter();
        for (i, (p, per_pressure)) in (coupling.first..).zip(pressure.iter().zip(per_pressure)) {
            let force = per_pressure.map(|f| p * f);
            next.force.of_mut(slave)[2 * i..2 * i + 2].copy_from_slice(&force);
            let (from, weights) = coupling.dual_row(i);
            let (other, _) = next.force.of_mut(slave.other()).as_chunks_mut::<2>();
            for (other, weight) in other[from..].iter_mut().zip(weights) {
                other[0] += weight * force[0];
                other[1] += weight * force[1];
            }
        }
        let (begin, stop) = coupling.master_range;
        next.set_loaded(slave, coupling.first..coupling.end);
        next.set_loaded(slave.other(), begin..stop);
    }

    /// Coupled nodes of a plane.
    pub(super) fn nodes(&self) -> usize {
        self.coupling.len()
    }

    /// Coupled nodes of all planes.
    pub(super) fn len(&self) -> usize {
        self.gap.len()
    }

    /// Mean slope under the last pressures, positive where the slider climbs it.
    pub(super) fn mean_slope_ahead(&self, pressure: &[f64]) -> f64 {
        let (mut load, mut moment) = (0.0, 0.0);
        for (at, p) in pressure.iter().enumerate() {
            let share = self.shares[at / self.nodes()] * p;
            load += share;
            moment += share * self.slope[at];
        }
        if load > 0.0 {
            self.direction * moment / load
        } else {
            0.0
        }
    }
}

/// Coefficients of friction at the coupled nodes of a plane, so many in each: one of all places, unless they differ.
fn coefficients(of_all: f64, differing: &[f64], plane: usize, nodes: usize) -> Coefficients<'_> {
    if differing.is_empty() {
        Coefficients::Uniform(of_all)
    } else {
        Coefficients::Local(&differing[plane * nodes..(plane + 1) * nodes])
    }
}
