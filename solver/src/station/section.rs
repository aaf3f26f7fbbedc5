//! A station: the plane contact of its section, and what that has worn.

use std::borrow::Cow;
use std::sync::Arc;

use super::error::StationError;
use super::place::Place;
use super::state::StationState;
use crate::ale::{self, Spines};
use crate::condensation::{self, Condensed};
use crate::contact::{
    self, ContactError, ContactState, Displacement, Pair, Solver, Surfaces, WarmStart,
};
use crate::cycle::{Neutral, wear_limit};
use crate::law::surface::{self, SurfaceWear};
use crate::law::wear::LocalState;
use crate::model::{Interface, Model};
use crate::scene::Accuracy;
use crate::sides::{Side, Sides};

/// Factor by which zones become wider where a contact has outgrown them.
const WIDER: f64 = 2.0;

/// A meshed section with its operators.
pub(super) struct Section {
    pub(super) model: Model,
    pub(super) condensed: Condensed,
    /// Worn depths that it was meshed at, mm, and the width of its zones over that of the layout.
    built: Option<Sides<Vec<f64>>>,
    widened: f64,
}

impl Section {
    /// The unworn section.
    ///
    /// # Errors
    /// [`StationError`] if it cannot be condensed.
    pub(super) fn unworn(model: Model) -> Result<Self, StationError> {
        Ok(Self {
            condensed: condensation::condense(&model)?,
            model,
            built: None,
            widened: 1.0,
        })
    }

    /// The section at the geometry that a state was computed with, from the unworn one.
    fn of(unworn: &Model, state: &StationState) -> Result<Self, StationError> {
        let model = match &state.built {
            None => unworn.clone(),
            Some(depth) => ale::relocate(unworn, depth)?,
        };
        let model = model.with_zones_widened(state.widened)?;
        Ok(Self {
            condensed: condensation::condense(&model)?,
            model,
            built: state.built.clone(),
            widened: state.widened,
        })
    }

    /// Whether it is at the geometry that a state was computed with.
    fn is_of(&self, state: &StationState) -> bool {
        self.built == state.built && self.widened.to_bits() == state.widened.to_bits()
    }
}

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

/// One increment of all stations.
#[derive(Debug, Clone, Copy)]
pub(super) struct Increment {
    /// Displacement of the slider before and after it, mm.
    pub(super) from: f64,
    pub(super) to: f64,
    /// Cycles that it stands for.
    pub(super) cycles: f64,
    /// Whether Lemke's method is tried.
    pub(super) lemke: bool,
    /// Number of the increment in its cycle and their number, if the last cycle has one like it to start from.
    pub(super) like: Option<(usize, usize)>,
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
    solver: Solver,
    next: ContactState,
}

impl Station {
    /// A station in a state, on the unworn section.
    pub(super) fn new(place: Place, section: &Arc<Section>, state: StationState) -> Self {
        let model = &section.model;
        let mut station = Self {
            place,
            section: Arc::clone(section),
            spines: Spines::of(model),
            interface: model.interface,
            attempt: Attempt::default(),
            slope: Sides::default(),
            solver: Solver::default(),
            next: ContactState::untouched(&section.condensed.operators, model.interface.slave),
            state,
        };
        station.update_slopes();
        station
    }

