//! Increments of a computed cycle: all planes take them together.

use super::bodies::Bodies;
use super::scene::ExtrudedScene;
use super::state::{CommonPlaneState, Effort, PlaneState, Planes};
use crate::ale::Spines;
use crate::along_line::{PositionContacts, Sections, SectionsIncrement};
use crate::contact::planes::{Extruded, ExtrudedSolver, PlaneWear, Slide, Solved};
use crate::contact::{
    ContactError, ContactState, Pair, Solver, Surfaces, WarmStart, Work, coefficients_in_contact,
    slopes_of_both,
};
use crate::cycle::retry::{RETRY, RetryPolicy};
use crate::cycle::{Neutral, WarmStarts, wear_limit};
use crate::law::friction::contact::{ContactFriction, CycleFriction};
use crate::model::Interface;
use crate::number::count;
use crate::scene::Scene;
use crate::schedule::plan::Cycles;
use crate::schedule::step::Position;
use crate::sides::{Side, Sides};

/// A contact of extruded bodies.
pub(crate) struct ExtrudedContact {
    pub(super) scene: ExtrudedScene,
    /// The plane section.
    pub(super) plane: Scene,
    pub(super) bodies: Bodies,
    pub(super) interface: Interface,
    pub(super) spines: Spines,
    pub(super) planes: Planes,
    pub(super) common: CommonPlaneState,
    pub(super) effort: Effort,
    pub(super) friction: ContactFriction,
    slopes: Vec<Sides<Vec<f64>>>,
    /// Coefficients of friction of each plane in the present computed cycle.
    cycle_friction: Vec<CycleFriction>,
    solver: ExtrudedSolver,
    /// Evaluates forces with the present normals, plane by plane.
    of_plane: Solver,
    next: Vec<ContactState>,
    worn: Vec<PlaneWear>,
}

/// A copy of what increments change.
pub(crate) struct SavedPlanes {
    pub(super) planes: Planes,
    effort: Effort,
}

impl ExtrudedContact {
    /// Unloaded, unworn bodies.
    pub(super) fn new(scene: &ExtrudedScene, plane: Scene, bodies: Bodies) -> Self {
        let unworn = bodies.unworn();
        let (sections, interface) = (&bodies.operators.sections, unworn.interface);
        let layered = unworn.surface.plating;
        let planes = bodies.shares.len();
        let contact = ContactState::untouched(sections, interface.slave);
        let state = PlaneState {
            depth: sections.as_ref().map(|body| vec![0.0; body.x.len()]),
            worn_area: Sides::default(),
            path: 0.0,
            energy: 0.0,
            line_load: 0.0,
            neutral: Neutral::default(),
            warm_starts: WarmStarts::default(),
        };
        Self {
            friction: plane.contact_friction(&interface.wear, layered),
            interface,
            scene: scene.clone(),
            plane,
            common: CommonPlaneState::default(),
            spines: Spines::of(bodies.unworn()),
            bodies,
            planes: Planes {
                states: vec![state; planes],
                contacts: vec![contact.clone(); planes],
                mean_half_width: 0.0,
            },
            effort: Effort::default(),
            slopes: Vec::new(),
            cycle_friction: Vec::new(),
            solver: ExtrudedSolver::default(),
            of_plane: Solver::default(),
            next: vec![contact; planes],
            worn: vec![PlaneWear::default(); planes],
        }
    }

    /// Force of the slider on the receptacle along the motion, mean over the width, N/mm.
    fn tangential_force(&self) -> f64 {
        let widths = &self
            .bodies
            .operators
            .sections
            .of(self.interface.slave)
            .widths;
        let planes = self.planes.contacts.iter().zip(&self.bodies.shares);
        planes
            .map(|(contact, share)| share * contact.tangential_force(&self.interface, widths))
            .sum()
    }

    /// Mean half-width of the planes in contact, weighted by their lengths, mm.
    pub(super) fn half_width(&self) -> f64 {
        let x = &self.bodies.operators.sections.of(self.interface.slave).x;
        let (mut sum, mut length) = (0.0, 0.0);
        for (contact, share) in self.planes.contacts.iter().zip(&self.bodies.shares) {
            let half_width = contact.half_width(x);
            if half_width > 0.0 {
                sum += share * half_width;
                length += share;
            }
        }
        if length > 0.0 { sum / length } else { 0.0 }
    }

    /// Makes a solved increment part of the state.
    fn accept(&mut self, solved: Solved, cycles: f64) {
        for (state, worn) in self.planes.states.iter_mut().zip(&self.worn) {
            for side in Side::BOTH {
                *state.worn_area.of_mut(side) += worn.worn_area.of(side);
                let depths = &mut state.depth.of_mut(side)[*worn.first.of(side)..];
                for (depth, recession) in depths.iter_mut().zip(worn.recession.of(side)) {
                    *depth += recession;
                }
            }
            state.path += cycles * worn.path;
            state.energy += cycles * worn.energy;
            state.line_load = worn.vertical_force;
        }
        std::mem::swap(&mut self.planes.contacts, &mut self.next);
        let widths = &self
            .bodies
            .operators
            .sections
            .of(self.interface.slave)
            .widths;
        let effort = &mut self.effort;
        effort.increments += 1;
        effort.iterations += solved.iterations;
        effort.work += Work {
            increments: 1,
            factorizations: count(solved.iterations),
            unknowns: count(solved.iterations * solved.unknowns),
            response_entries: count(solved.unknowns * solved.unknowns),
        };
        let checks = &mut effort.checks;
        checks.force_balance = checks.force_balance.max(solved.imbalance);
        checks.complementarity = checks.complementarity.max(solved.residual);
        for contact in &self.planes.contacts {
            checks.friction_use = checks.friction_use.max(contact.friction_use(widths));
        }
    }
}

