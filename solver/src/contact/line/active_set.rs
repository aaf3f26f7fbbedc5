//! Active set: updates the contact statuses from the signs of an iterate.

use super::problem::{GAP_TOLERANCE, Iterate, Problem};
use super::status::Status;

/// From this iteration on only one node changes its status at a time.
const SINGLE_CHANGE_FROM: usize = 20;
/// From then on a status is accepted within so many tolerances: at the edge of the friction cone a node can stick
/// slightly beyond it and slip slightly backward, each by round-off.
const SINGLE_CHANGE_SLACK: f64 = 10.0;

/// Updates the statuses from the signs of the iterate; returns the number of nodes whose status violates them.
///
/// All of them change at once, which mostly converges in three to six iterations. A contact on a steep wall can cycle;
/// from [`SINGLE_CHANGE_FROM`] on only the worst node changes, as in Murty's pivoting.
pub(super) fn update(problem: &Problem<'_>, it: &mut Iterate, iteration: usize) -> usize {
    let pressure_scale = it
        .pressure
        .iter()
        .fold(f64::MIN_POSITIVE, |m, p| m.max(p.abs()));
    let single_change = iteration >= SINGLE_CHANGE_FROM;
    let (mut changes, mut worst) = (0, (0.0, 0, Status::Open));
    let slack = if single_change {
        SINGLE_CHANGE_SLACK
    } else {
        1.0
    };
    for i in 0..it.status.len() {
        let (new, violation) = required_status(problem, it, i, pressure_scale, slack);
        if violation <= 0.0 {
            it.status[i] = new;
            continue;
        }
        changes += 1;
        if !single_change {
            it.status[i] = new;
        } else if violation > worst.0 {
            worst = (violation, i, new);
        }
    }
    if single_change && changes > 0 {
        it.status[worst.1] = worst.2;
    }
    changes
}

/// The status that follows from the signs at a node, and the violation of the present one (0 if it stays, within so
/// many tolerances).
fn required_status(
    problem: &Problem<'_>,
    it: &Iterate,
    i: usize,
    pressure_scale: f64,
    slack: f64,
) -> (Status, f64) {
    let (gap_scale, tolerance) = (it.indentation, slack * it.tolerance);
    let slip_scale = it.indentation + problem.step.abs();
    let (p, q, slip, old) = (it.pressure[i], it.shear[i], it.slip[i], it.status[i]);
    let cone = problem.friction.at(i) * p;
    if old == Status::Open {
        if it.gap[i] >= -tolerance * gap_scale {
            return (Status::Open, 0.0);
        }
        let new = if !problem.tracks_slip {
            Status::slip(problem.step)
        } else if problem.step.abs() > 0.0 {
            Status::slip(slip)
        } else {
            Status::Stick
        };
        return (new, -it.gap[i] / gap_scale);
    }
    if p < 0.0 {
        // The edge of a first load slips: where sticking would tear a node open, that is tried before it opens.
        let slips = problem.first_load && slack > 1.0;
        let new = if slips && old == Status::Stick {
            Status::slip(q)
        } else {
            Status::Open
        };
        return (new, -p / pressure_scale);
    }
    if !problem.tracks_slip {
        return (Status::slip(problem.step), 0.0);
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
        unchanged => (unchanged, 0.0),
    }
}
