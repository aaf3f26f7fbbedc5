//! A jump in a groove: the wear of its cycles but the last is extrapolated from the last computed cycle, and the last is
//! computed as a single one.
//!
//! So every contact that is solved is that of a single cycle, on a leading-edge step of one pass. A spring loses load as the
//! slider sinks: with the relative loss s of the load in a cycle, n cycles wear as
//!   (1 - exp(-s n))/s
//! cycles at the load of their beginning.

use super::groove::Groove;
use super::{CycleState, Integrator};
use crate::law::surface::SurfaceWear;
use crate::number::real_cycles;
use crate::scene::Spread;

impl Integrator<'_> {
    /// Wears the receptacle by so many cycles before so many computed ones, by fewer where it would be worn through; returns the
    /// dissipated energy, mJ/mm.
    pub(super) fn extrapolate(&mut self, state: &mut CycleState, most: u64, computed: u64) -> f64 {
        let body = &self.pair.operators.receptacle;
        let [one, other] = &state.wear_of_strokes;
        if one.len() != body.x.len() || other.len() != body.x.len() {
            return 0.0;
        }
        let wear = self.wear.receptacle;
        let curve = wear.and_then(SurfaceWear::dose_curve);
        let spread = if wear.is_some_and(SurfaceWear::is_by_time) {
            Spread::SineTime
        } else {
            Spread::Distance
        };
        let initial = curve.map_or(0.0, |curve| curve.initial_rate());
        let single: Vec<f64> = one.iter().zip(other).map(|(a, b)| a + b).collect();
        let groove = Groove {
            x: &body.x,
            widths: &body.widths,
            profile: body.profile,
            radius: self.scene.slider.shape.radius_mm,
            amplitude: self.scene.motion.amplitude_mm().abs(),
            half_width: self.followed(state).narrower(),
            spread,
            curve: curve.as_ref(),
            // Two passes.
            floor: 2.0 * initial * state.neutral.load,
        };
        let mut cycles = most;
        while cycles > 0 {
            let equal = at_the_first_load(real_cycles(cycles), state.loss_of_load);
            if let Some(wear) = groove.wear(&state.depth.receptacle, &single, equal) {
                let mut worn = state.depth.clone();
                for (depth, wear) in worn.receptacle.iter_mut().zip(&wear) {
                    *depth += wear;
                }
                if !self.spines.are_worn_through(&worn) {
                    let area = wear
                        .iter()
                        .zip(&body.widths)
                        .map(|(wear, width)| wear * width);
                    state.worn_area.receptacle += area.sum::<f64>();
                    state.depth = worn;
                    let before = state.cycle;
                    self.count(state, cycles);
                    self.update_surfaces(state, real_cycles(computed));
                    let friction = self.friction_since(before, state);
                    let energy = equal * state.energy_per_cycle * friction;
                    state.energy += energy;
                    return energy;
                }
            }
            cycles /= 2;
        }
        0.0
    }
}

/// Relative loss of the load in each of so many cycles that have changed it, as an exponential rate.
pub(super) fn loss_of_load(before: f64, after: f64, cycles: f64) -> f64 {
    if after > 0.0 && before > after {
        (before / after).ln() / cycles
    } else {
        0.0
    }
}

/// Cycles at the first load that wear as much as so many with this loss of load in each.
fn at_the_first_load(cycles: f64, loss: f64) -> f64 {
    if loss > 0.0 {
        -(-loss * cycles).exp_m1() / loss
    } else {
        cycles
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_spring_that_loses_load_wears_less() {
        assert!((at_the_first_load(100.0, 0.0) - 100.0).abs() <= 0.0);
        assert!((at_the_first_load(100.0, 1e-12) - 100.0).abs() < 1e-7);
        // In proportion to the load, which is exp(-1) of the first one in the end.
        let expected = 100.0 * (1.0 - (-1.0_f64).exp());
        assert!((at_the_first_load(100.0, 0.01) - expected).abs() < 1e-12);
        assert!((loss_of_load(1.0, (-1.0_f64).exp(), 100.0) - 0.01).abs() < 1e-15);
        assert!(loss_of_load(1.0, 1.0, 9.0).max(loss_of_load(1.0, 0.0, 9.0)) <= 0.0);
    }
}
