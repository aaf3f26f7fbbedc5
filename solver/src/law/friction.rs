//! Coulomb's law: |q| <= mu p, and q = mu p in the direction of slip where there is slip.
//!
//! The coefficient mu may change with the cycle, everywhere alike, or with the state of the surfaces at a place: by the dose
//! D = int p |ds| that it has received, as films wear off by it, or by the layer of a plating that lies open there. Each surface then
//! has a coefficient of its own at each place, and the contact the mean of both: the rule is ours, symmetric in both bodies, and equal
//! coefficients remain. A surface without one has no part in it. Limiting case: equal points or layers are the constant law.

pub(crate) mod contact;
pub mod table;

use crate::sides::{Side, Sides};
pub use table::{Point, Table};

/// Friction laws.
#[derive(Debug, Clone, PartialEq)]
pub enum Friction {
    /// No shear traction.
    Frictionless,
    /// |q| <= mu p.
    Coulomb {
        /// Coefficient of friction mu, -.
        coefficient: f64,
    },
    /// A coefficient that changes with the number of cycles done.
    ByCycle(Table),
    /// A coefficient of each surface that wears, by the dose of the place in MPa mm. A body that does not wear has no film to lose
    /// and no part in it.
    ByDose(Table),
    /// Coefficients of each layer of a plating from the surface down, and of the base below them; none of a side without.
    ByLayer(Sides<Vec<f64>>),
}

impl Friction {
    /// Coefficient of friction of the unworn contact in the first cycle, -.
    pub fn unworn(&self) -> f64 {
        match self {
            Self::Frictionless => 0.0,
            Self::Coulomb { coefficient } => *coefficient,
            Self::ByCycle(table) | Self::ByDose(table) => table.at(0.0),
            Self::ByLayer(layers) => {
                let outer = layers.as_ref().map(|side| side.first().copied());
                of_both(outer).unwrap_or(0.0)
            }
        }
    }

    /// The law in a run of so many cycles, whose table by cycle ends there.
    #[must_use]
    pub fn until(self, cycles: f64) -> Self {
        match self {
            Self::ByCycle(table) => Self::ByCycle(table.until(cycles)),
            other => other,
        }
    }

    /// Largest coefficient of friction, -: of all cycles of a table, and of all doses and layers, whether or not a run reaches
    /// them.
    pub fn largest(&self) -> f64 {
        match self {
            Self::Frictionless | Self::Coulomb { .. } => self.unworn(),
            Self::ByCycle(table) | Self::ByDose(table) => table.largest(),
            Self::ByLayer(layers) => {
                let most = layers.as_ref().map(|side| {
                    let most = side.iter().fold(0.0, |most: f64, mu| most.max(*mu));
                    (!side.is_empty()).then_some(most)
                });
                of_both(most).unwrap_or(0.0)
            }
        }
    }

    /// Returns `true` if the coefficient changes during a run.
    pub fn changes(&self) -> bool {
        match self {
            Self::Frictionless | Self::Coulomb { .. } => false,
            Self::ByCycle(table) => table.changes(),
            Self::ByDose(_) | Self::ByLayer(_) => {
                Side::BOTH.iter().any(|side| self.follows_wear_of(*side))
            }
        }
    }

    /// Returns `true` if the coefficient follows from how far a side has worn, where it wears.
    pub(crate) fn follows_wear_of(&self, side: Side) -> bool {
        match self {
            Self::Frictionless | Self::Coulomb { .. } | Self::ByCycle(_) => false,
            Self::ByDose(table) => table.changes(),
            Self::ByLayer(layers) => {
                let differ = |pair: &[f64]| pair[0].total_cmp(&pair[1]).is_ne();
                layers.of(side).windows(2).any(differ)
            }
        }
    }

    /// Table by cycle, if it has one.
    pub fn by_cycle(&self) -> Option<&Table> {
        match self {
            Self::ByCycle(table) => Some(table),
            _ => None,
        }
    }
}

/// Coefficient of the contact of two surfaces, -: the mean of both, or that of the only one that has one.
pub(crate) fn of_both(surfaces: Sides<Option<f64>>) -> Option<f64> {
    match (surfaces.slider, surfaces.receptacle) {
        (Some(slider), Some(receptacle)) => Some(0.5 * (slider + receptacle)),
        (slider, receptacle) => slider.or(receptacle),
    }
}

/// Coefficients of friction at places of a contact, -.
#[derive(Debug, Clone, Copy)]
pub(crate) enum Coefficients<'a> {
    /// The same at all of them.
    Uniform(f64),
    /// Coefficient of each place.
    Local(&'a [f64]),
}

