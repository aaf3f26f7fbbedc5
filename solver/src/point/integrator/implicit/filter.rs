//! Preconditioner of the pressures of all positions: the inverse of their operator on the whole plane, as a periodic filter.
//!
//! For one wave number with the compliance C = 2/(E* kappa), the phases e_s and e_r of the windows on both bodies, the paths w, and wear
//! a = n k of either side, pressures P at all positions open gaps of
//!   R = C P + a_s conj(e_s) S + a_r conj(e_r) T,   S = sum w e_s P,  T = sum w e_r P:
//! a diagonal and two modes (Woodbury). With S_R and T_R, the same sums of R, W_s = sum w |e_s|^2, W_r and X = sum w e_s conj(e_r), both modes follow from
//!   (C + a_s W_s) s + a_s X t = a_s S_R,  a_r X s + (C + a_r W_r) t = a_r T_R,   P = (R - conj(e_s) s - conj(e_r) t)/C.
//! Phases of a position are the means of those of its places.
//! Mirrored positions have conjugate spectra about the middle of the window, so that all sums are real.

use std::f64::consts::PI;

use rustfft::num_complex::Complex;
use rustfft::num_traits::Zero;

use super::positions::JumpPosition;
use crate::contact::area::{Cells, PlaneTransform};
use crate::number::real;
use crate::sides::{Side, Sides};

/// The filter.
pub(super) struct PressureFilter {
    transform: PlaneTransform,
    cells: Cells,
    modulus: f64,
    /// Specific wear rates times cycles.
    pub(super) wear: Sides<f64>,
    /// Spectra of all positions.
    spectra: Vec<Complex<f64>>,
    /// Phases of the middle of the window by the wave number along and across.
    middle: (Vec<Complex<f64>>, Vec<Complex<f64>>),
    /// Phases of all positions on both bodies by the wave number along.
    phases: Sides<Vec<Complex<f64>>>,
    /// Sums X, and W of either side, by the wave number along.
    mixed: Vec<f64>,
    own: Sides<Vec<f64>>,
    /// Paths of all positions.
    paths: Vec<f64>,
}

/// A wave of the window.
#[derive(Debug, Clone, Copy)]
struct Wave {
    /// Number along x, and index in a spectrum.
    along: usize,
    index: usize,
    /// Elastic compliance, mm/MPa.
    compliance: f64,
    /// Phase of the middle of the window.
    middle: Complex<f64>,
}

impl PressureFilter {
    /// For windows of these cells between half-spaces of a contact modulus in MPa.
    pub(super) fn new(cells: &Cells, modulus: f64) -> Self {
        Self {
            transform: PlaneTransform::new(cells, (cells.along_x, cells.along_z)),
            cells: *cells,
            modulus,
            wear: Sides::default(),
            spectra: Vec::new(),
            middle: (
                phases(cells.along_x, 0.5 - 0.5 * real(cells.along_x)),
                phases(cells.along_z, 0.5 - 0.5 * real(cells.along_z)),
            ),
            phases: Sides::default(),
            mixed: Vec::new(),
            own: Sides::default(),
            paths: Vec::new(),
        }
    }

    /// Takes the positions of a cycle.
    pub(super) fn place(&mut self, positions: &[JumpPosition]) {
        let nx = self.cells.along_x;
        self.paths = positions.iter().map(|position| position.path).collect();
        for side in Side::BOTH {
            let all = positions
                .iter()
                .flat_map(|position| mean_phases(nx, position, side));
            *self.phases.of_mut(side) = all.collect();
        }
        let sums = |of: &dyn Fn(usize) -> f64| -> Vec<f64> {
            let sum = |i: usize| {
                let terms = self.paths.iter().enumerate();
                terms.map(|(m, path)| path * of(m * nx + i)).sum()
            };
            (0..nx).map(sum).collect()
        };
        let mixed = sums(&|at| (self.phases.slider[at] * self.phases.receptacle[at].conj()).re);
        let own = self
            .phases
            .as_ref()
            .map(|phases| sums(&|at| phases[at].norm_sqr()));
        (self.mixed, self.own) = (mixed, own);
        self.spectra
            .resize(self.transform.length() * positions.len(), Complex::zero());
    }

