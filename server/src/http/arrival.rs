//! The body of a request while it arrives: how far it is behind.
//!
//! A body has to arrive at [`RATE`]. It is *due* until the time for which its bytes suffice at this rate; bytes that arrive faster
//! give no credit, so that neither single bytes nor a fast start let a client hold a body for long.

use std::cmp::Reverse;
use std::time::{Duration, Instant};

use tokio_util::sync::CancellationToken;

use crate::http::body_limits::BodyKind;

/// Rate at which a body has to arrive, bytes a second: half a megabit, that of a slow line.
pub(super) const RATE: u32 = 64 << 10;
/// A body that is this much behind gives way to another connection, if there are too many.
const LATE: Duration = Duration::from_secs(5);
/// A body that is this much behind is given up.
pub(super) const TIMEOUT: Duration = Duration::from_secs(30);

/// A body, from its first byte until it is not needed any more.
#[derive(Debug)]
pub(super) struct Arrival {
    pub(super) kind: BodyKind,
    began: Instant,
    due: Instant,
    /// When the last bytes were counted; the service has done something with them since.
    counted: Instant,
    /// Bytes of it in memory.
    pub(super) held: usize,
    pub(super) is_complete: bool,
    /// Cancelled when it gives way to others.
    pub(super) give_way: CancellationToken,
}

impl Arrival {
    /// One that began to arrive at a time.
    pub(super) fn new(kind: BodyKind, began: Instant) -> Self {
        Self {
            kind,
            began,
            due: began,
            counted: Instant::now(),
            held: 0,
            is_complete: false,
            give_way: CancellationToken::new(),
        }
    }

    /// Time until which the bytes that have arrived suffice.
    pub(super) fn due(&self) -> Instant {
        self.due
    }

    /// Checks whether the body is so far behind that it gives way to another connection.
    pub(super) fn is_late(&self, now: Instant) -> bool {
        !self.is_complete && now.saturating_duration_since(self.due) >= LATE
    }

    /// Order in which bodies give way to others: by whole seconds that they are behind, then the one that began first. Shorter times
    /// are those of the service, which reads from many connections by turns.
    pub(super) fn order_of_giving_way(&self, now: Instant) -> impl Ord + use<> {
        let behind = now.saturating_duration_since(self.due);
        (Reverse(behind.as_secs()), self.began)
    }

    /// Counts bytes that have arrived.
    pub(super) fn arrived(&mut self, bytes: usize, now: Instant) {
        let bytes = u32::try_from(bytes).unwrap_or(u32::MAX);
        let suffices = Duration::from_secs(1) * bytes / RATE;
        self.due = (self.due + suffices).min(now);
        self.counted = now;
    }

    /// The service waits for more: what it has done since the last bytes was not the client's time.
    pub(super) fn waits(&mut self, now: Instant) {
        self.due += now.saturating_duration_since(self.counted);
        self.counted = now;
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn seconds(number: u64) -> Duration {
        Duration::from_secs(number)
    }

    #[test]
    fn neither_single_bytes_nor_a_fast_start_keep_a_body_from_being_late() {
        let began = Instant::now();
        let rate = usize::try_from(RATE).expect("a number");
        let mut body = Arrival::new(BodyKind::Document, began);
        for second in 1..5 {
            body.arrived(1, began + seconds(second));
        }
        assert!(!body.is_late(began + seconds(4)));
        assert!(body.is_late(began + seconds(6)));

        let mut body = Arrival::new(BodyKind::Document, began);
        body.arrived(100 * rate, began + seconds(1));
        assert_eq!(body.due(), began + seconds(1));
        assert!(body.is_late(began + seconds(6)));
        // At the rate it never is.
        for second in 2..20 {
            body.arrived(rate, began + seconds(second));
            assert_eq!(body.due(), began + seconds(second));
        }
        body.is_complete = true;
        assert!(!body.is_late(began + seconds(100)));
    }

    #[test]
    fn the_time_that_the_service_takes_for_what_has_arrived_is_not_the_clients() {
        let began = Instant::now();
        let mut body = Arrival::new(BodyKind::File, began);
        body.arrived(1, began + seconds(2));
        let behind = began + seconds(2) - body.due();
        body.waits(began + seconds(60));
        assert_eq!(began + seconds(60) - body.due(), behind);
    }
}
