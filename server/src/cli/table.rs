//! Report of the demonstration: worn depth by cycle and station, compared with the analytical values.

use api::job::Job;
use api::results::{Station, WearHistory};
use comfy_table::Table;

use crate::export::markdown;
use crate::number::real;

/// mm to um and to nm.
const UM: f64 = 1e3;
const NM: f64 = 1e6;

/// Returns a wear history and its checks as lines of text.
pub(super) fn report(job: &Job, history: &WearHistory) -> Vec<String> {
    let rows = snapshot_rows(job, history);
    let mut lines = vec![
        String::new(),
        job.spec.name.clone().unwrap_or_default(),
        "Worn depth of the receptacle, um, by cycle and position x:".to_owned(),
        depths(history, &rows).to_string(),
    ];
    lines.extend(growth(job, history, &rows));
    lines.extend(area(job));
    lines
}

/// Returns the rows nearest to the cycles of the snapshots.
fn snapshot_rows(job: &Job, history: &WearHistory) -> Vec<usize> {
    let cycles = job.spec.output.snapshots_at_cycles.as_deref();
    let nearest = |cycle: &u64| {
        let distance = |index: &usize| history.cycle[*index].abs_diff(*cycle);
        (0..history.cycle.len()).min_by_key(distance)
    };
    let cycles = cycles.unwrap_or_default().iter();
    let mut rows: Vec<_> = cycles.filter_map(nearest).collect();
    rows.sort_unstable();
    rows.dedup();
    rows
}

fn depths(history: &WearHistory, rows: &[usize]) -> Table {
    let stations = history.stations.iter();
    let mut header = vec!["cycle".to_owned()];
    header.extend(
        stations
            .clone()
            .map(|station| format!("{} mm", station.x_mm)),
    );
    header.extend(["deepest".to_owned(), "middle, nm a cycle".to_owned()]);
    let mut table = markdown::table(header, 0);
    let deepest = history.receptacle.columns.get("max_depth_mm");
    for (index, &row) in rows.iter().enumerate() {
        let mut cells = vec![history.cycle[row].to_string()];
        let depths = stations.clone().map(|station| UM * station.depth_mm[row]);
        cells.extend(depths.map(|depth| format!("{depth:.3}")));
        cells.push(deepest.map_or_else(String::new, |depth| format!("{:.3}", UM * depth[row])));
        // The first row of a history is the unworn state.
        let before = index.checked_sub(1).map_or(0, |index| rows[index]);
        cells.push(slope(history, before, row).map_or_else(String::new, |nm| format!("{nm:.3}")));
        table.add_row(cells);
    }
    table
}

/// Returns the station nearest to the middle of the block.
fn middle(history: &WearHistory) -> Option<&Station> {
    history
        .stations
        .iter()
        .min_by(|a, b| a.x_mm.abs().total_cmp(&b.x_mm.abs()))
}

/// Returns the growth of the worn depth in the middle between two rows, nm per cycle.
fn slope(history: &WearHistory, from: usize, to: usize) -> Option<f64> {
    let cycles = history.cycle[to]
        .checked_sub(history.cycle[from])
        .filter(|cycles| *cycles > 0)?;
    let depth = &middle(history)?.depth_mm;
    Some(NM * (depth[to] - depth[from]) / real(cycles))
}

/// Compares the growth between the first two rows shown with theory: each cycle the contact passes the middle twice,
/// and each pass wears (k/H) P' as long as the floor of the scar is flat. Over a concave floor the contact moves faster
/// than the slider and wears less; worn area is conserved, so once the whole block wears, its depth grows by worn area
/// over length.
fn growth(job: &Job, history: &WearHistory, rows: &[usize]) -> Option<String> {
    let plan = job.plan.as_ref()?;
    let expected = 2.0 * NM * plan.estimates.get("receptacle_full_pass_depth_mm")?;
    let mut worn = rows.iter().copied().filter(|row| history.cycle[*row] > 0);
    let (first, second) = (worn.next()?, worn.next()?);
    let found = slope(history, first, second)?;
    Some(format!(
        "On the flat floor, cycle {} to {}: {found:.3} nm a cycle in the middle; 2 (k/H) P' = {expected:.3} nm ({:+.2} %).\n\
         Later the whole block wears, and its depth grows by worn area over length (docs/theory/thesis.md).",
        history.cycle[first],
        history.cycle[second],
        100.0 * (found / expected - 1.0)
    ))
}

/// Compares the worn area with its ideal value, and lists accuracy and cost.
fn area(job: &Job) -> Option<String> {
    let summary = job.summary.as_ref()?;
    let cost = &summary.cost;
    let ratio = summary
        .receptacle
        .ideal_area_mm2
        .filter(|ideal| *ideal > 0.0)
        .map_or_else(String::new, |ideal| {
            format!(
                " ({:.4} of k P' s / H)",
                summary.receptacle.worn_area_mm2 / ideal
            )
        });
    Some(format!(
        "Worn area {:.6e} mm^2{ratio}; it equals (k/H) times the integral of p |slip| within {:.1e}.\n\
         {} contact elements, {} increments a cycle, {} computed cycles; {:.2} s, {:.2} s of CPU, {:.0} MB.",
        summary.receptacle.worn_area_mm2,
        summary.checks.worn_area,
        summary.accuracy.contact_elements,
        summary.accuracy.increments_per_cycle,
        summary.accuracy.computed_cycles,
        cost.wall_s,
        cost.cpu_s,
        cost.peak_memory_mb
    ))
}
