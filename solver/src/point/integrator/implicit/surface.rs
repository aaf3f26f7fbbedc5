//! The worn surface of a body at the end of a jump: the doses of all positions on it, and its depths.
//!
//!   D = known + n d,   d = sum of path/2 (p + p mirrored) at their places,   h = G(D).
//!
//! Preconditioner: what opens all gaps of a place on the surface together has the compliance C + n k W with the rate k of its layer there, and
//! C + n k_m W by the filter with the mean k_m. The mean of all positions that load the place is scaled by the root of their ratio, before and
//! after the filter, with the least compliance c of the grid as C: s = sqrt((c + n k_m W)/(c + n k W)). Limiting case: one rate, s = 1.

use super::fields::add_mirrored;
use super::positions::JumpPosition;
use crate::point::surface::Surface;
use crate::sides::Side;

/// Largest wear of a place over the mean to begin with. Arbitrary.
const MOST_WORN: f64 = 2.0;

/// Dose over that of an interface at which a place has passed it, far beyond round-off.
const BEYOND: f64 = 1.0 + 1e-9;

/// A surface at the end of a jump.
pub(super) struct JumpSurface<'a> {
    side: Side,
    surface: &'a Surface,
    /// Known part of the dose, MPa mm.
    known: Vec<f64>,
    /// Cycles n that the doses of one cycle count for.
    cycles: f64,
    /// Dose d of one cycle, MPa mm.
    pub(super) of_cycle: Vec<f64>,
    /// Dose at the end, MPa mm, and the depth, mm.
    pub(super) dose: Vec<f64>,
    depth: Vec<f64>,
    /// Change of the dose of one cycle along a direction, MPa mm.
    change: Vec<f64>,
    /// Specific wear rate times the cycles at the present dose, 1/MPa.
    rate: Vec<f64>,
    /// (1 - s) over the path that loads a place, 1/mm.
    share: Vec<f64>,
    /// Sum of a field over all positions.
    sum: Vec<f64>,
}

impl<'a> JumpSurface<'a> {
    /// A surface of a known part of the dose in MPa mm, with doses that count for a number of cycles.
    pub(super) fn new(side: Side, surface: &'a Surface, known: Vec<f64>, cycles: f64) -> Self {
        let field = || vec![0.0; known.len()];
        Self {
            side,
            surface,
            cycles,
            of_cycle: field(),
            dose: field(),
            depth: field(),
            change: field(),
            rate: field(),
            share: field(),
            sum: field(),
            known,
        }
    }

    /// Takes the pressures of all positions.
    pub(super) fn load(&mut self, positions: &[JumpPosition], pressure: &[f64]) {
        let of_cycle = &mut self.of_cycle;
        add_positions(self.side, self.surface, positions, pressure, of_cycle);
        let places = self.of_cycle.iter().zip(&self.known);
        let ends = self.dose.iter_mut().zip(&mut self.depth);
        let ends = ends.zip(&mut self.rate);
        for (((dose, depth), rate), (of_cycle, known)) in ends.zip(places) {
            *dose = known + self.cycles * of_cycle;
            *depth = self.surface.depth_mm(*dose);
            *rate = self.cycles * self.surface.rate_at(*dose);
        }
    }

    /// Adds the depths to the gaps of all positions.
    pub(super) fn add_depths(&self, positions: &[JumpPosition], gap: &mut [f64]) {
        let count = gap.len() / positions.len();
        for (position, gap) in positions.iter().zip(gap.chunks_exact_mut(count)) {
            self.add_mean(position, &self.depth, gap);
        }
    }

    /// Adds the mean of a field of the surface at the places of a position.
    fn add_mean(&self, position: &JumpPosition, field: &[f64], out: &mut [f64]) {
        for (row, weight) in position.stays(self.side) {
            let first = self.first(row);
            let values = &field[first..first + out.len()];
            for (out, value) in out.iter_mut().zip(values) {
                *out += weight * value;
            }
        }
    }

