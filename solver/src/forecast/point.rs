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
use crate::point::{JumpControl, legs};
use crate::scene::{Effect, Scene};
use crate::schedule::mission::MissionPosition;
use crate::schedule::stops::StopQuantities;
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
    /// Contact solves over the cycles of the run.
    pub course: Course,
}

/// Share of the change of the wear per cycle in the estimate of the run. Fitted to runs of `sd_card` and of a ball of steel.
const SHARE: f64 = 0.5;
/// Half-length of the window over that of the contact; mean over a run of windows that widen by thirds.
const WINDOW: f64 = 1.6;
/// Iterations of a solve: about 12 of an unworn contact, 3 to 8 where it wears.
const ITERATIONS: f64 = 5.0;
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
        let until = position.until.min(cycles);
        let Block {
            contact,
            jumps,
            product,
        } = &mut blocks[position.block];
        let step = contact.step_over_indentation(worn.rates, worn.along);
        let jump = jumps.next(&contact.accuracy, done, until - done, step);
        let next = worn_after(scene, contact, done + jump);
        let grown = next.along * next.across;
        jumps.update(jump, SHARE * (1.0 - *product / grown));
        *product = grown;
        (done, worn) = (done + jump, next);
        let mut solving = Solving::of(contact, &worn, unworn);
        if is_first && contact.slip == SlipRegime::Partial {
            solving.solves += CHANGE_SOLVES;
        }
        is_first = false;
        forecast.add(done, 1.0, repetitions, &solving);
        let strip = (scene.largest_amplitude_mm() / worn.along + WINDOW) / WINDOW;
        let both = count_at_least((1.0 + strip) * solving.cells);
        forecast.surface_cells = forecast.surface_cells.max(both);
        if forecast.computed_cycles >= MOST_CYCLES {
            // With the last jump.
            let rest = real_cycles(cycles - done) / real_cycles(jump);
            forecast.add(cycles, rest, repetitions, &solving);
            break;
        }
    }
    Some(forecast)
}

/// The unworn contact in each block.
fn blocks(scene: &Scene, contact: &PointScene, unworn: &Worn) -> Vec<Block> {
    let slip = if effects::plan(scene).simulates(Effect::StickMemory) {
        SlipRegime::Partial
    } else {
        SlipRegime::Gross
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
    let rates = wear.zip(depth).map(|(wear, depth)| {
        wear.map_or(0.0, |wear| wear.largest_rate(depth, LocalState::default()))
    });
    Worn {
        along: grown(along, radii.0, depth.slider + followed * depth.receptacle),
        across: grown(across, radii.1, depth.slider + depth.receptacle),
        rates,
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
            cells: along * 2.0 * WINDOW * per_half * coarsened(worn.across / unworn.1),
        }
    }
}

impl PointForecast {
    /// Adds computed cycles until a cycle of the run.
    fn add(&mut self, until: u64, computed: f64, repetitions: f64, solving: &Solving) {
        let solves = real(solving.solves);
        self.computed_cycles += computed;
        self.most_increments = self.most_increments.max(solving.solves);
        self.increments += computed * repetitions * solves;
        self.course.add(until, computed * solves);
        self.cell_iterations +=
            computed * repetitions * solves * solving.iterations * solving.cells;
        self.most_cells = self.most_cells.max(count_at_least(solving.cells));
    }
}

/// Computed cycles that are forecast one by one; the rest is extrapolated from the last.
const MOST_CYCLES: f64 = 300.0;

/// Contact solves of a cycle of a contact of a half-length, mm.
fn solves(contact: &PointScene, length: f64) -> usize {
    let cell = length / contact.accuracy.cells_per_half_length;
    if contact.amplitude_mm.abs() < 0.5 * cell {
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
