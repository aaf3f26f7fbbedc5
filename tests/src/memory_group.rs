//! A control group of processes with a memory limit, of version 1 or 2 (cgroups(7)).

use std::path::{Path, PathBuf};

use nix::unistd::Pid;

/// Where the groups with the memory controller are, and the file of their limit, in either version.
const VERSIONS: [(&str, &str); 2] = [
    ("/sys/fs/cgroup/memory", "memory.limit_in_bytes"),
    ("/sys/fs/cgroup", "memory.max"),
];

/// The group; it is removed when it is dropped, which must be after its processes have ended.
#[derive(Debug)]
pub struct MemoryGroup(PathBuf);

impl MemoryGroup {
    /// Makes a group with a limit in bytes.
    ///
    /// # Panics
    /// If none can be made.
    pub fn with_limit(bytes: u64) -> Self {
        let name = format!("fretwear-test-{}", std::process::id());
        for (root, limit) in VERSIONS {
            let group = Self(Path::new(root).join(&name));
            let is_made = std::fs::create_dir(&group.0).is_ok();
            if is_made && std::fs::write(group.0.join(limit), bytes.to_string()).is_ok() {
                return group;
            }
        }
        panic!("no group with a memory limit can be made");
    }

    /// Moves a process into the group, in which its children will begin.
    ///
    /// # Panics
    /// If it cannot be moved.
    pub fn add(&self, process: Pid) {
        let written = std::fs::write(self.0.join("cgroup.procs"), process.to_string());
        written.expect("a process can be moved");
    }
}

impl Drop for MemoryGroup {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir(&self.0);
    }
}
