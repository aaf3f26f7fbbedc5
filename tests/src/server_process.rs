//! Figures of the system about the processes of a service.

use nix::unistd::Pid;

use crate::server::Server;

impl Server {
    /// Solving processes.
    pub fn solving(&self) -> Vec<Pid> {
        let threads = std::fs::read_dir(format!("/proc/{}/task", self.id()));
        let lists = threads.into_iter().flatten().flatten();
        let lists =
            lists.filter_map(|thread| std::fs::read_to_string(thread.path().join("children")).ok());
        lists
            .flat_map(|list| {
                let ids = list.split_whitespace().map(str::parse);
                ids.flatten().map(Pid::from_raw).collect::<Vec<_>>()
            })
            .collect()
    }

    /// Peak memory of the service process so far, MB.
    ///
    /// # Panics
    /// If it has ended.
    pub fn peak_memory_mb(&self) -> f64 {
        let status = std::fs::read_to_string(format!("/proc/{}/status", self.id()))
            .expect("the service is there");
        let peak = status.lines().find_map(|line| line.strip_prefix("VmHWM:"));
        let kilobytes = peak.and_then(|peak| peak.trim().strip_suffix(" kB"));
        let kilobytes: u32 = kilobytes
            .and_then(|number| number.trim().parse().ok())
            .expect("the system tells the peak");
        f64::from(kilobytes) / 1024.0
    }
}
