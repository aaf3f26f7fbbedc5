//! One increment of sliding: the active window, the solve, and the increment's wear, energy and residuals.

use super::active_window::{candidates, initial_window, undeformed_gaps, widened};
use super::complementarity::Complementarity;
use super::deformation::Deformation;
use super::error::ContactError;
use super::friction::{self, Coefficient};
use super::geometry::{Geometry, Setting};
use super::mortar;
use super::newton::{Convergence, Newton};
use super::outcome::{self, Increment, Recession, Solution};
use super::pair::{Displacement, Pair, Surfaces, Zones};
use super::pairing;
use super::predictor::{predict, start_from};
use super::problem::{GAP_TOLERANCE, Iterate, MOST_ITERATIONS, Problem, mean_slope};
use super::response::Response;
use super::slip_along::{Imposed, SlipAlong, Slopes};
use super::state::ContactState;
use super::wear_coupling::WearCoupling;
use super::work::Work;
use crate::model::Tangential;
use crate::sides::Sides;

/// Most extensions of the active window within one increment.
const MOST_EXTENSIONS: usize = 60;

/// Solves increments; its buffers are reused from one to the next.
#[derive(Default)]
pub struct Solver {
    geometry: Geometry,
    /// Candidates beside the window.
    flank: Geometry,
    deformation: Deformation,
    response: Response,
    wear: WearCoupling,
    newton: Newton,
    complementarity: Complementarity,
    iterate: Iterate,
    /// Undeformed vertical gap at height 0 of every covered node, mm.
    undeformed: Vec<f64>,
    fixed_slip: Vec<f64>,
    /// Coefficients of friction of the coupled nodes where these differ, -.
    friction: Vec<f64>,
    along: SlipAlong,
    recession: Sides<Vec<f64>>,
    /// The window that these buffers are assembled for.
    assembled: Option<(usize, usize)>,
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
        to: Displacement<'_>,
        next: &mut ContactState,
    ) -> Result<Increment<'_>, ContactError> {
        let slider_x = to.slider_x;
        // Work of an increment without a solution does not count.
        self.newton.work = Work::default();
        self.response.entries = 0;
        if is_at_rest(last, to) {
            next.clone_from(last);
            return Ok(Increment::NONE);
        }
        let friction = if surfaces.has_uniform_friction() {
            pair.interface.friction
        } else {
            last.friction
        };
        let pairing_x = pairing::position(pair, last, slider_x, friction);
        let covered = mortar::covered(pair, pairing_x);
        if covered.0 == covered.1 || pair.interface.load <= 0.0 {
            // Without a load, or where the stroke has taken the slider off the receptacle and a stop holds its height until
            // it returns.
            next.reset_open(last, slider_x, slider_x);
            return Ok(Increment::NONE);
        }
        self.assembled = self.assembled.filter(|_| to.repeated);
        let setting = Setting::new(&pair.interface, last, slider_x, pairing_x, to.height);
        let mut window = self.assembled.unwrap_or_else(|| {
            undeformed_gaps(pair, surfaces, pairing_x, covered, &mut self.undeformed);
            initial_window(pair, last, pairing_x, covered, &self.undeformed)
        });
        for _ in 0..MOST_EXTENSIONS {
            self.solve_window(pair, surfaces, last, to, setting, window)?;
            outcome::write(self.solution(pair, surfaces), pair, last, setting, next);
            let touching = self.touching_beside(pair, surfaces, next, setting, window, covered)?;
            if touching == window {
                let mut work = std::mem::take(&mut self.newton.work);
                work.increments = 1;
                work.response_entries += std::mem::take(&mut self.response.entries);
                let (coupling, path) = (&self.geometry.coupling, &self.iterate.path);
                let depths = &mut self.recession;
                let area = self.wear.recession(coupling, pair, path, depths);
                let depth = self.recession.as_slices();
                let worn = Recession { depth, area };
                let solution = self.solution(pair, surfaces);
                let response = self.newton.response_to_height();
                let increment = Increment::of(solution, worn, pair, next, to, response, work);
                return Ok(increment);
            }
            window = widened(touching, covered);
        }
        Err(ContactError::NotConverged {
            slider_x_mm: slider_x,
            iterations: MOST_EXTENSIONS * MOST_ITERATIONS,
            residual: f64::INFINITY,
            tolerance: GAP_TOLERANCE,
            changes: window.1 - window.0,
        })
    }

    /// |sum of vertical forces - load| over the load on the unworn contact, with the normals of other surfaces than the
    /// contact was solved with.
    pub(crate) fn force_balance_on(
        &mut self,
        pair: &Pair<'_>,
        surfaces: &Surfaces<'_>,
        contact: &ContactState,
    ) -> f64 {
        if contact.active_range().is_none() {
            return 0.0;
        }
        let vertical = self.vertical_force_on(pair, surfaces, contact);
        (vertical - contact.equilibrium_load(&pair.interface)).abs() / pair.interface.load
    }

    /// Sum of the vertical forces on the slider, N/mm, with the normals of other surfaces than the contact was solved with.
    pub(crate) fn vertical_force_on(
        &mut self,
        pair: &Pair<'_>,
        surfaces: &Surfaces<'_>,
        contact: &ContactState,
    ) -> f64 {
        let Some((first, end)) = contact.active_range() else {
            return 0.0;
        };
        let (slider_x, pairing_x) = (contact.slider_x, contact.pairing_x);
        let setting = Setting::new(&pair.interface, contact, slider_x, pairing_x, None);
        self.flank.place(pair, surfaces, setting, first..end);
        let slopes = &self.flank.slopes.interface;
        (first..end)
            .zip(slopes)
            .map(|(i, slope)| {
                let shear = match pair.interface.tangential {
                    Tangential::Omitted => 0.0,
                    Tangential::ImposedSlip | Tangential::StickSlip => contact.shear[i],
                };
                pair.slave().widths[i] * (contact.pressure[i] - shear * slope)
            })
            .sum()
    }

    /// The last solution over the window.
    fn solution(&self, pair: &Pair<'_>, surfaces: &Surfaces<'_>) -> Solution<'_> {
        let directions = &self.along.directions;
        Solution {
            geometry: &self.geometry,
            iterate: &self.iterate,
            friction: Coefficient::of(pair, surfaces, &self.friction, directions),
        }
    }

    /// The window with the candidates beside it that the bodies' deformation lets touch.
    fn touching_beside(
        &mut self,
        pair: &Pair<'_>,
        surfaces: &Surfaces<'_>,
        next: &ContactState,
        setting: Setting,
        window: (usize, usize),
        covered: (usize, usize),
    ) -> Result<(usize, usize), ContactError> {
        let it = &self.iterate;
        let slave = pair.interface.slave;
        let needed = candidates(&self.undeformed, covered.0, it.indentation, it.height);
        let mut touching = window;
        for flank in [needed.0..window.0, window.1..needed.1] {
            if flank.is_empty() {
                continue;
            }
            let geometry = &mut self.flank;
            geometry.place(pair, surfaces, setting, flank.clone());
            let (begin, stop) = geometry.coupling.master_range;
            let zones = pair.zones(next, flank.clone(), begin..stop)?;
            geometry.measure(pair, zones, surfaces, setting);
            self.deformation
                .under_contact(zones, slave, &geometry.coupling, next);
            let moved = self.deformation.averaged(&geometry.coupling);
            for ((node, [x, y]), slope) in flank.zip(moved).zip(&geometry.slopes.master) {
                let at = node - geometry.coupling.first;
                let raised = (1.0 + geometry.sag[at]) * it.height;
                let gap = geometry.gap[at] + raised + y - slope * x;
                if gap < -it.tolerance * it.indentation {
                    touching = (touching.0.min(node), touching.1.max(node + 1));
                }
            }
        }
        Ok(touching)
    }

    fn solve_window(
        &mut self,
        pair: &Pair<'_>,
        surfaces: &Surfaces<'_>,
        last: &ContactState,
        to: Displacement<'_>,
        setting: Setting,
        (first, end): (usize, usize),
    ) -> Result<(), ContactError> {
        let (slider_x, cycles) = (to.slider_x, to.cycles);
        let interface = &pair.interface;
        let tracks_slip = interface.tangential == Tangential::StickSlip;
        let step = to.across(last.slider_x);
        let wear = interface.wear.map(|wear| wear.filter(|_| cycles > 0.0));
        let is_assembled = self.assembled == Some((first, end));
        if !is_assembled {
            self.geometry.place(pair, surfaces, setting, first..end);
        }
        let (begin, stop) = self.geometry.coupling.master_range;
        let zones = pair.zones(last, first..end, begin..stop)?;
        if !is_assembled {
            let geometry = &mut self.geometry;
            geometry.measure(pair, zones, surfaces, setting);
            self.response.reset(geometry.coupling.len(), tracks_slip);
            self.wear
                .assemble(&geometry.coupling, pair, &wear, surfaces.depth, cycles);
            self.assemble_fixed_slip(pair, zones, last, step);
            self.assembled = Some((first, end));
        }
        let geometry = &self.geometry;
        let (pairing_x, coefficients) = (setting.pairing_x, &mut self.friction);
        friction::interpolate(pair, surfaces, pairing_x, first..end, coefficients);
        let width = &pair.slave().widths[first..end];
        let slope = &geometry.slopes.interface;
        let mean = mean_slope(&last.pressure[first..end], width, slope);
        let (across, along) = (step, to.along);
        self.along
            .impose(Imposed { across, along }, Slopes { nodes: slope, mean });
        let along = &self.along;
        let friction = Coefficient::of(pair, surfaces, &self.friction, &along.directions);
        let problem = Problem {
            pair,
            zones,
            coupling: &geometry.coupling,
            gap: &geometry.gap,
            width,
            slope,
            master_slope: &geometry.slopes.master,
            friction: friction::acting(interface, friction, step),
            tracks_slip,
            load: setting.load,
            spring: setting.spring,
            sag: &geometry.sag,
            fixed_slip: &self.fixed_slip,
            wears: wear.slider.is_some() || wear.receptacle.is_some(),
            travel: pair.travel(last, setting.pairing_x),
            first_load: last.reference_height.is_none(),
            step,
            along: &along.slip,
            height: to.height,
        };
        // Positive where the slider climbs it.
        let wall = step.signum() * mean;
        predict(&mut self.iterate, pair, last, &problem);
        if let Some(start) = to.start {
            start_from(&mut self.iterate, first, start);
        }
        let (newton, it) = (&mut self.newton, &mut self.iterate);
        let (response, wear) = (&mut self.response, &mut self.wear);
        // From no contact to all of it, one node at a time if need be.
        let single_changes = if problem.first_load {
            it.status.len()
        } else {
            0
        };
        let most = MOST_ITERATIONS + single_changes;
        let mut end = newton.solve(&problem, response, wear, it, most, is_assembled);
        if to.lemke && !matches!(end, Convergence::Converged) {
            end = self
                .complementarity
                .solve(newton, &problem, response, wear, it, end);
        }
        match end {
            Convergence::Converged => {
                if to.height.is_some() {
                    self.newton.respond_to_height(&problem, &self.iterate);
                }
                if interface.tangential == Tangential::Omitted && step != 0.0 {
                    self.iterate.apply_friction(friction);
                }
                Ok(())
            }
            _ if wall * problem.friction.largest() > 1.0 => Err(ContactError::Jammed {
                slider_x_mm: slider_x,
                slope: wall,
                limit: problem.friction.largest().recip(),
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

    /// Slip of each node before the new forces and the new height are known, mm: less the tangential jump that the last
    /// forces would make at the new position where the deformation is part of the slip.
    fn assemble_fixed_slip(
        &mut self,
        pair: &Pair<'_>,
        zones: Zones<'_>,
        last: &ContactState,
        step: f64,
    ) {
        let Geometry {
            coupling, slopes, ..
        } = &self.geometry;
        let slave = pair.interface.slave;
        self.fixed_slip.clear();
        if pair.interface.tangential != Tangential::StickSlip {
            let slopes = slopes.interface.iter();
            self.fixed_slip
                .extend(slopes.map(|s| step - s * last.height));
            return;
        }
        self.deformation.under_contact(zones, slave, coupling, last);
        let jumps = self.deformation.averaged(coupling).zip(&slopes.interface);
        self.fixed_slip
            .extend(jumps.map(|([x, y], s)| step - s * last.height - (x + s * y)));
    }
}

/// Returns `true` if a loaded contact does not move: another solve would only change its round-off.
fn is_at_rest(last: &ContactState, to: Displacement<'_>) -> bool {
    let distance = (to.slider_x - last.slider_x).abs() + to.surface_slip.abs() + to.along.abs();
    last.reference_height.is_some() && to.height.is_none() && distance <= 0.0
}
