//! Accepts and serves connections, with limits against slow clients: on the number of connections (of all clients and of each), on the time to read
//! the head of a request, and on the time that sent data stays unacknowledged.

use std::net::SocketAddr;
use std::sync::Arc;
use std::time::Duration;

use axum::Router;
use axum::body::Body;
use axum::http::Request;
use hyper::body::Incoming;
use hyper::server::conn::http1;
use hyper::service::service_fn;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::server::graceful::{GracefulShutdown, Watcher};
use nix::sys::resource::{Resource, getrlimit};
use nix::sys::socket::setsockopt;
use nix::sys::socket::sockopt::TcpUserTimeout;
use tokio::io::{AsyncRead, AsyncWrite};
use tokio::net::{TcpListener, TcpStream};
use tokio_util::sync::CancellationToken;
use tower::ServiceExt;

use crate::http::connections::{Connection, ConnectionLimits, Connections};
use crate::http::tls::Tls;

/// Maximum numbers of open connections. Each costs a file handle and a few kB.
const LIMITS: ConnectionLimits = ConnectionLimits {
    all: 4096,
    peer: 3072,
};
/// File handles of the process that are left to files, the database and solving processes.
const OTHER_FILES: u64 = 256;
/// File handles of a connection: its own, and that of the file that it sends or receives.
const FILES_OF_CONNECTION: u64 = 2;
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

/// Serves until shutdown, with TLS if it is given; returns when the last connection has ended.
pub async fn serve(
    listener: TcpListener,
    tls: Option<Tls>,
    router: Router,
    stopping: CancellationToken,
) {
    serve_at_most(limits(), listener, tls, router, stopping).await;
}

/// The limits that the file handles of this process allow.
fn limits() -> ConnectionLimits {
    let handles = getrlimit(Resource::RLIMIT_NOFILE).map_or(u64::MAX, |(soft, _)| soft);
    let most = handles.saturating_sub(OTHER_FILES) / FILES_OF_CONNECTION;
    let most = usize::try_from(most).unwrap_or(usize::MAX);
    ConnectionLimits {
        all: LIMITS.all.min(most.max(1)),
        peer: LIMITS.peer.min((most / 4 * 3).max(1)),
    }
}

async fn serve_at_most(
    limits: ConnectionLimits,
    listener: TcpListener,
    tls: Option<Tls>,
    router: Router,
    stopping: CancellationToken,
) {
    let connections = Connections::new(limits);
    let open = GracefulShutdown::new();
    for number in 0.. {
        let accepted = tokio::select! {
            accepted = accept(&listener, &connections) => accepted,
            () = stopping.cancelled() => break,
        };
        let Some((stream, peer)) = accepted else {
            tokio::time::sleep(ACCEPT_PAUSE).await;
            continue;
        };
        if let Some(connection) = connections.add(number, peer.ip()) {
            let (tls, router, watcher) = (tls.clone(), router.clone(), open.watcher());
            tokio::spawn(async move {
                let Some(tls) = tls else {
                    return handle(stream, connection, router, watcher).await;
                };
                match tls.handshake(stream).await {
                    Ok(stream) => handle(stream, connection, router, watcher).await,
                    Err(error) => tracing::debug!(%peer, %error, "a TLS handshake failed"),
                }
            });
        } else {
            tracing::debug!(%peer, "a connection of a client with too many requests was closed");
        }
    }
    drop(listener);
    open.shutdown().await;
}

/// Serves a connection until its end, or until it is closed for another one.
async fn handle(
    stream: impl AsyncRead + AsyncWrite + Unpin + 'static,
    connection: Connection,
    router: Router,
    watcher: Watcher,
) {
    let (close, connection) = (connection.close.clone(), Arc::new(connection));
    let service = service_fn(move |request: Request<Incoming>| {
        let in_progress = connection.request();
        let mut request = request.map(Body::new);
        request.extensions_mut().insert(Arc::clone(&connection));
        let response = router.clone().oneshot(request);
        async move {
            response
                .await
                .map(|response| in_progress.until_sent(response))
        }
    });
    let mut builder = http1::Builder::new();
    builder
        .timer(TokioTimer::new())
        .header_read_timeout(HEAD_TIMEOUT)
        .max_buf_size(MAX_HEAD_BYTES)
        // A buffer alone grows beyond its limit while a head that is in it is complete.
        .max_header_size(MAX_HEAD_BYTES)
        .max_headers(MAX_HEADERS);
    let served = watcher.watch(builder.serve_connection(TokioIo::new(stream), service));
    tokio::select! {
        // A client that disconnects or times out is not an error of the service.
        ended = served => if let Err(error) = ended {
            tracing::debug!(%error, "a connection was aborted");
        },
        () = close.cancelled() => tracing::debug!("an idle connection was closed for another one"),
    }
}

