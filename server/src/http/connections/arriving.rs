//! The body of a request that arrives on a connection, and the memory that bodies take together.

use std::collections::BTreeMap;
use std::net::IpAddr;
use std::sync::Arc;
use std::time::{Duration, Instant};

use tokio_util::sync::CancellationToken;

use super::{Connection, Entry};
use crate::http::arrival::{Arrival, TIMEOUT};
use crate::http::body_limits::BodyKind;

/// The service gave up a body because others need its memory or its connection.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(in crate::http) struct GaveWay;

/// A body that arrives on a connection; its memory counts until this is dropped.
#[derive(Debug)]
pub(in crate::http) struct Arriving {
    connection: Arc<Connection>,
    /// Cancelled when it gives way.
    give_way: CancellationToken,
}

impl Connection {
    /// The body of the request in progress, which begins to arrive.
    pub(in crate::http) fn body(self: &Arc<Self>, kind: BodyKind) -> Arriving {
        self.body_behind(Duration::ZERO, kind)
    }

    /// The same for one that is behind by some time.
    pub(in crate::http) fn body_behind(
        self: &Arc<Self>,
        behind: Duration,
        kind: BodyKind,
    ) -> Arriving {
        let now = Instant::now();
        let arrival = Arrival::new(kind, now.checked_sub(behind).unwrap_or(now));
        let give_way = arrival.give_way.clone();
        if let Some(entry) = self.connections.open().get_mut(&self.number) {
            entry.body = Some(arrival);
        }
        Arriving {
            connection: Arc::clone(self),
            give_way,
        }
    }
}

impl Arriving {
    /// Counts bytes that have arrived, and notes how many of the body are in memory.
    ///
    /// # Errors
    /// [`GaveWay`] if there is no memory for it, or its connection was closed for another one.
    pub(in crate::http) fn arrived(&self, bytes: usize, held: usize) -> Result<(), GaveWay> {
        let mut open = self.connection.connections.open();
        let entry = open.get_mut(&self.connection.number);
        let entry = entry.filter(|entry| entry.body.is_some()).ok_or(GaveWay)?;
        let (peer, body) = (entry.peer, entry.body.as_mut().ok_or(GaveWay)?);
        if body.give_way.is_cancelled() {
            return Err(GaveWay);
        }
        body.arrived(bytes, Instant::now());
        body.held = held;
        if held == 0 {
            return Ok(());
        }
        let (kind, limits) = (body.kind, body.kind.limits());
        let of_peer = Sharing {
            kind,
            peer: Some(peer),
        };
        make_room(&mut open, of_peer, limits.memory_of_peer);
        make_room(&mut open, Sharing { kind, peer: None }, limits.memory);
        if self.give_way.is_cancelled() {
            return Err(GaveWay);
        }
        Ok(())
    }

    /// Notes that the body is complete: it does not give way any more.
    pub(in crate::http) fn complete(&self) {
        let mut open = self.connection.connections.open();
        let entry = open.get_mut(&self.connection.number);
        if let Some(body) = entry.and_then(|entry| entry.body.as_mut()) {
            body.is_complete = true;
        }
    }

    /// Returns when the body gives way to others.
    pub(in crate::http) async fn gives_way(&self) {
        self.give_way.cancelled().await;
    }

    /// The service waits for more of the body; returns the time at which it is given up.
    pub(in crate::http) fn waits_until(&self) -> Instant {
        let (mut open, now) = (self.connection.connections.open(), Instant::now());
        let entry = open.get_mut(&self.connection.number);
        entry
            .and_then(|entry| entry.body.as_mut())
            .map_or(now, |body| {
                body.waits(now);
                body.due() + TIMEOUT
            })
    }
}

impl Drop for Arriving {
    fn drop(&mut self) {
        let mut open = self.connection.connections.open();
        if let Some(entry) = open.get_mut(&self.connection.number) {
            entry.body = None;
        }
    }
}

/// Bodies that share a limit of memory.
#[derive(Debug, Clone, Copy)]
struct Sharing {
    kind: BodyKind,
    /// One peer, or all.
    peer: Option<IpAddr>,
}

