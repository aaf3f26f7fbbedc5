//! A station: the plane contact of its section, and what that has worn.

use std::sync::Arc;

use super::error::StationError;
use super::place::Place;
use crate::ale::{self, Spines};
use crate::condensation::{self, Condensed};
use crate::contact::{
    self, ContactError, ContactState, Displacement, Pair, Solver, Surfaces, WarmStart,
};
use crate::cycle::{WarmStarts, wear_limit};
use crate::model::{Interface, Model};
use crate::scene::Accuracy;
use crate::schedule::jump::JumpControl;
use crate::sides::{Side, Sides};

/// Factor by which zones become wider where a contact has outgrown them.
const WIDER: f64 = 2.0;

/// A meshed section with its operators.
pub(super) struct Section {
    pub(super) model: Model,
    pub(super) condensed: Condensed,
}

/// Everything that the next cycle of a station depends on.
#[derive(Debug, Clone)]
pub(super) struct StationState {
    pub(super) contact: ContactState,
    /// Vertical worn depth at the contact nodes, mm.
    pub(super) depth: Sides<Vec<f64>>,
    /// Integrals of the wear rates, mm^2.
    pub(super) worn_area: Sides<f64>,
    /// Integral of p |slip| over contact and cycles, N/mm mm.
    pub(super) path: f64,
    /// Energy dissipated by friction, mJ/mm.
    pub(super) energy: f64,
    /// Mean half-width of the contact over the last computed cycle, mm.
    pub(super) mean_half_width: f64,
    pub(super) jump: JumpControl,
    pub(super) warm_starts: WarmStarts,
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
    /// Width of the zones over that of the layout.
    widened: f64,
    interface: Interface,
    slope: Sides<Vec<f64>>,
    solver: Solver,
    next: ContactState,
}

impl Station {
    /// An unloaded, unworn station.
    pub(super) fn new(place: Place, section: &Arc<Section>) -> Self {
        let (model, operators) = (&section.model, &section.condensed.operators);
        let contact = ContactState::untouched(operators, model.interface.slave);
        let mut station = Self {
            place,
            section: Arc::clone(section),
            spines: Spines::of(model),
            widened: 1.0,
            interface: model.interface,
            state: StationState {
                contact: contact.clone(),
                depth: operators.as_ref().map(|body| vec![0.0; body.x.len()]),
                worn_area: Sides::default(),
                path: 0.0,
                energy: 0.0,
                mean_half_width: 0.0,
                jump: JumpControl::default(),
                warm_starts: WarmStarts::default(),
            },
            attempt: Attempt::default(),
            slope: Sides::default(),
            solver: Solver::default(),
            next: contact,
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
        let attempt = &mut self.attempt;
        let slave = self.interface.slave;
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
        std::mem::swap(&mut state.contact, &mut self.next);
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

    /// Condenses the section again if it has drifted from the geometry of its operators.
    ///
    /// # Errors
    /// [`StationError`] if it cannot be meshed or condensed.
    pub(super) fn follow_wear(&mut self, accuracy: &Accuracy) -> Result<(), StationError> {
        let model = &self.section.model;
        if model.relocates && ale::has_drifted(model, &self.state.depth, accuracy) {
            self.rebuild(ale::relocate(model, &self.state.depth)?)?;
        }
        Ok(())
    }

    /// Gives the section wider zones of fine elements.
    ///
    /// # Errors
    /// [`StationError`] if it cannot be meshed or condensed.
    pub(super) fn widen(&mut self) -> Result<(), StationError> {
        self.widened *= WIDER;
        let model = self.section.model.clone();
        self.rebuild(model.with_zones_widened(self.widened)?)
    }

    fn rebuild(&mut self, model: Model) -> Result<(), StationError> {
        let condensed = condensation::condense(&model)?;
        self.section = Arc::new(Section { model, condensed });
        Ok(())
    }
}
