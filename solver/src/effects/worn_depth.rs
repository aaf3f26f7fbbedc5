//! Worn depths in closed form, for indicators.
//!
//! A worn section W = k P s of the receptacle is taken as a parabola of depth h over a scar of half-width A/2 + sqrt(2 R h),
//!   (4/3) h (A/2 + sqrt(2 R h)) = W:
//! for A = 0 the segment of the arc, in gross sliding an empirical mean of parabola and flat floor (`sd_card`: 1.83 um for 1.76 um
//! at A = 0.02 mm). A worn section of the slider is the segment. Each body is taken to
//! wear against an unworn one: where both wear a common scar, neither becomes deeper.

use crate::model::resolution;
use crate::number::real_cycles;
use crate::scene::Scene;
use crate::sides::Sides;

/// Halvings of the interval that holds a depth: far below any indicator's precision.
const HALVINGS: usize = 50;

/// Largest worn depths after so many cycles at these specific wear rates, mm.
pub(super) fn after(scene: &Scene, rates: Sides<f64>, cycles: u64) -> Sides<f64> {
    let sliding = scene.motion.distance_per_cycle_mm() * real_cycles(cycles);
    let sections = rates.map(|rate| rate * scene.load_n_per_mm * sliding);
    let radius = resolution::radius(scene);
    let most = scene.slider.shape.height_mm;
    Sides {
        slider: depth(sections.slider, 0.0, radius).min(most),
        receptacle: depth(sections.receptacle, scene.motion.amplitude_mm(), radius)
            .min(scene.receptacle.shape.height_mm),
    }
}

/// Depth of a groove of a section, mm.
fn depth(section: f64, amplitude: f64, radius: f64) -> f64 {
    let worn = |h: f64| 4.0 / 3.0 * h * (0.5 * amplitude + (2.0 * radius * h).sqrt());
    // Without the flat part.
    let segment = (0.75 * section / (2.0 * radius).sqrt()).powf(2.0 / 3.0);
    let (mut low, mut high) = (0.0, segment);
    for _ in 0..HALVINGS {
        let middle = 0.5 * (low + high);
        if worn(middle) < section {
            low = middle;
        } else {
            high = middle;
        }
    }
    high
}

#[cfg(test)]
mod tests {
    use super::depth;

    #[test]
    fn a_groove_holds_its_section() {
        for (amplitude, radius) in [(0.0, 0.4), (1e-3, 0.4), (0.02, 0.05), (1.0, 0.4)] {
            let h = depth(1e-4, amplitude, radius);
            let section = 4.0 / 3.0 * h * (0.5 * amplitude + (2.0 * radius * h).sqrt());
            assert!((section / 1e-4 - 1.0).abs() < 1e-9, "{amplitude} {radius}");
        }
        assert!(depth(0.0, 0.02, 0.4) <= 0.0);
    }
}
