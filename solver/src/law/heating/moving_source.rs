//! A uniform line source that moves steadily over a half-plane (Jaeger 1942): the largest temperature under it,
//!   dT = Q'/(pi K) f(L)/(2 L),  f(L) = max over X of int_{X-L}^{X+L} e^u K0(|u|) du,  L = v a/(2 kappa).
//!
//! Q': heat per length, W/m; K: conductivity, W/(m K); v: speed; a: half-width of the source; kappa: diffusivity; K0: modified Bessel
//! function. Limiting case: f = 2 sqrt(pi L) of a fast source, whose heat does not diffuse along the surface.

use std::f64::consts::{LN_10, PI};
use std::sync::LazyLock;

use crate::number::{count_at_least, real};

/// Decades of L in the table, and its points in each: linear interpolation of the logarithms is within 1e-4.
const DECADES: (f64, f64) = (-4.0, 3.0);
const POINTS_PER_DECADE: usize = 16;

/// f(L)/(2 L) at each point.
static TABLE: LazyLock<Vec<f64>> = LazyLock::new(|| {
    let decades = count_at_least(DECADES.1 - DECADES.0);
    (0..=decades * POINTS_PER_DECADE)
        .map(|i| {
            let decade = DECADES.0 + real(i) / real(POINTS_PER_DECADE);
            let peclet = 10_f64.powf(decade);
            largest(peclet) / (2.0 * peclet)
        })
        .collect()
});

/// Euler's constant gamma.
pub(super) const EULER: f64 = 0.577_215_664_901_532_9;

/// Lower limit of f(L)/(2 L), -, which it approaches for small L: 1 - gamma + ln(2/L), the source at rest in a body as far as diffusion is
/// ahead of it.
pub(super) fn least(peclet: f64) -> f64 {
    1.0 - EULER + (2.0 / peclet).ln()
}

/// f(L)/(2 L), -; that of the smallest L of the table for smaller ones, which is far beyond any contact's distance to a heat sink.
pub(super) fn factor(peclet: f64) -> f64 {
    let decade = peclet.max(f64::MIN_POSITIVE).ln() / LN_10;
    if decade >= DECADES.1 {
        return (PI / peclet).sqrt();
    }
    let at = (decade - DECADES.0).max(0.0) * real(POINTS_PER_DECADE);
    let first = count_at_least(at.floor()).min(TABLE.len() - 2);
    let [below, above] = [TABLE[first].ln(), TABLE[first + 1].ln()];
    (below + (at - real(first)) * (above - below)).exp()
}

/// f(L).
fn largest(peclet: f64) -> f64 {
    largest_under(peclet, |x| swept(x + peclet) - swept(x - peclet))
}

/// The largest temperature under a source by golden sections: there is one maximum.
fn largest_under(peclet: f64, at: impl Fn(f64) -> f64) -> f64 {
    const RATIO: f64 = 0.618_033_988_749_894_9;
    let (mut low, mut high) = (-peclet, peclet);
    for _ in 0..60 {
        let step = RATIO * (high - low);
        if at(high - step) > at(low + step) {
            high = low + step;
        } else {
            low = high - step;
        }
    }
    at(0.5 * (low + high))
}

/// int_0^x e^u K0(|u|) du = x e^x (K0 + K1) - 1 for x > 0, and -(1 - |x| e^x (K1 - K0)) for x < 0.
fn swept(x: f64) -> f64 {
    let size = x.abs();
    if size <= 0.0 {
        return 0.0;
    }
    let [k0, k1] = scaled_bessel(size);
    if x > 0.0 {
        size * (k0 + k1) - 1.0
    } else {
        size * (k1 - k0) * (-2.0 * size).exp() - 1.0
    }
}

/// e^x K0(x) and e^x K1(x) = int_0^inf exp(-x (cosh t - 1)) (1, cosh t) dt by the trapezoidal rule, which converges exponentially.
fn scaled_bessel(x: f64) -> [f64; 2] {
    // Below the round-off of the sum.
    const SMALLEST: f64 = 45.0;
    // A fraction of the width 1/sqrt(x) of the integrand's middle.
    let interval = (0.7 / x.sqrt()).min(0.1);
    let mut sums = [0.5, 0.5];
    for i in 1.. {
        let cosh = (interval * real(i)).cosh();
        let exponent = x * (cosh - 1.0);
        if exponent > SMALLEST {
            break;
        }
        let value = (-exponent).exp();
        sums = [sums[0] + value, sums[1] + value * cosh];
    }
    sums.map(|sum| interval * sum)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bessel_functions_have_their_tabulated_values() {
        // Abramowitz and Stegun, table 9.8: K0(1) = 0.421024438, K1(1) = 0.601907230.
        let [k0, k1] = scaled_bessel(1.0).map(|value| value / 1_f64.exp());
        assert!((k0 - 0.421_024_438).abs() < 1e-9 && (k1 - 0.601_907_230).abs() < 1e-9);
    }

    /// A source in proportion to Hertz' pressure, of the same heat, as strips: at least as hot, by 5 % where it is slow.
    #[test]
    fn the_heat_of_hertz_pressure_is_up_to_a_twentieth_hotter() {
        const STRIPS: usize = 2_000;
        let edge = |i: usize| (PI * (real(i) / real(STRIPS) - 0.5)).sin();
        for (peclet, value) in [(0.1, 0.727_02), (1.0, 3.286_56), (10.0, 11.032_79)] {
            let at = |x: f64| -> f64 {
                let strip = |i: usize| {
                    let (from, to) = (edge(i), edge(i + 1));
                    let middle = 0.5 * (from + to);
                    let heat = 4.0 / PI * (1.0 - middle * middle).sqrt();
                    heat * (swept(x - peclet * from) - swept(x - peclet * to))
                };
                (0..STRIPS).map(strip).sum()
            };
            let found = largest_under(peclet, at);
            assert!((found / value - 1.0).abs() < 1e-5, "{peclet}: {found}");
            let ratio = found / largest(peclet);
            assert!(ratio > 1.0 && ratio < 1.06, "{peclet}: {ratio}");
        }
    }

    #[test]
    fn a_moving_source_has_jaegers_temperatures() {
        for (peclet, value) in [(0.1, 0.691_25), (1.0, 3.115_99), (10.0, 10.948_44)] {
            let found = largest(peclet);
            assert!((found / value - 1.0).abs() < 2e-5, "{peclet}: {found}");
            let found = 2.0 * peclet * factor(peclet);
            assert!((found / value - 1.0).abs() < 1e-4, "{peclet}: {found}");
        }
        // From its lower limit on.
        for (i, found) in TABLE.iter().enumerate() {
            let peclet = 10_f64.powf(DECADES.0 + real(i) / real(POINTS_PER_DECADE));
            assert!(*found >= least(peclet), "{peclet}: {found}");
        }
        assert!((TABLE[0] / least(1e-4) - 1.0).abs() < 1e-4, "{}", TABLE[0]);
        for peclet in [3e-4, 0.0234, 0.7, 55.5, 700.0] {
            let found = 2.0 * peclet * factor(peclet) / largest(peclet);
            assert!((found - 1.0).abs() < 5e-4, "{peclet}: {found}");
        }
        assert!((factor(1e4) / factor(0.999e3) - (0.0999_f64).sqrt()).abs() < 5e-3);
    }
}
