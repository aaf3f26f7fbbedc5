//! Requirement: a service listens on a name as on an address and is reached by it; `probe` asks the service that it is given and no
//! other, and accepts the answer of no other program.

use std::net::TcpListener;

use tests::{Server, fretwear};
use tokio::io::{AsyncReadExt, AsyncWriteExt};

#[tokio::test]
async fn a_service_listens_on_a_name() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let server = Server::start_with(
        folder.path(),
        &["--listen", "localhost:0", "--workers", "0"],
    );
    let (_, port) = server.base.rsplit_once(':').expect("a port");
    let name = format!("localhost:{port}");
    let ran = fretwear(folder.path(), &["probe", "--listen", &name]);
    assert_eq!(ran.code, Some(0), "{}", ran.stderr);
    let list = fretwear(
        folder.path(),
        &["list", "--server", &format!("http://{name}")],
    );
    assert_eq!(list.code, Some(0), "{}", list.stderr);
    for address in ["localhost", "nowhere.invalid:80", "localhost:many"] {
        let ran = fretwear(folder.path(), &["serve", "--listen", address]);
        assert_eq!(ran.code, Some(2), "{address}");
        assert!(
            ran.stderr.contains("such as localhost:8080"),
            "{address}: {}",
            ran.stderr
        );
    }
}

#[tokio::test]
async fn a_probe_asks_one_service_alone() {
    let folder = tempfile::tempdir().expect("a folder can be made");
    let ran = fretwear(folder.path(), &["probe"]);
    assert_eq!(ran.code, Some(2), "without an address: {}", ran.stdout);
    assert!(ran.stderr.contains("--listen"), "{}", ran.stderr);

    // A program that answers every path, as the servers of many pages do.
    let listener = TcpListener::bind("127.0.0.1:0").expect("a port");
    listener
        .set_nonblocking(true)
        .expect("it can be waited for");
    let address = listener.local_addr().expect("an address").to_string();
    let listener = tokio::net::TcpListener::from_std(listener).expect("a listener");
    let answers = [
        "<html></html>",
        r#"{"status":"ready"}"#,
        r#"{"service":"other"}"#,
    ];
    tokio::spawn(async move {
        for body in answers {
            let (mut client, _) = listener.accept().await.expect("a connection");
            client.read_exact(&mut [0; 16]).await.expect("a request");
            let head = format!(
                "HTTP/1.1 200 OK\r\nconnection: close\r\ncontent-length: {}\r\n\r\n",
                body.len()
            );
            client
                .write_all(format!("{head}{body}").as_bytes())
                .await
                .expect("written");
            // Until the other side closes it.
            let _ = client.read_to_end(&mut Vec::new()).await;
        }
    });
    for body in answers {
        let (folder, address) = (folder.path().to_owned(), address.clone());
        let probe = move || fretwear(&folder, &["probe", "--listen", &address]);
        let ran = tokio::task::spawn_blocking(probe).await.expect("it ran");
        assert_eq!(ran.code, Some(1), "{body}: {}", ran.stdout);
        assert!(
            ran.stderr.contains("is no service of fretwear"),
            "{body}: {}",
            ran.stderr
        );
    }
}
