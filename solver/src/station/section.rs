//! A station: the plane contact of its section, and what that has worn.

mod worn;

use std::sync::Arc;

use super::meshed::Section;
use super::place::Place;
use super::state::StationState;
use crate::ale::Spines;
use crate::along_line::SectionsIncrement;
use crate::contact::{
    self, ContactError, ContactState, Displacement, Pair, Solver, Surfaces, WarmStart,
    slopes_of_both,
};
use crate::cycle::{Neutral, wear_limit};
use crate::law::friction::Coefficients;
use crate::law::friction::contact::{ContactFriction, CycleFriction};
use crate::model::{Interface, Tangential};
use crate::schedule::plan::Cycles;
use crate::sides::{Side, Sides};

/// A solved increment that is not part of the state yet.
#[derive(Debug, Default)]
pub(super) struct Attempt {
    /// Vertical force on the slider, N/mm, and its change per height, N/mm per mm.
    pub(super) line_load: f64,
    pub(super) load_per_height: f64,
    /// Change of the pressures per height, from a node on, MPa/mm.
    first_pressure: usize,
    pressure_per_height: Vec<f64>,
    /// First worn node of each side, and the recession from there on, mm.
    first: Sides<usize>,
    recession: Sides<Vec<f64>>,
    worn_area: Sides<f64>,
    path: f64,
    energy: f64,
    /// Friction along the line, as a force along the motion, N/mm.
    friction_along: f64,
    /// Of the balance of forces, of complementarity and of the friction cone.
    residuals: [f64; 3],
}

/// A station.
pub(super) struct Station {
    pub(super) place: Place,
    pub(super) section: Arc<Section>,
    pub(super) state: StationState,
    pub(super) attempt: Attempt,
    spines: Spines,
    interface: Interface,
    slope: Sides<Vec<f64>>,
    /// Coefficients of the present computed cycle.
    friction: CycleFriction,
    solver: Solver,
    next: ContactState,
}

impl Station {
    /// A station in a state, on the unworn section.
    pub(super) fn new(place: Place, section: &Arc<Section>, state: StationState) -> Self {
        let model = &section.model;
        Self {
            place,
            section: Arc::clone(section),
            spines: Spines::of(model),
            interface: model.interface,
            attempt: Attempt::default(),
            slope: Sides::default(),
            friction: CycleFriction::default(),
            solver: Solver::default(),
            next: ContactState::untouched(&section.condensed.operators, model.interface.slave),
            state,
        }
    }

