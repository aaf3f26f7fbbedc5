//! A clock that a test can step or let fail, for one service.

use std::fs::File;
use std::os::unix::fs::FileExt;
use std::path::{Path, PathBuf};
use std::process::Command;

/// A clock in a folder.
#[derive(Debug)]
pub struct SteppedClock {
    library: PathBuf,
    file: PathBuf,
}

impl SteppedClock {
    /// A clock that agrees with the system's so far.
    ///
    /// # Panics
    /// If its library cannot be compiled.
    pub fn new(folder: &Path) -> Self {
        let clock = Self {
            library: folder.join("stepped_clock.so"),
            file: folder.join("stepped_clock"),
        };
        let source = concat!(env!("CARGO_MANIFEST_DIR"), "/src/stepped_clock.c");
        let compiled = Command::new("cc")
            .args(["-shared", "-fPIC", "-O1", "-o"])
            .arg(&clock.library)
            .arg(source)
            .status();
        assert!(compiled.expect("a compiler").success());
        clock.write(0, 0);
        clock.write(1, 0);
        clock
    }

    /// Sets how far it is ahead of the system's clock, s.
    ///
    /// # Panics
    /// If the file cannot be written.
    pub fn set_to(&self, seconds: i64) {
        self.write(0, seconds);
    }

    /// Lets the next read of it by the service fail, so that the task that reads it panics.
    ///
    /// # Panics
    /// If the file cannot be written.
    pub fn fail_once(&self) {
        self.write(1, 1);
    }

    /// Takes back a failure that has met no read.
    ///
    /// # Panics
    /// If the file cannot be written.
    pub fn forget_failure(&self) {
        self.write(1, 0);
    }

    /// Writes one of the two numbers that the library reads.
    fn write(&self, index: u64, number: i64) {
        let file = File::options()
            .create(true)
            .truncate(false)
            .write(true)
            .open(&self.file);
        let written = file
            .expect("a file")
            .write_all_at(&number.to_ne_bytes(), 8 * index);
        written.expect("written");
    }

    /// Variables of the environment of a service with this clock.
    pub fn environment(&self) -> [(&'static str, &Path); 2] {
        [
            ("LD_PRELOAD", self.library.as_path()),
            ("STEPPED_CLOCK", self.file.as_path()),
        ]
    }
}
