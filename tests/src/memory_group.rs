//! A control group of processes with a memory limit, of version 1 or 2 (cgroups(7)). Also compiled into the build script.

use std::path::{Path, PathBuf};

/// Files of a version.
struct Version {
    /// Folder of the groups with the memory controller.
    root: &'static str,
    /// File of the largest memory, bytes.
    limit: &'static str,
    /// File of the largest swap space, and the least that can be written there beside a limit in bytes.
    swap: &'static str,
    least_swap: fn(u64) -> u64,
}

const VERSIONS: [Version; 2] = [
    Version {
        root: "/sys/fs/cgroup/memory",
        limit: "memory.limit_in_bytes",
        // Memory and swap space together.
        swap: "memory.memsw.limit_in_bytes",
        least_swap: |limit| limit,
    },
    Version {
        root: "/sys/fs/cgroup",
        limit: "memory.max",
        swap: "memory.swap.max",
        least_swap: |_| 0,
    },
];

/// The group; it is removed when it is dropped, which must be after its processes have ended.
#[derive(Debug)]
pub struct MemoryGroup(PathBuf);

impl MemoryGroup {
    /// Makes a group with a limit in bytes, and without swap space where the kernel counts it; `None` where none can be made.
    pub fn with_limit(bytes: u64) -> Option<Self> {
        let name = format!("fretwear-test-{}", std::process::id());
        VERSIONS.iter().find_map(|version| {
            let folder = Path::new(version.root).join(&name);
            std::fs::create_dir(&folder).ok()?;
            let group = Self(folder);
            group.write(version.limit, bytes).ok()?;
            let _ = group.write(version.swap, (version.least_swap)(bytes));
            Some(group)
        })
    }

    /// Moves a process into the group, in which its children will begin.
    ///
    /// # Errors
    /// If it cannot be moved.
    pub fn add(&self, process: u32) -> std::io::Result<()> {
        self.write("cgroup.procs", u64::from(process))
    }

    fn write(&self, file: &str, value: u64) -> std::io::Result<()> {
        std::fs::write(self.0.join(file), value.to_string())
    }
}

impl Drop for MemoryGroup {
    fn drop(&mut self) {
        let _ = std::fs::remove_dir(&self.0);
    }
}
