//! A clock that a test can step, for one service.

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
        clock.set_to(0);
        clock
    }

    /// Sets how far it is ahead of the system's clock, s.
    ///
    /// # Panics
    /// If the file cannot be written.
    pub fn set_to(&self, seconds: i64) {
        use std::os::unix::fs::FileExt;
        let file = std::fs::File::options()
            .create(true)
            .truncate(false)
            .write(true)
            .open(&self.file);
        let written = file
            .expect("a file")
            .write_all_at(&seconds.to_ne_bytes(), 0);
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
