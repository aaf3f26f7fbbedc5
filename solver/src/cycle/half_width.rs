//! Mean half-width of a contact over the increments of a cycle.

use crate::number::real;

/// Mean of the half-widths where there is contact.
#[derive(Debug, Clone, Copy, Default)]
pub(crate) struct MeanHalfWidth {
    sum_mm: f64,
    touching: usize,
}

impl MeanHalfWidth {
    /// Counts the half-width at the end of an increment, mm; 0 without contact.
    pub(crate) fn push(&mut self, half_width_mm: f64) {
        if half_width_mm > 0.0 {
            self.sum_mm += half_width_mm;
            self.touching += 1;
        }
    }

    /// The mean, mm; `None` if nothing has touched.
    pub(crate) fn mean_mm(self) -> Option<f64> {
        (self.touching > 0).then(|| self.sum_mm / real(self.touching))
    }
}
