//! A rigid block that friction alone holds on a base shaken with the acceleration a sin(w t).
//!
//! With the ratio r = mu N/(m a) of the friction to the inertia:
//! * r >= 1: it does not slip;
//! * r < 2/sqrt(4 + pi^2) = 0.537: it slips all the time, and the range of the relative displacement in each half of a period is
//!   d = (2 a/w^2) sqrt(1 - (pi r/2)^2)
//!   (Den Hartog 1931 for the case without a spring);
//! * between them it sticks until the base's acceleration exceeds that of the friction, at sin(t1) = r, and slips until both
//!   velocities are equal, cos(t1) - cos(t2) = r (t2 - t1):
//!   d = (a/w^2) [(t2 - t1) cos(t1) - sin(t2) + sin(t1) - r (t2 - t1)^2/2].
//!
//! Limiting case: without friction the block rests in space, d = 2 a/w^2.

use std::f64::consts::PI;

/// Halvings of the interval that holds the end of a slip.
const HALVINGS: usize = 60;

/// Range of the relative displacement in half of a period, d w^2/a, for the ratio r of friction to inertia.
pub(super) fn range(ratio: f64) -> f64 {
    if ratio >= 1.0 {
        0.0
    } else if ratio <= always_slips() {
        2.0 * (1.0 - (0.5 * PI * ratio).powi(2)).sqrt()
    } else {
        range_between_stops(ratio)
    }
}

/// Ratio below which the block never stops.
fn always_slips() -> f64 {
    2.0 / (4.0 + PI * PI).sqrt()
}

fn range_between_stops(ratio: f64) -> f64 {
    let begin = ratio.asin();
    let velocity = |t: f64| begin.cos() - t.cos() - ratio * (t - begin);
    // The velocity is largest where the accelerations are equal again, and negative a period later.
    let (mut low, mut high) = (PI - begin, begin + 2.0 * PI);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if velocity(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    let slip = low - begin;
    slip * begin.cos() - low.sin() + begin.sin() - 0.5 * ratio * slip * slip
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_block_sticks_slips_or_never_stops() {
        assert!((range(0.0) - 2.0).abs() < 1e-15);
        assert!((always_slips() - 0.537_029).abs() < 1e-6);
        assert!((range(0.6) - 0.788_372).abs() < 1e-6, "{}", range(0.6));
        assert!(range(1.0) <= 0.0 && range(0.999) < 1e-3 && range(0.999) > 0.0);
        // Both regimes meet.
        let apart = range(always_slips() - 1e-9) - range(always_slips() + 1e-9);
        assert!(apart.abs() < 1e-7, "{apart}");
    }

    /// Integrates the motion of the block by small steps, without knowing when it sticks.
    #[test]
    fn the_range_is_that_of_an_integrated_motion() {
        const STEPS: u32 = 20_000;
        for ratio in [0.3, 0.5, 0.7, 0.9] {
            let step = 2.0 * PI / f64::from(STEPS);
            let (mut velocity, mut place) = (0.0_f64, 0.0);
            let (mut least, mut most) = (f64::INFINITY, f64::NEG_INFINITY);
            for i in 0..40 * STEPS {
                let base = (step * f64::from(i)).sin();
                // Backward Euler of v' = sin t - r sign(v).
                let free = velocity + step * base;
                velocity = free.signum() * (free.abs() - step * ratio).max(0.0);
                place += step * velocity;
                if i >= 39 * STEPS {
                    (least, most) = (f64::min(least, place), f64::max(most, place));
                }
            }
            let off = (most - least) / range(ratio) - 1.0;
            assert!(off.abs() < 2e-3, "{ratio}: {off}");
        }
    }
}
