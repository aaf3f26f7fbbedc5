//! Contacts at all positions of a cycle.

use super::positions::CyclePosition;
use crate::contact::{
    ContactError, DoseUnknowns, LinearisedContact, NextWorn, Pair, Place, Surfaces, Thickness,
    WarmStart, Work,
};
use crate::cycle::{IncrementNumber, WarmStarts};
use crate::linear::BorderedBand;
use crate::sides::{Side, Sides};

/// Most updates of the closed nodes on fixed shapes.
const MOST_UPDATES: usize = 40;

/// The bodies, the slopes of their surfaces, and the wear of the master's nodes that comes next.
#[derive(Clone, Copy)]
pub(super) struct Bodies<'a> {
    pub(super) pair: &'a Pair<'a>,
    pub(super) slope: &'a Sides<Vec<f64>>,
    pub(super) next: NextWorn<'a>,
}

impl<'a> Bodies<'a> {
    /// Bodies worn to depths in mm, whose master wears an indentation in mm next.
    pub(super) fn of(
        pair: &'a Pair<'a>,
        slope: &'a Sides<Vec<f64>>,
        depth: &'a Sides<Vec<f64>>,
        indentation: f64,
    ) -> Self {
        let next = NextWorn {
            depth: depth.of(pair.interface.slave.other()),
            thickness: Thickness::Even(indentation),
        };
        Self { pair, slope, next }
    }

    /// Place of a position on surfaces of these depths in mm.
    pub(super) fn place(self, depth: &'a Sides<Vec<f64>>, position: &CyclePosition) -> Place<'a> {
        Place {
            pair: self.pair,
            surfaces: Surfaces {
                depth: depth.as_slices(),
                slope: self.slope.as_slices(),
                friction: Sides::default(),
            },
            position: position.at,
            next: self.next,
        }
    }
}

/// Contacts at all positions of a cycle.
#[derive(Default)]
pub(super) struct Contacts {
    pub(super) positions: Vec<CyclePosition>,
    pub(super) placed: Vec<LinearisedContact>,
    change: Vec<f64>,
    undeformed: Vec<f64>,
}

impl Contacts {
    /// Places contacts at positions on these depths in mm, from the starts of as many.
    ///
    /// # Errors
    /// [`ContactError`] if one cannot be placed.
    pub(super) fn place(
        &mut self,
        bodies: Bodies<'_>,
        positions: Vec<CyclePosition>,
        depth: &Sides<Vec<f64>>,
        starts: &WarmStarts,
    ) -> Result<(), ContactError> {
        self.positions = positions;
        let count = self.positions.len();
        self.placed.resize_with(count, LinearisedContact::default);
        let contacts = self.placed.iter_mut().zip(&self.positions).enumerate();
        for (number, (contact, position)) in contacts {
            let start = starts.of(IncrementNumber { number, count });
            contact.place(bodies.place(depth, position), start.unwrap_or(NO_START))?;
        }
        Ok(())
    }

    /// Solves all contacts for their closed nodes on these depths in mm.
    ///
    /// # Errors
    /// [`ContactError`] if one has no equilibrium.
    pub(super) fn solve(
        &mut self,
        bodies: Bodies<'_>,
        depth: &Sides<Vec<f64>>,
    ) -> Result<(), ContactError> {
        for (contact, position) in self.placed.iter_mut().zip(&self.positions) {
            contact.solve(bodies.place(depth, position))?;
        }
        Ok(())
    }

    /// Updates the closed nodes of all contacts by their solutions on these depths in mm; returns the number of changes.
    ///
    /// # Errors
    /// [`ContactError`] if one has outgrown its zones.
    pub(super) fn update(
        &mut self,
        bodies: Bodies<'_>,
        depth: &Sides<Vec<f64>>,
    ) -> Result<usize, ContactError> {
        let mut changes = 0;
        for (contact, position) in self.placed.iter_mut().zip(&self.positions) {
            changes += contact.update(bodies.place(depth, position), &mut self.undeformed)?;
        }
        Ok(changes)
    }

