//! Invariants of every run: one list, asserted by every case; contacts of finite width have some of their own (`across`).

pub(in crate::hard) mod across;

use solver::SolveError;
use solver::ale;
use solver::model;
use solver::record::{Checks, CycleReport, SideReport, Snapshot, TractionField};
use solver::schedule::increments::Position;
use solver::sides::Sides;

use super::run::Run;

/// Round-off of a relative residual.
const ROUND_OFF: f64 = 1e-9;
/// Largest accepted zigzag of the pressure, over its peak.
const LARGEST_ZIGZAG: f64 = 0.2;

/// Asserts the invariants.
///
/// # Panics
/// With all faults of the run at once.
pub(crate) fn hold(run: &Run) {
    assert_none(run, &|_, _| true);
}

/// Asserts the invariants of a run whose walls become steeper than the friction angle: from then on the pressure is smooth at
/// the neutral position. At the turning points its leading edge stands in a corner of few elements and alternates there,
/// where without wear nothing would hold the slider.
///
/// # Panics
/// With all faults of the run at once.
pub(crate) fn hold_on_steep_walls(run: &Run, friction: f64) {
    assert_none(run, &|snapshot, field| {
        let is_held = friction * steepest_wall(snapshot) < 1.0;
        is_held || field.position == Position::Neutral
    });
}

/// Steepest slope of the receptacle's worn depth, -.
pub(crate) fn steepest_wall(snapshot: &Snapshot) -> f64 {
    let (x, depth) = (&snapshot.receptacle.x_mm, &snapshot.receptacle.depth_mm);
    let slope = |i: usize| ((depth[i] - depth[i - 1]) / (x[i] - x[i - 1])).abs();
    (1..x.len()).map(slope).fold(0.0, f64::max)
}

/// Which pressures are examined for alternation.
type Examined<'a> = &'a dyn Fn(&Snapshot, &TractionField) -> bool;

fn assert_none(run: &Run, examined: Examined<'_>) {
    if let Err(error) = &run.end {
        panic!("the run failed: {error}");
    }
    let faults = faults_of(run, examined);
    assert!(faults.is_empty(), "{}", faults.join("\n"));
}

/// All faults of a run, as sentences; empty if the invariants hold. A failed run satisfies them if its error contains
/// numbers and its earlier reports satisfy them.
pub(crate) fn faults(run: &Run) -> Vec<String> {
    faults_of(run, &|_, _| true)
}

/// All faults of a run, with alternating pressures where they are examined.
fn faults_of(run: &Run, examined: Examined<'_>) -> Vec<String> {
    let mut faults = Vec::new();
    faults.extend(run.reports.iter().find_map(not_finite));
    faults.extend(run.snapshots.iter().find_map(unsound_tractions));
    faults.extend(run.reports.windows(2).find_map(taken_back));
    if resolved(run) {
        let unworn = run
            .reports
            .first()
            .map_or(0.0, |report| report.peak_pressure_mpa);
        faults.extend(
            run.snapshots
                .iter()
                .find_map(|snapshot| zigzags(snapshot, unworn, examined)),
        );
    }
    faults.extend(inverted_elements(run));
    match &run.end {
        Ok(summary) => faults.extend(large_residual(&summary.checks)),
        Err(error) => faults.extend(reason_without_numbers(error)),
    }
    faults
}

/// An error without numbers, or with some that are none.
fn reason_without_numbers(error: &SolveError) -> Option<String> {
    let message = error.to_string();
    let has_numbers = message.contains(|c: char| c.is_ascii_digit());
    let sound = has_numbers && !message.contains("NaN") && !message.contains("inf");
    (!sound).then(|| format!("the reason has no numbers: {message}"))
}

fn not_finite(report: &CycleReport) -> Option<String> {
    let other = [
        report.sliding_distance_mm,
        report.load_n_per_mm,
        report.peak_pressure_mpa,
        report.contact_half_width_mm,
    ];
    let sound = |value: f64| value.is_finite() && value >= 0.0;
    let all = wear(report)
        .into_iter()
        .chain(other)
        .chain([&report.receptacle, &report.slider].map(|side| side.scar_half_width_mm));
    (!all.into_iter().all(sound)).then(|| format!("not finite, or negative: {report:?}"))
}

fn unsound_tractions(snapshot: &Snapshot) -> Option<String> {
    let unsound = |field: &&TractionField| {
        let peak = field.pressure_mpa.iter().fold(0.0, |m: f64, p| m.max(*p));
        let pressed = |p: &f64| p.is_finite() && *p >= -ROUND_OFF * peak;
        !(field.pressure_mpa.iter().all(pressed) && field.shear_mpa.iter().all(|q| q.is_finite()))
    };
    let field = snapshot.positions.iter().find(unsound)?;
    Some(format!(
        "cycle {}: pressures {:?}",
        snapshot.cycle, field.pressure_mpa
    ))
}

