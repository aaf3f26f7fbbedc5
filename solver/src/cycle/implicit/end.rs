//! End of an implicit jump: the next state and the record of its last cycle.

use super::contacts::{Bodies, settle};
use super::jump::JumpEnd;
use super::positions::CyclePosition;
use crate::contact::{ContactError, ContactState, LinearisedContact, PassPosition, slopes_of_both};
use crate::cycle::{
    CycleRecord, CycleState, IncrementNumber, Integrator, Neutral, Skew, WarmStarts, wear_limit,
};
use crate::law::dose_laws::DoseLaws;
use crate::number::{real, real_cycles};
use crate::schedule::increments::Position;
use crate::schedule::jump::Formula;
use crate::schedule::jump::implicit::ImplicitWear;
use crate::sides::{Side, Sides};

/// The end of an implicit jump, and what it began from.
pub(super) struct End<'a> {
    pub(super) laws: &'a DoseLaws,
    pub(super) jump: u64,
    pub(super) formula: Formula,
    /// Doses before it, and of one cycle on the shapes before it, MPa mm.
    pub(super) before: Sides<Vec<f64>>,
    pub(super) first: Sides<Vec<f64>>,
    pub(super) reached: JumpEnd,
}

impl End<'_> {
    /// Mean dose of a cycle at a node in the jump, MPa mm.
    fn mean(&self, side: Side, node: usize) -> f64 {
        let grown = self.reached.dose.of(side)[node] - self.before.of(side)[node];
        grown / real_cycles(self.jump)
    }

    /// Wear of the jump between these depths in mm, and its estimated error. Where a fast layer opens, doses of the slow one above count by its rate.
    fn wear(&self, widths: Sides<&[f64]>, depth: &Sides<Vec<f64>>) -> ImplicitWear {
        let (mut area, mut error) = (0.0, 0.0);
        let mut rates = Sides::default();
        let cycles = real_cycles(self.jump);
        for side in Side::BOTH {
            let rate = self.laws.rate(side);
            let rates: &mut Vec<f64> = rates.of_mut(side);
            for (node, width) in widths.of(side).iter().enumerate() {
                let mean = self.mean(side, node);
                let (from, to) = (depth.of(side)[node], self.reached.depth.of(side)[node]);
                let slope = |depth| self.laws.slope(side, depth);
                let ends = self.first.of(side)[node] + self.reached.of_cycle.of(side)[node];
                area += width * (to - from) / cycles;
                error += width * slope(from).min(slope(to)) * (mean - 0.5 * ends).abs();
                rates.push(rate * mean);
            }
        }
        ImplicitWear {
            formula: self.formula,
            rates,
            error: if area > 0.0 { error / area } else { 0.0 },
            area,
        }
    }

    /// Work of the normal force over the path of the jump, N mm per mm: that of the doses of a side that wears.
    fn normal_work(&self, widths: Sides<&[f64]>) -> f64 {
        let side = if self.laws.wears().slider {
            Side::Slider
        } else {
            Side::Receptacle
        };
        let nodes = widths.of(side).iter().enumerate();
        let doses = nodes.map(|(node, width)| width * self.mean(side, node));
        real_cycles(self.jump) * doses.sum::<f64>()
    }
}