async fn accept(
    listener: &TcpListener,
    connections: &Connections,
) -> Option<(TcpStream, SocketAddr)> {
    connections.room().await;
    match listener.accept().await {
        Ok((stream, peer)) => {
            // Small responses must not wait for each other; without the option the connection is only slower.
            let _ = stream.set_nodelay(true);
            if let Err(error) = setsockopt(&stream, TcpUserTimeout, &USER_TIMEOUT_MS) {
                tracing::debug!(%error, "a connection has no user timeout");
            }
            Some((stream, peer))
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

    /// Two connections of a peer.
    const FEW: ConnectionLimits = ConnectionLimits { all: 9, peer: 2 };

    #[tokio::test]
    async fn idle_connections_of_a_client_do_not_keep_another_one_waiting() {
        let listener = TcpListener::bind("127.0.0.1:0").await.expect("a port");
        let address = listener.local_addr().expect("an address");
        let stopping = CancellationToken::new();
        let router = Router::new().route("/", get(|| async { "here" }));
        let served = tokio::spawn(serve_at_most(FEW, listener, None, router, stopping.clone()));
        let mut idle = Vec::new();
        for _ in 0..20 {
            idle.push(TcpStream::connect(address).await.expect("a connection"));
        }
        let mut answer = String::new();
        let mut asking = request(address).await;
        asking.read_to_string(&mut answer).await.expect("an answer");
        assert!(answer.ends_with("here"), "{answer}");
        let end = idle[0].read(&mut [0]).await;
        assert!(matches!(end, Ok(0) | Err(_)), "the first one is closed");
        stopping.cancel();
        served.await.expect("it ends");
    }

    #[tokio::test]
    async fn a_head_has_a_largest_size_however_it_is_sent() {
        let listener = TcpListener::bind("127.0.0.1:0").await.expect("a port");
        let address = listener.local_addr().expect("an address");
        let stopping = CancellationToken::new();
        let router = Router::new().route("/", get(|| async { "here" }));
        let served = tokio::spawn(serve_at_most(FEW, listener, None, router, stopping.clone()));
        let (begin, end) = ("GET / HTTP/1.1\r\nx: ", "\r\nconnection: close\r\n\r\n");
        for (length, parts, line) in [
            (MAX_HEAD_BYTES, 1, "HTTP/1.1 200"),
            (MAX_HEAD_BYTES, 9, "HTTP/1.1 200"),
            (MAX_HEAD_BYTES + 1, 1, "HTTP/1.1 431"),
            (100_000, 1, "HTTP/1.1 431"),
            (100_000, 9, "HTTP/1.1 431"),
        ] {
            let filling = "x".repeat(length - begin.len() - end.len());
            let head = format!("{begin}{filling}{end}").into_bytes();
            let mut stream = TcpStream::connect(address).await.expect("a connection");
            for part in head.chunks(length.div_ceil(parts)) {
                // The head may be refused before all of it is sent.
                let _ = stream.write_all(part).await;
                tokio::task::yield_now().await;
            }
            let mut answer = [0; 12];
            stream.read_exact(&mut answer).await.expect("an answer");
            let answer = String::from_utf8_lossy(&answer);
            assert_eq!(answer, line, "{length} bytes in {parts}");
        }
        stopping.cancel();
        served.await.expect("it ends");
    }

    #[tokio::test]
    async fn a_client_whose_connections_all_have_requests_gets_no_more() {
        let listener = TcpListener::bind("127.0.0.1:0").await.expect("a port");
        let address = listener.local_addr().expect("an address");
        let stopping = CancellationToken::new();
        let (begun, mut begins) = tokio::sync::mpsc::unbounded_channel();
        let endless = move || {
            begun.send(()).expect("the test waits");
            pending::<String>()
        };
        let router = Router::new().route("/", get(endless));
        let served = tokio::spawn(serve_at_most(FEW, listener, None, router, stopping.clone()));
        let asking = [request(address).await, request(address).await];
        for _ in &asking {
            begins.recv().await.expect("it begins");
        }
        let end = request(address).await.read(&mut [0]).await;
        assert!(matches!(end, Ok(0) | Err(_)), "it is closed");
        stopping.cancel();
        drop(asking);
        served.await.expect("it ends");
    }

    #[tokio::test]
    async fn connections_have_a_user_timeout() {
        let listener = TcpListener::bind("127.0.0.1:0").await.expect("a port");
        let address = listener.local_addr().expect("an address");
        let connections = Connections::new(FEW);
        let client = TcpStream::connect(address);
        let (accepted, _client) = tokio::join!(accept(&listener, &connections), client);
        let (stream, _) = accepted.expect("a connection");
        assert_eq!(getsockopt(&stream, TcpUserTimeout), Ok(USER_TIMEOUT_MS));
    }

    #[tokio::test]
    async fn the_service_stops_once_the_client_of_an_endless_request_disconnects() {
        let listener = TcpListener::bind("127.0.0.1:0").await.expect("a port");
        let address = listener.local_addr().expect("an address");
        let stopping = CancellationToken::new();
        let router = Router::new().route("/", get(|| async { pending::<String>().await }));
        let served = tokio::spawn(serve_at_most(FEW, listener, None, router, stopping.clone()));
        let stream = request(address).await;
        tokio::time::sleep(Duration::from_millis(50)).await;
        stopping.cancel();
        drop(stream);
        served.await.expect("it ends");
    }
}
