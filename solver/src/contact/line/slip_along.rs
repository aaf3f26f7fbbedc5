//! Slip along the line of a contact, over the slopes of its surfaces.
//!
//! A surface of slope s is longer than its projection by sqrt(1 + s^2), and recedes along its normal. Slip w along the line thus wears it by
//! k p w normal to itself and by k p w sqrt(1 + s^2) vertically, like the slip across the line, whose sigma is that many times the true one.
//! Per projected length the slip is
//!   sqrt(sigma^2 + w^2 (1 + s^2)).
//!
//! Friction opposes the slip in the tangent plane. Its direction is that of a slider which is displaced by a across the line and rises by a m, m the
//! mean slope under the last load: it slips by sigma = a (1 + m s), of which friction has the part
//!   sigma/sqrt(sigma^2 + w^2 (1 + s^2))
//! across the line. A contact on a wall climbs it, m = s; one that fills its trough does not rise, m = 0.
//! Limiting cases: the imposed direction on a flat floor; all of it across the line at w = 0, and along it at a = 0.

/// Slips and directions of friction at the coupled nodes; none without slip along the line.
#[derive(Debug, Default)]
pub(super) struct SlipAlong {
    /// w sqrt(1 + s^2), mm.
    pub(super) slip: Vec<f64>,
    /// Components of friction across the line and along it, over its magnitude.
    pub(super) directions: Vec<[f64; 2]>,
}

/// Slips of an increment, mm.
#[derive(Debug, Clone, Copy)]
pub(super) struct Imposed {
    pub(super) across: f64,
    pub(super) along: f64,
}

/// Slopes of the surfaces, -.
#[derive(Debug, Clone, Copy)]
pub(super) struct Slopes<'a> {
    /// At the coupled nodes, s.
    pub(super) nodes: &'a [f64],
    /// Mean under the last load, m.
    pub(super) mean: f64,
}

impl SlipAlong {
    /// Imposes slips on surfaces with slopes.
    pub(super) fn impose(&mut self, imposed: Imposed, slopes: Slopes<'_>) {
        let Imposed { across, along } = imposed;
        self.slip.clear();
        self.directions.clear();
        if along == 0.0 {
            return;
        }
        let Slopes { nodes, mean } = slopes;
        for slope in nodes {
            let along = along * slope.hypot(1.0);
            // None where the slider rises off the opposite wall faster than it moves along it.
            let across = across.abs() * (1.0 + mean * slope).max(0.0);
            let magnitude = across.hypot(along);
            self.slip.push(along);
            self.directions
                .push([across / magnitude, along.abs() / magnitude]);
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn friction_opposes_the_slip_on_walls() {
        let mut slip = SlipAlong::default();
        let [across, along] = [3.0, -4.0];
        let imposed = Imposed { across, along };
        let slopes = |nodes, mean| Slopes { nodes, mean };
        slip.impose(imposed, slopes(&[0.0, 1.0], 1.0));
        let is = |a: [f64; 2], b: [f64; 2]| (a[0] - b[0]).hypot(a[1] - b[1]) < 1e-15;
        assert!(is(slip.directions[0], [0.6, 0.8]));
        // Squares of the slips on a wall of 45 degrees, per projected length: (3 + 3)^2 and 2 4^2.
        let wall = [36.0, 32.0].map(|part: f64| (part / 68.0).sqrt());
        assert!(is(slip.directions[1], wall));
        assert!((slip.slip[1] + 32.0_f64.sqrt()).abs() < 1e-15);
        // In a filled trough the same wall is slid along, without rising.
        slip.impose(imposed, slopes(&[1.0], 0.0));
        let trough = [9.0, 32.0].map(|part: f64| (part / 41.0).sqrt());
        assert!(is(slip.directions[0], trough));
        let along = 0.0;
        slip.impose(Imposed { across, along }, slopes(&[0.0, 1.0], 1.0));
        assert!(slip.slip.is_empty() && slip.directions.is_empty());
    }
}
