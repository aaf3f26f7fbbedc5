//! Detects the optional programs that some cases need; cases whose program is absent are ignored, visibly.

#[expect(
    dead_code,
    unreachable_pub,
    reason = "the library moves processes into the group, and exports it"
)]
#[path = "src/memory_group.rs"]
mod memory_group;
#[path = "../server/build/postgresql.rs"]
mod postgresql;

use std::path::Path;
use std::process::Command;

fn main() {
    postgresql::find();
    println!("cargo::rerun-if-changed=build.rs");
    println!("cargo::rerun-if-changed=src/memory_group.rs");
    println!("cargo::rerun-if-env-changed=FRETWEAR_PYTHON");
    println!("cargo::rerun-if-env-changed=PATH");
    println!(
        "cargo::rustc-check-cfg=cfg(has_vtk, has_axe, has_cc, has_ccx, has_chromium, has_curl, has_fma, has_haproxy, has_memory_groups, has_moto, has_mount, has_network, has_promtool, has_schemathesis, has_slurm)"
    );
    let python = std::env::var("FRETWEAR_PYTHON").unwrap_or_else(|_| "python3".to_owned());
    println!("cargo::rustc-env=FRETWEAR_PYTHON={python}");
    if runs(Command::new(&python).args(["-c", "import vtkmodules.vtkIOXML"])) {
        println!("cargo::rustc-cfg=has_vtk");
    }
    if runs(Command::new(&python).args(["-c", "import schemathesis"])) {
        println!("cargo::rustc-cfg=has_schemathesis");
    }
    if runs(Command::new(&python).args(["-c", "import moto.server"])) {
        println!("cargo::rustc-cfg=has_moto");
    }
    if runs(Command::new("curl").arg("--version"))
        && runs(Command::new("bash").args(["-c", "true"]))
    {
        println!("cargo::rustc-cfg=has_curl");
    }
    if runs(Command::new("cc").arg("--version")) {
        println!("cargo::rustc-cfg=has_cc");
    }
    if has_fma() {
        println!("cargo::rustc-cfg=has_fma");
    }
    if can_mount() {
        println!("cargo::rustc-cfg=has_mount");
    }
    if runs(Command::new("chromium").arg("--version"))
        && runs(Command::new("chromedriver").arg("--version"))
    {
        println!("cargo::rustc-cfg=has_chromium");
    }
    let axe = Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../target/ci-node/node_modules/axe-core/axe.min.js");
    println!("cargo::rerun-if-changed={}", axe.display());
    println!("cargo::rustc-env=FRETWEAR_AXE={}", axe.display());
    if axe.is_file() {
        println!("cargo::rustc-cfg=has_axe");
    }
    if runs(Command::new("haproxy").arg("-v")) {
        println!("cargo::rustc-cfg=has_haproxy");
    }
    if memory_group::MemoryGroup::with_limit(1_000_000_000).is_some() {
        println!("cargo::rustc-cfg=has_memory_groups");
    }
    if can_make_networks() {
        println!("cargo::rustc-cfg=has_network");
    }
    if runs(Command::new("promtool").arg("--version")) {
        println!("cargo::rustc-cfg=has_promtool");
    }
    if has_slurm() {
        println!("cargo::rustc-cfg=has_slurm");
    }
    if runs(Command::new("ccx").arg("-v")) {
        println!("cargo::rustc-cfg=has_ccx");
    }
}

/// Checks whether a cluster can be started: with the programs of Slurm and MUNGE, as root.
fn has_slurm() -> bool {
    let user = Command::new("id").arg("-u").output();
    let is_root = user.is_ok_and(|output| output.stdout == b"0\n");
    is_root
        && ["slurmctld", "slurmd"]
            .iter()
            .all(|program| runs(Command::new(program).arg("-V")))
        && runs(Command::new("munged").arg("--version"))
}

/// Checks whether a file system in memory can be mounted, as root can.
fn can_mount() -> bool {
    let Some(folder) = std::env::var_os("OUT_DIR").map(|out| Path::new(&out).join("mounted"))
    else {
        return false;
    };
    let mounted = std::fs::create_dir_all(&folder).is_ok()
        && runs(
            Command::new("mount")
                .args(["-t", "tmpfs", "tmpfs"])
                .arg(&folder),
        );
    mounted && runs(Command::new("umount").arg(&folder))
}

/// Checks whether network namespaces with interfaces can be made, as root can.
fn can_make_networks() -> bool {
    let name = format!("fretwear-probe-{}", std::process::id());
    let pair = format!("fwp{}", std::process::id());
    let made = runs(Command::new("ip").args(["netns", "add", &name]));
    let cable = [
        "link", "add", &pair, "type", "veth", "peer", "name", "fwp", "netns", &name,
    ];
    let connected = made && runs(Command::new("ip").args(cable));
    // One of the pair goes with the other.
    made && runs(Command::new("ip").args(["netns", "del", &name])) && connected
}

/// Checks whether the processor has the vector instructions that the golden results were computed with.
#[cfg(target_arch = "x86_64")]
fn has_fma() -> bool {
    std::arch::is_x86_feature_detected!("avx2") && std::arch::is_x86_feature_detected!("fma")
}

/// Another architecture has none of them.
#[cfg(not(target_arch = "x86_64"))]
fn has_fma() -> bool {
    false
}

/// Checks whether a program exists and runs; `ccx -v` ends with a code of its own.
fn runs(command: &mut Command) -> bool {
    let program = command.get_program().to_string_lossy().into_owned();
    command
        .output()
        .is_ok_and(|output| output.status.success() || program == "ccx")
}