/// Quantities that never decrease.
fn wear(report: &CycleReport) -> Vec<f64> {
    let sides = [&report.receptacle, &report.slider];
    let depth = |side: &SideReport| [side.max_depth_mm, side.worn_area_mm2];
    let stations = report.station_depth_mm.iter().copied();
    stations
        .chain(sides.into_iter().flat_map(depth))
        .chain([report.dissipated_energy_mj_per_mm])
        .collect()
}

fn taken_back(pair: &[CycleReport]) -> Option<String> {
    let (early, late) = (&pair[0], &pair[1]);
    let (before, after) = (wear(early), wear(late));
    let mut values = before.iter().zip(&after);
    let less = values.find(|(before, after)| after < before);
    (less.is_some() || late.cycle <= early.cycle).then(|| {
        format!(
            "cycles {} to {}: wear is taken back: {less:?}",
            early.cycle, late.cycle
        )
    })
}

/// Checks whether the engine chose the increments. Prescribed ones may be longer than the contact and leave ripples.
fn resolved(run: &Run) -> bool {
    run.scene.accuracy.increments_per_cycle.is_none()
}

/// Pressures far below that of the unworn contact are compared with this part of it: where a spring has faded, the contact
/// rests on a few nodes, on what rounding and meshes leave of two worn surfaces.
const FADED: f64 = 0.01;

fn zigzags(snapshot: &Snapshot, unworn_mpa: f64, examined: Examined<'_>) -> Option<String> {
    let peaks = snapshot
        .positions
        .iter()
        .flat_map(|field| &field.pressure_mpa);
    let peak = peaks.fold(f64::MIN_POSITIVE, |m, p| m.max(*p));
    let fields = snapshot
        .positions
        .iter()
        .filter(|field| examined(snapshot, field));
    let zigzag = fields.map(zigzag).fold(0.0, f64::max) * (peak / (FADED * unworn_mpa)).min(1.0);
    (zigzag > LARGEST_ZIGZAG).then(|| {
        format!(
            "cycle {}: the pressure alternates by {zigzag:.2} of its peak",
            snapshot.cycle
        )
    })
}

/// The worst zigzag of a snapshot's pressures.
pub(crate) fn worst_zigzag(snapshot: &Snapshot) -> f64 {
    snapshot.positions.iter().map(zigzag).fold(0.0, f64::max)
}

/// Largest alternation of four successive neighbours around the lines through their own neighbours, over the peak pressure.
pub(crate) fn zigzag(field: &TractionField) -> f64 {
    let (x, p) = (&field.x_mm, &field.pressure_mpa);
    let peak = p.iter().fold(f64::MIN_POSITIVE, |m, p| m.max(*p));
    let bend: Vec<f64> = (1..p.len().saturating_sub(1))
        .map(|i| {
            let t = (x[i] - x[i - 1]) / (x[i + 1] - x[i - 1]);
            p[i] - (1.0 - t) * p[i - 1] - t * p[i + 1]
        })
        .collect();
    let alternates = |w: &&[f64]| w.windows(2).all(|w| w[0] * w[1] < 0.0);
    bend.windows(4)
        .filter(alternates)
        .map(|w| w.iter().fold(f64::INFINITY, |m, b| m.min(b.abs())))
        .fold(0.0, f64::max)
        / peak
}

/// Elements of the worn bodies are positive.
fn inverted_elements(run: &Run) -> Option<String> {
    let last = run.snapshots.last()?;
    let model =
        model::build(&run.scene, &solver::effects::plan(&run.scene)).expect("it was built before");
    let depth = Sides {
        slider: last.slider.depth_mm.clone(),
        receptacle: last.receptacle.depth_mm.clone(),
    };
    let worn = ale::relocate(&model, &depth);
    worn.err()
        .map(|error| format!("cycle {}: {error}", last.cycle))
}

fn large_residual(checks: &Checks) -> Option<String> {
    let residuals = [
        ("force balance", checks.force_balance),
        ("complementarity", checks.complementarity),
        ("friction cone", checks.friction_cone),
        ("friction use beyond 1", checks.friction_use - 1.0),
        ("worn area", checks.worn_area),
    ];
    let large = |residual: f64| residual.is_nan() || residual > ROUND_OFF;
    let (name, residual) = residuals
        .into_iter()
        .find(|(_, residual)| large(*residual))?;
    Some(format!("{name}: residual {residual:.1e}"))
}
