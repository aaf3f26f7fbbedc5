//! Thermal softening: hardness at a temperature over that at which it was measured,
//!   H(T)/H(T0) = 1 - (T - T0)/(Tm - T0),
//! T temperature of the contact, T0 = 20 °C, Tm melting temperature.
//!
//! The term of Johnson and Cook (1983) with the exponent 1, extended below T0. Range: below Tm; that of one phase. Limiting cases:
//! H(T0) at T0, none at Tm. A specific wear rate k/H grows by the inverse.

use super::plating::MOST_LAYERS;

/// Temperature at which hardnesses are measured, °C.
pub const REFERENCE_C: f64 = 20.0;

/// H(T)/H(T0), -, for a temperature and the melting temperature above it, °C.
pub fn hardness_ratio(temperature_c: f64, melting_c: f64) -> f64 {
    debug_assert!(temperature_c < melting_c, "a solid has a hardness");
    1.0 - (temperature_c - REFERENCE_C) / (melting_c - REFERENCE_C)
}

/// Hardnesses of a surface.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Softening {
    /// Hardness of each layer from the surface down, then of the base, at the temperature of the contact, MPa; `None` of an unknown one, empty
    /// where none is known.
    pub hardness_mpa: Vec<Option<f64>>,
    /// H(T)/H(T0) of each layer from the surface down, then of the base; `None` of an unknown one, whose rate stays. Empty at T0.
    pub ratios: Vec<Option<f64>>,
    /// Distance to the melting temperature of each layer from the surface down, then of the base, K; `None` where it is not known, or
    /// the wear does not depend on the hardness.
    pub margins_k: Vec<Option<f64>>,
    /// True if a surface that wears by its hardness has no known melting temperature.
    pub lacks_melting: bool,
    /// Least distance to a melting temperature of all of its materials, whether they wear or not, K, if one is known.
    pub to_melting_k: Option<f64>,
}

impl Softening {
    /// Ratio of a layer from the surface down, or of the base by the number of layers; 1 of an unknown one.
    pub fn ratio(&self, layer: usize) -> f64 {
        self.ratios.get(layer).copied().flatten().unwrap_or(1.0)
    }

    /// Least distance to a melting temperature, K, if one is known.
    pub(crate) fn margin_k(&self) -> Option<f64> {
        self.margins_k.iter().copied().flatten().reduce(f64::min)
    }

    /// Distances to the melting temperatures as far as they count.
    pub(crate) fn margins(&self) -> Margins {
        let mut margins = [f64::INFINITY; MOST_LAYERS + 1];
        for (margin, known) in margins.iter_mut().zip(&self.margins_k) {
            *margin = known.unwrap_or(f64::INFINITY);
        }
        Margins(margins)
    }

    /// Returns `true` if a ratio is unknown.
    pub(crate) fn is_unknown(&self) -> bool {
        self.ratios.iter().any(Option::is_none)
    }

    /// Largest relative change of a rate.
    pub(crate) fn change(&self) -> f64 {
        let ratios = self.ratios.iter().flatten();
        ratios
            .map(|ratio| (1.0 / ratio - 1.0).abs())
            .fold(0.0, f64::max)
    }
}

/// Distance to the melting temperature of each layer from the surface down, then of the base, K; without bound of one whose wear does not
/// depend on its hardness, or is not known to.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Margins(pub(crate) [f64; MOST_LAYERS + 1]);

impl Margins {
    /// The hardness of a layer that is warmer by a rise in K over that before, -.
    pub(crate) fn ratio(&self, layer: usize, rise_k: f64) -> f64 {
        1.0 - rise_k / self.0[layer]
    }

    /// Relative change of the wear rate of a layer; the largest number for one that melts.
    pub(crate) fn change(&self, layer: usize, rise_k: f64) -> f64 {
        let ratio = self.ratio(layer, rise_k);
        if ratio > 0.0 {
            1.0 / ratio - 1.0
        } else {
            MOLTEN
        }
    }
}

/// Relative change of the wear rate that stands for one without a bound. Arbitrary: beyond every limit.
pub const MOLTEN: f64 = 1e3;

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn tin_loses_a_third_of_its_hardness_where_gold_loses_a_sixteenth() {
        let lost = |melting| 1.0 - hardness_ratio(85.0, melting);
        assert!((lost(231.9) - 0.306_8).abs() < 1e-4, "{}", lost(231.9));
        assert!((lost(1_064.2) - 0.062_2).abs() < 1e-4, "{}", lost(1_064.2));
        assert!((hardness_ratio(REFERENCE_C, 231.9) - 1.0).abs() <= 0.0);
        assert!(hardness_ratio(-40.0, 231.9) > 1.0);
        // 1 700 MPa, 100 K above T0, of a metal that melts at 1 337.33 K.
        let hardness = 1_700.0 * hardness_ratio(120.0, 1_064.18);
        assert!((hardness - 1_537.193).abs() < 5e-4, "{hardness}");
    }

    #[test]
    fn unknown_ratios_leave_the_rates_and_are_named() {
        let softening = Softening {
            hardness_mpa: Vec::new(),
            ratios: vec![Some(0.5), None],
            margins_k: Vec::new(),
            lacks_melting: true,
            to_melting_k: None,
        };
        assert!(softening.is_unknown() && (softening.ratio(1) - 1.0).abs() <= 0.0);
        assert!((softening.change() - 1.0).abs() < 1e-15);
        assert!(!Softening::default().is_unknown() && Softening::default().change() <= 0.0);
    }
}
