//! What each node does, and how the signs of an iterate choose it: the active set of the Newton method.

use serde::{Deserialize, Serialize};

use super::GAP_TOLERANCE;
use super::newton::{Iterate, Problem};

/// From this iteration on only one node changes its status at a time.
const CAREFUL_FROM: usize = 20;
/// From then on a status is right within so many tolerances: at the edge of its cone a node can stick a little beyond
/// it and slip a little backward, each by round-off.
const CAREFUL_SLACK: f64 = 10.0;

/// What a node of the receptacle does.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Status {
    /// No contact.
    Open,
    /// Contact without slip.
    Stick,
    /// The slider slips toward +x.
    SlipRight,
    /// The slider slips toward -x.
    SlipLeft,
}

impl Status {
    /// Direction of slip, 0 without slip.
    pub(super) fn direction(self) -> f64 {
        match self {
            Self::Open | Self::Stick => 0.0,
            Self::SlipRight => 1.0,
            Self::SlipLeft => -1.0,
        }
    }

    /// Slip in the direction of a number.
    pub(super) fn slip(sign: f64) -> Self {
        if sign < 0.0 {
            Self::SlipLeft
        } else {
            Self::SlipRight
        }
    }
}

/// Chooses statuses from the signs of the iterate; returns how many nodes do not have the status they should.
///
/// All of them change at once while that works (it mostly takes three to six iterations). A contact that rattles on
/// a steep wall can cycle; from [`CAREFUL_FROM`] on only the worst node changes, as in Murty's pivoting.
pub(super) fn update(problem: &Problem<'_>, it: &mut Iterate, iteration: usize) -> usize {
    let pressure_scale = it
        .pressure
        .iter()
        .fold(f64::MIN_POSITIVE, |m, p| m.max(p.abs()));
    let careful = iteration >= CAREFUL_FROM;
    let (mut changes, mut worst) = (0, (0.0, 0, Status::Open));
    let slack = if careful { CAREFUL_SLACK } else { 1.0 };
    for i in 0..it.status.len() {
        let (new, violation) = wanted_status(problem, it, i, pressure_scale, slack);
        if violation <= 0.0 {
            it.status[i] = new;
            continue;
        }
        changes += 1;
        if !careful {
            it.status[i] = new;
        } else if violation > worst.0 {
            worst = (violation, i, new);
        }
    }
    if careful && changes > 0 {
        it.status[worst.1] = worst.2;
    }
    changes
}

/// The status that a node should have, and how much it violates its present one (0 if it keeps it, within so many
/// tolerances).
fn wanted_status(
    problem: &Problem<'_>,
    it: &Iterate,
    i: usize,
    pressure_scale: f64,
    slack: f64,
) -> (Status, f64) {
    let (gap_scale, tolerance) = (it.indentation, slack * it.tolerance);
    let slip_scale = it.indentation + problem.step.abs();
    let (p, q, slip, old) = (it.pressure[i], it.shear[i], it.slip[i], it.status[i]);
    let cone = problem.friction * p;
    if old == Status::Open {
        if it.gap[i] >= -tolerance * gap_scale {
            return (Status::Open, 0.0);
        }
        let sliding = problem.step.abs() > 0.0 || problem.friction <= 0.0;
        let new = if sliding {
            Status::slip(slip)
        } else {
            Status::Stick
        };
        return (new, -it.gap[i] / gap_scale);
    }
    if p < 0.0 {
        return (Status::Open, -p / pressure_scale);
    }
    if problem.friction <= 0.0 {
        let turned = old != Status::slip(slip) && slip.abs() > tolerance * slip_scale;
        return (
            Status::slip(slip),
            if turned { slip.abs() / slip_scale } else { 0.0 },
        );
    }
    match old {
        Status::Stick if q.abs() > cone * (1.0 + slack * GAP_TOLERANCE) => {
            (Status::slip(q), (q.abs() - cone) / pressure_scale)
        }
        Status::SlipRight | Status::SlipLeft
            if old.direction() * slip < -tolerance * slip_scale =>
        {
            (Status::Stick, slip.abs() / slip_scale)
        }
        kept => (kept, 0.0),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn slip_has_the_direction_it_was_made_from() {
        assert!((Status::slip(2.0).direction() - 1.0).abs() < f64::EPSILON);
        assert!((Status::slip(-2.0).direction() + 1.0).abs() < f64::EPSILON);
        assert!(Status::Stick.direction().abs() < f64::EPSILON);
    }
}
