//! One increment of sliding in all planes: the active window, the solve, and what it wears.

use super::super::line::active_window::{candidates, undeformed_gaps, widened};
use super::super::line::mortar;
use super::super::line::{ContactError, ContactState, GAP_TOLERANCE, Pair, Status, Surfaces};
use super::bodies::{Extruded, Slide};
use super::iterate::Iterate;
use super::newton::{Convergence, Newton};
use super::predictor::{moved, start_from};
use super::problem::{Problem, Zones};
use super::response::Response;
use super::wear::PlanesWear;
use crate::sides::{Side, Sides};

/// Most extensions of the active window within one increment.
const MOST_EXTENSIONS: usize = 60;

/// Wear of an increment in one plane; arrays begin at the first coupled node of their side.
#[derive(Debug, Clone, Default, PartialEq)]
pub(crate) struct PlaneWear {
    /// First coupled node of each side.
    pub first: Sides<usize>,
    /// Vertical recession at the nodes from there on, mm.
    pub recession: Sides<Vec<f64>>,
    /// Integral of the wear rate over the contact, mm^2.
    pub worn_area: Sides<f64>,
    /// Integral of p |sigma| over the contact, N/mm mm.
    pub path: f64,
    /// Energy dissipated by friction, N/mm mm.
    pub energy: f64,
    /// Vertical force on the slider, N/mm.
    pub vertical_force: f64,
}

/// How an increment was solved.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct Solved {
    /// Newton iterations.
    pub iterations: usize,
    /// Factorised equations: closed nodes of all planes and the height.
    pub unknowns: usize,
    /// |load - vertical force| over the load.
    pub imbalance: f64,
    /// Largest gap of a closed node over the indentation.
    pub residual: f64,
}

/// Solves increments; its buffers are reused from one to the next.
#[derive(Default)]
pub(crate) struct ExtrudedSolver {
    problem: Problem,
    wear: PlanesWear,
    response: Response,
    newton: Newton,
    iterate: Iterate,
    /// Undeformed vertical gap at height 0 of every covered node of each plane, mm.
    undeformed: Vec<Vec<f64>>,
    path: Vec<f64>,
}

