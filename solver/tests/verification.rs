//! Verification of the engine against closed solutions, published codes and measurements: one problem a file.

#![expect(
    clippy::print_stdout,
    reason = "the suite prints the figures that the book quotes"
)]

mod converge_scars;
mod converge_tolerance;
mod metamorphic;
mod random_scenes;
mod recorder;
mod scenes;
mod verify_block_on_ring;
mod verify_cattaneo_mindlin;
mod verify_changing_friction;
mod verify_constraint_side;
mod verify_contact_patch;
mod verify_contact_resistance;
mod verify_error_control;
mod verify_extruded;
mod verify_first_load;
mod verify_friction_in_jumps;
mod verify_fuzz_button_groove;
mod verify_gross_slip;
mod verify_heating;
mod verify_hertz_line_contact;
mod verify_implicit_jumps;
mod verify_implicit_points;
mod verify_invariance;
mod verify_jumps_in_a_deep_groove;
mod verify_life_by_resistance;
mod verify_line_fields;
mod verify_line_runs;
mod verify_long_wipe;
mod verify_mccoll;
mod verify_mission;
mod verify_mixed_mission;
mod verify_moving_line_contact;
mod verify_periodic_motion;
mod verify_plated_life;
mod verify_plating;
mod verify_point_contact;
mod verify_point_motions;
mod verify_point_runs;
mod verify_pressure_fields;
mod verify_pressure_history;
mod verify_repeatability;
mod verify_resume;
mod verify_section_and_ball;
mod verify_short_stroke_scar;
mod verify_spreading;
mod verify_spring_load;
mod verify_stations;
mod verify_stick_zone;
mod verify_symmetry;
mod verify_thermal_softening;
mod verify_threads;
mod verify_wear_laws;
mod verify_wide_contact;
mod verify_worn_slider;
