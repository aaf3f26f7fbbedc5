//! Fourier transform of a field on a grid, with zero padding or without, on one thread and in an order of operations that depends on the
//! size alone.
//!
//! The transforms are those of `realfft` and `rustfft` without their SIMD features. With these features the planner would choose the
//! instructions by the processor, and fused multiply-adds would change the last bits from machine to machine. The sine and cosine of the
//! twiddle factors are those of the platform's library.
//!
//! Spectra are ordered by the wave number along z, and then by that along x; those of a real field on z >= 0 are all. Only rows that hold
//! cells are transformed along z, back and forth. All memory is allocated once.

use std::sync::Arc;

use realfft::{ComplexToReal, RealFftPlanner, RealToComplex};
use rustfft::num_complex::Complex;
use rustfft::num_traits::Zero;

use super::cells::Cells;

/// Transform of fields on a grid.
pub(crate) struct PlaneTransform {
    /// Cells along z.
    width: usize,
    /// Cells along x and z with the padding.
    padded: (usize, usize),
    rows: Arc<dyn RealToComplex<f64>>,
    rows_back: Arc<dyn ComplexToReal<f64>>,
    columns: Arc<dyn rustfft::Fft<f64>>,
    columns_back: Arc<dyn rustfft::Fft<f64>>,
    /// A padded row along z, and its spectrum.
    row: Vec<f64>,
    row_spectrum: Vec<Complex<f64>>,
    /// Scratch of the transforms.
    inner: Vec<Complex<f64>>,
}

impl PlaneTransform {
    /// For fields on these cells, padded to lengths along x and z.
    pub(crate) fn new(cells: &Cells, padded: (usize, usize)) -> Self {
        let mut planner = RealFftPlanner::new();
        let mut complex = rustfft::FftPlanner::new();
        let (rows, rows_back) = (
            planner.plan_fft_forward(padded.1),
            planner.plan_fft_inverse(padded.1),
        );
        let (columns, columns_back) = (
            complex.plan_fft_forward(padded.0),
            complex.plan_fft_inverse(padded.0),
        );
        let lengths = [
            rows.get_scratch_len(),
            rows_back.get_scratch_len(),
            columns.get_inplace_scratch_len(),
            columns_back.get_inplace_scratch_len(),
        ];
        let inner = lengths.into_iter().fold(0, usize::max);
        Self {
            width: cells.along_z,
            padded,
            rows,
            rows_back,
            columns,
            columns_back,
            row: vec![0.0; padded.1],
            row_spectrum: vec![Complex::zero(); padded.1 / 2 + 1],
            inner: vec![Complex::zero(); inner],
        }
    }

    /// Lengths along x and z with the padding.
    pub(crate) fn padded(&self) -> (usize, usize) {
        self.padded
    }

    /// Number of the wave numbers of a spectrum.
    pub(crate) fn length(&self) -> usize {
        self.padded.0 * self.row_spectrum.len()
    }

    /// Writes the spectrum of a field.
    pub(crate) fn forward(&mut self, field: &[f64], spectrum: &mut [Complex<f64>]) {
        spectrum.fill(Complex::zero());
        let (width, length) = (self.width, self.padded.0);
        for (i, values) in field.chunks_exact(width).enumerate() {
            // A row without pressure has no spectrum.
            if values.iter().all(|value| *value == 0.0) {
                continue;
            }
            self.row[..width].copy_from_slice(values);
            self.row[width..].fill(0.0);
            self.transform_row();
            let columns = spectrum.chunks_exact_mut(length);
            for (column, value) in columns.zip(&self.row_spectrum) {
                column[i] = *value;
            }
        }
        self.transform_columns(spectrum);
    }

    /// Writes the spectrum of a field given at all padded cells, row by row.
    pub(super) fn forward_rows(
        &mut self,
        value: impl Fn(usize, usize) -> f64,
        spectrum: &mut [Complex<f64>],
    ) {
        let length = self.padded.0;
        for i in 0..length {
            for (j, at) in self.row.iter_mut().enumerate() {
                *at = value(i, j);
            }
            self.transform_row();
            let columns = spectrum.chunks_exact_mut(length);
            for (column, value) in columns.zip(&self.row_spectrum) {
                column[i] = *value;
            }
        }
        self.transform_columns(spectrum);
    }

    /// Writes the field of a spectrum times the number of padded cells, and destroys the spectrum.
    pub(crate) fn back(&mut self, spectrum: &mut [Complex<f64>], field: &mut [f64]) {
        self.columns_back
            .process_with_scratch(spectrum, &mut self.inner);
        let width = self.width;
        for (i, values) in field.chunks_exact_mut(width).enumerate() {
            self.transform_back(spectrum, i);
            values.copy_from_slice(&self.row[..width]);
        }
    }

    fn transform_columns(&mut self, spectrum: &mut [Complex<f64>]) {
        self.columns.process_with_scratch(spectrum, &mut self.inner);
    }

    /// Transforms the row into its spectrum, and destroys it.
    fn transform_row(&mut self) {
        let (row, spectrum) = (&mut self.row, &mut self.row_spectrum);
        let result = self
            .rows
            .process_with_scratch(row, spectrum, &mut self.inner);
        debug_assert!(result.is_ok(), "rows have the planned length");
    }

    /// Transforms the spectra at a row back.
    fn transform_back(&mut self, columns: &[Complex<f64>], i: usize) {
        let (row, spectrum) = (&mut self.row, &mut self.row_spectrum);
        for (value, column) in spectrum.iter_mut().zip(columns.chunks_exact(self.padded.0)) {
            *value = column[i];
        }
        // The spectrum of a real row is real up to round-off at both ends.
        spectrum[0].im = 0.0;
        if self.padded.1.is_multiple_of(2)
            && let Some(last) = spectrum.last_mut()
        {
            last.im = 0.0;
        }
        let result = self
            .rows_back
            .process_with_scratch(spectrum, row, &mut self.inner);
        debug_assert!(result.is_ok(), "rows have the planned length");
    }
}
