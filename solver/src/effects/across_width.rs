//! Distribution of the load across the width of the section, by the life of a ball.
//!
//! By Archard's law a section of the width w wears a segment of (4/3) h sqrt(2 R h) off a tip of the radius R until its depth is h, and
//! a ball of that radius a cap of pi R h^2, so that under one force and on one path
//!   N_ball/N_section = pi R h^2/(w (4/3) h sqrt(2 R h)) = (3 pi/(4 sqrt 2)) sqrt(R h)/w.
//! A groove in a flat pad, (4/3) t sqrt(2 R t) across the path over w t, has 1.886 instead of 1.666.
//!
//! R: radius of relative curvature, mm; h: worn depth, mm. Range: depths beyond the elastic approach. Limiting case: 1, where the ball is
//! worn over all of the width. A crown across the width lies between both.

use std::f64::consts::{PI, SQRT_2};

/// Life of a ball over that of the section until a depth, at most 1.
pub(super) fn life_of_ball(width_mm: f64, radius_mm: f64, depth_mm: f64) -> f64 {
    let ratio = 0.75 * PI / SQRT_2 * (radius_mm * depth_mm).sqrt() / width_mm;
    ratio.min(1.0)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_dimple_of_an_sd_card_is_through_its_gold_27_times_sooner() {
        let sooner = 1.0 / life_of_ball(0.8, 0.4, 0.76e-3);
        assert!((sooner - 27.54).abs() < 0.01, "{sooner}");
        assert!((life_of_ball(1e-3, 0.4, 0.76e-3) - 1.0).abs() < 1e-15);
    }
}
