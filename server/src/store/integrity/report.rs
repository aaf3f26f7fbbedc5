//! Result of a backup, a restore or a verification.

/// Jobs and files of a backup, a restore or a verification, with the damaged and unread ones.
#[derive(Debug, Clone, Default, PartialEq, Eq)]
pub struct CopySummary {
    /// Number of jobs in the database.
    pub jobs: i64,
    /// Number of result files.
    pub files: usize,
    /// Size of the result files, bytes.
    pub file_bytes: u64,
    /// Damaged results, each with its damage.
    pub damaged: Vec<String>,
    /// Results that could not be read, each with the cause.
    pub unread: Vec<String>,
    /// Results that are stored elsewhere: in the folder of another machine, or by the original of a copy.
    pub elsewhere: Vec<String>,
    /// True if so many in succession could not be read that the others were not tried.
    pub has_ended_early: bool,
}
