//! The open connections: how many there may be, of one peer and of all, and which of them is closed for a new one.
//!
//! A connection without a request in progress is idle, and so is one with a body that arrives too slowly. Where there are too many,
//! the one that has been idle the longest is closed: a client that opens thousands and sends nothing keeps no other one waiting.

pub(super) mod arriving;

use std::collections::BTreeMap;
use std::net::{IpAddr, Ipv6Addr};
use std::pin::Pin;
use std::sync::{Arc, Mutex, MutexGuard, PoisonError};
use std::task::{Context, Poll};
use std::time::{Duration, Instant};

use axum::body::{Body, Bytes, HttpBody};
use axum::response::Response;
use hyper::body::{Frame, SizeHint};
use tokio::sync::Notify;
use tokio_util::sync::CancellationToken;

use crate::http::arrival::Arrival;

/// Time after the last frame of an answer was handed over in which it is sent to all but the slowest clients.
const FLUSH_TIME: Duration = Duration::from_secs(5);

/// Largest numbers of open connections.
#[derive(Debug, Clone, Copy)]
pub(super) struct ConnectionLimits {
    /// Of all peers; more wait to be accepted while all have a request in progress.
    pub(super) all: usize,
    /// Of one address; more are closed while all have a request in progress.
    pub(super) peer: usize,
}

/// The open connections.
#[derive(Debug)]
pub(super) struct Connections {
    limits: ConnectionLimits,
    open: Mutex<BTreeMap<u64, Entry>>,
    closed: Notify,
}

#[derive(Debug)]
struct Entry {
    peer: IpAddr,
    requests: usize,
    /// When the last request ended; none before the first.
    answered: Option<Instant>,
    opened: Instant,
    /// The body of the request in progress, from its first byte until it is not needed any more.
    body: Option<Arrival>,
    close: CancellationToken,
}

/// An open connection; it counts until it is dropped.
#[derive(Debug)]
pub(super) struct Connection {
    connections: Arc<Connections>,
    number: u64,
    /// Cancelled to close it for another one.
    pub(super) close: CancellationToken,
}

impl Connections {
    /// No connection yet.
    pub(super) fn new(limits: ConnectionLimits) -> Arc<Self> {
        Arc::new(Self {
            limits,
            open: Mutex::default(),
            closed: Notify::new(),
        })
    }

    /// Waits until one more connection may be accepted: there is room, or an idle connection can be closed for it.
    pub(super) async fn room(&self) {
        loop {
            let closed = self.closed.notified();
            if self.has_room() {
                return;
            }
            tokio::select! {
                () = closed => {}
                // Connections become idle with time, too.
                () = tokio::time::sleep(FLUSH_TIME) => {}
            }
        }
    }

    fn has_room(&self) -> bool {
        let (open, now) = (self.open(), Instant::now());
        open.len() < self.limits.all || open.values().any(|entry| entry.is_idle(now))
    }

    /// Adds a connection from an address, for which an idle one may be closed; `None` if the peer has too many.
    pub(super) fn add(self: &Arc<Self>, number: u64, peer: IpAddr) -> Option<Connection> {
        let mut open = self.open();
        let of_peer = open.values().filter(|entry| entry.peer == peer).count();
        if of_peer >= self.limits.peer {
            close_longest_idle(&mut open, |entry| entry.peer == peer)?;
        } else if open.len() >= self.limits.all {
            close_longest_idle(&mut open, |_| true)?;
        }
        let entry = Entry::of(peer);
        let close = entry.close.clone();
        open.insert(number, entry);
        Some(Connection {
            connections: Arc::clone(self),
            number,
            close,
        })
    }

    /// A connection that no other one is closed for.
    pub(super) fn of_one() -> Arc<Connection> {
        let entry = Entry::of(Ipv6Addr::UNSPECIFIED.into());
        let close = entry.close.clone();
        Arc::new(Connection {
            connections: Arc::new(Self {
                limits: ConnectionLimits { all: 1, peer: 1 },
                open: Mutex::new(BTreeMap::from([(0, entry)])),
                closed: Notify::new(),
            }),
            number: 0,
            close,
        })
    }

    fn open(&self) -> MutexGuard<'_, BTreeMap<u64, Entry>> {
        self.open.lock().unwrap_or_else(PoisonError::into_inner)
    }

    /// Changes the number of requests in progress of a connection that may have been closed.
    fn count(&self, number: u64, change: impl FnOnce(usize) -> usize) {
        if let Some(entry) = self.open().get_mut(&number) {
            entry.requests = change(entry.requests);
            entry.answered = Some(Instant::now());
        }
        self.closed.notify_waiters();
    }
}

