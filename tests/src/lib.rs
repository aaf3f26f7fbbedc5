//! Shared by the end-to-end cases: runs the real binary as a user would, in a folder of its own.

mod bare_preset;
pub mod bits;
mod browser;
pub mod calculix;
mod certificates;
pub mod database;
pub mod disk;
mod haproxy;
mod memory_group;
mod network;
mod postgres;
mod postgres_dump;
mod postgres_standby;
mod postgres_tls;
pub mod program;
mod s3;
mod served_database;
pub mod server;
mod server_process;
mod slurm;
mod stepped_clock;
mod waiting;
mod worker;

pub use bare_preset::{bare_preset, merged};
pub use browser::Browser;
pub use certificates::Certificates;
pub use disk::Disk;
pub use haproxy::Haproxy;
pub use memory_group::MemoryGroup;
pub use network::Network;
pub use postgres::PostgresServer;
pub use program::{
    Ran, binary, fretwear, fretwear_reading, fretwear_with, fuzz_button_with_jump, spec,
};
pub use s3::S3;
pub use served_database::{address_of_database, use_database, use_postgresql};
pub use server::{Log, Server};
pub use slurm::Slurm;
pub use stepped_clock::SteppedClock;
pub use worker::RemoteWorker;