    /// First cell of the window from a row on.
    fn first(&self, row: usize) -> usize {
        self.surface.dose.width() * row
    }

    /// Takes a direction of the pressures; returns the sum of depths times its doses, and the change of that sum by the present layers.
    pub(super) fn direct(&mut self, positions: &[JumpPosition], direction: &[f64]) -> (f64, f64) {
        if self.cycles <= 0.0 {
            return (0.0, 0.0);
        }
        let change = &mut self.change;
        add_positions(self.side, self.surface, positions, direction, change);
        let (mut slope, mut curvature) = (0.0, 0.0);
        let places = self.rate.iter().zip(&self.depth).zip(&self.change);
        for ((rate, depth), change) in places.filter(|(_, change)| **change != 0.0) {
            slope += depth * change;
            curvature += rate * change * change;
        }
        (slope, curvature)
    }

    /// Adds the wear of a direction of the pressures in the present layers to a field.
    pub(super) fn add_worn(
        &mut self,
        positions: &[JumpPosition],
        direction: &[f64],
        field: &mut [f64],
    ) {
        if self.cycles <= 0.0 {
            return;
        }
        let change = &mut self.change;
        add_positions(self.side, self.surface, positions, direction, change);
        for (change, rate) in change.iter_mut().zip(&self.rate) {
            *change *= rate;
        }
        let count = field.len() / positions.len();
        for (position, field) in positions.iter().zip(field.chunks_exact_mut(count)) {
            self.add_mean(position, &self.change, field);
        }
    }

    /// Reduces pressures to begin with where they would wear a place much more than the others: by the harmonic mean, as a rigid body sinks.
    pub(super) fn limit_wear(&mut self, positions: &[JumpPosition], pressure: &mut [f64]) {
        if self.is_linear() {
            return;
        }
        self.load(positions, pressure);
        let (mut total, mut over_worn) = (0.0, 0.0);
        let worn = |known: f64, depth: f64| depth - self.surface.depth_mm(known);
        let places = self.of_cycle.iter().zip(self.known.iter().zip(&self.depth));
        for (of_cycle, (known, depth)) in places.filter(|(of_cycle, _)| **of_cycle > 0.0) {
            total += of_cycle;
            over_worn += of_cycle / worn(*known, *depth);
        }
        let most = MOST_WORN * total / over_worn;
        let places = self.dose.iter().zip(self.known.iter().zip(&self.depth));
        for (part, (dose, (known, depth))) in self.sum.iter_mut().zip(places) {
            *part = 1.0;
            let before = self.surface.depth_mm(*known);
            if depth - before > most {
                let limit = self.surface.dose_of(before + most).max(*known);
                *part = (limit - known) / (dose - known);
            }
        }
        self.reduce(positions, pressure);
    }

    /// Reduces pressures so that no place wears beyond its next faster layer; returns `true` if one would.
    pub(super) fn stop_at_layers(
        &mut self,
        positions: &[JumpPosition],
        pressure: &mut [f64],
    ) -> bool {
        if self.is_linear() {
            return false;
        }
        let sum = &mut self.sum;
        add_positions(self.side, self.surface, positions, pressure, sum);
        let mut stops = false;
        let places = self.dose.iter().zip(&self.known);
        for (part, (dose, known)) in self.sum.iter_mut().zip(places) {
            let after = known + self.cycles * *part;
            *part = 1.0;
            if after > *dose {
                // A little beyond, where the faster layer wears.
                let layer = BEYOND * self.surface.next_faster(*dose);
                if after > layer && layer > *known {
                    *part = (layer - known) / (after - known);
                    stops = true;
                }
            }
        }
        if stops {
            self.reduce(positions, pressure);
        }
        stops
    }

