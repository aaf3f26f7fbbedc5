//! Cost model of the run of a point contact, before anything is solved: its schedule on worn shapes of closed form.
//!
//! The jump control of the run is applied to a contact of the half-lengths b along and c across the sliding direction, which grow as the
//! arcs that have worn off, b^2 = a^2 + 2 R_x (h_s + h_r exp(-2.3 A/a)) and c^2 = a_z^2 + 2 R_z (h_s + h_r): a groove is followed along
//! by short strokes alone. The wear per cycle changes by the part 1 - b_0 c_0/(b_1 c_1) of it, of which the run's estimate is a share.

use super::course::Course;
use crate::closed_form::expected_wear::{expected_cycles, worn_depth_after};
use crate::closed_form::{PointScene, SlipRegime};
use crate::effects;
use crate::law::surface::SurfaceWear;
use crate::law::wear::LocalState;
use crate::number::{count_at_least, real, real_cycles};
use crate::point::{
    ITERATIONS, ITERATIONS_OF_IMPLICIT, JumpBounds, JumpControl, is_steady, laws_of_implicit_jumps,
    legs, saves_work,
};
use crate::scene::{Effect, Scene};
use crate::schedule::jump::Formula;
use crate::schedule::jump::implicit::two_steps;
use crate::schedule::mission::MissionPosition;
use crate::schedule::stops::{StopQuantities, next_point_of_friction};
use crate::schedule::stroke::even_friction;
use crate::sides::{Side, Sides};

/// Estimated work of the run of a point contact.
#[derive(Debug, Clone, Default, PartialEq)]
pub struct PointForecast {
    /// Computed cycles.
    pub computed_cycles: f64,
    /// Most contact solves of a cycle.
    pub most_increments: usize,
    /// Contact solves of the whole run.
    pub increments: f64,
    /// Iterations of these times the cells of their windows.
    pub cell_iterations: f64,
    /// Most cells of a window.
    pub most_cells: usize,
    /// Most cells of the grids of both bodies together.
    pub surface_cells: usize,
    /// Numbers that an implicit jump holds for the contacts at all of its positions at once, at most.
    pub held_numbers: f64,
    /// Contact solves over the cycles of the run.
    pub course: Course,
}

/// Share of the change of the wear per cycle in the estimate of the run. Fitted to runs of `sd_card` and of a ball of steel.
const SHARE: f64 = 0.5;
/// The same of implicit jumps, and what cells that pass an interface add from the first one on. Fitted to runs of a ball, bare and plated.
const SHARE_OF_IMPLICIT: f64 = 0.4;
const AT_LAYERS: f64 = 0.06;
/// Solves of an implicit jump beside those at its positions.
const SOLVES_AT_THE_END: usize = 2;
/// Fields of an implicit jump at each position: pressures before and after it, and those of `CyclePressures`.
const HELD_OF_CELL: f64 = 15.0;
/// Half-length of the window over that of the contact; mean over a run of windows that widen by thirds.
const WINDOW: f64 = 1.6;
/// Solves of a cycle in which a part sticks, and iterations of each with its stick and slip.
const STICKING_SOLVES: usize = 4;
const STICKING_ITERATIONS: f64 = 150.0;
/// Solves that move the slider to the next motion of a mission where a part sticks.
const CHANGE_SOLVES: usize = 2;
/// Decay with A/a of the groove that is followed along, as of sections (`closed_form::expected_life`).
const SHARED_DEPTH: f64 = 2.3;
/// Solves of an increment through layers.
const REPETITIONS: f64 = 2.5;
/// Cells along a half-length from which on they are merged, over the chosen ones.
const MERGED: f64 = 2.2;

/// A contact as it is worn.
struct Worn {
    /// Half-lengths, mm.
    along: f64,
    across: f64,
    /// Largest specific wear rates down to the worn depths, 1/MPa.
    rates: Sides<f64>,
    /// Worn depth of both sides, mm.
    depth: f64,
    /// True if a side is through to a layer that wears faster.
    is_at_layers: bool,
}

/// An implicit jump.
struct ImplicitStep {
    jump: u64,
    formula: Formula,
    /// The control that has chosen it.
    control: JumpControl,
}

impl ImplicitStep {
    /// The next one after so many cycles, as in the run.
    fn next(control: &JumpControl, contact: &PointScene, done: u64, remaining: u64) -> Self {
        let mut control = *control;
        let jump = control.next_implicit(&contact.accuracy, done, remaining);
        let (formula, _) = two_steps(control.last_jump(), real_cycles(jump));
        Self {
            jump,
            formula,
            control,
        }
    }
}

