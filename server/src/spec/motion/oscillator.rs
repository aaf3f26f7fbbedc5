//! A part on an elastic support that is shaken: its displacement relative to the base, of a natural frequency f_n and a quality
//! factor Q.
//!
//! For a base acceleration of amplitude a at a frequency f, with rho = f/f_n,
//!   u = a/w_n^2 / sqrt((1 - rho^2)^2 + (rho/Q)^2).
//! For a random one of the power spectral density G the standard deviation s of the displacement is the root of the integral of
//! G |u/a|^2 over f (here between the points of G, which are joined by straight lines in logarithms). The amplitudes A of a narrow-band
//! Gaussian displacement are Rayleigh's, P(A > x) = exp(-x^2/(2 s^2)). Where a stop ends them at b and a contact takes up c without slip,
//! a cycle has the path 4 (min(A, b) - c), or none, and in the mean
//!   4 int_c^b P(A > x) dx = 4 sqrt(pi/2) s [erfc(c/(s sqrt 2)) - erfc(b/(s sqrt 2))].

use std::f64::consts::{PI, SQRT_2};

use statrs::function::erf::erfc;

use super::contact::Limits;

/// Intervals of Simpson's rule over a segment: doubled until the integral changes by less than this part, or to the most.
const INTERVALS: (u32, u32) = (256, 1 << 20);
const CONVERGED: f64 = 1e-9;

/// A damped oscillator.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(super) struct Oscillator {
    /// Natural frequency, Hz.
    pub(super) natural_hz: f64,
    /// Quality factor, -.
    pub(super) quality: f64,
}

impl Oscillator {
    /// Relative displacement over the base's acceleration at a frequency in Hz, s^2.
    pub(super) fn compliance(self, frequency_hz: f64) -> f64 {
        let ratio = frequency_hz / self.natural_hz;
        let resonance = (1.0 - ratio * ratio).hypot(ratio / self.quality);
        1.0 / ((2.0 * PI * self.natural_hz).powi(2) * resonance)
    }

    /// Standard deviation of the relative displacement, mm, for points of a power spectral density in Hz and (mm/s^2)^2/Hz, in
    /// ascending order.
    pub(super) fn deviation(self, density: &[(f64, f64)]) -> f64 {
        let segments = density.windows(2);
        segments
            .map(|ends| self.variance(ends[0], ends[1]))
            .sum::<f64>()
            .sqrt()
    }

    /// Integral over a segment.
    fn variance(self, (from, first): (f64, f64), (to, last): (f64, f64)) -> f64 {
        let range = (to / from).ln();
        let slope = if first > 0.0 && last > 0.0 {
            (last / first).ln() / range
        } else {
            0.0
        };
        let value = |x: f64| {
            let frequency = from * x.exp();
            first * (slope * x).exp() * self.compliance(frequency).powi(2) * frequency
        };
        let (mut intervals, most) = INTERVALS;
        let mut integral = simpson(value, range, intervals);
        while intervals < most {
            intervals *= 2;
            let finer = simpson(value, range, intervals);
            let is_converged = (finer - integral).abs() <= CONVERGED * finer;
            integral = finer;
            if is_converged {
                break;
            }
        }
        integral
    }
}

/// Integral of a function from 0 on by Simpson's rule with an even number of intervals.
fn simpson(value: impl Fn(f64) -> f64, range: f64, intervals: u32) -> f64 {
    let step = range / f64::from(intervals);
    let inner: f64 = (1..intervals)
        .map(|i| {
            let weight = if i % 2 == 1 { 4.0 } else { 2.0 };
            weight * value(step * f64::from(i))
        })
        .sum();
    (value(0.0) + inner + value(range)) * step / 3.0
}

/// Mean path of the slip in a cycle, mm, of a Gaussian displacement of a standard deviation in mm.
pub(super) fn gaussian_path(deviation: f64, Limits { held_mm, stop_mm }: Limits) -> f64 {
    if !(deviation > 0.0 && held_mm < stop_mm) {
        return 0.0;
    }
    let beyond = |mm: f64| erfc(mm / (deviation * SQRT_2));
    4.0 * (0.5 * PI).sqrt() * deviation * (beyond(held_mm) - beyond(stop_mm))
}

#[cfg(test)]
mod tests {
    use super::super::vibration::STANDARD_GRAVITY_MM_S2;
    use super::*;

    #[test]
    fn a_resonance_multiplies_the_static_displacement_by_the_quality_factor() {
        let oscillator = Oscillator {
            natural_hz: 200.0,
            quality: 10.0,
        };
        let ratio = oscillator.compliance(200.0) / oscillator.compliance(1e-6);
        assert!((ratio - 10.0).abs() < 1e-9);
        // Far above it the part rests in space.
        let far = oscillator.compliance(2e6) * (2.0 * PI * 2e6_f64).powi(2);
        assert!((far - 1.0).abs() < 1e-6);
    }

    #[test]
    fn a_random_vibration_has_the_deviation_of_the_reference() {
        // 0.01 to 0.02 g^2/Hz from 5 to 20 Hz, then even to 500 Hz: 3.136 g.
        let g2 = STANDARD_GRAVITY_MM_S2.powi(2);
        let density = [(5.0, 0.01), (20.0, 0.02), (500.0, 0.02)].map(|(f, g)| (f, g * g2));
        let oscillator = Oscillator {
            natural_hz: 200.0,
            quality: 10.0,
        };
        let deviation = 1e3 * oscillator.deviation(&density);
        assert!((deviation - 49.119).abs() < 5e-4, "{deviation}");
    }

    fn path(deviation: f64, held_mm: f64, stop_mm: f64) -> f64 {
        gaussian_path(deviation, Limits { held_mm, stop_mm })
    }

    #[test]
    fn the_path_of_a_gaussian_displacement_falls_with_what_the_arm_takes_up() {
        for (held, expected) in [(0.0, 5.013_257), (1.0, 1.590_759)] {
            let path = path(1.0, held, f64::INFINITY);
            assert!((path - expected).abs() < 1e-6, "{held}: {path}");
        }
        assert!(path(0.0, 1.0, f64::INFINITY) <= 0.0 && path(1.0, 40.0, f64::INFINITY) < 1e-100);
    }

    /// Amplitudes at evenly spaced probabilities, which is the mean over Rayleigh's distribution.
    #[test]
    fn the_path_between_stops_is_the_mean_over_amplitudes_that_end_there() {
        const DRAWS: u32 = 200_000;
        for (held, stop) in [
            (0.0, 0.5),
            (0.0, 3.0),
            (0.7, 1.0),
            (1.5, 2.5),
            (1.0, 1.0),
            (2.0, 1.0),
        ] {
            let of_draw = |i: u32| {
                let above = (f64::from(i) + 0.5) / f64::from(DRAWS);
                let amplitude = (-2.0 * above.ln()).sqrt();
                4.0 * (amplitude.min(stop) - held).max(0.0)
            };
            let mean = (0..DRAWS).map(of_draw).sum::<f64>() / f64::from(DRAWS);
            // The sum is exact to a part of its number of terms.
            assert!(
                (path(1.0, held, stop) - mean).abs() < 1e-4,
                "{held}, {stop}: {mean}"
            );
        }
    }
}