impl Entry {
    fn of(peer: IpAddr) -> Self {
        Self {
            peer,
            requests: 0,
            answered: None,
            opened: Instant::now(),
            body: None,
            close: CancellationToken::new(),
        }
    }

    /// The end of an answer may still be on its way for a while.
    fn is_idle(&self, now: Instant) -> bool {
        let is_sent = |at: Instant| now.saturating_duration_since(at) >= FLUSH_TIME;
        match &self.body {
            Some(body) => body.is_late(now),
            None => self.requests == 0 && self.answered.is_none_or(is_sent),
        }
    }

    fn idle_since(&self) -> Instant {
        let body = self.body.as_ref().map(Arrival::due);
        body.or(self.answered).unwrap_or(self.opened)
    }
}

/// Closes the connection that has been idle the longest; `None` if none is idle.
fn close_longest_idle(
    open: &mut BTreeMap<u64, Entry>,
    which: impl Fn(&Entry) -> bool,
) -> Option<()> {
    let now = Instant::now();
    let idle = open.iter().filter(|(_, e)| e.is_idle(now) && which(e));
    let number = *idle.min_by_key(|(_, entry)| entry.idle_since())?.0;
    open.remove(&number)?.close.cancel();
    Some(())
}

impl Connection {
    /// A request of this connection, in progress until it is dropped.
    pub(super) fn request(self: &Arc<Self>) -> InProgress {
        self.connections.count(self.number, |requests| requests + 1);
        InProgress(Arc::clone(self))
    }
}

impl Drop for Connection {
    fn drop(&mut self) {
        self.connections.open().remove(&self.number);
        self.connections.closed.notify_waiters();
    }
}

/// A request in progress.
#[derive(Debug)]
pub(super) struct InProgress(Arc<Connection>);

impl InProgress {
    /// Ties the request to the end of its response.
    pub(super) fn until_sent(self, response: Response) -> Response {
        response.map(|body| {
            Body::new(Sent {
                body,
                _request: self,
            })
        })
    }
}

impl Drop for InProgress {
    fn drop(&mut self) {
        let Connection {
            connections,
            number,
            ..
        } = &*self.0;
        connections.count(*number, |requests| requests.saturating_sub(1));
    }
}

/// The body of a response whose request is in progress until it is sent.
struct Sent {
    body: Body,
    _request: InProgress,
}

impl HttpBody for Sent {
    type Data = Bytes;
    type Error = axum::Error;

    fn poll_frame(
        mut self: Pin<&mut Self>,
        context: &mut Context<'_>,
    ) -> Poll<Option<Result<Frame<Bytes>, axum::Error>>> {
        Pin::new(&mut self.body).poll_frame(context)
    }

    fn is_end_stream(&self) -> bool {
        self.body.is_end_stream()
    }

    fn size_hint(&self) -> SizeHint {
        self.body.size_hint()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    const LIMITS: ConnectionLimits = ConnectionLimits { all: 3, peer: 2 };

    fn peer(number: u8) -> IpAddr {
        IpAddr::from([10, 0, 0, number])
    }

    #[tokio::test]
    async fn the_connection_that_is_idle_the_longest_is_closed_for_a_new_one() {
        let connections = Connections::new(LIMITS);
        let first = Arc::new(connections.add(0, peer(1)).expect("room"));
        let second = connections.add(1, peer(1)).expect("room");
        let request = first.request();
        drop(request);
        let third = connections.add(2, peer(1)).expect("for the second");
        assert!(second.close.is_cancelled() && !first.close.is_cancelled());
        let other = connections.add(3, peer(2)).expect("room");
        // The end of the answer on the first one may not be sent yet.
        let last = connections.add(4, peer(3)).expect("for the third");
        assert!(third.close.is_cancelled() && !first.close.is_cancelled());
        assert!([other, last].iter().all(|c| !c.close.is_cancelled()));
    }

    #[tokio::test]
    async fn no_connection_with_a_request_in_progress_is_closed() {
        let connections = Connections::new(LIMITS);
        let open: Vec<_> = [(0, 1), (1, 1), (2, 2)]
            .map(|(number, of)| Arc::new(connections.add(number, peer(of)).expect("room")))
            .into();
        let mut requests: Vec<_> = open.iter().map(Connection::request).collect();
        assert!(connections.add(3, peer(1)).is_none(), "too many of a peer");
        let mut room = Box::pin(connections.room());
        assert!(futures_util::poll!(&mut room).is_pending());
        let response = requests.remove(2).until_sent(Response::new(Body::empty()));
        assert!(futures_util::poll!(&mut room).is_pending());
        drop(response);
        drop(open);
        room.await;
        assert!(connections.add(4, peer(3)).is_some());
    }
}
