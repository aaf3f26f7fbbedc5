//! Differences of solutions.

use api::results::{Profile, SideProfile, Summary};
use api::study::Errors;
use solver::interpolation;

/// The compared quantities of a run.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Solution {
    /// Largest worn depth, half-width of the scar, peak pressure, worn area.
    pub(crate) figures: [f64; 4],
    /// Worn depth along the receptacle and the slider.
    pub(crate) profiles: [SideProfile; 2],
}

impl Solution {
    /// From the summary and the last profile of a run. Width and area are those of the receptacle, or of the slider if
    /// only that wears.
    pub(crate) fn of(summary: &Summary, last: &Profile) -> Self {
        let worn = if summary.receptacle.worn_area_mm2 > 0.0 {
            &summary.receptacle
        } else {
            &summary.slider
        };
        Self {
            figures: [
                worn.max_depth_mm,
                worn.scar_half_width_mm,
                summary.peak_pressure_mpa,
                worn.worn_area_mm2,
            ],
            profiles: [last.receptacle.clone(), last.slider.clone()],
        }
    }

    /// Largest worn depth, mm.
    pub(crate) fn deepest(&self) -> f64 {
        let depths = self.profiles.iter().flat_map(|side| &side.depth_mm);
        depths.fold(0.0, |deepest: f64, depth| deepest.max(*depth))
    }

    /// Errors of another solution relative to this one.
    pub(crate) fn errors(&self, other: &Self) -> Errors {
        let relative = |index: usize| {
            let of = self.figures[index];
            relative((other.figures[index] - of).abs(), of.abs())
        };
        let pairs = self.profiles.iter().zip(&other.profiles);
        let differences = pairs.map(|(mine, other)| largest_difference(mine, other));
        Errors {
            depth: self::relative(differences.fold(0.0, f64::max), self.deepest()),
            width: relative(1),
            peak_pressure: relative(2),
            area: relative(3),
        }
    }
}

/// Returns the difference itself if the reference is zero.
fn relative(difference: f64, of: f64) -> f64 {
    if of > 0.0 {
        difference / of
    } else {
        difference
    }
}

/// Returns the largest difference of depth at the points of either profile.
fn largest_difference(mine: &SideProfile, other: &SideProfile) -> f64 {
    let points = mine.x_mm.iter().chain(&other.x_mm);
    let differences = points.map(|x| (depth_at(mine, *x) - depth_at(other, *x)).abs());
    differences.fold(0.0, f64::max)
}

/// Interpolates the depth between the nodes of a profile; constant beyond its ends.
pub(crate) fn depth_at(profile: &SideProfile, x: f64) -> f64 {
    interpolation::linear(&profile.x_mm, &profile.depth_mm, x)
}

#[cfg(test)]
mod tests {
    use super::*;

    fn solution(depth_mm: &[f64], figures: [f64; 4]) -> Solution {
        let nodes = (0..depth_mm.len()).map(|index| f64::from(u8::try_from(index).expect("few")));
        Solution {
            figures,
            profiles: [
                SideProfile {
                    x_mm: nodes.collect(),
                    depth_mm: depth_mm.to_vec(),
                },
                SideProfile::default(),
            ],
        }
    }

    #[test]
    fn depths_are_compared_everywhere_and_relative_to_the_largest_depth() {
        let reference = solution(&[0.0, 2.0, 0.0], [2.0, 1.0, 100.0, 2.0]);
        let other = solution(&[0.0, 1.9, 0.1], [1.9, 1.1, 90.0, 2.0]);
        let errors = reference.errors(&other);
        assert!((errors.depth - 0.05).abs() < 1e-12, "{errors:?}");
        assert!((errors.width - 0.1).abs() < 1e-12);
        assert!((errors.peak_pressure - 0.1).abs() < 1e-12);
        assert!(errors.area.abs() < 1e-12);
    }

    #[test]
    fn two_unworn_solutions_do_not_differ() {
        let unworn = solution(&[0.0, 0.0], [0.0, 0.0, 100.0, 0.0]);
        assert_eq!(unworn.errors(&unworn), Errors::default());
    }
}
