//! Takes connections and serves them, with limits that a client cannot outwait: on connections, on the time that the
//! head of a request may take, and on the time that open requests get when the service stops.

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

/// Open connections; more wait to be taken. Each costs a file handle and a few kB.
const CONNECTIONS: usize = 4096;
/// How long the head of a request may take, counted from the moment a connection is taken or its last answer was sent:
/// slow heads, and connections that nobody uses, end after it.
const HEAD_TIME: Duration = Duration::from_secs(30);
/// How long a client may leave what it was sent lying, ms: it has gone, or has stopped reading. The kernel breaks the
/// connection off then; otherwise such streams and downloads would stay for ever.
const UNREAD_TIME_MS: u32 = 60_000;
/// Largest head, bytes; a token and a long query fit.
const HEAD_LIMIT: usize = 64 << 10;
/// Most header fields of a request.
const FIELD_LIMIT: usize = 64;
/// Pause after a connection could not be taken, because the process has no more file handles for instance.
const PAUSE: Duration = Duration::from_millis(50);

/// Serves until the service stops; returns when the last connection has ended.
pub async fn serve(listener: TcpListener, router: Router, stopping: CancellationToken) {
    serve_at_most(CONNECTIONS, listener, router, stopping).await;
}

async fn serve_at_most(
    connections: usize,
    listener: TcpListener,
    router: Router,
    stopping: CancellationToken,
) {
    let room = Arc::new(Semaphore::new(connections));
    let open = GracefulShutdown::new();
    loop {
        let taken = tokio::select! {
            taken = take(&listener, &room) => taken,
            () = stopping.cancelled() => break,
        };
        let Some((stream, place)) = taken else {
            tokio::time::sleep(PAUSE).await;
            continue;
        };
        let mut rules = http1::Builder::new();
        rules
            .timer(TokioTimer::new())
            .header_read_timeout(HEAD_TIME)
            .max_buf_size(HEAD_LIMIT)
            .max_headers(FIELD_LIMIT);
        let service = TowerToHyperService::new(router.clone());
        let connection = open.watch(rules.serve_connection(TokioIo::new(stream), service));
        tokio::spawn(async move {
            // A client that goes away or is too slow is no failure of the service.
            if let Err(error) = connection.await {
                tracing::debug!(%error, "a connection was broken off");
            }
            drop(place);
        });
    }
    drop(listener);
    open.shutdown().await;
}

async fn take(
    listener: &TcpListener,
    room: &Arc<Semaphore>,
) -> Option<(TcpStream, tokio::sync::OwnedSemaphorePermit)> {
    let place = Arc::clone(room).acquire_owned().await.ok()?;
    match listener.accept().await {
        Ok((stream, _)) => {
            // Answers are small and must not wait for each other; a socket that refuses is only slower.
            let _ = stream.set_nodelay(true);
            if let Err(error) = setsockopt(&stream, TcpUserTimeout, &UNREAD_TIME_MS) {
                tracing::debug!(%error, "a connection has no limit on what is left unread");
            }
            Some((stream, place))
        }
        Err(error) => {
            tracing::warn!(%error, "a connection could not be taken");
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

    async fn asked(address: std::net::SocketAddr) -> TcpStream {
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
        let mut waiting = asked(address).await;
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
    async fn what_nobody_reads_does_not_stay_for_ever() {
        let listener = TcpListener::bind("127.0.0.1:0").await.expect("a port");
        let address = listener.local_addr().expect("an address");
        let room = Arc::new(Semaphore::new(1));
        let (taken, _client) = tokio::join!(take(&listener, &room), TcpStream::connect(address));
        let (stream, _) = taken.expect("a connection");
        assert_eq!(getsockopt(&stream, TcpUserTimeout), Ok(UNREAD_TIME_MS));
    }

    #[tokio::test]
    async fn the_service_stops_although_a_request_never_ends_once_it_is_broken_off() {
        let listener = TcpListener::bind("127.0.0.1:0").await.expect("a port");
        let address = listener.local_addr().expect("an address");
        let stopping = CancellationToken::new();
        let router = Router::new().route("/", get(|| async { pending::<String>().await }));
        let served = tokio::spawn(serve_at_most(9, listener, router, stopping.clone()));
        let stream = asked(address).await;
        tokio::time::sleep(Duration::from_millis(50)).await;
        stopping.cancel();
        drop(stream);
        served.await.expect("it ends");
    }
}