/// The contact in a block of a mission, or in the whole run.
struct Block {
    contact: PointScene,
    jumps: JumpControl,
    /// Product of the half-lengths after its last cycle, mm^2: other blocks have worn the contact since.
    product: f64,
}

/// Forecasts the run of a scene; `None` for one that is no point contact. Each block of a mission has its own jumps, and all of them wear one
/// scar, that of their mean cycle.
pub fn point_forecast(scene: &Scene) -> Option<PointForecast> {
    let contact = PointScene::of(scene, SlipRegime::Gross)?;
    let unworn = contact.half_lengths_mm();
    let cycles = expected_cycles(scene, unworn.0);
    let wear = scene.surface_wear();
    let layered = Side::BOTH.map(|side| wear.of(side).is_some_and(SurfaceWear::depends_on_depth));
    let repetitions = if layered.contains(&true) {
        REPETITIONS
    } else {
        1.0
    };
    let (mut done, mut worn, mut is_first) = (0, worn_after(scene, &contact, 0), false);
    let mut blocks = blocks(scene, &contact, &worn);
    let mut position = MissionPosition::first(scene);
    let mut forecast = PointForecast::default();
    while done < cycles {
        if scene.mission.is_some() && done >= position.until {
            position = position.next(scene, at(done), |_, _| 0.0);
            is_first = true;
        }
        let until = next_point_of_friction(scene, done)
            .min(position.until)
            .min(cycles);
        let Block {
            contact,
            jumps,
            product,
        } = &mut blocks[position.block];
        let is_moving = solves(contact, worn.along) > 1;
        let step = if is_moving {
            contact.step_over_indentation(worn.rates, worn.along)
        } else {
            0.0
        };
        let remaining = until - done;
        let (by_cycle, tolerance) = (scene.friction.by_cycle(), contact.accuracy.tolerance);
        let bounds = JumpBounds {
            step,
            even_friction: even_friction(by_cycle, tolerance, done),
        };
        let mut jump = jumps.next(&contact.accuracy, done, remaining, bounds);
        let implicit = laws_of_implicit_jumps(contact)
            .filter(|_| scene.mission.is_none() && is_moving && done > 0)
            .map(|_| ImplicitStep::next(jumps, contact, done, remaining))
            .filter(|step| saves_work(contact, worn.along, step.jump, jump));
        if let Some(step) = &implicit {
            jump = step.jump;
        }
        let next = worn_after(scene, contact, done + jump);
        let grown = next.along * next.across;
        let change = 1.0 - *product / grown;
        let mut solving = Solving::of(contact, &next, unworn);
        if let Some(step) = implicit {
            let error =
                SHARE_OF_IMPLICIT * change + if next.is_at_layers { AT_LAYERS } else { 0.0 };
            *jumps = step.control;
            jumps.update_implicit(jump, error, step.formula);
            solving.jump_implicitly(contact, &worn, next.depth - worn.depth);
        } else {
            jumps.update(jump, SHARE * change);
            solving.repetitions = repetitions;
        }
        *product = grown;
        (done, worn) = (done + jump, next);
        if is_first && contact.slip == SlipRegime::Partial {
            solving.solves += CHANGE_SOLVES;
        }
        is_first = false;
        forecast.add(done, 1.0, &solving);
        let strip = (scene.largest_amplitude_mm() / worn.along + WINDOW) / WINDOW;
        let both = count_at_least((1.0 + strip) * solving.cells);
        forecast.surface_cells = forecast.surface_cells.max(both);
        if forecast.computed_cycles >= MOST_CYCLES {
            // With the last jump.
            let rest = real_cycles(cycles - done) / real_cycles(jump);
            forecast.add(cycles, rest, &solving);
            break;
        }
    }
    Some(forecast)
}

/// The unworn contact in each block.
fn blocks(scene: &Scene, contact: &PointScene, unworn: &Worn) -> Vec<Block> {
    let plan = effects::plan(scene);
    let slip = if plan.simulates(Effect::StickMemory) {
        SlipRegime::Partial
    } else {
        SlipRegime::Gross
    };
    let spring = if plan.simulates(Effect::SpringFading) {
        contact.spring_n_per_mm
    } else {
        0.0
    };
    let contact = PointScene {
        spring_n_per_mm: spring,
        ..*contact
    };
    let blocks = scene.blocks().into_iter();
    let blocks = blocks.map(|block| Block {
        contact: contact.in_block(&block, slip),
        jumps: JumpControl::default(),
        product: unworn.along * unworn.across,
    });
    blocks.collect()
}

