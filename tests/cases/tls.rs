//! Requirement: a service with a certificate serves HTTPS only, and workers and commands trust the authority that they are given.

use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::AtomicBool;

use nix::sys::signal::Signal;
use signal_hook::consts::SIGHUP;
use signal_hook::flag::register_conditional_default;
use tests::{Certificates, RemoteWorker, Server, fretwear};

fn text(path: &Path) -> &str {
    path.to_str().expect("text")
}

#[test]
fn workers_and_commands_use_https_with_the_authority_that_they_are_given() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let certificates = Certificates::new(folder.path(), "127.0.0.1");
    let options = [
        "--tls-certificate",
        text(&certificates.certificate),
        "--tls-key",
        text(&certificates.key),
    ];
    let server = Server::without_workers(folder.path(), &options);
    assert!(server.base.starts_with("https://"), "{}", server.base);
    let address = server.base.trim_start_matches("https://");
    let probe = ["probe", "--listen", address];
    assert_eq!(fretwear(folder.path(), &probe).code, Some(1), "plain HTTP");
    let with_tls = [&probe[..], &["--tls-certificate", options[1]]].concat();
    let ready = fretwear(folder.path(), &with_tls);
    assert_eq!(ready.code, Some(0), "{}", ready.stderr);
    let spec = folder.path().join("spec.json");
    let content =
        r#"{"system": {"kind": "sd_card"}, "cycles": 20, "accuracy": {"preset": "draft"}}"#;
    std::fs::write(&spec, content).expect("a file can be written");
    let submit = ["submit", text(&spec), "--server", &server.base];
    let ca = ["--ca", text(&certificates.authority)];
    let untrusted = fretwear(folder.path(), &submit);
    assert_eq!(untrusted.code, Some(4), "{}", untrusted.stderr);
    let plain = server.base.replace("https", "http");
    let plain = fretwear(folder.path(), &["submit", text(&spec), "--server", &plain]);
    assert_eq!(plain.code, Some(4), "{}", plain.stderr);
    let submitted = fretwear(folder.path(), &[&submit[..], &ca].concat());
    assert_eq!(submitted.code, Some(0), "{}", submitted.stderr);
    let options = [&["--until-idle"][..], &ca].concat();
    let worker = RemoteWorker::start(folder.path(), &server.base, &options);
    assert_eq!(worker.wait(), Some(0));
    let list = fretwear(
        folder.path(),
        &[&["list", "--server", &server.base], &ca[..]].concat(),
    );
    assert!(list.stdout.contains("succeeded"), "{}", list.stdout);
}

#[test]
fn a_hangup_lets_a_service_read_its_certificate_again() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    // The default of SIGHUP for this process and those that it starts (execve(2)), also where the tests were started with it ignored.
    let always = Arc::new(AtomicBool::new(true));
    register_conditional_default(SIGHUP, always).expect("a handler");
    let first = Certificates::new(folder.path(), "127.0.0.1");
    let options = [
        "--tls-certificate",
        text(&first.certificate),
        "--tls-key",
        text(&first.key),
    ];
    let server = Server::without_workers(folder.path(), &options);
    let renewed = folder.path().join("renewed");
    std::fs::create_dir(&renewed).expect("a folder");
    let second = Certificates::new(&renewed, "127.0.0.1");
    let is_trusted = |authority: &Path| {
        let list = ["list", "--server", &server.base, "--ca", text(authority)];
        fretwear(folder.path(), &list).code == Some(0)
    };
    // Half of a renewal changes nothing.
    std::fs::copy(&second.certificate, &first.certificate).expect("copied");
    server.signal(Signal::SIGHUP);
    assert!(is_trusted(&first.authority));
    std::fs::copy(&second.key, &first.key).expect("copied");
    server.signal(Signal::SIGHUP);
    while !is_trusted(&second.authority) {
        std::thread::sleep(std::time::Duration::from_millis(20));
    }
    assert!(!is_trusted(&first.authority));
}

#[test]
fn a_service_says_which_file_has_no_certificate_or_another_key() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let certificates = Certificates::new(folder.path(), "127.0.0.1");
    std::fs::create_dir(folder.path().join("other")).expect("a folder");
    let other = Certificates::new(&folder.path().join("other"), "127.0.0.1");
    let serve = |certificate: &Path, key: &Path| {
        let options = [
            "serve",
            "--listen",
            "127.0.0.1:0",
            "--tls-certificate",
            text(certificate),
            "--tls-key",
            text(key),
        ];
        fretwear(folder.path(), &options)
    };
    let swapped = serve(&certificates.key, &certificates.certificate);
    assert_eq!(swapped.code, Some(1));
    let foreign = serve(&certificates.certificate, &other.key);
    assert_eq!(foreign.code, Some(1));
    assert!(
        foreign
            .stderr
            .contains("certificate and key cannot be used"),
        "{}",
        foreign.stderr
    );
    let missing = serve(&folder.path().join("none.pem"), &certificates.key);
    assert!(missing.stderr.contains("none.pem"), "{}", missing.stderr);
}
