//! Verification of the results that a database names, and the report of it, of a backup and of a restore.

pub(in crate::store) mod check;
pub(in crate::store) mod checked_read;
pub(in crate::store) mod database;
mod error;
mod report;

pub use error::BackupError;
pub use report::CopySummary;
