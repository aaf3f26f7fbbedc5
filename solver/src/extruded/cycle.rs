//! Increments of a computed cycle: all planes take them together.

use super::bodies::Bodies;
use crate::ale::Spines;
use crate::contact::planes::{Extruded, ExtrudedSolver, PlaneWear, Slide};
use crate::contact::{self, ContactError, ContactState, Surfaces, WarmStart};
use crate::cycle::step_control::RETRY;
use crate::cycle::{WarmStarts, wear_limit};
use crate::model::Interface;
use crate::number::real;
use crate::schedule::step::Step;
use crate::sides::{Side, Sides};

/// Work of a run.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub(super) struct Work {
    pub(super) increments: usize,
    pub(super) iterations: usize,
}

/// Everything that the next cycle of a plane depends on.
#[derive(Debug, Clone)]
pub(super) struct PlaneState {
    /// Vertical worn depth at the contact nodes, mm.
    pub(super) depth: Sides<Vec<f64>>,
    /// Integral of p |slip| over contact and cycles, N/mm mm.
    pub(super) path: f64,
    /// Energy dissipated by friction, mJ/mm.
    pub(super) energy: f64,
    /// Vertical force at the end of the last increment, N/mm.
    pub(super) line_load: f64,
    warm_starts: WarmStarts,
}

/// Both bodies in contact.
pub(super) struct Contact {
    pub(super) interface: Interface,
    pub(super) states: Vec<PlaneState>,
    /// Contact of each plane.
    pub(super) contacts: Vec<ContactState>,
    /// Mean half-width over the last computed cycle, mm, of planes in contact, weighted by their lengths.
    pub(super) mean_half_width: f64,
    pub(super) work: Work,
    spines: Spines,
    slopes: Vec<Sides<Vec<f64>>>,
    solver: ExtrudedSolver,
    next: Vec<ContactState>,
    worn: Vec<PlaneWear>,
}

/// What a cycle is repeated from.
pub(super) type Snapshot = (Vec<PlaneState>, Vec<ContactState>);

/// An increment from the last place of the slider.
#[derive(Debug, Clone, Copy)]
struct Increment {
    to: f64,
    cycles: f64,
    /// Number of the increment in its cycle and their number, if the last cycle has one like it to start from.
    like: Option<(usize, usize)>,
}

impl Contact {
    /// Unloaded, unworn bodies.
    pub(super) fn new(bodies: &Bodies, interface: &Interface) -> Self {
        let sections = &bodies.operators.sections;
        let planes = bodies.shares.len();
        let contact = ContactState::untouched(sections, interface.slave);
        let state = PlaneState {
            depth: sections.as_ref().map(|body| vec![0.0; body.x.len()]),
            path: 0.0,
            energy: 0.0,
            line_load: 0.0,
            warm_starts: WarmStarts::default(),
        };
        Self {
            interface: *interface,
            spines: Spines::of(bodies.model()),
            states: vec![state; planes],
            contacts: vec![contact.clone(); planes],
            mean_half_width: 0.0,
            work: Work::default(),
            slopes: Vec::new(),
            solver: ExtrudedSolver::default(),
            next: vec![contact; planes],
            worn: vec![PlaneWear::default(); planes],
        }
    }

    /// Applies the load at the neutral position without sliding.
    ///
    /// # Errors
    /// [`ContactError`] if there is no equilibrium.
    pub(super) fn apply_load(&mut self, bodies: &Bodies) -> Result<(), ContactError> {
        self.update_slopes(bodies);
        self.advance(
            bodies,
            Increment {
                to: 0.0,
                cycles: 0.0,
                like: None,
            },
        )?;
        for contact in &mut self.contacts {
            contact.reference_height = Some(contact.height);
        }
        self.mean_half_width = self.half_width(bodies);
        Ok(())
    }

    /// Takes steps, each of which stands for so many cycles.
    ///
    /// # Errors
    /// The number of halvings and the last error.
    pub(super) fn slide(
        &mut self,
        bodies: &Bodies,
        steps: &[Step],
        cycles: f64,
    ) -> Result<(), (u32, ContactError)> {
        self.update_slopes(bodies);
        let mut starts = vec![WarmStarts::default(); self.states.len()];
        let (mut half_widths, mut touching) = (0.0, 0);
        for (number, step) in steps.iter().enumerate() {
            let increment = Increment {
                to: step.slider_x,
                cycles,
                like: (cycles > 0.0).then_some((number, steps.len())),
            };
            self.halve_and_retry(bodies, increment, 0)?;
            for (starts, contact) in starts.iter_mut().zip(&self.contacts) {
                starts.push(contact);
            }
            let half_width = self.half_width(bodies);
            if half_width > 0.0 {
                half_widths += half_width;
                touching += 1;
            }
        }
        if cycles > 0.0 {
            for (state, starts) in self.states.iter_mut().zip(starts) {
                state.warm_starts = starts;
            }
            if touching > 0 {
                self.mean_half_width = half_widths / real(touching);
            }
        }
        Ok(())
    }