impl Integrator<'_> {
    /// Moves a state to the end of a jump; returns the record of its last cycle.
    ///
    /// # Errors
    /// [`ContactError`] if the jump wears off too much of a body, or a contact on the last shapes has no solution.
    pub(super) fn finish(
        &mut self,
        state: &mut CycleState,
        end: End<'_>,
        detailed: bool,
    ) -> Result<CycleRecord, ContactError> {
        let recession = Sides::from_fn(|side| {
            let nodes = end.reached.depth.of(side).iter().zip(state.depth.of(side));
            nodes
                .map(|(after, before)| after - before)
                .collect::<Vec<f64>>()
        });
        let first = Sides::default();
        let amplitude = self.scene.motion.amplitude_mm();
        let spines = &self.spines;
        wear_limit::check(
            spines,
            &state.depth,
            amplitude,
            first,
            recession.as_slices(),
        )?;
        if end.jump > 1 && spines.are_worn_through(&end.reached.depth) {
            return Err(super::contacts::not_converged(0));
        }
        let widths = self.pair.operators.as_ref().map(|body| &body.widths[..]);
        for side in Side::BOTH {
            let nodes = recession.of(side).iter().zip(*widths.of(side));
            *state.worn_area.of_mut(side) += nodes.map(|(worn, width)| worn * width).sum::<f64>();
        }
        let energy = self.pair.interface.friction * end.normal_work(widths);
        let cycles = real_cycles(end.jump);
        state.energy += energy;
        state.energy_per_cycle = energy / cycles;
        state.friction_per_cycle = self.pair.interface.friction;
        let load = state.contact.load(&self.pair.interface);
        let wear = end.wear(widths, &state.depth);
        let stroke: Vec<f64> = wear
            .rates
            .receptacle
            .iter()
            .map(|rate| 0.5 * rate)
            .collect();
        state.wear_of_strokes = [stroke.clone(), stroke];
        state.depth = end.reached.depth;
        state.jump.update_implicit(wear, end.jump);
        state.skew = Skew::default();
        self.count(state, end.jump);
        let record = self.contacts_at_the_end(state, detailed)?;
        let after = state.contact.load(&self.pair.interface);
        state.loss_of_load = super::super::extrapolation::loss_of_load(load, after, cycles);
        state.computed_cycles += 1;
        Ok(record)
    }

    /// Contacts on the shapes at the end of a jump: the starts of the next one, those at the named positions and the friction loop.
    fn contacts_at_the_end(
        &mut self,
        state: &mut CycleState,
        detailed: bool,
    ) -> Result<CycleRecord, ContactError> {
        let mut record = CycleRecord::default();
        let bodies = Bodies::of(
            &self.pair,
            &self.slope,
            &state.depth,
            state.contact.indentation,
        );
        let widths = &self.pair.slave().widths;
        let contacts = &mut self.implicit.contacts;
        let (mut starts, mut half_widths) = (WarmStarts::default(), 0.0);
        let mut forces = Vec::new();
        for (contact, position) in contacts.placed.iter_mut().zip(&contacts.positions) {
            let place = bodies.place(&state.depth, position);
            contact.write(place, &state.contact, &mut self.next);
            starts.push(&self.next);
            half_widths += self.next.half_width(&self.pair.slave().x);
            forces.push((
                position.at,
                self.next.tangential_force(&self.pair.interface, widths),
            ));
            let balance = contact.imbalance(place);
            state.checks.force_balance = state.checks.force_balance.max(balance);
        }
        let count = contacts.positions.len();
        state.mean_half_width = half_widths / real(count);
        state.work += contacts.take_work();
        state.most_increments = state.most_increments.max(count);
        state.warm_starts = starts;
        if detailed {
            let amplitude = self.scene.motion.amplitude_mm();
            record
                .friction_loop
                .extend(&loop_points(&forces, amplitude));
        }
        let named = [
            (Position::Leftmost, count - 1, -1.0),
            (Position::Neutral, count / 2, 1.0),
            (Position::Rightmost, 0, 1.0),
        ];
        self.slope = slopes_of_both(self.pair.operators, &state.depth);
        for (at, number, direction) in named {
            let contact = self.named_contact(state, number, direction)?;
            if at == Position::Neutral {
                state.neutral = Neutral::of(&contact, &self.pair);
            }
            state.contact.clone_from(&contact);
            let used = contact.friction_use(&self.pair.slave().widths);
            state.checks.friction_use = state.checks.friction_use.max(used);
            let balance = self.force_balance_with_present_normals(state);
            let worst = &mut state.checks.force_balance_present_normals;
            *worst = worst.max(balance);
            record.contacts.push((at, contact));
        }
        Ok(record)
    }

    /// The contact at a position in a pass of a direction, on the present shapes with their normals.
    fn named_contact(
        &mut self,
        state: &mut CycleState,
        number: usize,
        direction: f64,
    ) -> Result<ContactState, ContactError> {
        let positions = &self.implicit.contacts.positions;
        let at = PassPosition {
            direction,
            ..positions[number].at
        };
        let position = CyclePosition { at, path: 0.0 };
        let bodies = Bodies::of(
            &self.pair,
            &self.slope,
            &state.depth,
            state.contact.indentation,
        );
        let place = bodies.place(&state.depth, &position);
        let mut contact = LinearisedContact::default();
        let increment = IncrementNumber {
            number,
            count: positions.len(),
        };
        if let Some(start) = state.warm_starts.of(increment) {
            contact.place(place, start)?;
        }
        settle(&mut contact, place, &mut Vec::new())?;
        state.work += contact.work;
        let mut found = state.contact.clone();
        contact.write(place, &state.contact, &mut found);
        Ok(found)
    }
}

/// Points of the friction loop from the neutral position toward +x, from the forces at all positions from right to left.
fn loop_points(forces: &[(PassPosition, f64)], amplitude: f64) -> Vec<(f64, f64)> {
    let of_pass = |direction: f64| {
        let pass = forces
            .iter()
            .filter(move |(at, _)| at.direction * direction > 0.0);
        pass.map(|(at, force)| (at.slider_x, *force))
    };
    let toward_right: Vec<(f64, f64)> = of_pass(1.0).collect();
    let from = |neutral: bool| {
        let points = toward_right.iter().rev().copied();
        points.filter(move |(x, _)| (*x >= 0.0) == neutral)
    };
    // The force reverses at the turning points, where slip is imposed.
    let ends = |x: f64, point: Option<&(f64, f64)>| point.map(|(_, force)| (x, *force));
    let mut points: Vec<(f64, f64)> = from(true).collect();
    points.extend(ends(amplitude, toward_right.first()));
    points.extend(of_pass(-1.0));
    points.extend(ends(-amplitude, toward_right.last()));
    points.extend(from(false));
    points
}
