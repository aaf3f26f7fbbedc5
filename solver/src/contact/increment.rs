//! One increment of sliding: which nodes may touch, the solve, and what it transmits and wears.

use super::guess::guess;
use super::mortar::{self, Coupling};
use super::newton::{End, Iterate, Newton, Problem};
use super::pivoting::Pivoting;
use super::range::{first_range, lay_undeformed_gaps, watched, widened};
use super::recession::{WearTransfer, slider_recession};
use super::response::Response;
use super::{
    ContactError, ContactState, GAP_TOLERANCE, MOST_ITERATIONS, Move, Pair, Status, Surfaces,
};

/// How often the watched range may grow within one increment.
const MOST_EXTENSIONS: usize = 60;

/// Solves increments; keeps its buffers from one to the next.
#[derive(Default)]
pub struct Solver {
    coupling: Coupling,
    response: Response,
    transfer: WearTransfer,
    newton: Newton,
    pivoting: Pivoting,
    iterate: Iterate,
    /// Undeformed vertical gap at height 0 of every covered node, mm.
    undeformed: Vec<f64>,
    gap: Vec<f64>,
    sag: Vec<f64>,
    fixed_slip: Vec<f64>,
    recession: Vec<f64>,
}

/// What an increment did; arrays begin at `first`.
#[derive(Debug, Clone, Copy)]
pub struct Increment<'a> {
    /// First coupled node of the receptacle.
    pub first: usize,
    /// p |sigma| at the coupled nodes of the receptacle, MPa mm: vertical recession per k.
    pub path: &'a [f64],
    /// First coupled node of the slider.
    pub slider_first: usize,
    /// The same at the slider's nodes, MPa mm.
    pub slider_path: &'a [f64],
    /// Energy dissipated by friction, N/mm mm.
    pub energy: f64,
    /// |sum of vertical forces - load| over the load on the unworn contact.
    pub force_balance: f64,
    /// Largest gap of a closed node or penetration of an open one, over the indentation (and what round-off leaves
    /// of it).
    pub complementarity: f64,
    /// Largest |q| - mu p over the peak pressure.
    pub friction_cone: f64,
}

