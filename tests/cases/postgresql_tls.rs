//! Requirement: a service encrypts its connections to a PostgreSQL server and verifies its name, where it is asked to, and starts with no
//! other server.

use std::path::Path;

use serde_json::json;
use tests::{Certificates, PostgresServer, Server, fretwear, use_database};

#[tokio::test]
#[cfg_attr(not(has_postgresql), ignore = "needs the programs of PostgreSQL")]
async fn a_service_verifies_the_server_that_it_is_given() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let [low, high] = [std::process::id() % 250 + 1, std::process::id() / 250 % 250];
    let [address, unnamed] = [77, 78].map(|net| format!("127.{net}.{high}.{low}"));
    let listen = format!("listen_addresses={address},{unnamed}");
    let database = PostgresServer::start(&[&listen, "fsync=off"]);
    let certificates = Certificates::new(folder.path(), &address);
    database.encrypt(&certificates);
    let name = database.new_database();
    let name = name
        .split_once('?')
        .expect("a socket")
        .0
        .rsplit_once('/')
        .expect("a name")
        .1;
    let url = |authority: &Path, host: &str| {
        let authority = authority.display();
        format!("postgres://fretwear@{host}/{name}?sslmode=verify-full&sslrootcert={authority}")
    };
    use_database(folder.path(), &url(&certificates.authority, &address));
    let server = Server::start(folder.path());
    let spec =
        json!({"system": {"kind": "sd_card"}, "cycles": 20, "accuracy": {"preset": "draft"}});
    assert_eq!(server.ended(&spec).await["status"], "succeeded");
    let encrypted = database.answer(
        "SELECT count(*) > 1 AND bool_and(ssl) FROM pg_stat_ssl JOIN pg_stat_activity USING (pid) WHERE application_name = 'fretwear'",
    );
    assert_eq!(encrypted, "t");

    let other = folder.path().join("other");
    std::fs::create_dir(&other).expect("a folder");
    let other = Certificates::new(&other, &address);
    for (url, reason) in [
        (
            url(&other.authority, &address),
            "an authority that it does not know",
        ),
        (
            url(&certificates.authority, &unnamed),
            "a name that is not in the certificate",
        ),
    ] {
        let refused = fretwear(
            folder.path(),
            &["serve", "--listen", "127.0.0.1:0", "--database", &url],
        );
        assert_eq!(refused.code, Some(1), "{reason}: {}", refused.stderr);
        assert!(
            refused.stderr.contains("certificate"),
            "{reason}: {}",
            refused.stderr
        );
    }
}
