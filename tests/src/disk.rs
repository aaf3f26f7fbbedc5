//! A small mounted disk that a test can fill.

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::process::Command;
use std::time::Duration;

use tempfile::TempDir;

/// A folder, on a small disk of its own if the tests can mount one.
#[derive(Debug)]
pub struct Disk {
    folder: TempDir,
    mounted: bool,
}

impl Disk {
    /// A disk of this size.
    ///
    /// # Panics
    /// If no folder can be made.
    pub fn new(size_mb: usize) -> Self {
        let folder = tempfile::tempdir().expect("a folder can be made");
        let mounted = Command::new("mount")
            .args(["-t", "tmpfs", "-o", &format!("size={size_mb}m"), "tmpfs"])
            .arg(folder.path())
            .output()
            .is_ok_and(|output| output.status.success());
        Self { folder, mounted }
    }

    /// The folder.
    pub fn path(&self) -> &Path {
        self.folder.path()
    }

    /// Checks whether it is a disk of its own, so that it can be filled.
    pub fn is_mounted(&self) -> bool {
        self.mounted
    }

    /// Fills all free space, down to the last byte; also the space that was freed since the last call.
    ///
    /// # Panics
    /// If there is no file to fill it with.
    pub fn fill(&self) {
        let file = File::options()
            .create(true)
            .append(true)
            .open(self.filler());
        let mut file = file.expect("a file can be made");
        for size in [1 << 20, 1 << 12, 1] {
            let block = vec![0_u8; size];
            while file.write_all(&block).is_ok() {}
        }
    }

    /// Frees the space that was filled.
    ///
    /// # Panics
    /// If it cannot be freed.
    pub fn free(&self) {
        std::fs::remove_file(self.filler()).expect("the file can be removed");
    }

    /// Fills all free space for a while.
    ///
    /// # Panics
    /// If the space cannot be filled or freed.
    pub async fn fill_for(&self, time: Duration) {
        self.fill();
        tokio::time::sleep(time).await;
        self.free();
    }

    fn filler(&self) -> PathBuf {
        self.folder.path().join("filler")
    }
}

impl Drop for Disk {
    fn drop(&mut self) {
        if self.mounted {
            // A disk that stays mounted after a failed test is small.
            let _ = Command::new("umount")
                .arg("-l")
                .arg(self.folder.path())
                .status();
        }
    }
}
