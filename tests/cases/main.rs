//! End-to-end cases: the real binary, real processes, real files.

#![expect(
    clippy::print_stdout,
    reason = "some cases print the figures that the book quotes"
)]

mod access_token;
mod addresses;
mod alarms;
mod api_fuzz;
mod architecture;
mod auto_against_all_on;
mod backup;
mod bench;
mod book;
mod browser;
mod calculix_agrees;
mod cancel_running_job;
mod changing_friction;
mod chaos;
mod client_commands;
mod clock_steps;
mod command_line;
mod contact_resistance;
mod docker_files;
mod every_system_from_its_kind_alone;
mod example_answers;
mod extruded_contact;
mod failing_log;
mod fault_injection;
mod fields_open_in_vtk;
mod file_size_limit;
mod full_disk;
mod golden_results;
mod hard;
mod heated_contact;
mod hostile_inputs;
mod line_contact;
mod load;
mod long_solve_in_a_terminal;
mod main_job;
mod many_jobs;
mod many_workers;
mod mission;
mod no_shared_folder;
mod objects;
mod partition;
mod plated_contact;
mod plated_presets;
mod point_contact;
mod postgresql;
mod postgresql_tls;
mod predicted_cost;
mod refused_specifications;
mod remote_workers;
mod replayed_events;
mod restored_beside_workers;
mod result_files;
mod retry;
mod second_server;
mod server_killed;
mod short_ids;
mod slurm;
mod small_strains_cost_what_the_plan_says;
mod specification_documents;
mod stale_server;
mod structured_log;
mod study_of_accuracy;
mod study_over_http;
mod summary_tables;
mod sweep;
mod tls;
mod unacknowledged_workers;
mod unusable_destinations;
mod vibrated_contact;
mod wear_laws;
