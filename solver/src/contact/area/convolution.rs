//! Convolution of a field on a grid with a kernel that is even along both axes or odd along both, by a Fourier transform with zero padding.
//!
//!   u_ij = sum over k, l of K(i - k, j - l) p_kl,  K(i, j) = K(-i, j) = K(i, -j) or -K(-i, j) = -K(i, -j).
//!
//! Padded to at least 2 n - 1 cells along either direction, the cyclic convolution of the transform is that of the infinite
//! plane; without padding it is periodic. The spectrum of such a kernel is real.

use std::cmp::Ordering;

use rustfft::num_complex::Complex;
use rustfft::num_traits::Zero;

use super::cells::Cells;
use super::transform::PlaneTransform;
use crate::number::real;

/// Symmetry of a kernel along both axes.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Parity {
    /// The same value on either side.
    Even,
    /// The opposite value on the other side.
    Odd,
}

/// A convolution with a kernel of one parity along both axes.
pub(crate) struct Convolution {
    transform: PlaneTransform,
    /// Spectrum of the kernel over the number of padded cells, by the wave number along z and then along x.
    spectrum: Vec<f64>,
    /// Parity of a field.
    columns: Vec<Complex<f64>>,
}

impl Convolution {
    /// The convolution of the infinite plane with a kernel of a parity, given by the offset in cells.
    pub(crate) fn new(cells: &Cells, parity: Parity, kernel: impl Fn(usize, usize) -> f64) -> Self {
        let padded = (
            even_length(2 * cells.along_x),
            even_length(2 * cells.along_z),
        );
        let mut convolution = Self::with_length(cells, padded);
        let distance = |i: usize, n: usize| i.min(n - i);
        // The middle of the padding lies on both sides; no pair of cells is as far apart.
        let sign = |i: usize, n: usize| match (parity, (2 * i).cmp(&n)) {
            (Parity::Even, _) | (Parity::Odd, Ordering::Less) => 1.0,
            (Parity::Odd, Ordering::Equal) => 0.0,
            (Parity::Odd, Ordering::Greater) => -1.0,
        };
        let value = |i: usize, j: usize| {
            let there = kernel(distance(i, padded.0), distance(j, padded.1));
            sign(i, padded.0) * sign(j, padded.1) * there
        };
        let Self {
            transform, columns, ..
        } = &mut convolution;
        transform.forward_rows(value, columns);
        let norm = 1.0 / (real(padded.0) * real(padded.1));
        convolution.spectrum = convolution.columns.iter().map(|v| norm * v.re).collect();
        convolution
    }

    /// A periodic filter by its response to the wave numbers along x and z, 1/mm.
    pub(crate) fn periodic(cells: &Cells, response: impl Fn(f64, f64) -> f64) -> Self {
        let length = (cells.along_x, cells.along_z);
        let mut convolution = Self::with_length(cells, length);
        convolution.set_response(cells, response);
        convolution
    }

    /// Replaces the response of a periodic filter.
    pub(crate) fn set_response(&mut self, cells: &Cells, response: impl Fn(f64, f64) -> f64) {
        let (nx, nz) = self.transform.padded();
        let wave = |i: usize, n: usize, step: f64| {
            2.0 * std::f64::consts::PI * real(i.min(n - i)) / (real(n) * step)
        };
        let norm = 1.0 / (real(nx) * real(nz));
        self.spectrum.clear();
        for j in 0..=nz / 2 {
            let across = wave(j, nz, cells.dz_mm);
            let along = (0..nx).map(|i| norm * response(wave(i, nx, cells.dx_mm), across));
            self.spectrum.extend(along);
        }
    }

    fn with_length(cells: &Cells, padded: (usize, usize)) -> Self {
        let transform = PlaneTransform::new(cells, padded);
        Self {
            columns: vec![Complex::zero(); transform.length()],
            spectrum: Vec::new(),
            transform,
        }
    }

    /// Writes the convolution of a field into another one; both have a value for each cell.
    pub(crate) fn apply(&mut self, field: &[f64], out: &mut [f64]) {
        self.transform.forward(field, &mut self.columns);
        for (value, factor) in self.columns.iter_mut().zip(&self.spectrum) {
            *value *= *factor;
        }
        self.transform.back(&mut self.columns, out);
    }
}