/// The contact as it is worn after so many cycles.
fn worn_after(scene: &Scene, contact: &PointScene, done: u64) -> Worn {
    let ((along, across), radii) = (contact.half_lengths_mm(), contact.radii_mm());
    let followed = (-SHARED_DEPTH * scene.motion.amplitude_mm() / along).exp();
    let wear = scene.surface_wear();
    let depth = worn_depth_after(scene, along, &wear, done);
    let grown = |half: f64, radius: f64, worn: f64| (half * half + 2.0 * radius * worn).sqrt();
    let is_through = |wear: Option<SurfaceWear>, depth: f64| {
        wear.is_some_and(|wear| wear.without_faster(depth).start > 0.0)
    };
    let is_at_layers =
        is_through(wear.slider, depth.slider) || is_through(wear.receptacle, depth.receptacle);
    let rates = wear.zip(depth).map(|(wear, depth)| {
        wear.map_or(0.0, |wear| wear.largest_rate(depth, LocalState::default()))
    });
    Worn {
        along: grown(along, radii.0, depth.slider + followed * depth.receptacle),
        across: grown(across, radii.1, depth.slider + depth.receptacle),
        rates,
        depth: depth.slider + depth.receptacle,
        is_at_layers,
    }
}

/// Progress for the rounds of a mission; a stop is at the expected end.
fn at(cycle: u64) -> StopQuantities {
    StopQuantities {
        cycle,
        cycles_left: f64::INFINITY,
        fastest_rate: Sides::default(),
        worn_through: false,
        exceeds_resistance: false,
    }
}

/// Solves of a cycle.
struct Solving {
    solves: usize,
    /// Iterations of each.
    iterations: f64,
    /// Numbers that an implicit jump holds.
    held_numbers: f64,
    /// Repetitions of each.
    repetitions: f64,
    cells: f64,
}

impl Solving {
    /// Solves of a cycle of a worn contact whose unworn half-lengths are these, mm.
    fn of(contact: &PointScene, worn: &Worn, unworn: (f64, f64)) -> Self {
        let (solves, iterations) = match contact.slip {
            SlipRegime::Partial => (STICKING_SOLVES, STICKING_ITERATIONS),
            SlipRegime::Gross => (solves(contact, worn.along), ITERATIONS),
        };
        let per_half = contact.accuracy.cells_per_half_length;
        let along = 2.0 * WINDOW * per_half * coarsened(worn.along / unworn.0);
        Self {
            solves,
            iterations,
            held_numbers: 0.0,
            repetitions: 1.0,
            cells: along * 2.0 * WINDOW * per_half * coarsened(worn.across / unworn.1),
        }
    }

    /// Takes the solves of an implicit jump that wears a depth in mm: at all positions before and after it, and of the contacts that are reported.
    fn jump_implicitly(&mut self, contact: &PointScene, worn: &Worn, depth: f64) {
        let parts = contact.parts(worn.along);
        let positions = parts.pressures(contact.amplitude_mm.abs());
        // Indentation of a flat punch.
        let mean_length = (worn.along * worn.across).sqrt();
        let indentation = contact.force_n / (2.0 * contact.modulus() * mean_length);
        self.solves = 2 * positions + SOLVES_AT_THE_END;
        self.held_numbers = HELD_OF_CELL * real(positions) * self.cells;
        self.iterations = ITERATIONS_OF_IMPLICIT * (1.0 + depth / indentation).sqrt();
    }
}

impl PointForecast {
    /// Adds computed cycles until a cycle of the run.
    fn add(&mut self, until: u64, computed: f64, solving: &Solving) {
        let solves = real(solving.solves);
        self.computed_cycles += computed;
        self.most_increments = self.most_increments.max(solving.solves);
        self.increments += computed * solving.repetitions * solves;
        self.course.add(until, computed * solves);
        self.cell_iterations +=
            computed * solving.repetitions * solves * solving.iterations * solving.cells;
        self.most_cells = self.most_cells.max(count_at_least(solving.cells));
        self.held_numbers = self.held_numbers.max(solving.held_numbers);
    }
}

/// Computed cycles that are forecast one by one; the rest is extrapolated from the last.
const MOST_CYCLES: f64 = 300.0;

/// Contact solves of a cycle of a contact of a half-length, mm.
fn solves(contact: &PointScene, length: f64) -> usize {
    let cell = length / contact.accuracy.cells_per_half_length;
    if is_steady(contact) || contact.amplitude_mm.abs() < 0.5 * cell {
        return 1;
    }
    let step = contact.accuracy.step_over_half_length * length;
    let legs = legs(contact).into_iter();
    let steps = legs.map(|leg| count_at_least(leg.length() / step));
    steps.sum::<usize>() + 1
}

/// Cells over the chosen ones of a contact that has grown by a factor and whose cells are merged in pairs.
fn coarsened(grown: f64) -> f64 {
    let mut cells = grown;
    while cells > MERGED {
        cells *= 0.5;
    }
    cells
}
