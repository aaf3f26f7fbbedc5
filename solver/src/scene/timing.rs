//! Course of the imposed motion in time: nothing in the contact problem depends on it, wear laws of time and speed do.

use std::f64::consts::{FRAC_2_PI, PI};
use std::sync::Arc;

use super::motion::Motion;
use super::series::Series;
use crate::law::pace::Pace;
use crate::law::surface::SurfaceWear;
use crate::law::wear::WearLaw;
use crate::number::real;

/// Course of the imposed motion in time.
#[derive(Debug, Clone, PartialEq)]
pub enum Timing {
    /// A sine of the period of a reciprocating motion.
    Sine,
    /// A constant speed between the turning points of a reciprocating or periodic motion.
    Triangle,
    /// The series whose turning points those of a periodic motion are.
    Series(Arc<Series>),
    /// A constant speed of a continuous motion.
    Speed {
        /// The speed, mm/s.
        mm_s: f64,
    },
}

/// A motion and its course in time.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct TimedMotion {
    /// Amplitude of a reciprocating motion, mm.
    amplitude_mm: f64,
    /// Distance of a cycle, mm; 0 of a continuous motion.
    distance_mm: f64,
    /// Period, s; without bound of a continuous one.
    period_s: f64,
    timing: Timing,
}

impl TimedMotion {
    /// A motion with its course.
    pub(crate) fn new(motion: Motion, timing: &Timing) -> Self {
        Self {
            amplitude_mm: motion.amplitude_mm().abs(),
            distance_mm: match motion {
                Motion::Continuous { .. } => 0.0,
                _ => motion.distance_per_cycle_mm().abs(),
            },
            period_s: motion.period_s().unwrap_or(f64::INFINITY),
            timing: timing.clone(),
        }
    }

    /// Mean pace of a cycle; none of a motion without a distance.
    pub(crate) fn mean(&self) -> Pace {
        match self.timing {
            Timing::Speed { mm_s } => self.at_speed(mm_s),
            Timing::Sine | Timing::Triangle | Timing::Series(_) => {
                self.at_speed(self.distance_mm / self.period_s)
            }
        }
    }

    fn at_speed(&self, mm_s: f64) -> Pace {
        let distance = self.distance_mm;
        Pace {
            cycles_per_mm: if distance > 0.0 { 1.0 / distance } else { 0.0 },
            ..Pace::at_speed(mm_s)
        }
    }

    /// Pace at the fastest moment.
    pub(crate) fn fastest(&self) -> Pace {
        match &self.timing {
            Timing::Sine => self.at_speed(2.0 * PI * self.amplitude_mm / self.period_s),
            Timing::Series(series) => self.at_speed(series.fastest() / self.period_s),
            Timing::Speed { .. } | Timing::Triangle => self.mean(),
        }
    }

    /// Mean of a value that depends on the speed in mm/s, by distance.
    pub(crate) fn mean_by_distance(&self, at: impl Fn(f64) -> f64) -> f64 {
        // Midpoints of a quarter of a sine: exact for its first harmonics.
        const PARTS: usize = 16;
        match &self.timing {
            Timing::Speed { .. } | Timing::Triangle => at(self.mean().speed()),
            Timing::Series(series) => {
                let (mut sum, mut whole) = (0.0, 0.0);
                for speed in series.speeds() {
                    sum += speed * at(speed / self.period_s);
                    whole += speed;
                }
                sum / whole
            }
            Timing::Sine => {
                let fastest = self.fastest().speed();
                let shares = (0..PARTS).map(|i| (0.5 * PI * (real(i) + 0.5) / real(PARTS)).cos());
                let (mut sum, mut whole) = (0.0, 0.0);
                for share in shares {
                    sum += share * at(share * fastest);
                    whole += share;
                }
                sum / whole
            }
        }
    }

    /// A law of speed as its mean rate over the distance of a cycle; another wear as it is, and a law of time, whose rate at the mean speed it
    /// is.
    pub(crate) fn mean_wear(&self, wear: SurfaceWear) -> SurfaceWear {
        match wear {
            SurfaceWear::Law(WearLaw::OfSpeed(law)) if !law.is_by_time() => {
                SurfaceWear::Law(WearLaw::Archard {
                    k_over_h_per_mpa: self.mean_by_distance(|mm_s| law.rate(Pace::at_speed(mm_s))),
                })
            }
            wear => wear,
        }
    }

