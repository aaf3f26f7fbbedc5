//! The worn surface of a body: the dose of each cell, from which its depth follows.
//!
//! The dose D = int p |ds| of a place, MPa mm, adds where depths of layers do not; its depth is h = G(D) (`law::dose`), k D for
//! a law of one rate. An increment of a dose dD recedes the surface by G(D + dD) - G(D).

use std::ops::Range;

use serde::{Deserialize, Serialize};

use super::field::{Axis, Field};
use super::section::section;
use crate::interpolation::part_way;
use crate::law::surface::SurfaceWear;

/// A worn surface.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(super) struct Surface {
    /// Law, which a checkpoint has no copy of.
    #[serde(skip)]
    wear: Option<SurfaceWear>,
    /// Rate at which the equivalent depth grows by the dose, 1/MPa.
    rate: f64,
    /// Dose of each cell, MPa mm.
    pub(super) dose: Field,
    /// That before the present computed cycle, and between its passes.
    before: Field,
    between: Field,
    /// Dose per cycle in the last computed one, MPa mm.
    pace: Field,
}

/// Sums over all cells of the equivalent depth of wear, mm.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(super) struct WearSums {
    /// Change of the wear per cycle from the last computed cycle to this one, without its sign.
    pub(super) change: f64,
    /// Wear per cycle in this one.
    pub(super) total: f64,
    /// Wear before it.
    pub(super) earlier: f64,
}

impl Surface {
    /// An unworn one.
    pub(super) fn new(wear: Option<SurfaceWear>, half: (usize, usize)) -> Self {
        Self {
            wear,
            rate: wear.and_then(SurfaceWear::dose_rate).unwrap_or(0.0),
            dose: Field::zero(half),
            before: Field::zero(half),
            between: Field::zero(half),
            pace: Field::zero(half),
        }
    }

    /// Gives a surface of a checkpoint its law.
    pub(super) fn resume(&mut self, wear: Option<SurfaceWear>) {
        self.wear = wear;
    }

    /// Returns `true` if the rate is the same at every depth.
    pub(super) fn is_linear(&self) -> bool {
        self.wear.is_none_or(|wear| !wear.depends_on_depth())
    }

    /// Depth of a dose, mm.
    pub(super) fn depth_mm(&self, dose: f64) -> f64 {
        let equivalent = self.rate * dose;
        self.wear.map_or(0.0, |wear| wear.depth(equivalent))
    }

    /// Dose of a depth in mm, MPa mm.
    pub(super) fn dose_of(&self, depth: f64) -> f64 {
        match self.wear {
            Some(wear) if depth.is_finite() => wear.equivalent(depth) / self.rate,
            _ => f64::INFINITY,
        }
    }

    /// Dose at the beginning of the next faster layer below that of a dose, MPa mm.
    pub(super) fn next_faster(&self, dose: f64) -> f64 {
        let layers = |wear: SurfaceWear| wear.without_faster(self.depth_mm(dose));
        let end = self.wear.map_or(f64::INFINITY, |wear| layers(wear).end);
        self.dose_of(end)
    }

    /// Dose of a cell in a row and a column after a part of the present computed cycle that is done, MPa mm: it grows evenly.
    pub(super) fn dose_within(&self, part: f64, row: usize, column: usize) -> f64 {
        let at = |field: &Field| field.rows(row, 1)[column];
        part_way(at(&self.before), at(&self.dose), part)
    }

    /// Growth of the depth of a place of a dose by another one that is added, mm, and the specific wear rate then, 1/MPa.
    pub(super) fn growth(&self, dose: f64, added: f64) -> (f64, f64) {
        let Some(wear) = self.wear else {
            return (0.0, 0.0);
        };
        if self.is_linear() {
            return (self.rate * added, self.rate);
        }
        let after = self.depth_mm(dose + added);
        let rate = self.rate * wear.relative_rate(after);
        (after - self.depth_mm(dose), rate)
    }

    /// Specific wear rate of a place of a dose, 1/MPa.
    pub(super) fn rate_at(&self, dose: f64) -> f64 {
        self.growth(dose, 0.0).1
    }

    /// Dose per cycle in the last computed one, MPa mm.
    pub(super) fn pace(&self) -> &[f64] {
        &self.pace.values
    }

