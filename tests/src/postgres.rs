//! A PostgreSQL server with files of its own, which listens on a socket in their folder and ends with the process of the test.

use std::os::unix::fs::chown;
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, Command, Stdio};
use std::sync::OnceLock;
use std::sync::atomic::{AtomicU32, Ordering};
use std::time::Duration;

/// Folder of its programs.
const PROGRAMS: &str = env!("FRETWEAR_POSTGRESQL");
/// The user as which it runs in a test of the superuser, which it refuses to run for.
const USER: &str = "postgres";
/// First process waits for the end of its input, which ends with the test, and then stops and removes everything, also what the test
/// has paused.
const SCRIPT: &str =
    r#""$@" & server=$!; read -r _; kill -INT $server; wait $server; rm -rf "$FOLDER""#;
/// Settings of a server whose files need not survive the machine.
pub(crate) const SETTINGS: [&str; 3] = ["fsync=off", "full_page_writes=off", "max_connections=400"];

/// A server.
#[derive(Debug)]
pub struct PostgresServer {
    pub(crate) folder: PathBuf,
    databases: AtomicU32,
    first: Child,
    /// End is the end of the server.
    input: Option<ChildStdin>,
}

impl PostgresServer {
    /// The server that the tests of a process share.
    pub fn shared() -> &'static Self {
        static SHARED: OnceLock<PostgresServer> = OnceLock::new();
        SHARED.get_or_init(|| Self::start(&SETTINGS))
    }

    /// Starts one with settings.
    ///
    /// # Panics
    /// If it does not start.
    pub fn start(settings: &[&str]) -> Self {
        let folder = new_folder();
        let data = folder.join("data");
        let initialized = program("initdb")
            .args(["-D", data.to_str().expect("text"), "-U", "fretwear"])
            .args(["-A", "trust", "--locale=C.UTF-8", "--encoding=UTF8"])
            .args(["--data-checksums", "--no-sync"])
            .stdout(Stdio::null())
            .status();
        assert!(initialized.expect("initdb").success(), "initdb failed");
        Self::of(folder, settings)
    }

    /// Starts that of a folder.
    pub(crate) fn of(folder: PathBuf, settings: &[&str]) -> Self {
        let server = Self {
            first: first(&folder, settings),
            folder,
            databases: AtomicU32::new(0),
            input: None,
        };
        server.ready()
    }

    /// Makes an empty database and returns its address.
    ///
    /// # Panics
    /// If it cannot be made.
    pub fn new_database(&self) -> String {
        let name = format!("t{}", self.databases.fetch_add(1, Ordering::Relaxed));
        let made = program("createdb")
            .args(["-h", self.folder(), "-U", "fretwear", &name])
            .status();
        assert!(made.expect("createdb").success(), "createdb failed");
        format!(
            "postgres://fretwear@localhost/{name}?host={}",
            self.folder()
        )
    }

    /// The folder of its socket.
    pub(crate) fn folder(&self) -> &str {
        self.folder.to_str().expect("text")
    }

    fn ready(mut self) -> Self {
        self.input = self.first.stdin.take();
        let is_ready = || {
            let answer = program("pg_isready")
                .args(["-q", "-h", self.folder()])
                .status();
            answer.expect("pg_isready").success()
        };
        wait_until("PostgreSQL starts", is_ready);
        self
    }
}

/// Waits until a condition is met.
///
/// # Panics
/// If it is not in half a minute.
pub(crate) fn wait_until(what: &str, is_met: impl Fn() -> bool) {
    for _ in 0..600 {
        if is_met() {
            return;
        }
        std::thread::sleep(Duration::from_millis(50));
    }
    panic!("not in time: {what}");
}

impl Drop for PostgresServer {
    fn drop(&mut self) {
        drop(self.input.take());
        // The server may have been ended by the test.
        let _ = self.first.wait();
    }
}

/// A new folder that belongs to the user of the server.
pub(crate) fn new_folder() -> PathBuf {
    let folder = std::env::temp_dir().join(format!("pg{}-{}", std::process::id(), next()));
    std::fs::create_dir(&folder).expect("a folder");
    if let Some((user, group)) = owner() {
        chown(&folder, Some(user), Some(group)).expect("a folder of the user");
    }
    folder
}

/// Starts the first process of a server.
fn first(folder: &Path, settings: &[&str]) -> Child {
    let mut command = Command::new("sh");
    command.args(["-c", SCRIPT, "sh"]);
    let server = program("postgres");
    command.arg(server.get_program()).args(server.get_args());
    command.arg("-D").arg(folder.join("data"));
    command.arg("-k").arg(folder);
    command.args(["-c", "listen_addresses="]);
    for setting in settings {
        command.args(["-c", setting]);
    }
    let log = std::fs::File::create(folder.join("log")).expect("a file");
    let started = command
        .env("FOLDER", folder)
        .stdin(Stdio::piped())
        .stdout(Stdio::null())
        .stderr(log)
        .spawn();
    started.expect("a shell")
}

/// A program of PostgreSQL, run by its own user where the test is the superuser.
pub(crate) fn program(name: &str) -> Command {
    let path = Path::new(PROGRAMS).join(name);
    let Some((user, group)) = owner() else {
        return Command::new(path);
    };
    let mut command = Command::new("setpriv");
    command
        .arg(format!("--reuid={user}"))
        .arg(format!("--regid={group}"))
        .arg("--clear-groups")
        .arg(path);
    command
}

/// User and group of the server's files, where the test is the superuser.
fn owner() -> Option<(u32, u32)> {
    let id = |arguments: &[&str]| {
        let output = Command::new("id").args(arguments).output().expect("id");
        let text = String::from_utf8(output.stdout).expect("text");
        text.trim().parse::<u32>().expect("a number")
    };
    (id(&["-u"]) == 0).then(|| (id(&["-u", USER]), id(&["-g", USER])))
}

/// A number that is new in this process.
fn next() -> u32 {
    static LAST: AtomicU32 = AtomicU32::new(0);
    LAST.fetch_add(1, Ordering::Relaxed)
}