    /// The wear from one displacement of a stroke to another, mm. A law of speed that is not one of time has the mean rate of the parts of
    /// the increment: it may begin, or change its mechanism, within.
    pub(crate) fn wear_between(
        &self,
        wear: SurfaceWear,
        stroke: usize,
        from: f64,
        to: f64,
        distance_mm: f64,
    ) -> SurfaceWear {
        const PARTS: usize = 16;
        let pace = self.between(stroke, from, to);
        match wear {
            SurfaceWear::Law(WearLaw::OfSpeed(law))
                if !law.is_by_time() && self.constant().is_none() =>
            {
                let at = |part: usize| from + (to - from) * real(part) / real(PARTS);
                let rates =
                    (0..PARTS).map(|part| law.rate(self.between(stroke, at(part), at(part + 1))));
                SurfaceWear::Law(WearLaw::Archard {
                    k_over_h_per_mpa: rates.sum::<f64>() / real(PARTS),
                })
            }
            wear => wear.during(pace, distance_mm),
        }
    }

    /// The pace, if it is the same all the time.
    pub(crate) fn constant(&self) -> Option<Pace> {
        match self.timing {
            Timing::Sine | Timing::Series(_) => None,
            Timing::Speed { .. } | Timing::Triangle => Some(self.mean()),
        }
    }

    /// Mean pace from one displacement of a stroke of the cycle to another, mm.
    pub(crate) fn between(&self, stroke: usize, from: f64, to: f64) -> Pace {
        let time = match &self.timing {
            Timing::Speed { .. } | Timing::Triangle => return self.mean(),
            Timing::Sine => {
                let phase = |x: f64| (x / self.amplitude_mm).clamp(-1.0, 1.0).asin();
                self.period_s / (2.0 * PI) * (phase(to) - phase(from)).abs()
            }
            Timing::Series(series) => {
                self.period_s * (series.time(stroke, to) - series.time(stroke, from)).abs()
            }
        };
        let distance = (to - from).abs();
        self.at_speed(if time > 0.0 { distance / time } else { 0.0 })
    }
}

/// How the wear of a pass is spread over its stroke.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Spread {
    /// Evenly over the distance.
    Distance,
    /// Evenly over the time of a sine.
    SineTime,
}

impl Spread {
    /// Part of a pass up to a displacement s, from -A to A, as a displacement in mm that would be worn evenly; its integral over s.
    pub(crate) fn swept(self, s: f64, amplitude: f64) -> (f64, f64) {
        let within = s.clamp(-amplitude, amplitude);
        match self {
            Self::Distance => (within, within * (s - 0.5 * within)),
            Self::SineTime => {
                let share = within / amplitude;
                let swept = FRAC_2_PI * amplitude * share.asin();
                let rest = FRAC_2_PI * amplitude * amplitude * (1.0 - share * share).sqrt();
                (swept, swept * s + rest)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const SINE: TimedMotion = TimedMotion {
        amplitude_mm: 0.5,
        distance_mm: 2.0,
        period_s: 2.0,
        timing: Timing::Sine,
    };

    #[test]
    fn the_parts_of_a_stroke_take_half_a_period_together() {
        let steps = [-0.5, -0.3, 0.0, 0.1, 0.45, 0.5];
        let time = |pair: &[f64]| SINE.between(0, pair[0], pair[1]).s_per_mm * (pair[1] - pair[0]);
        let all: f64 = steps.windows(2).map(time).sum();
        assert!((all - 1.0).abs() < 1e-15, "{all}");
        assert!((SINE.mean().s_per_mm - 1.0).abs() < 1e-15);
        // The middle of the stroke has the highest speed.
        let middle = SINE.between(0, -1e-6, 1e-6).s_per_mm;
        assert!((middle / SINE.fastest().s_per_mm - 1.0).abs() < 1e-6);
        assert!(SINE.between(0, 0.1, 0.1).s_per_mm <= 0.0);
    }

    #[test]
    fn the_integral_of_a_swept_part_is_its_own() {
        for spread in [Spread::Distance, Spread::SineTime] {
            let swept = |s| spread.swept(s, 0.5);
            assert!((swept(2.0).0 - 0.5).abs() < 1e-15 && (swept(-2.0).0 + 0.5).abs() < 1e-15);
            for s in [-0.8, -0.5, -0.2, 0.0, 0.3, 0.499, 0.7] {
                let h = 1e-7;
                let slope = (swept(s + h).1 - swept(s - h).1) / (2.0 * h);
                assert!((slope - swept(s).0).abs() < 1e-4, "{spread:?} {s}");
            }
        }
    }
}
