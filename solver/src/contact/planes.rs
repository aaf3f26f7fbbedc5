//! Contact of extruded bodies: the plane contact in each of several sections, coupled by the compliance of the bodies.
//!
//! The node planes of both bodies coincide, so that each has the mortar pairing of `contact::line` and its own worn surfaces. All of the contact
//! slips along x as imposed. With the height v of the slider, which does not tilt, the unknowns are the pressures p of the closed nodes of all
//! planes and v:
//!
//!   g_ki + v + sum_lj R_ki,lj p_lj + (W_k e_k)_i = 0 for each closed node i of each plane k,  e = p |sigma|,
//!   sum_k w_k/W sum_i d_i (1 - q_ki/p_ki s_ki) p_ki = P',
//!
//! with the response R of both bodies to the line forces of a pressure and its friction q = mu p, the wear coupling W_k and the slopes s_k of
//! each plane, the lengths w_k that the planes stand for, their sum W and the mean line load P'. Everything is linear but e, through the
//! slip sigma that the height changes on a slope. A spring of the stiffness K per width that applies the load makes it P' + K (v - v_0).
//!
//! One semi-smooth Newton iteration runs over all planes (`newton`): 1.8 iterations an increment of single cycles, 4 of long jumps.
//! Iterating plane by plane instead, with the deformation by the other planes as a change of the gap, takes 13 to 25 rounds to 1e-10 for 2
//! to 7 planes of the thesis' fuzz button, at a given height, with closed nodes that are known (each round leaves 0.15 to 0.6 of the error): the
//! planes couple almost as much as the nodes of one of them.
//!
//! Limits: slip is imposed and along x; nothing slips or wears along z, and the slope of a worn surface along z is left out of its normal.

mod bodies;
mod increment;
mod iterate;
mod newton;
mod predictor;
mod problem;
mod response;
mod wear;

pub use bodies::Extruded;
pub(crate) use bodies::Slide;
pub(crate) use increment::ExtrudedSolver;
pub(crate) use increment::{PlaneWear, Solved};
