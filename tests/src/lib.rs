//! What every end-to-end case needs: the real binary, run as a user would run it, in a folder of its own.

pub mod bits;
pub mod calculix;
pub mod database;
pub mod disk;
pub mod program;
pub mod server;

pub use disk::Disk;
pub use program::{Ran, binary, fretwear, spec};
pub use server::Server;
