//! Requirement: the container files name existing paths, the binary, its commands and variables.

use std::path::{Path, PathBuf};

use tests::fretwear;

fn root() -> PathBuf {
    let here = Path::new(env!("CARGO_MANIFEST_DIR"));
    here.parent().expect("the workspace").to_owned()
}

fn read(name: &str) -> String {
    std::fs::read_to_string(root().join(name)).unwrap_or_else(|cause| panic!("{name}: {cause}"))
}

/// Arguments of each occurrence of a Dockerfile instruction.
fn instructions<'a>(dockerfile: &'a str, name: &str) -> Vec<&'a str> {
    let lines = dockerfile.lines();
    lines
        .filter_map(|line| line.strip_prefix(name)?.strip_prefix(' '))
        .collect()
}

/// Returns `true` if a help names a variable of the environment, with its value or without, where that may be a secret.
fn has_variable(help: &str, name: &str) -> bool {
    ['=', ']']
        .iter()
        .any(|end| help.contains(&format!("[env: {name}{end}")))
}

#[test]
fn the_image_is_built_from_this_workspace_and_contains_its_binary() {
    let dockerfile = read("docker/Dockerfile");
    assert_eq!(instructions(&dockerfile, "FROM").len(), 2, "two stages");
    let build = instructions(&dockerfile, "RUN")[0];
    assert!(build.contains("--locked --package server --bin fretwear"));
    assert!(root().join("Cargo.lock").is_file());
    assert!(read("server/Cargo.toml").contains("name = \"fretwear\""));
    let copied = instructions(&dockerfile, "COPY");
    assert_eq!(
        copied.last(),
        Some(&"--from=build /source/target/release/fretwear /usr/local/bin/fretwear")
    );
    let version = |text: &str| -> Vec<u32> { text.split('.').flat_map(str::parse).collect() };
    let toolchain = instructions(&dockerfile, "FROM")[0];
    let toolchain = toolchain.trim_start_matches("rust:").split('-').next();
    let manifest = read("Cargo.toml");
    let wanted = manifest
        .lines()
        .find_map(|line| line.strip_prefix("rust-version = "))
        .expect("a version");
    assert!(version(toolchain.expect("a version")) >= version(wanted.trim_matches('"')));
}

#[test]
fn the_container_runs_unprivileged_with_one_volume_and_a_health_check() {
    let dockerfile = read("docker/Dockerfile");
    let user = instructions(&dockerfile, "USER");
    assert!(user.len() == 1 && user[0] != "root");
    assert_eq!(instructions(&dockerfile, "VOLUME"), ["[\"/data\"]"]);
    let folder = tempfile::tempdir().expect("a folder can be made");
    let health = instructions(&dockerfile, "HEALTHCHECK")[0];
    let command = health.split("CMD ").nth(1).expect("a command");
    let command: Vec<String> = serde_json::from_str(command).expect("a list");
    assert_eq!(command[0], "fretwear");
    for name in [command[1].as_str(), "serve"] {
        let ran = fretwear(folder.path(), &[name, "--help"]);
        assert_eq!(ran.code, Some(0), "{name}: {}", ran.stderr);
    }
    let help = fretwear(folder.path(), &["serve", "--help"]).stdout;
    let variables = instructions(&dockerfile, "ENV")[0];
    for variable in variables.split_whitespace() {
        let name = variable.split('=').next().expect("a name");
        assert!(has_variable(&help, name), "{name}");
    }
    assert!(variables.contains("sqlite:///data/"));
}

#[test]
fn the_compose_file_names_the_dockerfile_and_the_volume() {
    let compose = read("docker/compose.yaml");
    let field = |name: &str| {
        let line = compose.lines().find(|line| line.trim().starts_with(name));
        let line = line.unwrap_or_else(|| panic!("{name} is missing"));
        line.trim()[name.len()..].trim().to_owned()
    };
    let context = root().join("docker").join(field("context:"));
    assert!(context.join(field("dockerfile:")).is_file());
    assert!(compose.contains("fretwear-data:/data"));
    // As compose names it.
    let volume = format!("{}_fretwear-data:/data", field("name:"));
    assert!(read("docker/README.md").contains(&volume), "{volume}");
    let grace = field("stop_grace_period:");
    let grace: u32 = grace.trim_end_matches('s').parse().expect("seconds");
    // The service gives solves 5 s and open requests 5 s more.
    assert!(grace > 10);
}

/// Each command of systemd's units and of the manifests, with its options and variables, is one of the program.
#[test]
fn units_and_manifests_name_commands_options_and_variables() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    for (file, command) in [
        ("systemd/fretwear.service", &["serve"][..]),
        ("systemd/fretwear-work.service", &["work"]),
        ("systemd/fretwear-pilot.service", &["pilot", "slurm"]),
        ("kubernetes/service.yaml", &["serve"]),
        ("kubernetes/workers.yaml", &["work"]),
    ] {
        let text = read(&format!("docker/{file}"));
        let of_command = |line: &&str| {
            let line = line.trim();
            line.starts_with("ExecStart=") || line.starts_with("args: [")
        };
        let line = text.lines().find(of_command).expect("a command");
        let words: Vec<&str> = line.split(|c: char| " =[],\"".contains(c)).collect();
        assert!(
            command.iter().all(|name| words.contains(name)),
            "{file}: {line}"
        );
        let help = fretwear(folder.path(), &[command, &["--help"]].concat());
        assert_eq!(help.code, Some(0), "{}", help.stderr);
        for option in words.iter().filter(|word| word.starts_with("--")) {
            assert!(
                help.stdout.contains(&format!("{option} "))
                    || help.stdout.contains(&format!("{option}\n")),
                "{file}: {option}"
            );
        }
        let words = text.split(|c: char| !(c.is_ascii_uppercase() || c == '_'));
        for variable in words.filter(|word| word.starts_with("FRETWEAR_")) {
            assert!(has_variable(&help.stdout, variable), "{file}: {variable}");
        }
    }
}

#[tokio::test]
async fn the_health_check_distinguishes_a_running_service_from_none() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = tests::Server::start(folder.path());
    let listen = server.base.trim_start_matches("http://").to_owned();
    let probe = || fretwear(folder.path(), &["probe", "--listen", &listen]);
    let ran = probe();
    let ready = format!("ready: {}", server.base);
    assert_eq!((ran.code, ran.stdout.trim()), (Some(0), ready.as_str()));
    drop(server);
    assert_eq!(probe().code, Some(1));
}
