//! Thermal softening: hardness at a temperature over that at which it was measured,
//!   H(T)/H(T0) = 1 - (T - T0)/(Tm - T0),
//! T temperature of the contact, T0 = 20 °C, Tm melting temperature.
//!
//! The term of Johnson and Cook (1983) with the exponent 1, extended below T0. Range: below Tm; that of one phase. Limiting cases:
//! H(T0) at T0, none at Tm. A specific wear rate k/H grows by the inverse.

/// Temperature at which hardnesses are measured, °C.
pub const REFERENCE_C: f64 = 20.0;

/// H(T)/H(T0), -, for a temperature and the melting temperature above it, °C.
pub fn hardness_ratio(temperature_c: f64, melting_c: f64) -> f64 {
    debug_assert!(temperature_c < melting_c, "a solid has a hardness");
    1.0 - (temperature_c - REFERENCE_C) / (melting_c - REFERENCE_C)
}

/// Hardness ratios of a surface.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct Softening {
    /// H(T)/H(T0) of each layer from the surface down, then of the base; `None` of an unknown one, whose rate stays. Empty at T0.
    pub ratios: Vec<Option<f64>>,
    /// Least distance of a surface that wears by its hardness to its melting temperature, K; `None` where that is not known, or none
    /// does.
    pub margin_k: Option<f64>,
}

impl Softening {
    /// Ratio of a layer from the surface down, or of the base by the number of layers; 1 of an unknown one.
    pub fn ratio(&self, layer: usize) -> f64 {
        self.ratios.get(layer).copied().flatten().unwrap_or(1.0)
    }

    /// Whether a ratio is unknown.
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
            ratios: vec![Some(0.5), None],
            margin_k: None,
        };
        assert!(softening.is_unknown() && (softening.ratio(1) - 1.0).abs() <= 0.0);
        assert!((softening.change() - 1.0).abs() < 1e-15);
        assert!(!Softening::default().is_unknown() && Softening::default().change() <= 0.0);
    }
}
