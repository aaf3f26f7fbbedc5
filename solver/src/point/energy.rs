//! Energy that friction dissipates in a point contact and in its middle section.

use serde::{Deserialize, Serialize};

/// A quantity of the whole contact, and of its middle section.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct WholeAndSection<T> {
    pub(super) whole: T,
    pub(super) section: T,
}

/// Energy dissipated by friction: sliding work under one coefficient after the other.
#[derive(Debug, Clone, Copy, Default, PartialEq, Serialize, Deserialize)]
pub(super) struct DissipatedEnergy {
    /// Present coefficient, -, and the sliding work under it.
    coefficient: f64,
    work: f64,
    /// Energy under the coefficients before it.
    before: f64,
}

impl DissipatedEnergy {
    /// Adds sliding work under a coefficient.
    pub(super) fn add(&mut self, coefficient: f64, work: f64) {
        if coefficient.to_bits() != self.coefficient.to_bits() {
            *self = Self {
                coefficient,
                work: 0.0,
                before: self.sum(),
            };
        }
        self.work += work;
    }

    /// Energy since the run began.
    pub(super) fn sum(&self) -> f64 {
        self.before + self.coefficient * self.work
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_energy_is_the_sum_of_the_work_times_its_coefficient() {
        let mut energy = DissipatedEnergy::default();
        for _ in 0..3 {
            energy.add(0.3, 0.1);
        }
        // As of one coefficient, to the bit.
        assert_eq!(
            energy.sum().to_bits(),
            (0.3 * (0.1 + 0.1 + 0.1_f64)).to_bits()
        );
        energy.add(0.5, 2.0);
        energy.add(0.0, 7.0);
        assert!((energy.sum() - 1.09).abs() < 1e-15, "{energy:?}");
    }
}
