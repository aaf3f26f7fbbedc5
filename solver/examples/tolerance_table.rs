//! True errors of random scenes at a tolerance, against references at a tenth of it.
//!
//! `cargo run --release -p solver --example tolerance_table [TOLERANCE [DRAWS [SEED [FIRST]]]]`: 0.02, 100, 1 and 0 unless
//! given. One row a wearing side: relative errors of the deepest wear, the scar's width and the worn area, and of the peak
//! pressure at the neutral position, each beside the run's own estimate of it, in per cent; processor seconds of the run
//! with its companions, and of the reference. `!` marks a run that states an error beyond its tolerance in its outcome.
//! Then per regime and altogether the median, 90 %, 95 % and worst of each, and how many lie within what was asked for:
//! the tolerance, and three times the tolerance for pressures; how many runs estimate more than that, restarted, or ended
//! outside of their tolerance, and the time of all over that without error control.

#![expect(clippy::print_stdout, reason = "it prints a table")]

#[path = "../tests/random_scenes.rs"]
mod random_scenes;
#[path = "../tests/recorder.rs"]
#[expect(dead_code, reason = "the verification suite uses more of it")]
mod recorder;
#[path = "../tests/scenes.rs"]
#[expect(dead_code, reason = "the verification suite uses more of it")]
mod scenes;

use std::str::FromStr;

use random_scenes::{Drawn, Regime, draw};
use recorder::solve;
use solver::SolveError;
use solver::record::{Errors, Outcome, Quantity, SideReport, Summary};
use solver::sides::{Side, Sides};

/// The tolerance of a reference over that of the run.
const REFERENCE: f64 = 0.1;
/// Most processor seconds that the reference of a drawn scene is expected to take.
const MOST_S: f64 = 10.0;
/// Clock ticks of a second in `/proc/self/stat`, on every Linux that Rust supports.
const TICKS: f64 = 100.0;

/// Errors of one scene, relative, each that of the worse side: that is what a run estimates.
struct Row {
    regime: Regime,
    /// Depth, width, area, peak pressure.
    errors: [f64; 4],
    estimates: [f64; 4],
    /// Processor seconds with error control, without it, and of the reference.
    costs: [f64; 3],
    restarted: bool,
    outside: bool,
}

const COLUMNS: [&str; 4] = ["depth", "width", "area", "peak"];
const QUANTITIES: [Quantity; 4] = [
    Quantity::WornDepth,
    Quantity::ScarHalfWidth,
    Quantity::WornArea,
    Quantity::PeakPressure,
];

fn main() {
    let tolerance: f64 = argument(1, 0.02);
    let (draws, seed, first): (u64, u64, u64) = (argument(2, 100), argument(3, 1), argument(4, 0));
    println!(
        "tolerance {tolerance}, references {}",
        REFERENCE * tolerance
    );
    println!(
        "{:<52} {:>10} {:>7} {:>5} {:>7} {:>5} {:>7} {:>5} {:>7} {:>5} {:>7} {:>7}",
        "scene",
        "side",
        "depth",
        "est.",
        "width",
        "est.",
        "area",
        "est.",
        "peak",
        "est.",
        "s",
        "ref. s"
    );
    let (mut rows, mut failed) = (Vec::new(), 0);
    for number in first..first + draws {
        let drawn = draw(seed, number, REFERENCE * tolerance, MOST_S);
        match errors(&drawn, tolerance) {
            Ok(row) => rows.push(row),
            Err(error) => {
                failed += 1;
                println!("{:<52} {error}", drawn.name());
            }
        }
    }
    let all = [Regime::PartialSlip, Regime::ShortStroke, Regime::LongGroove];
    for regime in all {
        let of_regime: Vec<&Row> = rows.iter().filter(|row| row.regime == regime).collect();
        print_summary(&format!("{regime:?}"), &of_regime, tolerance);
    }
    print_summary("all", &rows.iter().collect::<Vec<_>>(), tolerance);
    println!("{failed} of {draws} scenes without a result");
}

fn argument<T: FromStr>(place: usize, default: T) -> T {
    let given = std::env::args().nth(place);
    given.and_then(|text| text.parse().ok()).unwrap_or(default)
}

/// Solves a scene at a tolerance and at that of its reference; prints the errors of its wearing sides.
fn errors(drawn: &Drawn, tolerance: f64) -> Result<Row, SolveError> {
    let mut asked = drawn.scene.clone();
    asked.accuracy.tolerance = tolerance;
    let (plain, plain_cost) = timed(|| solve(&asked));
    asked.accuracy.estimate_errors = true;
    let (found, cost) = timed(|| solve(&asked));
    let (exact, reference_cost) = timed(|| solve(&drawn.scene));
    let (found, plain, exact) = (found?.0, plain?.0, exact?.0);
    let peak = relative(found.last.peak_pressure_mpa, exact.last.peak_pressure_mpa);
    let estimates = estimates(&found);
    let outside = found.outcome == Outcome::OutsideTolerance;
    let mark = if outside { "!" } else { "" };
    let mut worst = [0.0_f64; 4];
    for side in Side::BOTH {
        let (found, exact) = (*worn(&found).of(side), *worn(&exact).of(side));
        if exact.max_depth_mm <= 0.0 {
            continue;
        }
        let errors = [
            relative(found.max_depth_mm, exact.max_depth_mm),
            relative(found.scar_half_width_mm, exact.scar_half_width_mm),
            relative(found.worn_area_mm2, exact.worn_area_mm2),
            peak,
        ];
        let pairs = errors.iter().zip(estimates);
        let figures: Vec<String> = pairs
            .map(|(error, estimate)| format!(" {:>+7.2} {:>5.2}", 100.0 * error, 100.0 * estimate))
            .collect();
        println!(
            "{:<52} {:>10}{} {cost:>7.2} {reference_cost:>7.2} {mark}",
            drawn.name(),
            side.name(),
            figures.concat(),
        );
        for (worst, error) in worst.iter_mut().zip(errors) {
            *worst = worst.max(error.abs());
        }
    }
    Ok(Row {
        regime: drawn.regime,
        errors: worst,
        estimates,
        costs: [cost, plain_cost, reference_cost],
        // A finer run has other elements, increments or cycles.
        restarted: found.resolution != plain.resolution,
        outside,
    })
}