/// Lets the bodies that are behind the most give way until the others fit into memory.
fn make_room(open: &mut BTreeMap<u64, Entry>, sharing: Sharing, limit: usize) {
    let Sharing { kind, peer } = sharing;
    let concerned = |entry: &Entry| peer.is_none_or(|peer| entry.peer == peer);
    let of_kind = |body: &Arrival| body.kind == kind && body.held > 0;
    let now = Instant::now();
    loop {
        let entries = open.values().filter(|entry| concerned(entry));
        let bodies = entries.filter_map(|entry| entry.body.as_ref());
        let held: usize = bodies.filter(|b| of_kind(b)).map(|body| body.held).sum();
        let entries = open.values_mut().filter(|entry| concerned(entry));
        let bodies = entries.filter_map(|entry| entry.body.as_mut());
        let incomplete = bodies.filter(|body| of_kind(body) && !body.is_complete);
        match incomplete.min_by_key(|body| body.order_of_giving_way(now)) {
            Some(last) if held > limit => {
                last.held = 0;
                last.give_way.cancel();
            }
            _ => return,
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::http::connections::{ConnectionLimits, Connections};

    const LIMITS: ConnectionLimits = ConnectionLimits { all: 9, peer: 2 };

    fn seconds(number: u64) -> Duration {
        Duration::from_secs(number)
    }

    fn connection(of: &Arc<Connections>, number: u64, peer: u8) -> Arc<Connection> {
        let peer = IpAddr::from([10, 0, 0, peer]);
        Arc::new(of.add(number, peer).expect("room"))
    }

    #[test]
    fn bodies_that_are_behind_the_most_give_way_where_memory_is_short() {
        let connections = Connections::new(LIMITS);
        let [first, second] = [0, 1].map(|number| connection(&connections, number, 1));
        let other = connection(&connections, 2, 2);
        let most = BodyKind::Document.limits().memory_of_peer;
        let first = first.body_behind(seconds(2), BodyKind::Document);
        let second = second.body_behind(seconds(3), BodyKind::Document);
        let other = other.body_behind(seconds(9), BodyKind::Document);
        assert_eq!(other.arrived(1, most), Ok(()));
        assert_eq!(first.arrived(1, most - 9), Ok(()));
        assert_eq!(second.arrived(1, 9), Ok(()));
        // The second is behind the most of this peer, although it asks for more itself.
        assert_eq!(second.arrived(1, 10), Err(GaveWay));
        assert!(second.give_way.is_cancelled() && !first.give_way.is_cancelled());
        assert_eq!(first.arrived(1, most), Ok(()));
        assert!(!other.give_way.is_cancelled(), "another peer");
    }

    #[test]
    fn of_bodies_that_arrive_at_once_the_latest_is_received() {
        let connections = Connections::new(LIMITS);
        let [first, second] = [0, 1].map(|number| connection(&connections, number, 1));
        let most = BodyKind::Document.limits().memory_of_peer;
        let second = second.body_behind(Duration::from_millis(10), BodyKind::Document);
        let first = first.body_behind(Duration::from_millis(20), BodyKind::Document);
        assert_eq!(second.arrived(1, 1), Ok(()));
        // The service has read from the first one after it has read from the second one.
        assert_eq!(first.arrived(1 << 20, most), Err(GaveWay));
        assert_eq!(second.arrived(1, most), Ok(()));
    }

    #[test]
    fn a_complete_body_never_gives_way_and_counts_until_its_request_has_ended() {
        let connections = Connections::new(LIMITS);
        let [first, second] = [0, 1].map(|number| connection(&connections, number, 1));
        let most = BodyKind::Document.limits().memory_of_peer;
        let complete = first.body_behind(seconds(9), BodyKind::Document);
        assert_eq!(complete.arrived(1, most), Ok(()));
        complete.complete();
        let refused = second.body(BodyKind::Document);
        assert_eq!(refused.arrived(1, 1), Err(GaveWay));
        assert!(!complete.give_way.is_cancelled());
        drop((complete, refused));
        assert_eq!(second.body(BodyKind::Document).arrived(1, 1), Ok(()));
    }

    #[test]
    fn all_peers_together_have_a_limit_of_their_own() {
        let connections = Connections::new(LIMITS);
        let limits = BodyKind::Document.limits();
        let peers = limits.memory / limits.memory_of_peer;
        let bodies: Vec<_> = (0..=peers)
            .map(|number| {
                let peer = u8::try_from(number).expect("few");
                let behind = seconds(10 - u64::from(peer));
                connection(&connections, u64::from(peer), peer)
                    .body_behind(behind, BodyKind::Document)
            })
            .collect();
        for body in &bodies {
            assert_eq!(body.arrived(1, limits.memory_of_peer), Ok(()));
        }
        let gave_way = bodies.iter().map(|body| body.give_way.is_cancelled());
        let expected = (0..=peers).map(|number| number == 0);
        assert!(gave_way.eq(expected), "the first is behind the most");
    }

    #[test]
    fn a_connection_with_a_late_body_is_closed_for_a_new_one() {
        let connections = Connections::new(LIMITS);
        let [slow, other] = [0, 1].map(|number| connection(&connections, number, 1));
        let _requests = [slow.request(), other.request()];
        let body = slow.body(BodyKind::Document);
        let peer = IpAddr::from([10, 0, 0, 1]);
        assert!(connections.add(2, peer).is_none(), "it is not late yet");
        drop(body);
        let body = slow.body_behind(seconds(6), BodyKind::Document);
        let _new = connections.add(3, peer).expect("room");
        assert!(slow.close.is_cancelled() && !other.close.is_cancelled());
        assert_eq!(body.arrived(1, 1), Err(GaveWay));
    }
}