impl Sections for ExtrudedContact {
    type Unsolved = ContactError;
    type Saved = SavedPlanes;
    const RETRY: RetryPolicy = RETRY;

    fn advance(&mut self, increment: SectionsIncrement) -> Result<(), ContactError> {
        let SectionsIncrement {
            to, cycles, start, ..
        } = increment;
        let planes = self.planes.states.iter().zip(&self.slopes);
        let surfaces: Vec<Surfaces<'_>> = planes
            .zip(&self.cycle_friction)
            .map(|((state, slope), friction)| Surfaces {
                depth: state.depth.as_slices(),
                slope: slope.as_slices(),
                friction: friction.nodal(),
            })
            .collect();
        let starts: Option<Vec<WarmStart<'_>>> = start.and_then(|number| {
            let states = self.planes.states.iter();
            states.map(|state| state.warm_starts.of(number)).collect()
        });
        let extruded = Extruded {
            operators: &self.bodies.operators,
            interface: self.interface,
            shares: &self.bodies.shares,
        };
        let slide = Slide {
            slider_x: to,
            cycles,
            starts: starts.as_deref(),
        };
        let (last, next, worn) = (&self.planes.contacts, &mut self.next, &mut self.worn);
        let solved = self
            .solver
            .advance(&extruded, &surfaces, last, slide, next, worn)?;
        for (state, worn) in self.planes.states.iter().zip(&self.worn) {
            let recession = worn.recession.as_slices();
            wear_limit::check(&self.spines, &state.depth, to, worn.first, recession)?;
        }
        self.accept(solved, cycles);
        Ok(())
    }

    fn update_surfaces(&mut self, cycles: Cycles) {
        let sections = &self.bodies.operators.sections;
        let depths = self.planes.states.iter().map(|state| &state.depth);
        let slopes = depths.clone().map(|depth| slopes_of_both(sections, depth));
        self.slopes = slopes.collect();
        let friction = depths.map(|depth| self.friction.in_cycles(depth, cycles.range()));
        self.cycle_friction = friction.collect();
        let coefficients = self.cycle_friction.iter().map(|plane| plane.coefficient);
        self.interface.friction = coefficients.fold(0.0, f64::max);
    }

    fn save(&self) -> SavedPlanes {
        SavedPlanes {
            planes: self.planes.clone(),
            effort: self.effort,
        }
    }

    fn go_back(&mut self, before: &SavedPlanes) {
        self.planes.clone_from(&before.planes);
    }

    /// Replays count as work, and not as increments of the cycle.
    fn end_replay(&mut self, before: &SavedPlanes) {
        self.go_back(before);
        self.effort = Effort {
            work: self.effort.work,
            ..before.effort
        };
    }

    fn slider_x(&self) -> f64 {
        self.planes.contacts[0].slider_x
    }

    fn contacts(&self) -> impl Iterator<Item = &ContactState> {
        self.planes.contacts.iter()
    }

    fn half_widths(&self) -> Vec<f64> {
        vec![self.half_width()]
    }

    fn tangential_force_n(&self) -> f64 {
        self.bodies.width_mm() * self.tangential_force()
    }

    fn length_mm(&self) -> f64 {
        self.bodies.width_mm()
    }

    fn contacts_at(&mut self, position: Position) -> PositionContacts {
        let pair = &Pair {
            operators: &self.bodies.operators.sections,
            interface: self.interface,
        };
        let (mut force, mut found) = (0.0, Vec::new());
        let mut coefficients = Vec::new();
        let planes = self.planes.states.iter().zip(&self.planes.contacts);
        let planes = planes.zip(&self.cycle_friction);
        for (((state, contact), friction), share) in planes.zip(&self.bodies.shares) {
            let slope = slopes_of_both(pair.operators, &state.depth);
            let surfaces = Surfaces {
                depth: state.depth.as_slices(),
                slope: slope.as_slices(),
                friction: friction.nodal(),
            };
            coefficients.push(coefficients_in_contact(pair, &surfaces, contact));
            force += share * self.of_plane.vertical_force_on(pair, &surfaces, contact);
            found.push(Neutral {
                load: state.line_load,
                ..Neutral::of(contact, pair)
            });
        }
        let load = self.planes.contacts[0].load(&self.interface);
        PositionContacts {
            position,
            slider_x: self.slider_x(),
            contacts: self.planes.contacts.clone(),
            friction: coefficients,
            found,
            imbalance: (force - load).abs() / self.interface.load,
        }
    }

    fn worst_imbalance(&mut self) -> &mut f64 {
        &mut self.effort.checks.force_balance_present_normals
    }

    fn end_cycle(&mut self, starts: Vec<WarmStarts>, half_widths_mm: Vec<Option<f64>>) {
        for (state, starts) in self.planes.states.iter_mut().zip(starts) {
            state.warm_starts = starts;
        }
        if let [Some(half_width)] = half_widths_mm[..] {
            self.planes.mean_half_width = half_width;
        }
    }
}