fn relative(found: f64, exact: f64) -> f64 {
    found / exact - 1.0
}

/// The estimated errors of depth, width, area and peak pressure; NaN if they are not estimated.
fn estimates(summary: &Summary) -> [f64; 4] {
    let of = |errors: Errors| QUANTITIES.map(|quantity| errors.parts(quantity).relative);
    summary.errors.map_or([f64::NAN; 4], of)
}

fn worn(summary: &Summary) -> Sides<SideReport> {
    Sides {
        slider: summary.last.slider,
        receptacle: summary.last.receptacle,
    }
}

/// The result of a computation with the processor seconds that it took.
fn timed<T>(compute: impl FnOnce() -> T) -> (T, f64) {
    let before = processor_s();
    let result = compute();
    (result, (processor_s() - before).max(1.0 / TICKS))
}

/// Processor seconds of this process: fields 14 and 15 of proc(5), the second one after the name in parentheses.
fn processor_s() -> f64 {
    let stat = std::fs::read_to_string("/proc/self/stat").unwrap_or_default();
    let fields = stat.rsplit(')').next().unwrap_or_default();
    let ticks = fields.split_whitespace().skip(11).take(2);
    let ticks: f64 = ticks.filter_map(|field| field.parse::<f64>().ok()).sum();
    ticks / TICKS
}

fn print_summary(name: &str, rows: &[&Row], tolerance: f64) {
    if rows.is_empty() {
        return;
    }
    println!("\n{name}: {} scenes, per cent", rows.len());
    println!(
        "{:>10} {:>7} {:>7} {:>7} {:>7} {:>17} {:>17} {:>24} {:>16}",
        "",
        "median",
        "90 %",
        "95 %",
        "worst",
        "within asked for",
        "within estimate",
        "estimate/true, median",
        "estimated beyond"
    );
    for (column, title) in COLUMNS.iter().enumerate() {
        let asked = QUANTITIES[column].allowed(tolerance);
        let errors = sorted(rows.iter().map(|row| row.errors[column]));
        let [median, most, nearly_all, worst] =
            [0.5, 0.9, 0.95, 1.0].map(|part| 100.0 * quantile(&errors, part));
        let share = |within: &dyn Fn(&&&Row) -> bool| {
            100.0 * real(rows.iter().filter(within).count()) / real(rows.len())
        };
        let beyond = share(&|row| row.estimates[column] > asked);
        let asked = share(&|row| row.errors[column] <= asked);
        let estimated = share(&|row| row.errors[column] <= row.estimates[column]);
        let ratios = rows
            .iter()
            .map(|row| row.estimates[column] / row.errors[column].max(f64::MIN_POSITIVE));
        println!(
            "{title:>10} {median:>7.2} {most:>7.2} {nearly_all:>7.2} {worst:>7.2} {asked:>17.0} {estimated:>17.0} {:>24.2} {beyond:>16.0}",
            quantile(&sorted(ratios), 0.5)
        );
    }
    let count = |of: &dyn Fn(&&&Row) -> bool| rows.iter().filter(of).count();
    let total = |k: usize| rows.iter().map(|row| row.costs[k]).sum::<f64>();
    println!(
        "{} restarted, {} ended outside of their tolerance; time over that without error control: {:.2}",
        count(&|row| row.restarted),
        count(&|row| row.outside),
        total(0) / total(1)
    );
    let ratios = sorted(rows.iter().map(|row| row.costs[2] / row.costs[0]));
    println!(
        "cost of the reference over the run's, median: {:.0}",
        quantile(&ratios, 0.5)
    );
}

fn sorted(values: impl Iterator<Item = f64>) -> Vec<f64> {
    let mut values: Vec<f64> = values.collect();
    values.sort_by(f64::total_cmp);
    values
}

/// The smallest value that a part of them does not exceed.
fn quantile(sorted: &[f64], part: f64) -> f64 {
    let below = sorted.iter().enumerate();
    let mut enough = below.skip_while(|(i, _)| real(i + 1) < part * real(sorted.len()));
    enough.next().map_or(0.0, |(_, value)| *value)
}

fn real(count: usize) -> f64 {
    f64::from(u32::try_from(count).unwrap_or(u32::MAX))
}