    fn pair(&self) -> Pair<'_> {
        Pair {
            operators: &self.section.condensed.operators,
            interface: self.interface,
        }
    }

    /// Takes the normals and the friction of the surfaces as worn now, in so many cycles.
    pub(super) fn update_surfaces(&mut self, friction: &ContactFriction, cycles: Cycles) {
        let depth = &self.state.depth;
        self.slope = slopes_of_both(&self.section.condensed.operators, depth);
        self.friction = friction.in_cycles(depth, cycles.range());
        self.interface.friction = self.friction.coefficient;
    }

    /// Lets friction hold the section together where nothing is imposed that could slip.
    pub(super) fn hold(&mut self) {
        if self.interface.friction > 0.0 {
            self.interface.tangential = Tangential::StickSlip;
        }
    }

    /// Lets the section slip as it is displaced.
    pub(super) fn release(&mut self) {
        self.interface.tangential = self.section.model.interface.tangential;
    }

    /// Solves an increment from the state, under the load of the section or at a height in mm. After another one of the same
    /// displacement `raised` by a height in mm, its contact is the predictor.
    ///
    /// # Errors
    /// [`ContactError`] if it has no solution or wears too much.
    pub(super) fn solve(
        &mut self,
        increment: SectionsIncrement,
        height: Option<f64>,
        raised: Option<f64>,
    ) -> Result<(), ContactError> {
        let earlier = raised.map(|by| self.predicted(by));
        let like = increment.start.filter(|_| earlier.is_none());
        let starts = std::mem::take(&mut self.state.warm_starts);
        let start = match &earlier {
            Some((first, contact)) => Some(WarmStart {
                first: *first,
                status: &contact.0,
                pressure: &contact.1,
            }),
            None => like.and_then(|number| starts.of(number)),
        };
        let mut solved = self.advance(increment, height, start, raised.is_some());
        if solved.is_err() && start.is_some() {
            solved = self.advance(increment, height, None, false);
        }
        self.state.warm_starts = starts;
        solved
    }

    /// The contact of the last attempt, raised by a height: first node, statuses and pressures from there on.
    fn predicted(&self, by: f64) -> (usize, (Vec<contact::Status>, Vec<f64>)) {
        let contact = &self.next;
        let (first, end) = contact.active_range().unwrap_or_default();
        let per_height = |node: usize| {
            let from_first = node.checked_sub(self.attempt.first_pressure);
            let change = from_first.and_then(|i| self.attempt.pressure_per_height.get(i));
            change.copied().unwrap_or(0.0)
        };
        let pressures = (first..end).map(|i| (contact.pressure[i] + by * per_height(i)).max(0.0));
        (
            first,
            (contact.status[first..end].to_vec(), pressures.collect()),
        )
    }

    fn advance(
        &mut self,
        increment: SectionsIncrement,
        height: Option<f64>,
        start: Option<WarmStart<'_>>,
        repeated: bool,
    ) -> Result<(), ContactError> {
        let moved = self.place.displaced(increment.from, increment.to);
        let to = Displacement {
            slider_x: moved.slider_x,
            surface_slip: moved.surface_slip,
            along: moved.along,
            height,
            repeated,
            cycles: increment.cycles,
            lemke: increment.lemke,
            start,
        };
        let section = Arc::clone(&self.section);
        let pair = Pair {
            operators: &section.condensed.operators,
            interface: self.interface,
        };
        let surfaces = Surfaces {
            depth: self.state.depth.as_slices(),
            slope: self.slope.as_slices(),
            friction: self.friction.nodal(),
        };
        let done =
            self.solver
                .advance(&pair, &surfaces, &self.state.contact, to, &mut self.next)?;
        wear_limit::check(
            &self.spines,
            &self.state.depth,
            to.slider_x,
            done.first,
            done.recession,
        )?;
        self.state.work += done.work;
        let attempt = &mut self.attempt;
        let slave = self.interface.slave;
        attempt.residuals = [done.force_balance, done.complementarity, done.friction_cone];
        attempt.line_load = done.vertical_force;
        attempt.load_per_height = done.force_per_height;
        attempt.first_pressure = *done.first.of(slave);
        attempt.pressure_per_height.clear();
        attempt
            .pressure_per_height
            .extend_from_slice(done.pressure_per_height);
        attempt.first = done.first;
        attempt.worn_area = done.worn_area;
        let widths = &pair.slave().widths[*done.first.of(slave)..];
        let path: f64 = done.path.iter().zip(widths).map(|(e, d)| e * d).sum();
        attempt.path = increment.cycles * path;
        let [_, sin] = self.place.direction();
        attempt.friction_along = sin * done.friction_along * moved.along.signum();
        attempt.energy = increment.cycles * done.energy;
        for side in Side::BOTH {
            let recession = attempt.recession.of_mut(side);
            recession.clear();
            recession.extend_from_slice(done.recession.of(side));
        }
        Ok(())
    }

    /// Makes the last attempt part of the state.
    pub(super) fn accept(&mut self) {
        let (state, attempt) = (&mut self.state, &self.attempt);
        for side in Side::BOTH {
            *state.worn_area.of_mut(side) += attempt.worn_area.of(side);
            let depths = &mut state.depth.of_mut(side)[*attempt.first.of(side)..];
            for (depth, recession) in depths.iter_mut().zip(attempt.recession.of(side)) {
                *depth += recession;
            }
        }
        state.path += attempt.path;
        state.energy += attempt.energy;
        let [force_balance, complementarity, friction_cone] = attempt.residuals;
        let checks = &mut state.checks;
        checks.force_balance = checks.force_balance.max(force_balance);
        checks.complementarity = checks.complementarity.max(complementarity);
        checks.friction_cone = checks.friction_cone.max(friction_cone);
        std::mem::swap(&mut state.contact, &mut self.next);
        if state.contact.friction > 0.0 {
            let operators = &self.section.condensed.operators;
            let widths = &operators.of(self.interface.slave).widths;
            let used = state.contact.friction_use(widths);
            state.checks.friction_use = state.checks.friction_use.max(used);
        }
    }

    /// Height of the slider in the last attempt, mm.
    pub(super) fn attempted_height(&self) -> f64 {
        self.next.height
    }

    /// Indentation of the last attempt, mm.
    pub(super) fn attempted_indentation(&self) -> f64 {
        self.next.indentation
    }

    /// Records that the first load is applied.
    pub(super) fn loaded(&mut self) {
        let contact = &mut self.state.contact;
        contact.reference_height = Some(contact.height);
        self.state.mean_half_width = self.half_width();
        self.state.unworn_half_width = self.state.mean_half_width;
        self.state.neutral = self.present();
    }

    /// The contact of the present increment.
    pub(super) fn present(&self) -> Neutral {
        Neutral {
            load: self.attempt.line_load,
            friction: self.mean_coefficient(),
            ..Neutral::of(&self.state.contact, &self.pair())
        }
    }

    /// Coefficients of friction at the nodes of the present contact from the first that touches to the last, -.
    pub(super) fn coefficients(&self) -> Vec<f64> {
        let surfaces = Surfaces {
            depth: self.state.depth.as_slices(),
            slope: self.slope.as_slices(),
            friction: self.friction.nodal(),
        };
        contact::coefficients_in_contact(&self.pair(), &surfaces, &self.state.contact)
    }

    /// Mean coefficient of friction of the present contact, weighted by the pressures; that of the interface where nothing touches.
    fn mean_coefficient(&self) -> f64 {
        let contact = &self.state.contact;
        let Some((first, end)) = contact.active_range() else {
            return self.interface.friction;
        };
        let widths = &self.pair().slave().widths[first..end];
        let pressures = contact.pressure[first..end].iter().zip(widths);
        let forces = pressures.map(|(pressure, width)| pressure * width);
        Coefficients::Local(&self.coefficients()).mean(forces)
    }

    /// Normal load of the present contact under an even top, which a spring reduces, N/mm.
    pub(super) fn load(&self) -> f64 {
        self.state.contact.load(&self.interface)
    }

    /// Force of the slider on the receptacle along the motion in the present increment, N/mm.
    pub(super) fn force_along_motion(&self) -> f64 {
        let widths = &self.pair().slave().widths;
        let across = self.state.contact.tangential_force(&self.interface, widths);
        let [cos, _] = self.place.direction();
        cos * across + self.attempt.friction_along
    }

    /// Vertical force on the slider of the present contact with the normals of the surfaces as worn now, N/mm.
    pub(super) fn force_with_present_normals(&mut self) -> f64 {
        let section = Arc::clone(&self.section);
        let operators = &section.condensed.operators;
        let depth = &self.state.depth;
        let slope = slopes_of_both(operators, depth);
        let surfaces = Surfaces {
            depth: depth.as_slices(),
            slope: slope.as_slices(),
            friction: Sides::default(),
        };
        let pair = Pair {
            operators,
            interface: self.interface,
        };
        self.solver
            .vertical_force_on(&pair, &surfaces, &self.state.contact)
    }

    /// Half-width of the present contact, mm.
    pub(super) fn half_width(&self) -> f64 {
        self.state.contact.half_width(&self.pair().slave().x)
    }
}