    /// Writes pressures for gaps at all positions.
    pub(super) fn apply(&mut self, gap: &[f64], pressure: &mut [f64]) {
        let length = self.transform.length();
        let count = self.cells.count();
        let spectra = self.spectra.chunks_exact_mut(length);
        for (gap, spectrum) in gap.chunks_exact(count).zip(spectra) {
            self.transform.forward(gap, spectrum);
        }
        self.filter();
        let spectra = self.spectra.chunks_exact_mut(length);
        for (pressure, spectrum) in pressure.chunks_exact_mut(count).zip(spectra) {
            self.transform.back(spectrum, pressure);
        }
    }

    /// Multiplies the spectra of all positions with the inverse of their operator.
    fn filter(&mut self) {
        let (nx, nz) = self.transform.padded();
        let Cells { dx_mm, dz_mm, .. } = self.cells;
        let least = PI / (real(nx) * dx_mm).max(real(nz) * dz_mm);
        for j in 0..=nz / 2 {
            let across = wave(j, nz, dz_mm);
            for i in 0..nx {
                let kappa = wave(i, nx, dx_mm).hypot(across).max(least);
                let middle = self.middle.0[i] * self.middle.1[j];
                self.filter_wave(Wave {
                    along: i,
                    index: j * nx + i,
                    compliance: 2.0 / (self.modulus * kappa),
                    middle,
                });
            }
        }
    }

    /// The same for a wave.
    fn filter_wave(&mut self, wave: Wave) {
        let Wave {
            along: i,
            index,
            compliance,
            middle,
        } = wave;
        let (nx, length) = (self.cells.along_x, self.transform.length());
        let mut sums = Sides {
            slider: 0.0,
            receptacle: 0.0,
        };
        for (m, path) in self.paths.iter().enumerate() {
            let value = self.spectra[m * length + index] * middle;
            sums.slider += path * (self.phases.slider[m * nx + i] * value).re;
            sums.receptacle += path * (self.phases.receptacle[m * nx + i] * value).re;
        }
        let (wear, mixed) = (self.wear, self.mixed[i]);
        let total = self.own.as_ref().map(|own| own[i]);
        let own = wear
            .zip(total)
            .map(|(wear, total)| compliance + wear * total);
        let other = wear.map(|wear| wear * mixed);
        let det = own.slider * own.receptacle - other.slider * other.receptacle;
        let rhs = wear.zip(sums).map(|(wear, sum)| wear * sum);
        let slider = (own.receptacle * rhs.slider - other.slider * rhs.receptacle) / det;
        let receptacle = (own.slider * rhs.receptacle - other.receptacle * rhs.slider) / det;
        let (slider, receptacle) = (middle.conj() * slider, middle.conj() * receptacle);
        let factor = 1.0 / (compliance * real(nx) * real(self.cells.along_z));
        for m in 0..self.paths.len() {
            let value = &mut self.spectra[m * length + index];
            let modes = self.phases.slider[m * nx + i].conj() * slider
                + self.phases.receptacle[m * nx + i].conj() * receptacle;
            *value = (*value - modes) * factor;
        }
    }
}

/// Wave number of an index, 1/mm.
fn wave(i: usize, n: usize, step: f64) -> f64 {
    2.0 * PI * real(i.min(n - i)) / (real(n) * step)
}

/// Mean of the phases of a position on a side by the wave number.
fn mean_phases(n: usize, position: &JumpPosition, side: Side) -> Vec<Complex<f64>> {
    let mut mean = vec![Complex::zero(); n];
    for (place, weight) in position.weights() {
        for (mean, phase) in mean.iter_mut().zip(phases(n, *place.offsets.of(side))) {
            *mean += phase * weight;
        }
    }
    mean
}

/// Phases exp(-i k u) of an offset u in cells by the wave number.
fn phases(n: usize, offset: f64) -> Vec<Complex<f64>> {
    let signed = |i: usize| {
        if 2 * i > n {
            real(i) - real(n)
        } else {
            real(i)
        }
    };
    (0..n)
        .map(|i| Complex::from_polar(1.0, -2.0 * PI * signed(i) * offset / real(n)))
        .collect()
}
