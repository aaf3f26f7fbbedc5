//! A network of its own, connected to this machine by a cable that can be cut; removed when it goes out of scope.

use std::process::Command;

/// Address of no machine: packets to it are sent and arrive nowhere.
const NOWHERE: &str = "02:00:00:00:00:99";

/// A network namespace with one pair of virtual interfaces.
#[derive(Debug)]
pub struct Network {
    name: String,
    /// Interface, and that of this machine.
    interfaces: [String; 2],
    /// Address of this machine in it.
    pub address: String,
}

impl Network {
    /// Makes it; needs to be root.
    ///
    /// # Panics
    /// If it cannot be made.
    pub fn start() -> Self {
        let process = std::process::id();
        let (high, low) = (process / 64 % 256, process % 64 * 4);
        let of = |last: u32| format!("10.213.{high}.{}", low + last);
        let network = Self {
            name: format!("fretwear-{process}"),
            interfaces: ["n", "h"].map(|end| format!("fw{end}{process}")),
            address: of(1),
        };
        let [inner, outer] = &network.interfaces;
        let name = &network.name[..];
        ip(&["netns", "add", name]);
        ip(&[
            "link", "add", outer, "type", "veth", "peer", "name", inner, "netns", name,
        ]);
        ip(&["addr", "add", &format!("{}/30", of(1)), "dev", outer]);
        ip(&["link", "set", outer, "up"]);
        network.ip(&["addr", "add", &format!("{}/30", of(2)), "dev", inner]);
        network.ip(&["link", "set", inner, "up"]);
        network.ip(&["link", "set", "lo", "up"]);
        network
    }

    /// From now on no packet of it arrives, and nobody is notified.
    ///
    /// # Panics
    /// If it cannot be cut.
    pub fn cut(&self) {
        let [inner, _] = &self.interfaces;
        let gone = [
            "neigh",
            "replace",
            &self.address,
            "lladdr",
            NOWHERE,
            "nud",
            "permanent",
            "dev",
            inner,
        ];
        self.ip(&gone);
    }

    /// Packets arrive again.
    ///
    /// # Panics
    /// If it cannot be mended.
    pub fn mend(&self) {
        let [inner, _] = &self.interfaces;
        self.ip(&["neigh", "del", &self.address, "dev", inner]);
    }

    /// Command that runs a program inside the network, to be followed by the program and its arguments.
    pub fn inside(&self) -> [&str; 4] {
        ["ip", "netns", "exec", &self.name]
    }

    fn ip(&self, arguments: &[&str]) {
        ip(&[&["-n", &self.name], arguments].concat());
    }
}

impl Drop for Network {
    fn drop(&mut self) {
        // The pair of interfaces goes with one of them.
        for arguments in [
            ["link", "del", &self.interfaces[1]],
            ["netns", "del", &self.name],
        ] {
            let _ = Command::new("ip").args(arguments).status();
        }
    }
}

fn ip(arguments: &[&str]) {
    let ran = Command::new("ip").args(arguments).output();
    let ran = ran.expect("the program ip runs");
    let said = String::from_utf8_lossy(&ran.stderr);
    assert!(ran.status.success(), "ip {arguments:?}: {said}");
}
