//! Progress of a run: its life, its end, and the quantities of its stops.

use super::resistance;
use crate::ale::Spines;
use crate::checkpoint::SectionRun;
use crate::cycle::CycleState;
use crate::law::surface;
use crate::model::Model;
use crate::record::{self, Exposed, Outcome};
use crate::scene::Scene;
use crate::schedule::stops::{self, StopQuantities};
use crate::sides::Sides;

/// The outcome of a run that ends here.
pub(super) fn end(
    scene: &Scene,
    model: &Model,
    spines: &Spines,
    run: &SectionRun,
) -> Option<Outcome> {
    let state = &run.state.cycle_state;
    let depth = |side, part| record::worn_surface(model, state, side).depth_of_part(part);
    stops::end(scene, now(scene, model, spines, run), depth)
}

/// Progress for its stops.
pub(super) fn now(
    scene: &Scene,
    model: &Model,
    spines: &Spines,
    run: &SectionRun,
) -> StopQuantities {
    let state = &run.state.cycle_state;
    StopQuantities {
        exceeds_resistance: resistance::exceeds_limit(scene, &run.electrical),
        ..progress(model, spines, state, state.jump.rates())
    }
}

/// Progress of the run for its stops, at rates of the contact nodes as equivalent depths, mm a cycle.
pub(super) fn progress(
    model: &Model,
    spines: &Spines,
    state: &CycleState,
    equivalent: Sides<&[f64]>,
) -> StopQuantities {
    let wear = model.interface.wear;
    let rates = Sides::from_fn(|side| {
        surface::at_relative_rates(*wear.of(side), equivalent.of(side), state.depth.of(side))
    });
    StopQuantities {
        cycle: state.cycle,
        cycles_left: spines.cycles_left(&state.depth, rates.as_ref().map(|rates| &rates[..])),
        fastest_rate: equivalent.map(|rates| rates.iter().fold(0.0, |m: f64, rate| m.max(*rate))),
        worn_through: spines.are_worn_through(&state.depth),
        exceeds_resistance: false,
    }
}
