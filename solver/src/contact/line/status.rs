//! Contact status of a node.

use serde::{Deserialize, Serialize};

/// Contact status of a node of the slave.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum Status {
    /// No contact.
    Open,
    /// Contact without slip.
    Stick,
    /// The slider slips toward +x.
    SlipRight,
    /// The slider slips toward -x.
    SlipLeft,
}

impl Status {
    /// Direction of slip, 0 without slip.
    pub(in crate::contact) fn direction(self) -> f64 {
        match self {
            Self::Open | Self::Stick => 0.0,
            Self::SlipRight => 1.0,
            Self::SlipLeft => -1.0,
        }
    }

    /// Slip in the direction of a number.
    pub(in crate::contact) fn slip(sign: f64) -> Self {
        if sign < 0.0 {
            Self::SlipLeft
        } else {
            Self::SlipRight
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_slipping_status_has_the_direction_of_the_slip() {
        assert!((Status::slip(2.0).direction() - 1.0).abs() < f64::EPSILON);
        assert!((Status::slip(-2.0).direction() + 1.0).abs() < f64::EPSILON);
        assert!(Status::Stick.direction().abs() < f64::EPSILON);
    }
}
