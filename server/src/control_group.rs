//! Memory limits and kills of the control groups that this process is in: version 2, and the memory controller of version 1 (cgroups(7)).

use std::path::{Path, PathBuf};

/// Memory of the control groups of a process.
#[derive(Debug)]
struct ControlGroup {
    /// Folder of the group.
    folder: PathBuf,
    /// Folder of the outermost group that the process can see.
    root: PathBuf,
    files: Files,
}

/// Names of files of a version.
#[derive(Debug)]
struct Files {
    /// Largest memory, bytes.
    limit: &'static str,
    /// Counters of events.
    events: &'static str,
}

const VERSION_1: Files = Files {
    limit: "memory.limit_in_bytes",
    events: "memory.oom_control",
};
const VERSION_2: Files = Files {
    limit: "memory.max",
    events: "memory.events",
};

impl ControlGroup {
    /// The group of this process; `None` where the system has no control groups of memory.
    fn own() -> Option<Self> {
        let groups = std::fs::read_to_string("/proc/self/cgroup").ok()?;
        Self::of(&groups, Path::new("/sys/fs/cgroup"))
    }

    /// The group in the list of a process (`/proc/pid/cgroup`), where all groups are mounted.
    fn of(groups: &str, mounted: &Path) -> Option<Self> {
        let fields = groups.lines().map(|line| line.splitn(3, ':'));
        let mut groups = fields.filter_map(|mut fields| {
            let (_, controllers, path) = (fields.next()?, fields.next()?, fields.next()?);
            Some((controllers, path.trim_start_matches('/')))
        });
        let of_memory = |(controllers, _): &(&str, &str)| {
            controllers
                .split(',')
                .any(|controller| controller == "memory")
        };
        // Version 2 has one group without names of controllers; version 1 may be beside it.
        let first = groups.clone().find(of_memory);
        let (root, path, files) = if let Some((_, path)) = first {
            (mounted.join("memory"), path, VERSION_1)
        } else {
            let (_, path) = groups.find(|(controllers, _)| controllers.is_empty())?;
            (mounted.to_owned(), path, VERSION_2)
        };
        Some(Self {
            folder: root.join(path),
            root,
            files,
        })
    }

    /// Smallest limit of the group and of those that contain it, bytes. In a container the path may be one of its host: then the folder of
    /// the container is the root.
    fn memory_limit(&self) -> Option<u64> {
        let folders = self.folder.ancestors();
        let folders = folders.take_while(|folder| folder.starts_with(&self.root));
        let limits = folders.filter_map(|folder| {
            let text = std::fs::read_to_string(folder.join(self.files.limit)).ok()?;
            text.trim().parse().ok()
        });
        limits.min()
    }

    /// Number of processes of the group that the kernel has killed because memory ran out.
    fn memory_kills(&self) -> Option<u64> {
        let mut folders = [&self.folder, &self.root].into_iter();
        folders.find_map(|folder| {
            counter(&std::fs::read_to_string(folder.join(self.files.events)).ok()?)
        })
    }
}

/// Smallest memory limit of the control groups of this process, bytes; `None` without one.
pub(crate) fn memory_limit() -> Option<u64> {
    ControlGroup::own()?.memory_limit()
}

/// Number of processes that the kernel has killed because memory ran out: in the control group of this process or, without one, on this
/// machine.
pub(crate) fn memory_kills() -> Option<u64> {
    let in_group = ControlGroup::own().and_then(|group| group.memory_kills());
    in_group.or_else(|| counter(&std::fs::read_to_string("/proc/vmstat").ok()?))
}

/// The counter of kills in a list of counters.
fn counter(counters: &str) -> Option<u64> {
    let mut lines = counters.lines();
    lines.find_map(|line| line.strip_prefix("oom_kill ")?.trim().parse().ok())
}

#[cfg(test)]
mod tests {
    use std::fs;

    use super::*;

    /// Writes the files of a group, in the folder of all groups.
    fn with_files(mounted: &Path, path: &str, files: &[(&str, &str)]) {
        let folder = mounted.join(path);
        fs::create_dir_all(&folder).expect("a folder");
        for (name, text) in files {
            fs::write(folder.join(name), text).expect("written");
        }
    }

    #[test]
    fn the_smallest_limit_of_the_groups_around_a_process_counts() {
        let mounted = tempfile::tempdir().expect("a folder");
        let mounted = mounted.path();
        with_files(mounted, "pod", &[("memory.max", "4294967296\n")]);
        with_files(
            mounted,
            "pod/service",
            &[
                ("memory.max", "max\n"),
                (
                    "memory.events",
                    "low 0\noom 3\noom_kill 2\noom_group_kill 0\n",
                ),
            ],
        );
        let group = ControlGroup::of("0::/pod/service\n", mounted).expect("a group");
        assert_eq!(group.memory_limit(), Some(4 << 30));
        assert_eq!(group.memory_kills(), Some(2));
    }

    #[test]
    fn a_container_of_version_1_has_its_limit_at_the_root_of_what_it_sees() {
        let mounted = tempfile::tempdir().expect("a folder");
        let mounted = mounted.path();
        let control = "oom_kill_disable 0\nunder_oom 0\noom_kill 7\n";
        let files = [
            ("memory.limit_in_bytes", "1073741824\n"),
            ("memory.oom_control", control),
        ];
        with_files(mounted, "memory", &files);
        let groups = "8:pids:/docker/1\n4:cpu,memory:/docker/1\n0::/\n";
        let group = ControlGroup::of(groups, mounted).expect("a group");
        assert_eq!(group.memory_limit(), Some(1 << 30));
        assert_eq!(group.memory_kills(), Some(7));
    }

    #[test]
    fn a_process_without_a_limit_has_none() {
        let mounted = tempfile::tempdir().expect("a folder");
        let group = ControlGroup::of("0::/\n", mounted.path()).expect("a group");
        assert_eq!((group.memory_limit(), group.memory_kills()), (None, None));
        assert!(ControlGroup::of("", mounted.path()).is_none());
    }
}
