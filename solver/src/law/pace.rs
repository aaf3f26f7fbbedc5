//! Pace of an imposed motion: what laws of time take over a displacement.
//!
//! A point that slips by the part |s'| of the imposed displacement |ds| of an increment is taken to slip for that part of its
//! duration, so that its time of slip is |s'| times the pace: exact in gross slip, none where a point sticks.

/// Time and cycles over imposed displacement.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub struct Pace {
    /// Time per displacement, s/mm: the inverse of the mean speed.
    pub s_per_mm: f64,
    /// Cycles per displacement, 1/mm; none of a motion without cycles.
    pub cycles_per_mm: f64,
}

impl Pace {
    /// Pace of a speed in mm/s; none of a motion that stands still, in which nothing slips.
    pub(crate) fn at_speed(mm_s: f64) -> Self {
        Self {
            s_per_mm: if mm_s > 0.0 { 1.0 / mm_s } else { 0.0 },
            cycles_per_mm: 0.0,
        }
    }

    /// The speed, mm/s.
    pub fn speed(self) -> f64 {
        if self.s_per_mm > 0.0 {
            1.0 / self.s_per_mm
        } else {
            0.0
        }
    }
}
