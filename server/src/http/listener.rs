//! Takes connections and serves them, with limits that a client cannot outwait: on connections, on the time that the
//! head of a request may take, and on the time that open requests get when the service stops.

use std::sync::Arc;
use std::time::Duration;

use axum::Router;
use hyper::server::conn::http1;
use hyper_util::rt::{TokioIo, TokioTimer};
use hyper_util::server::graceful::GracefulShutdown;
use hyper_util::service::TowerToHyperService;
use tokio::net::{TcpListener, TcpStream};
use tokio::sync::Semaphore;
use tokio_util::sync::CancellationToken;

/// Open connections; more wait to be taken. Each costs a file handle and a few kB.
const CONNECTIONS: usize = 4096;
/// How long the head of a request may take, counted from the moment a connection is taken or its last answer was sent:
/// slow heads, and connections that nobody uses, end after it.
const HEAD_TIME: Duration = Duration::from_secs(30);
/// Largest head, bytes; a token and a long query fit.
const HEAD_LIMIT: usize = 64 << 10;
/// Most header fields of a request.
const FIELD_LIMIT: usize = 64;
/// Pause after a connection could not be taken, because the process has no more file handles for instance.
const PAUSE: Duration = Duration::from_millis(50);

/// Serves until the service stops; returns when the last connection has ended.
pub async fn serve(listener: TcpListener, router: Router, stopping: CancellationToken) {
    let room = Arc::new(Semaphore::new(CONNECTIONS));
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
            Some((stream, place))
        }
        Err(error) => {
            tracing::warn!(%error, "a connection could not be taken");
            None
        }
    }
}
