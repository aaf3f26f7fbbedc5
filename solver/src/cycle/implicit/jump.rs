//! The doses at the end of a jump.
//!
//! For given sets of closed nodes and given layers of all nodes the residual is linear in the doses. The sets and the layers follow from the
//! signs of its solution, all at once: the primal-dual active set method (Hintermueller, Ito and Kunisch 2003) for contact and layers
//! together. Closed nodes are updated on the depths that the layers of the iteration give, not on those of the layers that follow:
//! beyond an interface the latter may be hundreds of times as deep.

use super::contacts::{Bodies, Contacts, not_converged};
use crate::contact::{ContactError, DoseUnknowns};
use crate::law::dose_laws::DoseLaws;
use crate::linear::BorderedBand;
use crate::schedule::jump::implicit::formulas::Formulas;
use crate::sides::{Side, Sides};

/// Most iterations of a jump. Arbitrary: those that converge take three to ten.
const MOST_ITERATIONS: usize = 25;

/// Depth over the indentation by which the layers of an iteration may differ from those of its doses.
const DEPTH_TOLERANCE: f64 = 1e-6;

/// Least number of unknowns of a banded system, and least of them over its half-width and border: smaller ones are dense. Arbitrary: the results
/// are the same to round-off.
const LEAST_BANDED: usize = 400;
const LEAST_OF_WIDTH: usize = 4;

/// A jump: D1 = known + cycles d(G(D1)).
pub(super) struct ImplicitJump<'a> {
    pub(super) bodies: Bodies<'a>,
    pub(super) laws: &'a DoseLaws,
    pub(super) formulas: &'a Formulas,
    /// Depths at its beginning, mm, which a side that does not wear keeps.
    pub(super) before: &'a Sides<Vec<f64>>,
}

/// Doses, depths and doses of one cycle at the end of a jump.
#[derive(Debug, Clone)]
pub(super) struct JumpEnd {
    pub(super) dose: Sides<Vec<f64>>,
    pub(super) depth: Sides<Vec<f64>>,
    pub(super) of_cycle: Sides<Vec<f64>>,
}

/// Buffers of the iteration.
#[derive(Default)]
pub(super) struct JumpSystem {
    unknowns: DoseUnknowns,
    system: BorderedBand,
    rhs: Vec<f64>,
    slopes: Vec<f64>,
}

impl ImplicitJump<'_> {
    /// Solves for the end of the jump from a predictor of the doses there.
    ///
    /// # Errors
    /// [`ContactError`] if sets and layers do not converge.
    pub(super) fn solve(
        &self,
        contacts: &mut Contacts,
        system: &mut JumpSystem,
        predictor: Sides<Vec<f64>>,
    ) -> Result<JumpEnd, ContactError> {
        let mut dose = predictor;
        let mut depth = self.before.clone();
        for _ in 0..MOST_ITERATIONS {
            contacts.unknowns(self.bodies, self.laws.wears(), &mut system.unknowns);
            self.place_on_curves(&system.unknowns, &mut dose, &mut depth);
            contacts.solve(self.bodies, &depth)?;
            let doses = contacts.doses(self.bodies);
            if !self.change(contacts, system, &dose, &depth, &doses) {
                return Err(not_converged(0));
            }
            let changes = system.unknowns.nodes.iter().zip(&system.rhs);
            for (((side, node), change), slope) in changes.zip(&system.slopes) {
                dose.of_mut(*side)[*node] += change;
                depth.of_mut(*side)[*node] += slope * change;
            }
            contacts.solve(self.bodies, &depth)?;
            let changes = contacts.update(self.bodies, &depth)?;
            if changes == 0 && self.is_on_curves(contacts, system, &dose, &depth) {
                let of_cycle = contacts.doses(self.bodies);
                self.place_on_curves(&system.unknowns, &mut dose, &mut depth);
                return Ok(JumpEnd {
                    dose,
                    depth,
                    of_cycle,
                });
            }
        }
        Err(not_converged(MOST_ITERATIONS))
    }

    /// Sets the doses of nodes that no contact touches to the known ones, and the depths to those of the doses.
    fn place_on_curves(
        &self,
        unknowns: &DoseUnknowns,
        dose: &mut Sides<Vec<f64>>,
        depth: &mut Sides<Vec<f64>>,
    ) {
        for side in Side::BOTH {
            if !self.laws.wears().of(side) {
                continue;
            }
            let nodes = dose.of_mut(side).iter_mut().zip(depth.of_mut(side));
            let known = self.formulas.known.of(side);
            for (node, ((dose, depth), known)) in nodes.zip(known).enumerate() {
                if !unknowns.contains(side, node) {
                    *dose = *known;
                }
                *depth = self.laws.depth(side, *dose);
            }
        }
    }

    /// Solves for the changes of the unknown doses; `false` if they are not finite.
    fn change(
        &self,
        contacts: &mut Contacts,
        system: &mut JumpSystem,
        dose: &Sides<Vec<f64>>,
        depth: &Sides<Vec<f64>>,
        of_cycle: &Sides<Vec<f64>>,
    ) -> bool {
        self.lay_out(contacts, system);
        let (nodes, matrix) = (&system.unknowns.nodes, &mut system.system);
        let Formulas { known, cycles, .. } = self.formulas;
        contacts.add_sensitivity(self.bodies, &system.unknowns, -cycles, matrix);
        system.rhs.clear();
        system.slopes.clear();
        for (number, (side, node)) in nodes.iter().enumerate() {
            let slope = self.laws.slope(*side, depth.of(*side)[*node]);
            let mut column = matrix.column_mut(number);
            column.scale(slope);
            column.add(number, 1.0);
            let at = |values: &Sides<Vec<f64>>| values.of(*side)[*node];
            system.slopes.push(slope);
            let residual = at(dose) - at(known) - cycles * at(of_cycle);
            system.rhs.push(-residual);
        }
        matrix.solve(&mut system.rhs);
        system.rhs.iter().all(|change| change.is_finite())
    }

    /// Lays out a zero system. A short contact on a long scar couples near nodes of the scar with one another and with those of the other
    /// side: numbered along the scar, they are banded, and the other side is their border.
    fn lay_out(&self, contacts: &Contacts, system: &mut JumpSystem) {
        let unknowns = &mut system.unknowns;
        let order = unknowns.nodes.len();
        let counts = Sides::from_fn(|side| unknowns.count(side));
        let scar = if counts.slider > counts.receptacle {
            Side::Slider
        } else {
            Side::Receptacle
        };
        let (core, half_width) = (*counts.of(scar), contacts.reach(self.bodies, scar));
        let border = order - core;
        if order >= LEAST_BANDED && order > LEAST_OF_WIDTH * (half_width + border) {
            unknowns.number_first(scar);
            system.system.reset(core, half_width, border);
        } else {
            system.system.reset(0, 0, order);
        }
    }

    /// Returns `true` if the depths are those of the doses.
    fn is_on_curves(
        &self,
        contacts: &Contacts,
        system: &JumpSystem,
        dose: &Sides<Vec<f64>>,
        depth: &Sides<Vec<f64>>,
    ) -> bool {
        let tolerance = DEPTH_TOLERANCE * contacts.indentation();
        system.unknowns.nodes.iter().all(|(side, node)| {
            let on_curve = self.laws.depth(*side, dose.of(*side)[*node]);
            (on_curve - depth.of(*side)[*node]).abs() <= tolerance
        })
    }
}
