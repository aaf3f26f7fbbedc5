//! Preconditioner of the normal contact: the inverse of its operator on the whole plane, as a periodic filter.
//!
//! A pressure of the wave number kappa in 1/mm displaces half-spaces by 2/(E* kappa) times it (Johnson, Contact Mechanics, 1985,
//! section 13.2), and wears by d times it. The mean has no displacement of its own on the whole plane: it takes that of half the
//! smallest wave number of the grid. Any positive response preconditions; this one leaves a condition that hardly depends on
//! the size of the cells.

use super::cells::Cells;
use super::convolution::Convolution;

/// The filter 1/(2/(E* kappa) + d).
pub(super) struct Preconditioner {
    modulus: f64,
    /// Mean wear d that the filter is made for, mm/MPa.
    wear: f64,
    filter: Convolution,
}

impl Preconditioner {
    /// The filter for no wear.
    pub(super) fn new(cells: &Cells, modulus: f64) -> Self {
        let response = response(cells, modulus, 0.0);
        Self {
            modulus,
            wear: 0.0,
            filter: Convolution::periodic(cells, response),
        }
    }

    /// Takes the mean wear of an increment, mm/MPa.
    pub(super) fn set_wear(&mut self, cells: &Cells, wear: f64) {
        if wear.to_bits() != self.wear.to_bits() {
            self.filter
                .set_response(cells, response(cells, self.modulus, wear));
            self.wear = wear;
        }
    }

    /// Writes the pressure of a displacement.
    pub(super) fn apply(&mut self, displacement: &[f64], pressure: &mut [f64]) {
        self.filter.apply(displacement, pressure);
    }
}

fn response(cells: &Cells, modulus: f64, wear: f64) -> impl Fn(f64, f64) -> f64 + use<> {
    let length = |count: usize, step: f64| crate::number::real(count) * step;
    let longest = length(cells.along_x, cells.dx_mm).max(length(cells.along_z, cells.dz_mm));
    let least = std::f64::consts::PI / longest;
    move |along, across| {
        let kappa = along.hypot(across).max(least);
        1.0 / (2.0 / (modulus * kappa) + wear)
    }
}