impl Coefficients<'_> {
    /// Coefficient of a place.
    #[inline]
    pub(crate) fn at(self, place: usize) -> f64 {
        match self {
            Self::Uniform(coefficient) => coefficient,
            Self::Local(coefficients) => coefficients[place],
        }
    }

    /// Largest coefficient.
    pub(crate) fn largest(self) -> f64 {
        match self {
            Self::Uniform(coefficient) => coefficient,
            Self::Local(coefficients) => {
                let places = coefficients.iter();
                places.fold(0.0, |most: f64, mu| most.max(*mu))
            }
        }
    }

    /// Mean coefficient with weights of the places; that of the first one where no weight counts. Exact where all are the same.
    pub(crate) fn mean(self, weights: impl Iterator<Item = f64>) -> f64 {
        match self {
            Self::Uniform(coefficient) => coefficient,
            Self::Local(coefficients) => weighted_mean(coefficients, weights),
        }
    }
}

/// Mean of coefficients, -, with weights; the first one where no weight counts. Exact where all are the same.
pub(crate) fn weighted_mean(coefficients: &[f64], weights: impl Iterator<Item = f64>) -> f64 {
    let first = coefficients.first().copied().unwrap_or(0.0);
    let (mut sum, mut total) = (0.0, 0.0);
    for (coefficient, weight) in coefficients.iter().zip(weights) {
        sum += weight * (coefficient - first);
        total += weight;
    }
    if total > 0.0 {
        first + sum / total
    } else {
        first
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn close(a: f64, b: f64) -> bool {
        (a - b).abs() <= 1e-15
    }

    #[test]
    fn frictionless_is_coulomb_without_a_coefficient() {
        assert!(Friction::Frictionless.unworn().abs() < f64::MIN_POSITIVE);
        let constant = Friction::Coulomb { coefficient: 0.9 };
        assert!(close(constant.unworn(), 0.9) && close(constant.largest(), 0.9));
        assert!(!constant.changes());
    }

    #[test]
    fn two_surfaces_share_the_coefficient_and_one_has_it_alone() {
        let both = |slider, receptacle| of_both(Sides { slider, receptacle });
        assert_eq!(both(Some(0.25), Some(0.75)), Some(0.5));
        assert_eq!(both(Some(0.75), Some(0.25)), Some(0.5));
        assert_eq!(both(Some(0.3), Some(0.3)), Some(0.3));
        assert_eq!(both(None, Some(0.75)), Some(0.75));
        assert_eq!(both(Some(0.25), None), Some(0.25));
        assert_eq!(both(None, None), None);
    }

    #[test]
    fn the_weighted_mean_of_one_coefficient_is_exact() {
        let weights = [0.3, 1e-7, 0.11];
        let mean = |values: &[f64]| weighted_mean(values, weights.into_iter());
        assert_eq!(mean(&[0.3; 3]).to_bits(), 0.3_f64.to_bits());
        let expected = (0.3 * 0.2 + 1e-7 * 0.4 + 0.11 * 0.6) / (0.41 + 1e-7);
        assert!(close(mean(&[0.2, 0.4, 0.6]), expected));
        assert!(close(
            weighted_mean(&[0.7, 0.2], [0.0, 0.0].into_iter()),
            0.7
        ));
    }

    #[test]
    fn the_largest_coefficient_is_that_of_any_layer_or_of_the_cycles_of_the_run() {
        let table = Table::new(&[(0.0, 0.2), (100.0, 0.6)]);
        let by_cycle = Friction::ByCycle(table.clone());
        let half = by_cycle.clone().until(50.0);
        assert!(close(half.largest(), 0.4) && close(half.unworn(), 0.2));
        assert!(close(by_cycle.largest(), 0.6));
        assert!(close(Friction::ByDose(table).until(50.0).largest(), 0.6));
        let by_layer = Friction::ByLayer(Sides {
            slider: vec![0.25, 0.75, 0.5],
            receptacle: vec![0.25, 0.25],
        });
        assert!(close(by_layer.unworn(), 0.25) && close(by_layer.largest(), 0.5));
        assert!(by_layer.follows_wear_of(Side::Slider) && !by_cycle.follows_wear_of(Side::Slider));
        assert!(by_layer.changes() && by_cycle.changes());
        let even = Friction::ByLayer(Sides {
            slider: vec![0.2, 0.2],
            receptacle: vec![0.6],
        });
        assert!(!even.changes() && !even.follows_wear_of(Side::Slider));
        let even = Friction::ByDose(Table::new(&[(0.0, 0.3), (9.0, 0.3)]));
        assert!(!even.changes() && !even.follows_wear_of(Side::Receptacle));
    }
}
