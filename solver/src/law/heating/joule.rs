//! Joule heat of a constriction: its hottest place by the voltage over it,
//!   T^2 - T0^2 = V^2/(4 L).
//!
//! T, T0: absolute temperatures of the constriction and of the bodies, K; V: voltage, V; L: Lorenz number, V^2/K^2. Heat and current
//! take the same way, so that the shape does not count (Holm, *Electric Contacts*, 1967). Range: metals, whose conductivities follow
//! Wiedemann and Franz' law; constrictions that are closed and symmetric, which leaves a film's voltage on either side alike. Limiting
//! case: no rise without a voltage.

/// Lorenz number of metals, V^2/K^2 (Sommerfeld's value).
const LORENZ: f64 = 2.44e-8;

/// Kelvin at 0 °C.
const ZERO_CELSIUS_K: f64 = 273.15;

/// Temperature rise, K, of a voltage in V over surroundings in °C.
pub(crate) fn rise_k(voltage_v: f64, surroundings_c: f64) -> f64 {
    let bodies = surroundings_c + ZERO_CELSIUS_K;
    let square = voltage_v * voltage_v / (4.0 * LORENZ);
    // Not as a difference of nearly equal temperatures.
    square / (bodies + (bodies * bodies + square).sqrt())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ten_amperes_heat_a_contact_of_some_milliohm_by_ten_kelvin() {
        // 2.4 mOhm at 20 °C: 0.001 K at 0.1 A, 9.9 K at 10 A.
        let rise = |current: f64| rise_k(2.4e-3 * current, 20.0);
        assert!((rise(0.1) - 1.006e-3).abs() < 1e-6, "{}", rise(0.1));
        assert!((rise(10.0) - 9.898_8).abs() < 1e-4, "{}", rise(10.0));
        assert!(rise(0.0) <= 0.0);
        // Softening voltages of metals are some tenths of a volt: 0.12 V is 190 °C of copper (Holm).
        assert!(
            (rise_k(0.12, 20.0) - 190.0).abs() < 25.0,
            "{}",
            rise_k(0.12, 20.0)
        );
    }
}