    /// Mean half-width of the planes in contact, weighted by their lengths, mm.
    pub(super) fn half_width(&self, bodies: &Bodies) -> f64 {
        let x = &bodies.operators.sections.of(self.interface.slave).x;
        let (mut sum, mut length) = (0.0, 0.0);
        for (contact, share) in self.contacts.iter().zip(&bodies.shares) {
            let half_width = contact.half_width(x);
            if half_width > 0.0 {
                sum += share * half_width;
                length += share;
            }
        }
        if length > 0.0 { sum / length } else { 0.0 }
    }

    /// Whether a body is nearly consumed in a plane.
    pub(super) fn is_worn_through(&self, plane: usize) -> bool {
        self.spines.are_worn_through(&self.states[plane].depth)
    }

    pub(super) fn snapshot(&self) -> Snapshot {
        (self.states.clone(), self.contacts.clone())
    }

    pub(super) fn restore(&mut self, before: &Snapshot) {
        self.states.clone_from(&before.0);
        self.contacts.clone_from(&before.1);
    }

    /// Takes the normals of the surfaces as worn now.
    fn update_slopes(&mut self, bodies: &Bodies) {
        let sections = &bodies.operators.sections;
        let of_plane = |state: &PlaneState| {
            Sides::from_fn(|side| contact::slopes(sections.of(side), state.depth.of(side), side))
        };
        self.slopes = self.states.iter().map(of_plane).collect();
    }

    /// Takes an increment, from the last contact if it fails from another start, and in halves if it fails as a whole.
    fn halve_and_retry(
        &mut self,
        bodies: &Bodies,
        increment: Increment,
        halvings: u32,
    ) -> Result<(), (u32, ContactError)> {
        let Err(error) = self.advance(bodies, increment) else {
            return Ok(());
        };
        let cold = Increment {
            like: None,
            ..increment
        };
        if increment.like.is_some() {
            return self.halve_and_retry(bodies, cold, halvings);
        }
        if halvings == RETRY.halvings || error.needs_wider_zones() {
            return Err((halvings, error));
        }
        let to = 0.5 * (self.contacts[0].slider_x + increment.to);
        self.halve_and_retry(bodies, Increment { to, ..cold }, halvings + 1)?;
        self.halve_and_retry(bodies, cold, halvings + 1)
    }

    /// Solves an increment and makes it part of the state.
    fn advance(&mut self, bodies: &Bodies, increment: Increment) -> Result<(), ContactError> {
        let Increment { to, cycles, like } = increment;
        let pairs = self.states.iter().zip(&self.slopes);
        let surfaces: Vec<Surfaces<'_>> = pairs
            .map(|(state, slope)| Surfaces {
                depth: state.depth.as_slices(),
                slope: slope.as_slices(),
                friction: Sides::default(),
            })
            .collect();
        let starts: Option<Vec<WarmStart<'_>>> = like.and_then(|(number, count)| {
            let states = self.states.iter();
            states
                .map(|state| state.warm_starts.of(number, count))
                .collect()
        });
        let extruded = Extruded {
            operators: &bodies.operators,
            interface: self.interface,
            shares: &bodies.shares,
        };
        let slide = Slide {
            slider_x: to,
            cycles,
        };
        let from = (&self.contacts[..], starts.as_deref());
        let iterations = self.solver.advance(
            &extruded,
            &surfaces,
            from,
            slide,
            (&mut self.next, &mut self.worn),
        )?;
        for (state, worn) in self.states.iter().zip(&self.worn) {
            let worn = (worn.first, worn.recession.as_slices());
            wear_limit::leaves_part(&self.spines, &state.depth, to, worn)?;
        }
        for (state, worn) in self.states.iter_mut().zip(&self.worn) {
            for side in Side::BOTH {
                let depths = &mut state.depth.of_mut(side)[*worn.first.of(side)..];
                for (depth, recession) in depths.iter_mut().zip(worn.recession.of(side)) {
                    *depth += recession;
                }
            }
            state.path += cycles * worn.path;
            state.energy += cycles * worn.energy;
            state.line_load = worn.vertical_force;
        }
        std::mem::swap(&mut self.contacts, &mut self.next);
        self.work.increments += 1;
        self.work.iterations += iterations;
        Ok(())
    }
}
