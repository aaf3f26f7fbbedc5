//! Making a move, in halves if it cannot be made at once.

use super::{CycleError, CycleState, Integrator, path};
use crate::contact::{ContactError, Move};
use crate::number::real;

/// How hard an increment is tried.
#[derive(Debug, Clone, Copy)]
struct Patience {
    /// How often it may be halved before it is given up.
    halvings: u32,
    /// From this many halvings on, it is pivoted where Newton's method does not settle.
    pivots_from: u32,
}

const PATIENCE: Patience = Patience {
    halvings: 8,
    pivots_from: 2,
};

/// A probe can be done without.
const PROBES_PATIENCE: Patience = Patience {
    pivots_from: u32::MAX,
    ..PATIENCE
};

impl Integrator<'_> {
    pub(super) fn step(
        &mut self,
        state: &mut CycleState,
        step: &path::Step,
        cycles: f64,
        increment: usize,
    ) -> Result<(), CycleError> {
        let cycle = state.cycle;
        self.reach(state, move_of(step, cycles), 0, PATIENCE)
            .map_err(|(halvings, source)| CycleError::Increment {
                cycle,
                increment,
                halvings,
                source,
            })
    }

    /// A step that digs for a single cycle, in equal parts; whether it could be made.
    pub(super) fn probe(
        &mut self,
        state: &mut CycleState,
        step: &path::Step,
        parts: usize,
    ) -> bool {
        let from = state.contact.slider_x;
        let part = |k: usize| path::Step {
            slider_x: from + (step.slider_x - from) * real(k) / real(parts),
            run: step.run / real(parts),
            at: None,
        };
        (1..=parts).all(|k| {
            self.reach(state, move_of(&part(k), 1.0), 0, PROBES_PATIENCE)
                .is_ok()
        })
    }

    /// Makes a move, in halves if it cannot be made at once.
    fn reach(
        &mut self,
        state: &mut CycleState,
        to: Move,
        halvings: u32,
        patience: Patience,
    ) -> Result<(), (u32, ContactError)> {
        let to = Move {
            pivots: halvings >= patience.pivots_from,
            ..to
        };
        let Err(error) = self.increment(state, to) else {
            return Ok(());
        };
        if halvings == patience.halvings {
            return Err((halvings, error));
        }
        let slider_x = 0.5 * (state.contact.slider_x + to.slider_x);
        let run = 0.5 * to.run;
        self.reach(
            state,
            Move {
                slider_x,
                run,
                ..to
            },
            halvings + 1,
            patience,
        )?;
        self.reach(state, Move { run, ..to }, halvings + 1, patience)
    }
}

fn move_of(step: &path::Step, cycles: f64) -> Move {
    Move {
        slider_x: step.slider_x,
        run: step.run,
        cycles,
        pivots: false,
    }
}
