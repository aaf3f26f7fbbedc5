//! Temperature of a sliding line contact above its surroundings,
//!   dT = s (Q'(t) r_flash + mean(Q') r_bulk),  Q' = mu P' v.
//!
//! Q': heat of friction per depth, W/m; s: the body's share of it, such that both meet at one temperature (Blok 1937); r: thermal
//! resistances of the body, m K/W. What flows in during half a period reaches as far as l = sqrt(kappa T/pi), the depth of penetration
//! of the period T; beyond it the heat is even in time.
//! * Body at which the contact stays:     r_flash = (ln(l/a) + 1)/(pi K),  r_bulk = ln(d/l)/(pi K).
//! * Body over which the contact moves:   r_flash = the smaller of the same and Jaeger's f(L)/(2 L)/(pi K) (`moving_source`); its
//!   mean heat is spread over the track, r_bulk = (ln(d/w) + 1 - l/w)/(pi K) where l < w, and as above where l > w.
//!
//! Heat that has flowed for a time t has reached d = sqrt(4 kappa t) exp(-gamma/2), gamma Euler's constant: with it the temperature of a line
//! source at rest, Q'/(2 pi K) E1(r^2/(4 kappa t)), is that of a sink at d.
//!
//! a: half-width of the contact; w: amplitude + a; d: distance to where the bodies keep their temperature; K: conductivity; kappa:
//! diffusivity; a uniform source at rest has (ln(d/a) + 1)/(pi K) at its middle (Jaeger 1942; Carslaw and Jaeger 1959). Without a known
//! diffusivity a body is taken as fast as it is at rest, l = d: an upper limit.
//!
//! Range: one temperature for the whole contact; against Green's functions of an oscillating source within what the test below states.
//! Limiting cases: none without speed; slow sliding has the temperature at rest of its momentary heat.

use std::f64::consts::PI;

use super::moving_source::{self, EULER};

/// A body as a conductor of heat.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Conductor {
    /// Thermal conductivity K, W/(m K).
    pub conductivity_w_mk: f64,
    /// Diffusivity kappa, mm^2/s; `None` where it is not known.
    pub diffusivity_mm2_s: Option<f64>,
}

/// A sliding contact as a source of heat.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct SlidingHeat {
    /// Half-width a, mm.
    pub half_width_mm: f64,
    /// Amplitude of the motion, mm.
    pub amplitude_mm: f64,
    /// Period T, s; without bound of a continuous motion.
    pub period_s: f64,
    /// Time t for which it has slid, s; without bound of steady heat.
    pub duration_s: f64,
    /// Distance d to where the bodies keep their temperature, mm.
    pub distance_mm: f64,
    /// The body at which the contact stays.
    pub resting: Conductor,
    /// The body over which it moves.
    pub passed: Conductor,
}

impl SlidingHeat {
    /// Temperature rise at a speed, and the mean speed of the motion, in mm/s, for each N/mm of friction, K mm/N.
    pub(crate) fn rise(&self, speed_mm_s: f64, mean_mm_s: f64) -> f64 {
        let resting = self.near(self.resting) * speed_mm_s + self.far(self.resting) * mean_mm_s;
        let near = self.near(self.passed);
        let peclet = self
            .passed
            .diffusivity_mm2_s
            .map(|diffusivity| 0.5 * speed_mm_s * self.half_width_mm / diffusivity);
        // A source that is slow against diffusion is the one at rest.
        let fast = peclet.filter(|peclet| moving_source::least(*peclet) < near);
        let near = fast.map_or(near, |peclet| moving_source::factor(peclet).min(near));
        let passed = near * speed_mm_s + self.far_of_track() * mean_mm_s;
        // N/mm mm/s = W/m.
        let conductance = |of: f64, body: Conductor| PI * body.conductivity_w_mk / of;
        1.0 / (conductance(resting, self.resting) + conductance(passed, self.passed))
    }

    /// pi K r_flash at rest.
    fn near(&self, body: Conductor) -> f64 {
        (self.reach(body) / self.half_width_mm).ln() + 1.0
    }

    /// pi K r_bulk at rest.
    fn far(&self, body: Conductor) -> f64 {
        (self.distance_reached(body) / self.reach(body)).ln()
    }

    /// pi K r_bulk of the body over which the contact moves.
    fn far_of_track(&self) -> f64 {
        let (reach, distance) = (self.reach(self.passed), self.distance_reached(self.passed));
        let track = (self.amplitude_mm + self.half_width_mm).min(distance);
        if reach < track {
            (distance / track).ln() + 1.0 - reach / track
        } else {
            self.far(self.passed)
        }
    }

    /// The distance to the sink; a contact that is wider is as far as its half-width.
    fn distance(&self) -> f64 {
        self.distance_mm.max(self.half_width_mm)
    }

    /// The same, or what heat has reached in the time of sliding, but not less than in a period.
    fn distance_reached(&self, body: Conductor) -> f64 {
        let reached = body.diffusivity_mm2_s.map_or(f64::INFINITY, |kappa| {
            (4.0 * kappa * self.duration_s).sqrt() * (-0.5 * EULER).exp()
        });
        self.distance().min(reached.max(self.reach(body)))
    }

    /// l, mm.
    fn reach(&self, body: Conductor) -> f64 {
        let reach = body
            .diffusivity_mm2_s
            .map_or(f64::INFINITY, |kappa| (kappa * self.period_s / PI).sqrt());
        reach.clamp(self.half_width_mm, self.distance())
    }
}

#[cfg(test)]
mod tests;
