//! Accepts and serves connections, with limits against slow clients: on the number of connections, on the time to read
//! the head of a request, and on the time that sent data stays unacknowledged.

use std::sync::Arc;
use std::time::Duration;

use axum::Router;
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::server::graceful::GracefulShutdown;
use hyper_util::service::TowerToHyperService;
use nix::sys::socket::setsockopt;
use nix::sys::socket::sockopt::TcpUserTimeout;
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::Semaphore;
use tokio_util::sync::CancellationToken;

/// Maximum number of open connections; more wait to be accepted. Each costs a file handle and a few kB.
const MAX_CONNECTIONS: usize = 4096;
/// Timeout of the head of a request, from the moment a connection is accepted or its last response was sent; also ends
/// idle connections.
const HEAD_TIMEOUT: Duration = Duration::from_secs(30);
/// `TCP_USER_TIMEOUT`, ms: the kernel closes a connection whose client has not acknowledged data for this long. Streams
/// and downloads to clients that stopped reading would otherwise stay open for ever.
const USER_TIMEOUT_MS: u32 = 60_000;
/// Maximum size of a head, bytes; a token and a long query fit.
const MAX_HEAD_BYTES: usize = 64 << 10;
/// Maximum number of header fields of a request.
const MAX_HEADERS: usize = 64;
/// Pause after a failed accept, for instance because the process has no more file handles.
const ACCEPT_PAUSE: Duration = Duration::from_millis(50);

/// Serves until shutdown; returns when the last connection has ended.
pub async fn serve(listener: TcpListener, router: Router, stopping: CancellationToken) {
    serve_at_most(MAX_CONNECTIONS, listener, router, stopping).await;
}

async fn serve_at_most(
    max_connections: usize,
    listener: TcpListener,
    router: Router,
    stopping: CancellationToken,
) {
    let permits = Arc::new(Semaphore::new(max_connections));
    let open = GracefulShutdown::new();
    loop {
        let accepted = tokio::select! {
            accepted = accept(&listener, &permits) => accepted,
            () = stopping.cancelled() => break,
        };
        let Some((stream, permit)) = accepted else {
            tokio::time::sleep(ACCEPT_PAUSE).await;
            continue;
        };
        let mut builder = http1::Builder::new();
        builder
            .timer(TokioTimer::new())
            .header_read_timeout(HEAD_TIMEOUT)
            .max_buf_size(MAX_HEAD_BYTES)
            .max_headers(MAX_HEADERS);
        let service = TowerToHyperService::new(router.clone());
        let connection = open.watch(builder.serve_connection(TokioIo::new(stream), service));
        tokio::spawn(async move {
            // A client that disconnects or times out is not an error of the service.
            if let Err(error) = connection.await {
                tracing::debug!(%error, "a connection was aborted");
            }
            drop(permit);
        });
    }
    drop(listener);
    open.shutdown().await;
}

async fn accept(
    listener: &TcpListener,
    permits: &Arc<Semaphore>,
) -> Option<(TcpStream, tokio::sync::OwnedSemaphorePermit)> {
    let permit = Arc::clone(permits).acquire_owned().await.ok()?;
    match listener.accept().await {
        Ok((stream, _)) => {
            // Small responses must not wait for each other; without the option the connection is only slower.
            let _ = stream.set_nodelay(true);
            if let Err(error) = setsockopt(&stream, TcpUserTimeout, &USER_TIMEOUT_MS) {
                tracing::debug!(%error, "a connection has no user timeout");
            }
            Some((stream, permit))
        }
        Err(error) => {
            tracing::warn!(%error, "a connection could not be accepted");
            None
        }
    }
}

#[cfg(test)]
mod tests {
    use std::future::pending;

    use axum::routing::get;
    use nix::sys::socket::getsockopt;
    use tokio::io::{AsyncReadExt, AsyncWriteExt};

    use super::*;

    const REQUEST: &[u8] = b"GET / HTTP/1.1\r\nhost: 127.0.0.1\r\nconnection: close\r\n\r\n";

    async fn request(address: std::net::SocketAddr) -> TcpStream {
        let mut stream = TcpStream::connect(address).await.expect("a connection");
        stream.write_all(REQUEST).await.expect("a request");
        stream
    }

    #[tokio::test]
    async fn more_connections_than_the_limit_wait_for_one_to_end() {
        let listener = TcpListener::bind("127.0.0.1:0").await.expect("a port");
        let address = listener.local_addr().expect("an address");
        let stopping = CancellationToken::new();
        let router = Router::new().route("/", get(|| async { "here" }));
        let served = tokio::spawn(serve_at_most(1, listener, router, stopping.clone()));
        let silent = TcpStream::connect(address).await.expect("a connection");
        let mut waiting = request(address).await;
        let (mut answer, shortly) = (String::new(), Duration::from_millis(200));
        let early = tokio::time::timeout(shortly, waiting.read_to_string(&mut answer)).await;
        assert!(early.is_err(), "{answer}");
        drop(silent);
        waiting
            .read_to_string(&mut answer)
            .await
            .expect("an answer");
        assert!(answer.ends_with("here"), "{answer}");
        stopping.cancel();
        served.await.expect("it ends");
    }

    #[tokio::test]
    async fn connections_have_a_user_timeout() {
        let listener = TcpListener::bind("127.0.0.1:0").await.expect("a port");
        let address = listener.local_addr().expect("an address");
        let permits = Arc::new(Semaphore::new(1));
        let client = TcpStream::connect(address);
        let (accepted, _client) = tokio::join!(accept(&listener, &permits), client);
        let (stream, _) = accepted.expect("a connection");
        assert_eq!(getsockopt(&stream, TcpUserTimeout), Ok(USER_TIMEOUT_MS));
    }

    #[tokio::test]
    async fn the_service_stops_once_the_client_of_an_endless_request_disconnects() {
        let listener = TcpListener::bind("127.0.0.1:0").await.expect("a port");
        let address = listener.local_addr().expect("an address");
        let stopping = CancellationToken::new();
        let router = Router::new().route("/", get(|| async { pending::<String>().await }));
        let served = tokio::spawn(serve_at_most(9, listener, router, stopping.clone()));
        let stream = request(address).await;
        tokio::time::sleep(Duration::from_millis(50)).await;
        stopping.cancel();
        drop(stream);
        served.await.expect("it ends");
    }
}
