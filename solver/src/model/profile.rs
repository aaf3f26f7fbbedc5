//! Unworn surfaces as graphs y(x) in the frame of their body.
//!
//! The gap uses these exact shapes minus the worn depth, not the chords of the mesh: a moving contact would
//! otherwise feel every element of the other surface.

/// An unworn surface.
#[derive(Debug, Clone, Copy, PartialEq)]
pub enum Profile {
    /// y = 0.
    Flat,
    /// Upper arc of a circle whose highest point is the origin: y = sqrt(R^2 - x^2) - R.
    Crown {
        /// Radius R, mm.
        radius: f64,
    },
    /// Lower arc of a circle whose lowest point is the origin: y = R - sqrt(R^2 - x^2).
    Arc {
        /// Radius R, mm.
        radius: f64,
    },
}

impl Profile {
    /// Height at x, mm; at and beyond the rim of an arc the height of its centre.
    pub fn height(self, x: f64) -> f64 {
        match self {
            Self::Flat => 0.0,
            Self::Arc { radius } => sagitta(radius, x),
            Self::Crown { radius } => -sagitta(radius, x),
        }
    }

    /// Slope dy/dx at x; finite inside of the rim.
    pub fn slope(self, x: f64) -> f64 {
        let arc = |radius: f64| x / (radius * radius - x * x).max(f64::MIN_POSITIVE).sqrt();
        match self {
            Self::Flat => 0.0,
            Self::Arc { radius } => arc(radius),
            Self::Crown { radius } => -arc(radius),
        }
    }
}

/// R - sqrt(R^2 - x^2), written without cancellation near x = 0; R at and beyond the rim, where the quotient may be rounded above it.
fn sagitta(radius: f64, x: f64) -> f64 {
    (x * x / (radius + (radius * radius - x * x).max(0.0).sqrt())).min(radius)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn an_arc_is_a_circle_without_cancellation_at_its_lowest_point() {
        let arc = Profile::Arc { radius: 6.0 };
        assert!((arc.height(3.0) - (6.0 - 27.0_f64.sqrt())).abs() < 1e-14);
        let x = 1e-6;
        assert!((arc.height(x) / (x * x / 12.0) - 1.0).abs() < 1e-12);
        assert!((arc.height(6.0) - 6.0).abs() < 1e-14);
    }

    #[test]
    fn the_rim_is_no_higher_than_the_centre_whatever_the_radius() {
        for radius in (1..1_000).map(|i| 1e-3 * f64::from(i)) {
            for x in [radius, radius.next_up(), 2.0 * radius, -radius] {
                let height = Profile::Arc { radius }.height(x);
                assert!(height <= radius && height >= radius.next_down(), "{height}");
            }
            let inside = Profile::Arc { radius }.height(radius.next_down());
            assert!(inside <= radius && inside > radius * (1.0 - 1e-7));
        }
    }

    #[test]
    fn slopes_are_the_derivatives_of_heights() {
        for profile in [
            Profile::Flat,
            Profile::Arc { radius: 2.0 },
            Profile::Crown { radius: 3.0 },
        ] {
            for x in [-1.5, 0.0, 0.3, 1.7] {
                let step = 1e-6;
                let central = (profile.height(x + step) - profile.height(x - step)) / (2.0 * step);
                assert!((profile.slope(x) - central).abs() < 1e-8, "{profile:?} {x}");
            }
        }
    }
}