    /// Ends a jump that began and ended with these doses, in which both passes of a cycle wear alike.
    pub(super) fn jump_to(&mut self, before: &[f64], dose: Vec<f64>, cycles: f64) {
        self.before.values.copy_from_slice(before);
        self.dose.values = dose;
        let ends = self.before.values.iter().zip(&self.dose.values);
        let fields = self.between.values.iter_mut().zip(&mut self.pace.values);
        for ((between, pace), (before, after)) in fields.zip(ends) {
            *between = 0.5 * (before + after);
            *pace = (after - before) / cycles;
        }
    }

    /// Depths of all cells, mm.
    pub(super) fn depths_mm(&self) -> Vec<f64> {
        let doses = self.dose.values.iter();
        doses.map(|dose| self.depth_mm(*dose)).collect()
    }

    /// Depths along the middle section, mm.
    pub(super) fn section_depths_mm(&self) -> impl Iterator<Item = f64> {
        let depths = self.depths_mm();
        let section: Vec<f64> = section(self.dose.width(), &depths).collect();
        section.into_iter()
    }

    /// Largest specific wear rate down to the deepest place, 1/MPa.
    pub(super) fn largest_rate(&self) -> f64 {
        let deepest = self
            .dose
            .values
            .iter()
            .fold(0.0, |most: f64, dose| most.max(*dose));
        let state = crate::law::wear::LocalState::default();
        self.wear
            .map_or(0.0, |wear| wear.largest_rate(self.depth_mm(deepest), state))
    }

    /// Largest growth of the equivalent depth of a place per cycle in the last computed one, mm.
    pub(super) fn fastest_rate(&self) -> f64 {
        let fastest = self.pace.values.iter();
        self.rate * fastest.fold(0.0, |most: f64, pace| most.max(*pace))
    }

    /// Growth of the equivalent depth per cycle by which the deepest place would come to a limit in mm as soon as the first place does, mm: where
    /// a fast layer wears under a slow one that stands beside it, the equivalent of the latter grows faster from far less.
    pub(super) fn rate_toward(&self, limit: f64) -> f64 {
        let deepest = self.dose.values.iter();
        let deepest = deepest.fold(0.0, |most: f64, dose| most.max(*dose));
        let left = limit - self.rate * deepest;
        if left <= 0.0 {
            return self.fastest_rate();
        }
        let places = self.dose.values.iter().zip(&self.pace.values);
        let toward =
            places.map(|(dose, pace)| self.rate * pace * left / (limit - self.rate * dose));
        toward.fold(0.0, f64::max)
    }

    /// Adds the dose of a pressure in MPa over a path in mm, as an even part at each of the windows that begin with these rows.
    pub(super) fn add_dose(&mut self, pressure: &[f64], path_mm: f64, rows: Range<usize>) {
        let part = path_mm / crate::number::real(rows.len());
        let count = pressure.len() / self.dose.width();
        for row in rows {
            let doses = self.dose.rows_mut(row, count).iter_mut();
            for (dose, pressure) in doses.zip(pressure) {
                *dose += part * pressure;
            }
        }
    }

    /// Adds a dose at the cells of the window that begins with a row.
    pub(super) fn add(&mut self, added: &[f64], first_row: usize) {
        let count = added.len() / self.dose.width();
        let doses = self.dose.rows_mut(first_row, count).iter_mut();
        for (dose, added) in doses.zip(added) {
            *dose += added;
        }
    }

    /// Takes out the dose per cycle of the last computed one, MPa mm.
    pub(super) fn take_pace(&mut self) -> Field {
        let none = Field::zero(self.pace.half());
        std::mem::replace(&mut self.pace, none)
    }

    /// Takes a dose per cycle of an earlier one.
    pub(super) fn set_pace(&mut self, pace: Field) {
        self.pace = pace;
    }

    /// Rate at which the equivalent depth grows by the dose, 1/MPa.
    pub(super) fn dose_rate(&self) -> f64 {
        self.rate
    }

    /// Dose of each cell before the present computed cycle, MPa mm.
    pub(super) fn dose_before(&self) -> &Field {
        &self.before
    }

    /// Depth of each cell then, mm.
    pub(super) fn depths_before_mm(&self) -> Vec<f64> {
        let doses = self.before.values.iter();
        doses.map(|dose| self.depth_mm(*dose)).collect()
    }

