//! Legs of a cycle: its strokes, divided at the neutral position.

use crate::closed_form::{CyclePath, PointScene};
use crate::scene::TurningPoints;
use crate::schedule::step::Position;
use crate::schedule::turning_steps::parts;

/// A leg of a cycle, mm.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Leg {
    pub(super) from: f64,
    pub(crate) to: f64,
    /// The named position at its end.
    pub(crate) at: Option<Position>,
    /// True if the slider turns at its end.
    pub(super) turns: bool,
}

impl Leg {
    /// Length, mm.
    pub(crate) fn length(&self) -> f64 {
        (self.to - self.from).abs()
    }

    /// Direction, 1 or -1.
    pub(super) fn direction(&self) -> f64 {
        (self.to - self.from).signum()
    }

    /// The leg in two where it passes the neutral position.
    fn divided(self) -> impl Iterator<Item = Self> {
        let passes = self.from * self.to < 0.0;
        let first = Self {
            to: 0.0,
            at: None,
            ..self
        };
        let last = Self {
            from: if passes { 0.0 } else { self.from },
            ..self
        };
        passes.then_some(first).into_iter().chain([last])
    }
}

/// Legs of a cycle, from the turning point where it begins; none of a continuous motion.
pub(crate) fn legs(scene: &PointScene) -> Vec<Leg> {
    let start = -scene.amplitude_mm;
    let turns = match scene.path {
        CyclePath::ToAndFro => TurningPoints::new(&[start, -start]),
        CyclePath::Turning(turns) => Some(turns),
        CyclePath::Continuous { .. } => None,
    };
    let parts = turns.as_ref().map(parts).unwrap_or_default();
    let parts = parts.iter().map(|part| Leg {
        from: part.from,
        to: part.to,
        at: part.at,
        turns: false,
    });
    let mut legs: Vec<Leg> = parts.flat_map(Leg::divided).collect();
    let next = legs.iter().cycle().skip(1).map(Leg::direction);
    let directions: Vec<f64> = next.take(legs.len()).collect();
    for (leg, next) in legs.iter_mut().zip(directions) {
        leg.turns = leg.direction() * next < 0.0;
    }
    legs
}

#[cfg(test)]
mod tests;
