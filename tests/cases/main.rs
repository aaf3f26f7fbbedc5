//! End-to-end cases: the real binary, real processes, real files.

mod architecture;
mod backup;
mod calculix_agrees;
mod cancel_running_job;
mod chaos;
mod command_line;
mod disturbed_jobs;
mod docker_files;
mod fields_open_in_vtk;
mod main_job;
mod refused_specifications;
mod replayed_events;
mod result_files;
mod server_killed;
mod stale_server;
mod sweep;
