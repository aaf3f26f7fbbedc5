//! Starts for the increments of the next cycle: it passes the same places with almost the same tractions.

use serde::{Deserialize, Serialize};

use crate::contact::{ContactState, Status, WarmStart};

/// Statuses and pressures from the first closed node to the last, at the end of each increment of a computed cycle.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub struct WarmStarts {
    /// First node of each increment, and where its values end.
    increments: Vec<(usize, usize)>,
    status: Vec<Status>,
    pressure: Vec<f64>,
}

/// An increment of a cycle, which may start from the one like it of the last cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct IncrementNumber {
    /// Number in the cycle, from 0 on.
    pub(crate) number: usize,
    /// Increments of the cycle.
    pub(crate) count: usize,
}

impl WarmStarts {
    /// Appends the contact at the end of the next increment.
    pub(crate) fn push(&mut self, contact: &ContactState) {
        let (first, end) = contact.active_range().unwrap_or_default();
        self.status.extend_from_slice(&contact.status[first..end]);
        self.pressure
            .extend_from_slice(&contact.pressure[first..end]);
        self.increments.push((first, self.status.len()));
    }

    /// Start of an increment of the next cycle, if that has as many.
    pub(crate) fn of(&self, increment: IncrementNumber) -> Option<WarmStart<'_>> {
        let IncrementNumber { number, count } = increment;
        if count != self.increments.len() {
            return None;
        }
        let (first, end) = self.increments[number];
        let begin = number
            .checked_sub(1)
            .map_or(0, |before| self.increments[before].1);
        Some(WarmStart {
            first,
            status: &self.status[begin..end],
            pressure: &self.pressure[begin..end],
        })
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::condensation::{BodyOperators, Operators};
    use crate::model::Profile;
    use crate::sides::Side;

    fn operators() -> Operators {
        let body = || BodyOperators {
            x: vec![0.0, 1.0, 2.0, 3.0],
            widths: vec![1.0; 4],
            profile: Profile::Flat,
            zones: Vec::new(),
        };
        Operators {
            slider: body(),
            receptacle: body(),
        }
    }

    #[test]
    fn each_increment_starts_from_the_same_one_of_the_last_cycle() {
        let mut contact = ContactState::untouched(&operators(), Side::Receptacle);
        let mut starts = WarmStarts::default();
        starts.push(&contact);
        contact.set_statuses(1, &[Status::Stick; 2]);
        contact.pressure[1..3].copy_from_slice(&[5.0, 7.0]);
        starts.push(&contact);
        let of = |number, count| starts.of(IncrementNumber { number, count });
        let start = of(0, 2).expect("as many increments");
        assert!(start.status.is_empty());
        let start = of(1, 2).expect("as many increments");
        assert_eq!(start.first, 1);
        assert_eq!(start.status, [Status::Stick; 2]);
        assert_eq!(start.pressure, [5.0, 7.0]);
        assert_eq!(of(1, 3), None);
    }
}
