//! This program as a file.

use std::path::PathBuf;

/// The program that this process is, whatever has become of its file since the start: it may have been replaced, moved or removed
/// (`/proc/pid/exe` in proc(5)).
pub fn own() -> PathBuf {
    PathBuf::from("/proc/self/exe")
}
