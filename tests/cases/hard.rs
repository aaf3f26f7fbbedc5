//! The hard cases: scenes on which a naive code fails. One file a case, each with the requirement, its source and the
//! failure of a naive code; all of them assert one list of invariants.

mod additions;
mod beside_standing_plating;
mod change_of_wear;
mod conforming;
mod corner_contact;
mod deep_ring_grooves;
mod draws;
mod edges_of_finite_contacts;
mod extreme_elasticity;
mod extreme_loads;
mod fading_spring;
mod faulty_models;
mod first_touch;
mod friction_beyond_one;
pub(crate) mod invariants;
mod jumps;
mod leaving_the_block;
mod loads_of_each_dimension;
mod long_wipes;
mod million_cycles;
mod naive;
mod no_slip;
mod radius_range;
mod random_specifications;
mod regressions_of_random_specifications;
mod reversal;
pub(crate) mod run;
mod slender_elements;
mod specs;
mod sphere_in_partial_slip;
mod steep_wall;
mod switches_of_auto;
mod unloaded_sections;
mod unstable_explicit_wear;
mod wear_rates;
mod worn_through;