/// The smallest even number from a length on that has no other prime factors than 2, 3 and 5, for which transforms are fast.
pub(super) fn even_length(least: usize) -> usize {
    let is_smooth = |length: &usize| {
        let mut rest = *length;
        for factor in [2, 3, 5] {
            while rest.is_multiple_of(factor) {
                rest /= factor;
            }
        }
        rest == 1
    };
    let least = least.max(2);
    let even = (least.div_ceil(2)..).map(|half| 2 * half);
    // A power of two ends the search.
    even.into_iter().find(is_smooth).unwrap_or(least)
}

#[cfg(test)]
mod tests {
    use super::*;

    const CELLS: Cells = Cells {
        along_x: 7,
        along_z: 5,
        dx_mm: 0.1,
        dz_mm: 0.2,
    };

    /// A field without symmetry.
    fn field() -> Vec<f64> {
        (0..CELLS.count())
            .map(|i| (1.0 + real(i)).sqrt() % 1.0)
            .collect()
    }

    #[test]
    fn a_convolution_is_the_sum_that_it_stands_for() {
        let kernel = |i: usize, j: usize| 1.0 / (1.0 + real(i * i + 3 * j));
        let field = field();
        let mut out = vec![0.0; CELLS.count()];
        Convolution::new(&CELLS, Parity::Even, kernel).apply(&field, &mut out);
        let cell = |index: usize| (index / CELLS.along_z, index % CELLS.along_z);
        for (at, found) in out.iter().enumerate() {
            let (i, j) = cell(at);
            let terms = field.iter().enumerate().map(|(from, value)| {
                let (k, l) = cell(from);
                kernel(i.abs_diff(k), j.abs_diff(l)) * value
            });
            let sum: f64 = terms.sum();
            assert!((found - sum).abs() < 1e-14, "{at}: {found} {sum}");
        }
    }

    #[test]
    fn an_odd_kernel_changes_its_sign_on_the_other_side() {
        let kernel = |i: usize, j: usize| real(i * j) / (1.0 + real(i * i + 3 * j));
        let mut field = vec![0.0; CELLS.count()];
        // At (3, 2).
        field[3 * CELLS.along_z + 2] = 1.0;
        let mut out = vec![0.0; CELLS.count()];
        Convolution::new(&CELLS, Parity::Odd, kernel).apply(&field, &mut out);
        let at = |i: usize, j: usize| out[i * CELLS.along_z + j];
        assert!((at(5, 3) - kernel(2, 1)).abs() < 1e-14);
        assert!((at(1, 3) + kernel(2, 1)).abs() < 1e-14);
        assert!((at(1, 0) - kernel(2, 2)).abs() < 1e-14);
    }

    #[test]
    fn the_same_field_gives_the_same_bits() {
        let kernel = |i: usize, j: usize| 1.0 / (1.0 + real(i + j));
        let mut convolution = Convolution::new(&CELLS, Parity::Even, kernel);
        let mut outs = [vec![0.0; CELLS.count()], vec![0.0; CELLS.count()]];
        for out in &mut outs {
            convolution.apply(&field(), out);
        }
        let mut other = vec![0.0; CELLS.count()];
        Convolution::new(&CELLS, Parity::Even, kernel).apply(&field(), &mut other);
        assert_eq!(outs[0], outs[1]);
        assert_eq!(outs[0], other);
    }

    #[test]
    fn a_periodic_filter_scales_a_wave_by_its_response() {
        let cells = Cells {
            along_x: 12,
            along_z: 10,
            ..CELLS
        };
        let kappa = 2.0 * std::f64::consts::PI / 1.2;
        let wave = cells.map(|x, _| (kappa * x).cos());
        let mut out = vec![0.0; cells.count()];
        Convolution::periodic(&cells, |along, across| along + 100.0 * across)
            .apply(&wave, &mut out);
        for (found, wave) in out.iter().zip(&wave) {
            assert!((found - kappa * wave).abs() < 1e-12);
        }
    }

    #[test]
    fn lengths_are_even_and_smooth() {
        assert_eq!(
            [1, 14, 22, 128, 254].map(even_length),
            [2, 16, 24, 128, 256]
        );
    }
}
