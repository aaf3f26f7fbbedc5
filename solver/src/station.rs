//! Contact along a line in plane sections, the stations, that are coupled by their section forces.
//!
//! Bodies that are long against the width of their contact deform in plane strain at each place along it. A station is the plane
//! section there: the contact of `contact::line` on operators that all stations share until they are worn unlike. What differs along the
//! line is the direction of the imposed slip (`place`) and the line load.
//!
//! Ring: a wire bent to a circle of the radius R on a ring of the same radius, displaced by u along x in the plane of both. At the angle
//! theta from x the wire crosses the radial section at
//!   rho = u cos(theta) + sqrt(R^2 - u^2 sin^2(theta)) - R,
//! while its surface slips by u cos(theta) across the wire and by u sin(theta) along it. Friction opposes the slip in the tangent plane,
//! |q| = mu p, and wear takes its magnitude. The half ring 0 <= theta <= pi stands for the whole one.
//!
//! Straight line: sections at z across a width, with the gaps of a crown z^2/(2 R_c) and of a tilt.
//!
//! Top: what carries the sections. `Even`: each has the mean line load F/L. `Rigid`: all have one height v, from
//!   sum_j w_j P_j(v + g_j) = F, which a spring lowers as the top sinks,
//! by Newton's method, with the section forces P_j and their derivatives from the sections' own solutions (`top`). `Pressure`: each is
//! lifted besides as the slider bends. So are the sections of crowns and tilts, by what the places beside them carry (`coupling`, `coupled`).
//!
//! Limits: the slip is imposed, no part of a contact sticks; surfaces wear by the dose; the ends of a line are those of its mirror images, and the
//! wear of a slider stays in its section. Limiting cases: a station of a ring at theta = 0 is the plane contact; under a rigid
//! top a ring with a flat floor wears by k F/(2 R) a cycle everywhere.

mod coupled;
mod coupling;
mod cycle;
mod error;
mod height;
mod integrator;
mod meshed;
mod motion_history;
mod place;
mod record;
mod run;
mod scene;
mod section;
mod side_by_side;
mod spacing;
mod state;
mod top;

pub(crate) use cycle::LineContact;
pub use error::StationError;
pub(crate) use integrator::LineIntegrator;
pub use motion_history::LineHistory;
pub use record::StationSummary;
pub use run::run;
pub use scene::StationScene;
#[cfg(test)]
pub(crate) use scene::stations_for;
pub use state::{LineState, StationsState};