    /// Begins a computed cycle.
    pub(super) fn begin_cycle(&mut self) {
        self.before.values.copy_from_slice(&self.dose.values);
    }

    /// Notes the surface between both passes.
    pub(super) fn turn(&mut self) {
        self.between.values.copy_from_slice(&self.dose.values);
    }

    /// Removes the skew toward the last pass that a jump has more of than single cycles (`cycle/skew.rs`): half of
    /// (D_0 + D_R)/2 - D_L, with the doses before, after and between the passes.
    pub(super) fn unskew(&mut self, jump: f64) {
        let part = 0.5 * (1.0 - 1.0 / jump);
        let earlier = self.before.values.iter().zip(&self.between.values);
        for (dose, (before, between)) in self.dose.values.iter_mut().zip(earlier) {
            let skew = 0.5 * (before + *dose) - between;
            *dose = (*dose - part * skew).max(0.0);
        }
    }

    /// Ends a computed cycle of a jump.
    pub(super) fn end_cycle(&mut self, jump: f64) -> WearSums {
        let (mut change, mut total, mut earlier) = (0.0, 0.0, 0.0);
        let doses = self.dose.values.iter().zip(&self.before.values);
        for (pace, (after, before)) in self.pace.values.iter_mut().zip(doses) {
            let new = (after - before) / jump;
            change += self.rate * (new - *pace).abs();
            total += self.rate * new;
            earlier += self.rate * before;
            *pace = new;
        }
        WearSums {
            change,
            total,
            earlier,
        }
    }

    /// The surface on a grid of another size.
    pub(super) fn resize(&mut self, half: (usize, usize)) {
        self.change(|field| field.resized(half));
    }

    /// The surface on cells of twice the size along an axis, with a grid of this size.
    pub(super) fn merge(&mut self, axis: Axis, half: (usize, usize)) {
        self.change(|field| field.merged(axis).resized(half));
    }

    fn change(&mut self, change: impl Fn(&Field) -> Field) {
        let fields = [
            &mut self.dose,
            &mut self.before,
            &mut self.between,
            &mut self.pace,
        ];
        for field in fields {
            *field = change(field);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::law::plating::Layer;
    use crate::law::wear::WearLaw;

    #[test]
    fn increments_through_a_layer_wear_it_and_then_the_base() {
        let layer = Layer {
            thickness_mm: 1e-3,
            rate_per_mpa: 1e-8,
        };
        let base = WearLaw::Archard {
            k_over_h_per_mpa: 4e-8,
        };
        let surface = Surface::new(SurfaceWear::new(&[layer], Some(base)), (1, 1));
        // 1e5 MPa mm wear the layer, as many more 4 um of the base.
        let is = |(depth, rate): (f64, f64), expected: (f64, f64)| {
            (depth - expected.0).abs() < 1e-15 && (rate - expected.1).abs() < 1e-20
        };
        assert!(is(surface.growth(0.0, 0.0), (0.0, 1e-8)));
        assert!(is(surface.growth(0.0, 5e4), (5e-4, 1e-8)));
        assert!(is(surface.growth(0.0, 2e5), (5e-3, 4e-8)));
        assert!(is(surface.growth(2e5, 0.0), (0.0, 4e-8)));
        assert!((surface.depth_mm(2e5) - 5e-3).abs() < 1e-15);
    }

    #[test]
    fn the_deepest_place_is_foreseen_by_the_rates_of_all() {
        let base = WearLaw::Archard {
            k_over_h_per_mpa: 1e-8,
        };
        let mut surface = Surface::new(SurfaceWear::new(&[], Some(base)), (1, 1));
        surface.jump_to(&[0.0; 4], vec![9e4, 6e4, 0.0, 0.0], 3e4);
        // Per cycle 0.03 and 0.02 nm, and 0.1 nm of a place without wear so far.
        surface.pace.values = vec![3.0, 2.0, 10.0, 0.0];
        let toward = |limit: f64| surface.rate_toward(limit);
        assert!((toward(1.2e-3) - 3e-8).abs() < 1e-20);
        assert!((toward(9e-3) - 9e-8).abs() < 1e-20);
        assert!((toward(9e-4) - surface.fastest_rate()).abs() < 1e-20);
    }
}