    fn pair(&self) -> Pair<'_> {
        Pair {
            operators: &self.section.condensed.operators,
            interface: self.interface,
        }
    }

    /// Takes the normals of the surfaces as worn now.
    pub(super) fn update_slopes(&mut self) {
        let operators = &self.section.condensed.operators;
        let depth = &self.state.depth;
        self.slope =
            Sides::from_fn(|side| contact::slopes(operators.of(side), depth.of(side), side));
    }

    /// Solves an increment from the state, under the load of the section or at a height in mm. After another one of the same
    /// displacement `raised` by a height in mm, its contact is the predictor.
    ///
    /// # Errors
    /// [`ContactError`] if it has no solution or wears too much.
    pub(super) fn solve(
        &mut self,
        increment: Increment,
        height: Option<f64>,
        raised: Option<f64>,
    ) -> Result<(), ContactError> {
        let earlier = raised.map(|by| self.predicted(by));
        let like = increment.like.filter(|_| earlier.is_none());
        let starts = std::mem::take(&mut self.state.warm_starts);
        let start = match &earlier {
            Some((first, contact)) => Some(WarmStart {
                first: *first,
                status: &contact.0,
                pressure: &contact.1,
            }),
            None => like.and_then(|(number, count)| starts.of(number, count)),
        };
        let mut solved = self.advance(increment, height, (start, raised.is_some()));
        if solved.is_err() && start.is_some() {
            solved = self.advance(increment, height, (None, false));
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
        increment: Increment,
        height: Option<f64>,
        (start, repeated): (Option<WarmStart<'_>>, bool),
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
            friction: Sides::default(),
        };
        let done =
            self.solver
                .advance(&pair, &surfaces, &self.state.contact, to, &mut self.next)?;
        wear_limit::check(&self.spines, &self.state.depth, to.slider_x, &done, None)?;
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
        let moved = increment.to - increment.from;
        let [_, sin] = self.place.direction();
        attempt.friction_along = if moved == 0.0 {
            0.0
        } else {
            self.interface.friction * sin * sin * path / moved
        };
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
            let widths = &self
                .section
                .condensed
                .operators
                .of(self.interface.slave)
                .widths;
            let used = state.contact.friction_use(widths);
            state.checks.friction_use = state.checks.friction_use.max(used);
        }
    }

    /// Height of the slider in the last attempt, mm.
    pub(super) fn attempted_height(&self) -> f64 {
        self.next.height
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
            ..Neutral::of(&self.state.contact, &self.pair())
        }
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
        let slope =
            Sides::from_fn(|side| contact::slopes(operators.of(side), depth.of(side), side));
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

    /// Integrals of the worn depths, mm^2.
    pub(super) fn worn_section(&self) -> Sides<f64> {
        Sides::from_fn(|side| {
            let widths = &self.section.condensed.operators.of(side).widths;
            let nodes = self.state.depth.of(side).iter().zip(widths);
            nodes.map(|(depth, width)| depth * width).sum()
        })
    }

    /// |worn area of the profile - integral of the wear rate| over the latter, of the worse side.
    pub(super) fn worn_area_residual(&self) -> f64 {
        let worn = self.worn_section().zip(self.state.worn_area);
        let residual = worn.map(|(area, expected)| {
            if expected > 0.0 {
                (area / expected - 1.0).abs()
            } else {
                0.0
            }
        });
        residual.slider.max(residual.receptacle)
    }

    /// Depth of the receptacle's groove below the higher one of its ends, mm.
    pub(super) fn groove_mm(&self) -> f64 {
        let depth = &self.state.depth.receptacle;
        let ends = depth.first().zip(depth.last());
        let rim = ends.map_or(0.0, |(first, last)| first.min(*last));
        depth.iter().fold(0.0, |most: f64, depth| most.max(*depth)) - rim
    }

    /// Whether a body is nearly consumed.
    pub(super) fn is_worn_through(&self) -> bool {
        self.spines.are_worn_through(&self.state.depth)
    }

    /// Cycles until a body is nearly consumed or the groove is as deep as a radius in mm, at the present rate.
    pub(super) fn cycles_left(&self, radius_mm: f64) -> f64 {
        let (wear, equivalent) = (&self.interface.wear, self.state.jump.rates());
        let rates = Sides::from_fn(|side| {
            let depth = self.state.depth.of(side);
            surface::at_relative_rates(*wear.of(side), equivalent.of(side), depth)
        });
        let fastest = rates
            .receptacle
            .iter()
            .fold(f64::MIN_POSITIVE, |most, rate| rate.max(most));
        let groove = (radius_mm - self.groove_mm()) / fastest;
        let rates = rates.as_ref().map(|rates| &rates[..]);
        self.spines
            .cycles_left(&self.state.depth, rates)
            .min(groove.max(0.0))
    }

    /// Largest wear rates from the surfaces down to the worn depths, 1/MPa.
    pub(super) fn rates(&self) -> Sides<f64> {
        let wear = self.interface.wear.zip(self.state.depth.largest_of_each());
        wear.map(|(wear, depth)| {
            wear.map_or(0.0, |wear| wear.largest_rate(depth, LocalState::default()))
        })
    }

    /// Whether a rate depends on the worn depth.
    pub(super) fn wears_by_depth(&self) -> bool {
        let wear = self.interface.wear;
        let by_depth = |side| wear.of(side).is_some_and(SurfaceWear::depends_on_depth);
        Side::BOTH.into_iter().any(by_depth)
    }

    /// Measures what the next jump depends on, after one from these depths that all stations share.
    pub(super) fn measure_jump(&mut self, before: &Sides<Vec<f64>>, jump: u64) {
        let (wear, operators) = (self.interface.wear, &self.section.condensed.operators);
        let after = &self.state.depth;
        let weights = Sides::from_fn(|side| {
            let widths = &operators.of(side).widths[..];
            surface::at_relative_rates(*wear.of(side), widths, after.of(side))
        });
        let [before, after] = [before, after].map(|depth| {
            Sides::from_fn(|side| surface::equivalents(*wear.of(side), depth.of(side)))
        });
        let slices = (slices(&before), slices(&after));
        let control = &mut self.state.jump;
        control.share(jump);
        control.update((self::slices(&weights), 0.0), slices, jump);
    }

    /// Whether the section has drifted from the geometry of its operators; these are then those of the present depths.
    pub(super) fn drifts(&mut self, accuracy: &Accuracy) -> bool {
        let model = &self.section.model;
        let drifted = model.relocates && ale::has_drifted(model, &self.state.depth, accuracy);
        if drifted {
            self.state.built = Some(self.state.depth.clone());
        }
        drifted
    }

    /// Records that the zones of fine elements must be wider.
    pub(super) fn widen(&mut self) {
        self.state.widened *= WIDER;
    }

    /// Meshes and condenses the section where it is not at the geometry of the state.
    ///
    /// # Errors
    /// [`StationError`] if it cannot be meshed or condensed.
    pub(super) fn follow_state(&mut self, unworn: &Arc<Section>) -> Result<(), StationError> {
        if unworn.is_of(&self.state) {
            self.section = Arc::clone(unworn);
        } else if !self.section.is_of(&self.state) {
            self.section = Arc::new(Section::of(&unworn.model, &self.state)?);
        }
        Ok(())
    }
}

fn slices<'a>(values: &'a Sides<Cow<'_, [f64]>>) -> Sides<&'a [f64]> {
    values.as_ref().map(|values| &values[..])
}