impl ExtrudedSolver {
    /// Solves the increment to a displacement; writes the new contacts to `next` and the wear of the planes to `worn`.
    ///
    /// # Errors
    /// [`ContactError`]; `next` and `worn` are then undefined.
    pub(crate) fn advance(
        &mut self,
        bodies: &Extruded<'_>,
        surfaces: &[Surfaces<'_>],
        last: &[ContactState],
        to: Slide<'_>,
        next: &mut [ContactState],
        worn: &mut [PlaneWear],
    ) -> Result<Solved, ContactError> {
        let pair = &bodies.pair();
        self.newton.iterations = 0;
        let covered = mortar::covered(pair, to.slider_x);
        if covered.0 == covered.1 {
            // A stop holds the height of a slider that its stroke has taken off the receptacle.
            for ((next, last), worn) in next.iter_mut().zip(last).zip(worn) {
                next.reset_open(last, to.slider_x, to.slider_x);
                *worn = PlaneWear::default();
            }
            return Ok(Solved::default());
        }
        self.undeformed.resize_with(surfaces.len(), Vec::new);
        for (surfaces, gaps) in surfaces.iter().zip(&mut self.undeformed) {
            undeformed_gaps(pair, surfaces, to.slider_x, covered, gaps);
        }
        let mut window = self.first_window(pair, last, to, covered);
        let mut earlier: Option<(usize, usize)> = None;
        for _ in 0..MOST_EXTENSIONS {
            self.problem
                .assemble(bodies, surfaces, last, to, window, &mut self.wear);
            match earlier {
                Some(earlier) => self.extend(earlier, window, surfaces.len()),
                None => self.predict(pair, last, to),
            }
            self.solve(bodies, to)?;
            let it = &self.iterate;
            let needed = self.candidates(it.indentation, it.height, covered);
            if needed.0 >= window.0 && needed.1 <= window.1 {
                self.write(pair, last, to, next, worn);
                let it = &self.iterate;
                return Ok(Solved {
                    iterations: self.newton.iterations,
                    unknowns: it.is_closed.iter().filter(|closed| **closed).count() + 1,
                    imbalance: it.balance(&self.problem).abs() / self.problem.full_load,
                    residual: it.residual,
                });
            }
            earlier = Some(window);
            let all = (needed.0.min(window.0), needed.1.max(window.1));
            window = widened(all, covered);
        }
        Err(ContactError::NotConverged {
            slider_x_mm: to.slider_x,
            iterations: self.newton.iterations,
            residual: f64::INFINITY,
            tolerance: GAP_TOLERANCE,
            changes: window.1 - window.0,
        })
    }

    /// Nodes that may touch in a plane: first and one past the last; empty ranges are reversed.
    fn candidates(&self, indentation: f64, height: f64, covered: (usize, usize)) -> (usize, usize) {
        let planes = self.undeformed.iter();
        let planes = planes.map(|gaps| candidates(gaps, covered.0, indentation, height));
        planes.fold((usize::MAX, 0), |all, own| {
            (all.0.min(own.0), all.1.max(own.1))
        })
    }

    /// The first window: the last contacts, moved with the slider over the receptacle, and the candidates at the last height.
    fn first_window(
        &self,
        pair: &Pair<'_>,
        last: &[ContactState],
        to: Slide<'_>,
        covered: (usize, usize),
    ) -> (usize, usize) {
        let x = &pair.slave().x;
        let travel = pair.travel(&last[0], to.slider_x);
        let mut window = (usize::MAX, 0);
        for contact in last {
            let Some((first, end)) = contact.active_range() else {
                continue;
            };
            let begin = x.partition_point(|&at| at < x[first] + travel);
            let stop = x.partition_point(|&at| at <= x[end - 1] + travel);
            let begin = begin.clamp(covered.0, covered.1 - 1);
            let stop = stop.clamp(begin + 1, covered.1);
            window = (window.0.min(begin), window.1.max(stop));
        }
        if window.0 < window.1 {
            let near = self.candidates(last[0].indentation, last[0].height, covered);
            window = (window.0.min(near.0), window.1.max(near.1));
        } else {
            let gaps = self
                .undeformed
                .iter()
                .flat_map(|gaps| gaps.iter().enumerate());
            let lowest = gaps.fold(
                (0, f64::INFINITY),
                |m, (i, g)| if *g < m.1 { (i, *g) } else { m },
            );
            window = (covered.0 + lowest.0, covered.0 + lowest.0 + 1);
        }
        widened(window, covered)
    }

    /// Writes the predictor of the iteration.
    fn predict(&mut self, pair: &Pair<'_>, last: &[ContactState], to: Slide<'_>) {
        let (first, n) = (self.problem.coupling.first, self.problem.nodes());
        let it = &mut self.iterate;
        it.reset(self.problem.len(), last[0].height);
        for (plane, contact) in last.iter().enumerate() {
            let range = plane * n..(plane + 1) * n;
            let (closed, pressure) = (&mut it.is_closed[range.clone()], &mut it.pressure[range]);
            match to.starts.map(|starts| starts[plane]) {
                Some(start) => start_from(closed, pressure, first, start),
                None => moved(pair, contact, to.slider_x, closed, pressure, first),
            }
        }
        if it.is_closed.iter().all(|closed| !closed) {
            it.is_closed.fill(true);
        }
    }

    /// Widens the last iterate to another window: the nodes that are new are open.
    fn extend(&mut self, from: (usize, usize), to: (usize, usize), planes: usize) {
        let (before, after) = (from.1 - from.0, to.1 - to.0);
        let it = &mut self.iterate;
        let closed = std::mem::take(&mut it.is_closed);
        let pressure = std::mem::take(&mut it.pressure);
        it.reset(planes * after, it.height);
        for plane in 0..planes {
            let begin = plane * after + from.0 - to.0;
            let (old, new) = (plane * before..(plane + 1) * before, begin..begin + before);
            it.is_closed[new.clone()].copy_from_slice(&closed[old.clone()]);
            it.pressure[new].copy_from_slice(&pressure[old]);
        }
    }

    fn solve(&mut self, bodies: &Extruded<'_>, to: Slide<'_>) -> Result<(), ContactError> {
        let (interface, coupling) = (&bodies.interface, &self.problem.coupling);
        let zone = |side: Side, (first, end): (usize, usize)| {
            let zone = bodies.operators.zone(side, &(first..end));
            zone.ok_or_else(|| ContactError::WiderThanZone {
                slider_x_mm: to.slider_x,
                nodes: end - first,
                body: side.name(),
                zone: (bodies.operators.zones.of(side).iter())
                    .map(|zone| zone.nodes().len())
                    .max()
                    .unwrap_or(0),
            })
        };
        let zones = Zones {
            slave: zone(interface.slave, (coupling.first, coupling.end))?,
            master: zone(interface.slave.other(), coupling.master_range)?,
        };
        self.problem.sag(zones, interface.slave);
        self.response.reset(self.problem.len());
        let friction = self.problem.friction;
        let wall = self.problem.mean_slope_ahead(&self.iterate.pressure) * friction;
        let (problem, it) = (&self.problem, &mut self.iterate);
        let (newton, response) = (&mut self.newton, &mut self.response);
        let (wear, pair) = (&mut self.wear, &bodies.pair());
        match newton.solve(problem, zones, response, wear, pair, it) {
            Convergence::Converged => Ok(()),
            _ if wall > 1.0 => Err(ContactError::Jammed {
                slider_x_mm: to.slider_x,
                slope: wall / friction,
                limit: friction.recip(),
            }),
            Convergence::Singular { active } => Err(ContactError::NoEquilibrium {
                slider_x_mm: to.slider_x,
                active,
            }),
            Convergence::NotConverged { residual, changes } => Err(ContactError::NotConverged {
                slider_x_mm: to.slider_x,
                iterations: newton.iterations,
                residual,
                tolerance: it.tolerance,
                changes,
            }),
        }
    }

    /// Writes the solution to the contacts of the planes, and what it wears.
    fn write(
        &mut self,
        pair: &Pair<'_>,
        last: &[ContactState],
        to: Slide<'_>,
        next: &mut [ContactState],
        worn: &mut [PlaneWear],
    ) {
        let (problem, it) = (&self.problem, &self.iterate);
        let (coupling, n) = (&problem.coupling, problem.nodes());
        let slave = pair.interface.slave;
        let slipping = Status::slip(problem.direction);
        let widths = &pair.slave().widths[coupling.first..coupling.end];
        let planes = next.iter_mut().zip(last).zip(worn).enumerate();
        for (k, ((next, last), worn)) in planes {
            next.reset_open(last, to.slider_x, to.slider_x);
            next.height = it.height;
            next.indentation = it.indentation;
            let own = k * n..(k + 1) * n;
            let status = |closed: &bool| if *closed { slipping } else { Status::Open };
            let statuses: Vec<Status> = it.is_closed[own.clone()].iter().map(status).collect();
            next.set_statuses(coupling.first, &statuses);
            let pressure = &it.pressure[own.clone()];
            next.pressure[coupling.first..coupling.end].copy_from_slice(pressure);
            let friction = problem.coefficients(k);
            let shears = next.shear[coupling.first..].iter_mut().zip(pressure);
            for (node, (shear, p)) in shears.enumerate() {
                *shear = problem.direction * friction.at(node) * p;
            }
            next.friction = friction.mean(pressure.iter().zip(widths).map(|(p, width)| p * width));
            problem.write_forces(k, pressure, slave, next);
            self.path.clear();
            self.path.extend_from_slice(&it.path[own.clone()]);
            worn.first = Sides::from_fn(|side| {
                if side == slave {
                    coupling.first
                } else {
                    coupling.master_range.0
                }
            });
            worn.worn_area =
                self.wear
                    .of(k)
                    .recession(coupling, pair, &self.path, &mut worn.recession);
            let paths = self.path.iter().zip(widths).map(|(e, d)| e * d);
            worn.path = paths.clone().sum();
            worn.energy = (problem.direction * friction.mean(paths)).abs() * worn.path;
            let forces = pressure.iter().zip(&problem.force[own]);
            worn.vertical_force = forces.map(|(p, force)| p * force[1]).sum();
        }
    }
}
