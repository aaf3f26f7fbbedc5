//! Preconditioner of the normal contact: the inverse of its operator on the whole plane, as a periodic filter.
//!
//! A pressure of the wave number kappa in 1/mm displaces half-spaces by 2/(E* kappa) times it (Johnson, Contact Mechanics, 1985,
//! section 13.2), and wears by d times it. The mean has no displacement of its own on the whole plane: it takes that of half the
//! smallest wave number of the grid. Any positive response preconditions; this one leaves a condition that hardly depends on
//! the size of the cells.
//!
//! Where a part of the contact sticks and the rest slips, d is 0 in places and thousands of times the elastic compliance in others, and no
//! mean serves both. With the least elastic compliance c = 2/(E* kappa) of the grid and s = 1/sqrt(1 + d/c), the filter G without wear is
//! scaled, s G s, and what wears takes the pressure of its own compliance besides, d/(c + d)^2. Limiting cases: G without wear, 1/d of much
//! wear. Both are within a small factor of the inverse. Iterations on an annulus that wears by 7e-5, 7e-3, 0.7, 70 and 7 000 times the mean
//! elastic compliance: 11, 10, 8, 12 and 17; by the mean 13, 13, 76, and none in 2 000.

use std::f64::consts::PI;

use super::cells::Cells;
use super::convolution::Convolution;
use crate::number::real;

/// Largest wear over the smallest, with the least elastic compliance, from which on the mean does not serve both. Arbitrary: a mean serves
/// layers of rates that differ by as much.
const CONTRAST: f64 = 30.0;

/// The filter 1/(2/(E* kappa) + d).
pub(super) struct Preconditioner {
    modulus: f64,
    /// Mean wear d that the filter is made for, mm/MPa.
    wear: f64,
    filter: Convolution,
    /// At each cell where the wear differs much.
    local: Option<Local>,
}

/// The preconditioner of a wear that differs from place to place.
struct Local {
    /// s, -.
    scale: Vec<f64>,
    /// d/(c + d)^2, MPa/mm.
    own: Vec<f64>,
    scaled: Vec<f64>,
}

impl Preconditioner {
    /// The filter for no wear.
    pub(super) fn new(cells: &Cells, modulus: f64) -> Self {
        let response = response(cells, modulus, 0.0);
        Self {
            modulus,
            wear: 0.0,
            filter: Convolution::periodic(cells, response),
            local: None,
        }
    }

    /// Takes the wear of an increment at each cell and its mean in contact, mm/MPa, under a pressure that is positive there.
    pub(super) fn set_wear(&mut self, cells: &Cells, wear: &[f64], mean: f64, pressure: &[f64]) {
        let least = least_compliance(cells, self.modulus);
        self.local = differs(wear, pressure, least).then(|| Local::new(wear, least));
        let mean = if self.local.is_some() { 0.0 } else { mean };
        if mean.to_bits() != self.wear.to_bits() {
            self.filter
                .set_response(cells, response(cells, self.modulus, mean));
            self.wear = mean;
        }
    }

    /// Checks whether the wear differs from place to place.
    pub(super) fn is_local(&self) -> bool {
        self.local.is_some()
    }

    /// Writes the pressure of a displacement.
    pub(super) fn apply(&mut self, displacement: &[f64], pressure: &mut [f64]) {
        let Some(Local { scale, own, scaled }) = &mut self.local else {
            self.filter.apply(displacement, pressure);
            return;
        };
        for ((scaled, scale), u) in scaled.iter_mut().zip(&*scale).zip(displacement) {
            *scaled = scale * u;
        }
        self.filter.apply(scaled, pressure);
        let places = scale.iter().zip(own).zip(displacement);
        for (pressure, ((scale, own), u)) in pressure.iter_mut().zip(places) {
            *pressure = scale * *pressure + *own * u;
        }
    }
}

impl Local {
    fn new(wear: &[f64], least: f64) -> Self {
        let scale = wear.iter().map(|wear| 1.0 / (1.0 + wear / least).sqrt());
        let own = wear.iter().map(|wear| wear / (least + wear).powi(2));
        Self {
            scale: scale.collect(),
            own: own.collect(),
            scaled: vec![0.0; wear.len()],
        }
    }
}

/// Elastic compliance of the shortest waves of the grid, mm/MPa.
pub(super) fn least_compliance(cells: &Cells, modulus: f64) -> f64 {
    2.0 * cells.dx_mm.min(cells.dz_mm) / (PI * modulus)
}

/// Checks whether the wear differs so much in contact that its mean does not serve.
fn differs(wear: &[f64], pressure: &[f64], least_compliance: f64) -> bool {
    let (mut least, mut most) = (f64::INFINITY, 0.0_f64);
    for (wear, pressure) in wear.iter().zip(pressure) {
        if *pressure > 0.0 {
            (least, most) = (least.min(*wear), most.max(*wear));
        }
    }
    most > CONTRAST * (least + least_compliance)
}

fn response(cells: &Cells, modulus: f64, wear: f64) -> impl Fn(f64, f64) -> f64 + use<> {
    let length = |count: usize, step: f64| real(count) * step;
    let longest = length(cells.along_x, cells.dx_mm).max(length(cells.along_z, cells.dz_mm));
    let least = PI / longest;
    move |along, across| {
        let kappa = along.hypot(across).max(least);
        1.0 / (2.0 / (modulus * kappa) + wear)
    }
}
