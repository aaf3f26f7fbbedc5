//! One increment of sliding: the active window, the solve, and the increment's wear, energy and residuals.

use super::active_window::{candidates, initial_window, undeformed_gaps, widened};
use super::complementarity::Complementarity;
use super::error::ContactError;
use super::local_slopes::LocalSlopes;
use super::mortar::{self, Coupling};
use super::newton::{Convergence, Newton};
use super::pair::{Displacement, Pair, Surfaces, Zones};
use super::pairing;
use super::predictor::predict;
use super::problem::{GAP_TOLERANCE, Iterate, MOST_ITERATIONS, Problem};
use super::response::Response;
use super::state::ContactState;
use super::status::Status;
use super::wear_coupling::WearCoupling;
use crate::sides::{Side, Sides};

/// Most extensions of the active window within one increment.
const MOST_EXTENSIONS: usize = 60;

/// Solves increments; its buffers are reused from one to the next.
#[derive(Default)]
pub struct Solver {
    coupling: Coupling,
    response: Response,
    wear: WearCoupling,
    newton: Newton,
    complementarity: Complementarity,
    iterate: Iterate,
    /// Undeformed vertical gap at height 0 of every covered node, mm.
    undeformed: Vec<f64>,
    gap: Vec<f64>,
    sag: Vec<f64>,
    slopes: LocalSlopes,
    fixed_slip: Vec<f64>,
    recession: Sides<Vec<f64>>,
}

/// Result of an increment; arrays begin at the first coupled node of their side.
#[derive(Debug, Clone, Copy)]
pub struct Increment<'a> {
    /// First coupled node of each side.
    pub first: Sides<usize>,
    /// Path p |sigma| of the slave's nodes from there on, MPa mm.
    pub path: &'a [f64],
    /// Vertical recession at the nodes from there on, mm; empty where nothing wears.
    pub recession: Sides<&'a [f64]>,
    /// Integral of the wear rate over the contact, mm^2.
    pub worn_area: Sides<f64>,
    /// Energy dissipated by friction, N/mm mm.
    pub energy: f64,
    /// |sum of vertical forces - load| over the load on the unworn contact.
    pub force_balance: f64,
    /// Largest gap of a closed node or penetration of an open one, over the indentation (or the round-off of longer
    /// lengths).
    pub complementarity: f64,
    /// Largest |q| - mu p over the peak pressure.
    pub friction_cone: f64,
}