impl Solver {
    /// Makes a move; writes the new state to `next`.
    ///
    /// # Errors
    /// [`ContactError`]; `next` is then of no use.
    pub fn advance(
        &mut self,
        pair: &Pair<'_>,
        surfaces: &Surfaces<'_>,
        last: &ContactState,
        to: Move,
        next: &mut ContactState,
    ) -> Result<Increment<'_>, ContactError> {
        let slider_x = to.slider_x;
        if rests(last, to) {
            return Ok(self.rest(last, next));
        }
        let covered = mortar::covered(pair.operators, slider_x);
        if covered.0 == covered.1 || pair.interface.load <= 0.0 {
            return Ok(self.leave(last, slider_x, next));
        }
        lay_undeformed_gaps(pair, surfaces, slider_x, covered, &mut self.undeformed);
        let mut range = first_range(pair, last, slider_x, covered, &self.undeformed);
        for _ in 0..MOST_EXTENSIONS {
            self.solve_range(pair, surfaces, last, to, range)?;
            let (indentation, height) = (self.iterate.indentation, self.iterate.height);
            let needed = watched(&self.undeformed, covered.0, indentation, height);
            let wanted = (needed.0.min(range.0), needed.1.max(range.1));
            if wanted == range {
                self.write(pair, last, slider_x, next);
                return Ok(self.report(pair, next));
            }
            range = widened(wanted, covered);
        }
        Err(ContactError::NotConverged {
            slider_x_mm: slider_x,
            iterations: MOST_EXTENSIONS * MOST_ITERATIONS,
            residual: f64::INFINITY,
            tolerance: GAP_TOLERANCE,
            changes: range.1 - range.0,
        })
    }

    /// A contact that is not there: without a load, or where the stroke has taken the slider off the receptacle and a
    /// stop holds its height until it comes back.
    fn leave(
        &mut self,
        last: &ContactState,
        slider_x: f64,
        next: &mut ContactState,
    ) -> Increment<'_> {
        next.lift(last, slider_x);
        self.nothing()
    }

    /// A contact that stays as it is.
    fn rest(&mut self, last: &ContactState, next: &mut ContactState) -> Increment<'_> {
        next.clone_from(last);
        self.nothing()
    }

    /// No wear, and nothing that could be unbalanced.
    fn nothing(&mut self) -> Increment<'_> {
        self.iterate.path.clear();
        self.recession.clear();
        Increment {
            first: 0,
            path: &self.iterate.path,
            slider_first: 0,
            slider_path: &self.recession,
            energy: 0.0,
            force_balance: 0.0,
            complementarity: 0.0,
            friction_cone: 0.0,
        }
    }

    fn solve_range(
        &mut self,
        pair: &Pair<'_>,
        surfaces: &Surfaces<'_>,
        last: &ContactState,
        to: Move,
        (first, end): (usize, usize),
    ) -> Result<(), ContactError> {
        let (slider_x, cycles) = (to.slider_x, to.cycles);
        self.coupling
            .integrate(pair.operators, slider_x, first, end);
        self.response.begin(pair, &self.coupling, surfaces, last);
        let interface = &pair.interface;
        let kappa = [interface.receptacle_wear, interface.slider_wear].map(|k| k * cycles);
        let slider_widths = &pair.operators.slider.widths;
        self.transfer.lay(&self.coupling, slider_widths, kappa);
        // Before the first load there is no height that the spring counts from.
        let (spring, reference) = last
            .reference_height
            .map_or((0.0, 0.0), |height| (interface.spring, height));
        let load = interface.load - spring * reference;
        self.lay_gap(pair, surfaces, load, spring);
        let step = slider_x - last.slider_x + to.run;
        self.lay_fixed_slip(step, last.height);
        let problem = Problem {
            operators: pair.operators,
            coupling: &self.coupling,
            transfer: &self.transfer,
            gap: &self.gap,
            width: &pair.operators.receptacle.widths[first..end],
            slope: &surfaces.slope[first..end],
            friction: interface.friction,
            load,
            spring,
            sag: &self.sag,
            fixed_slip: &self.fixed_slip,
            wears: kappa[0] + kappa[1] > 0.0,
            travel: slider_x - last.slider_x,
            step,
        };
        guess(&mut self.iterate, pair, last, &problem);
        let (newton, it) = (&mut self.newton, &mut self.iterate);
        let response = &mut self.response;
        let mut end = newton.solve(&problem, response, it, MOST_ITERATIONS);
        if to.pivots && !matches!(end, End::Settled) {
            end = self.pivoting.solve(newton, &problem, response, it, end);
        }
        let wall = || wall_ahead(last, surfaces, &pair.operators.receptacle.widths, step);
        match end {
            End::Settled => Ok(()),
            _ if wall() * interface.friction > 1.0 => Err(ContactError::Jammed {
                slider_x_mm: slider_x,
                slope: wall(),
                limit: interface.friction.recip(),
            }),
            End::Singular { active } => Err(ContactError::NoEquilibrium {
                slider_x_mm: slider_x,
                active,
            }),
            End::Unsettled { residual, changes } => Err(ContactError::NotConverged {
                slider_x_mm: slider_x,
                iterations: MOST_ITERATIONS,
                residual,
                tolerance: self.iterate.tolerance,
                changes,
            }),
        }
    }

    /// Gap of the worn bodies at height 0, deformed by the far-face load that belongs to it, and what that load's
    /// growth with the height adds.
    fn lay_gap(&mut self, pair: &Pair<'_>, surfaces: &Surfaces<'_>, load: f64, spring: f64) {
        let coupling = &self.coupling;
        let response = &pair.operators.slider.load_response;
        self.gap.clear();
        self.sag.clear();
        for i in coupling.first..coupling.end {
            let (from, weights) = coupling.dual_row(i);
            let (mut worn, mut moved) = (0.0, 0.0);
            for (offset, weight) in weights.iter().enumerate() {
                let j = from + offset;
                worn += weight * surfaces.slider_depth[j];
                moved += weight * (response[2 * j + 1] - surfaces.slope[i] * response[2 * j]);
            }
            let shape = coupling.gap[i - coupling.first] + surfaces.receptacle_depth[i];
            self.gap.push(shape + worn + load * moved);
            self.sag.push(spring * moved);
        }
    }

    /// Slip of each node before the new forces and the new height are known, mm.
    fn lay_fixed_slip(&mut self, step: f64, last_height: f64) {
        let Response {
            slope, last_jump, ..
        } = &self.response;
        let places = slope.iter().zip(last_jump);
        self.fixed_slip.clear();
        self.fixed_slip
            .extend(places.map(|(s, jump)| step - s * last_height - jump));
    }

    fn write(
        &mut self,
        pair: &Pair<'_>,
        last: &ContactState,
        slider_x: f64,
        next: &mut ContactState,
    ) {
        let (coupling, it) = (&self.coupling, &self.iterate);
        next.lift(last, slider_x);
        next.height = it.height;
        next.indentation = it.indentation;
        let span = coupling.first..coupling.end;
        next.status[span.clone()].copy_from_slice(&it.status);
        next.pressure[span.clone()].copy_from_slice(&it.pressure);
        next.shear[span.clone()].copy_from_slice(&it.shear);
        for i in span {
            let width = pair.operators.receptacle.widths[i];
            let (p, q, s) = (next.pressure[i], next.shear[i], self.slope_at(i));
            let force = [width * (-p * s - q), width * (p - q * s)];
            next.receptacle_force[2 * i..2 * i + 2].copy_from_slice(&force);
            let (from, weights) = coupling.dual_row(i);
            for (offset, weight) in weights.iter().enumerate() {
                next.slider_force[2 * (from + offset)] += weight * force[0];
                next.slider_force[2 * (from + offset) + 1] += weight * force[1];
            }
        }
    }

    fn slope_at(&self, i: usize) -> f64 {
        self.response.slope[i - self.coupling.first]
    }

    fn report(&mut self, pair: &Pair<'_>, next: &ContactState) -> Increment<'_> {
        let (coupling, it) = (&self.coupling, &self.iterate);
        let widths = &pair.operators.receptacle.widths[coupling.first..coupling.end];
        slider_recession(
            coupling,
            &pair.operators.slider.widths,
            &it.path,
            &mut self.recession,
        );
        let energy = widths
            .iter()
            .zip(it.shear.iter().zip(&it.slip))
            .zip(&it.status)
            .filter(|(_, status)| status.direction() != 0.0)
            .map(|((d, (q, slip)), _)| d * (q * slip).abs())
            .sum();
        let vertical: f64 = next.receptacle_force.iter().skip(1).step_by(2).sum();
        let load = next.equilibrium_load(&pair.interface);
        let peak = next.peak_pressure().max(f64::MIN_POSITIVE);
        // Where lengths cancel, what round-off leaves of the indentation.
        let scale = (it.indentation * it.tolerance / GAP_TOLERANCE).max(f64::MIN_POSITIVE);
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
            first: coupling.first,
            path: &it.path,
            slider_first: coupling.slider_range.0,
            slider_path: &self.recession,
            energy,
            force_balance: (vertical - load).abs() / pair.interface.load,
            complementarity: complementarity / scale,
            friction_cone: cone / peak,
        }
    }
}

/// Whether a contact that is loaded already does not move at all: solving again would only stir its round-off.
fn rests(last: &ContactState, to: Move) -> bool {
    let way = (to.slider_x - last.slider_x).abs() + to.run.abs();
    last.reference_height.is_some() && way <= 0.0
}

/// Slope that the load stands on, in the mean; positive where the slider climbs it.
fn wall_ahead(contact: &ContactState, surfaces: &Surfaces<'_>, widths: &[f64], step: f64) -> f64 {
    let (mut load, mut moment) = (0.0, 0.0);
    let places = contact.pressure.iter().zip(widths).zip(surfaces.slope);
    for ((p, width), slope) in places {
        load += width * p;
        moment += width * p * slope;
    }
    if load > 0.0 {
        step.signum() * moment / load
    } else {
        0.0
    }
}