    /// Multiplies the pressures of all positions with the parts in `sum` of the places that they load.
    fn reduce(&self, positions: &[JumpPosition], pressure: &mut [f64]) {
        let count = pressure.len() / positions.len();
        for (position, pressure) in positions.iter().zip(pressure.chunks_exact_mut(count)) {
            for (cell, p) in pressure.iter_mut().enumerate() {
                let rows = position.stays(self.side).map(|(row, _)| row);
                let parts = rows.map(|row| self.sum[self.first(row) + cell]);
                *p *= parts.fold(f64::INFINITY, f64::min);
            }
        }
    }

    /// The sum of depths times the doses of the direction after a step against it.
    pub(super) fn slope_after(&self, step: f64) -> f64 {
        if self.cycles <= 0.0 {
            return 0.0;
        }
        let step = step * self.cycles;
        let places = self.dose.iter().zip(&self.change);
        let changed = places.filter(|(_, change)| **change != 0.0);
        let terms = changed.map(|(dose, change)| {
            let after = (dose - step * change).max(0.0);
            change * self.surface.depth_mm(after)
        });
        terms.sum()
    }

    /// Returns `true` if the depths are linear in the pressures.
    pub(super) fn is_linear(&self) -> bool {
        self.surface.is_linear() || self.cycles <= 0.0
    }

    /// Specific wear rate times the cycles in the mean of the doses of a cycle, 1/MPa.
    pub(super) fn mean_wear(&self) -> f64 {
        let (mut worn, mut total) = (0.0, 0.0);
        let places = self.rate.iter().zip(&self.of_cycle);
        for (rate, of_cycle) in places.filter(|(_, of_cycle)| **of_cycle > 0.0) {
            worn += of_cycle * rate;
            total += of_cycle;
        }
        if total > 0.0 { worn / total } else { 0.0 }
    }

    /// Chooses the scales for the present layers and contacts, with the least compliance of the grid, mm/MPa.
    pub(super) fn set_scale(
        &mut self,
        positions: &[JumpPosition],
        free: &[f64],
        least_compliance: f64,
    ) {
        if self.is_linear() {
            return;
        }
        let total: f64 = positions.iter().map(|position| position.path).sum();
        let mean = least_compliance + total * self.mean_wear();
        add_positions(self.side, self.surface, positions, free, &mut self.sum);
        let places = self.sum.iter().zip(&self.rate);
        for (share, (path, rate)) in self.share.iter_mut().zip(places) {
            *share = 0.0;
            if *path > 0.0 {
                let wear = least_compliance + total * rate;
                *share = (1.0 - (mean / wear).sqrt()) / path;
            }
        }
    }

    /// Scales the mean of a field of all positions in free cells.
    pub(super) fn scale(&mut self, positions: &[JumpPosition], free: &[f64], field: &mut [f64]) {
        if self.is_linear() {
            return;
        }
        add_positions(self.side, self.surface, positions, field, &mut self.sum);
        let count = field.len() / positions.len();
        let fields = field.chunks_exact_mut(count);
        for (position, (field, free)) in positions.iter().zip(fields.zip(free.chunks_exact(count)))
        {
            for (row, weight) in position.stays(self.side) {
                let first = self.first(row);
                let shares = &self.share[first..first + count];
                let means = self.sum[first..first + count].iter().zip(shares);
                for ((value, free), (sum, share)) in field.iter_mut().zip(free).zip(means) {
                    *value -= weight * free * share * sum;
                }
            }
        }
    }
}

/// Writes the sum of half of the path times a field at each place and at the mirrored one.
fn add_positions(
    side: Side,
    surface: &Surface,
    positions: &[JumpPosition],
    field: &[f64],
    out: &mut [f64],
) {
    out.fill(0.0);
    let count = field.len() / positions.len();
    for (position, values) in positions.iter().zip(field.chunks_exact(count)) {
        for stay in position.stays.of(side) {
            let first = surface.dose.width() * stay.first_row;
            let half = 0.5 * stay.path;
            for (out, value) in out[first..first + count].iter_mut().zip(values) {
                *out += half * value;
            }
        }
    }
    add_mirrored(out);
}