impl Solver {
    /// Solves the increment to a displacement and writes the new state to `next`.
    ///
    /// # Errors
    /// [`ContactError`]; `next` is then undefined.
    pub fn advance(
        &mut self,
        pair: &Pair<'_>,
        surfaces: &Surfaces<'_>,
        last: &ContactState,
        to: Displacement,
        next: &mut ContactState,
    ) -> Result<Increment<'_>, ContactError> {
        let slider_x = to.slider_x;
        if is_at_rest(last, to) {
            return Ok(self.unchanged(last, next));
        }
        let pairing_x = pairing::position(pair, last, slider_x);
        let covered = mortar::covered(pair, pairing_x);
        if covered.0 == covered.1 || pair.interface.load <= 0.0 {
            return Ok(self.open(last, slider_x, next));
        }
        undeformed_gaps(pair, surfaces, pairing_x, covered, &mut self.undeformed);
        let mut window = initial_window(pair, last, pairing_x, covered, &self.undeformed);
        for _ in 0..MOST_EXTENSIONS {
            self.solve_window(pair, surfaces, last, (to, pairing_x), window)?;
            let (indentation, height) = (self.iterate.indentation, self.iterate.height);
            let needed = candidates(&self.undeformed, covered.0, indentation, height);
            let extended = (needed.0.min(window.0), needed.1.max(window.1));
            if extended == window {
                self.write(pair, last, (slider_x, pairing_x), next);
                return Ok(self.report(pair, next));
            }
            window = widened(extended, covered);
        }
        Err(ContactError::NotConverged {
            slider_x_mm: slider_x,
            iterations: MOST_EXTENSIONS * MOST_ITERATIONS,
            residual: f64::INFINITY,
            tolerance: GAP_TOLERANCE,
            changes: window.1 - window.0,
        })
    }

    /// An open contact: without a load, or where the stroke has taken the slider off the receptacle and a stop holds
    /// its height until it returns.
    fn open(
        &mut self,
        last: &ContactState,
        slider_x: f64,
        next: &mut ContactState,
    ) -> Increment<'_> {
        next.reset_open(last, (slider_x, slider_x));
        self.no_increment()
    }

    /// An unchanged contact.
    fn unchanged(&mut self, last: &ContactState, next: &mut ContactState) -> Increment<'_> {
        next.clone_from(last);
        self.no_increment()
    }

    /// No wear, no energy, no residuals.
    fn no_increment(&mut self) -> Increment<'_> {
        self.recession = Sides::default();
        Increment {
            first: Sides::default(),
            path: &[],
            recession: self.recession.as_slices(),
            worn_area: Sides::default(),
            energy: 0.0,
            force_balance: 0.0,
            complementarity: 0.0,
            friction_cone: 0.0,
        }
    }

    fn solve_window(
        &mut self,
        pair: &Pair<'_>,
        surfaces: &Surfaces<'_>,
        last: &ContactState,
        (to, pairing_x): (Displacement, f64),
        (first, end): (usize, usize),
    ) -> Result<(), ContactError> {
        let (slider_x, cycles) = (to.slider_x, to.cycles);
        self.coupling.integrate(pair, pairing_x, first, end);
        self.slopes.assemble(pair, &self.coupling, surfaces);
        let (begin, stop) = self.coupling.master_range;
        let zones = pair.zones(last, first..end, begin..stop)?;
        let interface = &pair.interface;
        self.response
            .reset(zones, interface.slave, &self.coupling, &self.slopes, last);
        let laws = interface.wear.map(|law| law.filter(|_| cycles > 0.0));
        self.wear.assemble(&self.coupling, pair, laws, cycles);
        // Before the first load the spring has no reference height.
        let (spring, reference) = last
            .reference_height
            .map_or((0.0, 0.0), |height| (interface.spring, height));
        let load = interface.load - spring * reference;
        self.assemble_gap((pair, zones), surfaces, load, spring);
        self.add_lag(slider_x - pairing_x);
        let step = slider_x - last.slider_x + to.surface_slip;
        self.assemble_fixed_slip(step, last.height);
        let problem = Problem {
            pair,
            zones,
            coupling: &self.coupling,
            gap: &self.gap,
            width: &pair.slave().widths[first..end],
            slope: &self.slopes.receptacle,
            master_slope: &self.slopes.master,
            friction: interface.friction,
            load,
            spring,
            sag: &self.sag,
            fixed_slip: &self.fixed_slip,
            wears: laws.slider.is_some() || laws.receptacle.is_some(),
            travel: pair.travel(last, pairing_x),
            first_load: last.reference_height.is_none(),
            step,
        };
        let wall = problem.mean_slope_ahead(last);
        predict(&mut self.iterate, pair, last, &problem);
        let (newton, it) = (&mut self.newton, &mut self.iterate);
        let (response, wear) = (&mut self.response, &mut self.wear);
        // From no contact to all of it, one node at a time if need be.
        let single_changes = if problem.first_load {
            it.status.len()
        } else {
            0
        };
        let most = MOST_ITERATIONS + single_changes;
        let mut end = newton.solve(&problem, response, wear, it, most);
        if to.lemke && !matches!(end, Convergence::Converged) {
            end = self
                .complementarity
                .solve(newton, &problem, response, wear, it, end);
        }
        match end {
            Convergence::Converged => Ok(()),
            _ if wall * interface.friction > 1.0 => Err(ContactError::Jammed {
                slider_x_mm: slider_x,
                slope: wall,
                limit: interface.friction.recip(),
            }),
            Convergence::Singular { active } => Err(ContactError::NoEquilibrium {
                slider_x_mm: slider_x,
                active,
            }),
            Convergence::NotConverged { residual, changes } => Err(ContactError::NotConverged {
                slider_x_mm: slider_x,
                iterations: most,
                residual,
                tolerance: self.iterate.tolerance,
                changes,
            }),
        }
    }

    /// Gap of the worn bodies at height 0 under the far-face load there, and its change per height by that load's
    /// growth.
    fn assemble_gap(
        &mut self,
        (pair, zones): (&Pair<'_>, Zones<'_>),
        surfaces: &Surfaces<'_>,
        load: f64,
        spring: f64,
    ) {
        let coupling = &self.coupling;
        let slave = pair.interface.slave;
        let (own, other) = (surfaces.depth.of(slave), surfaces.depth.of(slave.other()));
        let slider = match slave {
            Side::Slider => zones.slave,
            Side::Receptacle => zones.master,
        };
        self.gap.clear();
        self.sag.clear();
        for (i, slope) in (coupling.first..coupling.end).zip(&self.slopes.master) {
            let (from, weights) = coupling.dual_row(i);
            let moved_by = |j: usize| {
                let [x, y] = slider.under_load(j);
                y - slope * x
            };
            let (mut worn, mut moved) = (0.0, 0.0);
            for (j, weight) in (from..).zip(weights) {
                worn += weight * other[j];
                if slave == Side::Receptacle {
                    moved += weight * moved_by(j);
                }
            }
            if slave == Side::Slider {
                moved = moved_by(i);
            }
            let shape = coupling.gap[i - coupling.first] + own[i];
            self.gap.push(shape + worn + load * moved);
            self.sag.push(spring * moved);
        }
    }

    /// Adds the gap that the master opens by its displacement beyond the pairing.
    fn add_lag(&mut self, lag: f64) {
        for (gap, slope) in self.gap.iter_mut().zip(&self.slopes.master) {
            *gap -= slope * lag;
        }
    }

    /// Slip of each node before the new forces and the new height are known, mm.
    fn assemble_fixed_slip(&mut self, step: f64, last_height: f64) {
        let places = self.slopes.receptacle.iter().zip(&self.response.last_jump);
        self.fixed_slip.clear();
        self.fixed_slip
            .extend(places.map(|(s, jump)| step - s * last_height - jump));
    }

    fn write(
        &mut self,
        pair: &Pair<'_>,
        last: &ContactState,
        position: (f64, f64),
        next: &mut ContactState,
    ) {
        let (coupling, it) = (&self.coupling, &self.iterate);
        let slave = pair.interface.slave;
        next.reset_open(last, position);
        next.height = it.height;
        next.indentation = it.indentation;
        let span = coupling.first..coupling.end;
        next.status[span.clone()].copy_from_slice(&it.status);
        next.pressure[span.clone()].copy_from_slice(&it.pressure);
        next.shear[span.clone()].copy_from_slice(&it.shear);
        for i in span {
            let width = pair.slave().widths[i];
            let (p, q, s) = (next.pressure[i], next.shear[i], self.slope_at(i));
            let force = [width * (-p * s - q), width * (p - q * s)];
            next.force.of_mut(slave)[2 * i..2 * i + 2].copy_from_slice(&force);
            let other = next.force.of_mut(slave.other());
            let (from, weights) = coupling.dual_row(i);
            for (offset, weight) in weights.iter().enumerate() {
                other[2 * (from + offset)] += weight * force[0];
                other[2 * (from + offset) + 1] += weight * force[1];
            }
        }
    }

    fn slope_at(&self, i: usize) -> f64 {
        self.slopes.receptacle[i - self.coupling.first]
    }

    fn report(&mut self, pair: &Pair<'_>, next: &ContactState) -> Increment<'_> {
        let (coupling, it) = (&self.coupling, &self.iterate);
        let slave = pair.interface.slave;
        let widths = &pair.slave().widths[coupling.first..coupling.end];
        let recession = &mut self.recession;
        let worn_area = self.wear.recession(coupling, pair, &it.path, recession);
        let energy = widths
            .iter()
            .zip(it.shear.iter().zip(&it.slip))
            .zip(&it.status)
            .filter(|(_, status)| status.direction() != 0.0)
            .map(|((d, (q, slip)), _)| d * (q * slip).abs())
            .sum();
        let forces = &next.force.of(slave)[2 * coupling.first..2 * coupling.end];
        let vertical: f64 = forces.iter().skip(1).step_by(2).sum();
        let load = next.equilibrium_load(&pair.interface);
        let peak = next.peak_pressure().max(f64::MIN_POSITIVE);
        // Round-off of longer lengths where these exceed the indentation.
        let scale = it.indentation.max(f64::MIN_POSITIVE) * it.tolerance / GAP_TOLERANCE;
        let (mut complementarity, mut cone) = (0.0_f64, 0.0_f64);
        for (i, status) in it.status.iter().enumerate() {
            let violation = if *status == Status::Open {
                -it.gap[i]
            } else {
                it.gap[i].abs()
            };
            complementarity = complementarity.max(violation);
            cone = cone.max(it.shear[i].abs() - pair.interface.friction * it.pressure[i]);
        }
        Increment {
            first: Sides::from_fn(|side| {
                if side == slave {
                    coupling.first
                } else {
                    coupling.master_range.0
                }
            }),
            path: &it.path,
            recession: self.recession.as_slices(),
            worn_area,
            energy,
            force_balance: (vertical - load).abs() / pair.interface.load,
            complementarity: complementarity / scale,
            friction_cone: cone / peak,
        }
    }
}

/// Whether a loaded contact does not move: another solve would only change its round-off.
fn is_at_rest(last: &ContactState, to: Displacement) -> bool {
    let distance = (to.slider_x - last.slider_x).abs() + to.surface_slip.abs();
    last.reference_height.is_some() && distance <= 0.0
}