    /// Solves all contacts on fixed shapes.
    ///
    /// # Errors
    /// [`ContactError`] if one has no solution.
    pub(super) fn settle(
        &mut self,
        bodies: Bodies<'_>,
        depth: &Sides<Vec<f64>>,
    ) -> Result<(), ContactError> {
        for (contact, position) in self.placed.iter_mut().zip(&self.positions) {
            settle(contact, bodies.place(depth, position), &mut self.undeformed)?;
        }
        Ok(())
    }

    /// Places contacts at positions on fixed shapes and solves them; returns the doses of one cycle, MPa mm.
    ///
    /// # Errors
    /// [`ContactError`] if one has no solution.
    pub(super) fn doses_on(
        &mut self,
        bodies: Bodies<'_>,
        positions: &[CyclePosition],
        depth: &Sides<Vec<f64>>,
        starts: &WarmStarts,
    ) -> Result<Sides<Vec<f64>>, ContactError> {
        self.place(bodies, positions.to_vec(), depth, starts)?;
        self.settle(bodies, depth)?;
        Ok(self.doses(bodies))
    }

    /// Doses of one cycle at the nodes of both sides, MPa mm.
    pub(super) fn doses(&self, bodies: Bodies<'_>) -> Sides<Vec<f64>> {
        let operators = bodies.pair.operators.as_ref();
        let mut doses = operators.map(|body| vec![0.0; body.x.len()]);
        for (contact, position) in self.placed.iter().zip(&self.positions) {
            contact.add_doses(bodies.pair, position.path, &mut doses);
        }
        doses
    }

    /// Determines the nodes under all closed nodes of the sides that wear.
    pub(super) fn unknowns(
        &self,
        bodies: Bodies<'_>,
        wears: Sides<bool>,
        unknowns: &mut DoseUnknowns,
    ) {
        let operators = bodies.pair.operators.as_ref();
        unknowns.reset(operators.map(|body| body.x.len()));
        for contact in &self.placed {
            contact.insert_unknowns(bodies.pair, wears, unknowns);
        }
    }

    /// Most nodes of a side under one contact.
    pub(super) fn reach(&self, bodies: Bodies<'_>, side: Side) -> usize {
        let nodes = |contact: &LinearisedContact| contact.nodes_of(bodies.pair, side).len();
        self.placed.iter().map(nodes).max().unwrap_or(0)
    }

    /// Adds the change of the doses of one cycle per change of the depths, times a factor, to a matrix of the unknowns.
    pub(super) fn add_sensitivity(
        &mut self,
        bodies: Bodies<'_>,
        unknowns: &DoseUnknowns,
        factor: f64,
        matrix: &mut BorderedBand,
    ) {
        for (contact, position) in self.placed.iter().zip(&self.positions) {
            let factor = factor * position.path;
            let change = &mut self.change;
            contact.add_sensitivity(bodies.pair, unknowns, factor, change, matrix);
        }
    }

    /// Mean indentation, mm.
    pub(super) fn indentation(&self) -> f64 {
        let (mut sum, mut count) = (0.0, 0.0);
        for contact in &self.placed {
            sum += contact.indentation();
            count += 1.0;
        }
        sum / count
    }

    /// Work of all contacts since the last time.
    pub(super) fn take_work(&mut self) -> Work {
        let mut work = Work::default();
        for contact in &mut self.placed {
            work += std::mem::take(&mut contact.work);
        }
        work
    }
}

/// No node that was closed before.
const NO_START: WarmStart<'_> = WarmStart {
    first: 0,
    status: &[],
    pressure: &[],
};

/// Solves one contact on fixed shapes. `undeformed` is a buffer.
///
/// # Errors
/// [`ContactError`] if it has no solution.
pub(super) fn settle(
    contact: &mut LinearisedContact,
    place: Place<'_>,
    undeformed: &mut Vec<f64>,
) -> Result<(), ContactError> {
    for _ in 0..MOST_UPDATES {
        contact.solve(place)?;
        contact.work.increments += 1;
        if contact.update(place, undeformed)? == 0 {
            return Ok(());
        }
    }
    Err(not_converged(MOST_UPDATES))
}

/// Closed nodes or layers that do not converge in so many iterations.
pub(super) fn not_converged(iterations: usize) -> ContactError {
    ContactError::NotConverged {
        slider_x_mm: 0.0,
        iterations,
        residual: f64::INFINITY,
        tolerance: 0.0,
        changes: 1,
    }
}
