//! Barwell's laws of wear that changes in the course of sliding (thesis, equations 1 and 3), by dose instead of time:
//!   decelerating, as in running-in: dh/dD = k0 - h/D0,  h = k0 D0 (1 - exp(-D/D0)),
//!   accelerating:                   dh/dD = k0 + h/D0,  h = k0 D0 (exp(D/D0) - 1).
//!
//! D = int p |ds|: dose, MPa mm; k0: initial specific wear rate, 1/MPa; D0: characteristic dose, MPa mm; h: worn depth, mm. The
//! source gives the worn volume W over the time t, W = (beta/alpha) (1 - exp(-alpha t)) and W = beta exp(alpha t), for a constant
//! load and speed; the dose is in proportion to that time, alpha t = D/D0, and holds for any course of load and speed. Corrections
//! of the source: its epsilon is e; its (3) starts at beta, which is subtracted here, so that the unworn surface has no wear; its
//! beta is a rate in (1) and a volume in (3), beta = k0 and k0 D0 here. Equation 2, W = alpha t, is a constant rate: Archard's law.
//!
//! Limiting case: D0 without bound is Archard's law with k0. Range: empirical, of the course that k0 and D0 were fitted to. The
//! decelerating course ends at the depth k0 D0; the accelerating one has no end of its own.

use super::rate::{LocalState, Rate};

/// Rest of the decelerating course, over the depth where it ends, that does not wear any more: its dose would be the difference of
/// nearly equal numbers. Far below any tolerance, far above round-off.
const REST: f64 = 1e-12;

/// How the rate changes with the dose.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Course {
    /// The rate falls toward zero (equation 1).
    Decelerating,
    /// The rate grows with the depth (equation 3).
    Accelerating,
}

/// The law of a surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Barwell {
    /// Initial specific wear rate k0, 1/MPa; positive.
    pub rate_per_mpa: f64,
    /// Characteristic dose D0, MPa mm; positive.
    pub dose_mpa_mm: f64,
    /// How the rate changes.
    pub course: Course,
}

impl Barwell {
    /// Depth scale k0 D0, mm.
    fn scale(&self) -> f64 {
        self.rate_per_mpa * self.dose_mpa_mm
    }

    /// Specific wear rate at a depth in mm, 1/MPa.
    pub fn rate(&self, depth: f64) -> f64 {
        let share = depth / self.scale();
        match self.course {
            Course::Decelerating if depth >= self.deepest() => 0.0,
            Course::Decelerating => self.rate_per_mpa * (1.0 - share),
            Course::Accelerating => self.rate_per_mpa * (1.0 + share),
        }
    }

    /// Largest specific wear rate from the surface down to a depth in mm, 1/MPa.
    pub(crate) fn largest_rate(&self, depth: f64) -> f64 {
        match self.course {
            Course::Decelerating => self.rate_per_mpa,
            Course::Accelerating => self.rate(depth),
        }
    }

    /// Largest depth that wear reaches, mm.
    pub fn deepest(&self) -> f64 {
        match self.course {
            Course::Decelerating => self.scale() * (1.0 - REST),
            Course::Accelerating => f64::INFINITY,
        }
    }

    /// Depth by which a dose in MPa mm recedes a surface that is worn to a depth, mm, and the rate that it ends with, 1/MPa.
    pub(crate) fn recession(&self, depth: f64, dose: f64) -> (f64, f64) {
        let part = dose / self.dose_mpa_mm;
        let worn = match self.course {
            Course::Decelerating => {
                let room = (self.deepest() - depth).max(0.0);
                ((depth - self.scale()) * (-part).exp_m1()).min(room)
            }
            Course::Accelerating => (depth + self.scale()) * part.exp_m1(),
        };
        (worn, self.rate(depth + worn))
    }

    /// k0 times the dose of a depth in mm, mm.
    pub fn equivalent(&self, depth: f64) -> f64 {
        let scale = self.scale();
        match self.course {
            Course::Decelerating => -scale * (-depth.min(self.deepest()) / scale).ln_1p(),
            Course::Accelerating => scale * (depth / scale).ln_1p(),
        }
    }

    /// The law at another hardness than it was given with: the same course after a dose in proportion to the hardness.
    #[must_use]
    pub(crate) fn softened(self, ratio: f64) -> Self {
        Self {
            rate_per_mpa: self.rate_per_mpa / ratio,
            dose_mpa_mm: self.dose_mpa_mm * ratio,
            ..self
        }
    }
}

/// Mean specific wear rate over the dose of an increment that begins at the depth of a state, with its derivatives.
pub(super) fn rate(law: Barwell, at: LocalState) -> Rate {
    let (worn, end) = law.recession(at.depth, at.pressure * at.slip);
    Rate::over_dose(at.pressure, at.slip, worn, end)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// k = 1e-4 over H = 1 700 MPa, D0 = 600 MPa mm.
    const fn law(course: Course) -> Barwell {
        Barwell {
            rate_per_mpa: 1e-4 / 1_700.0,
            dose_mpa_mm: 600.0,
            course,
        }
    }

    const COURSES: [Course; 2] = [Course::Decelerating, Course::Accelerating];

    #[test]
    fn half_the_characteristic_dose_and_three_more_wear_a_plated_contact() {
        for (course, first, next) in [
            (Course::Decelerating, 1.388_715e-5, 1.067_677e-7),
            (Course::Accelerating, 2.289_604e-5, 2.916_794e-7),
        ] {
            let worn = law(course).recession(0.0, 300.0).0;
            assert!((worn - first).abs() < 1e-11, "{worn}");
            let worn = law(course).recession(worn, 3.0).0;
            assert!((worn - next).abs() < 1e-13, "{worn}");
        }
    }

    #[test]
    fn many_increments_wear_as_one_and_the_dose_of_a_depth_is_its_inverse() {
        for course in COURSES {
            let law = law(course);
            let mut depth = 0.0;
            for _ in 0..1_000 {
                depth += law.recession(depth, 1.2).0;
            }
            let once = law.recession(0.0, 1_200.0).0;
            assert!((depth / once - 1.0).abs() < 1e-12, "{depth} {once}");
            let equivalent = law.equivalent(once);
            assert!((equivalent / (1_200.0 * law.rate_per_mpa) - 1.0).abs() < 1e-13);
        }
    }

    #[test]
    fn a_characteristic_dose_without_bound_is_archards_law() {
        for course in COURSES {
            let law = Barwell {
                dose_mpa_mm: 1e12,
                ..law(course)
            };
            let worn = law.recession(1e-5, 300.0).0;
            assert!((worn / (300.0 * law.rate_per_mpa) - 1.0).abs() < 1e-8);
        }
    }

    #[test]
    fn a_decelerating_course_ends_at_its_depth() {
        let law = law(Course::Decelerating);
        let (worn, end) = law.recession(0.0, 1e9);
        assert!((worn / law.deepest() - 1.0).abs() < 1e-15 && end <= 0.0);
        assert!(law.equivalent(worn).is_finite());
        assert!(law.recession(worn, 1.0).0 <= 0.0);
        let softer = law.softened(0.5);
        assert!((softer.deepest() / law.deepest() - 1.0).abs() < 1e-15);
        let sooner = softer.recession(0.0, 150.0).0 / law.recession(0.0, 300.0).0;
        assert!((sooner - 1.0).abs() < 1e-15, "{sooner}");
    }
}
