//! A study as text, CSV, JSON and as a work-precision diagram.

mod picture;

use api::study::{Errors, Orders, Study};
use comfy_table::{ColumnConstraint, Table};

use crate::export::csv;
use crate::export::documents::{CSV, Document, DocumentError, JSON, SVG};
use crate::export::{markdown, pictures};

/// Column of the sections along a line, hidden where there are none.
const SECTIONS: usize = 6;

/// mm to um.
const UM: f64 = 1e3;

/// Returns the study's files: `study.json`, `study.csv`, `study.svg`.
///
/// # Errors
/// [`DocumentError`] if one cannot be made.
pub fn documents(study: &Study) -> Result<Vec<Document>, DocumentError> {
    let drawing = svg(study)?;
    let document = |name: &str, media_type, bytes| Document {
        name: name.to_owned(),
        cycle: None,
        media_type,
        bytes,
    };
    Ok(vec![
        document("study.json", JSON, serde_json::to_vec_pretty(study)?),
        document("study.csv", CSV, csv::study(study)?),
        document("study.svg", SVG, drawing.into_bytes()),
    ])
}

/// Draws the work-precision diagram as SVG.
///
/// # Errors
/// [`DocumentError`] if it cannot be drawn.
pub fn svg(study: &Study) -> Result<String, DocumentError> {
    Ok(pictures::svg(&picture::work_precision(study))?)
}

/// Returns the study as text: runs, reference, observed orders.
pub fn text(study: &Study) -> String {
    let reference = &study.reference;
    let mut lines = vec![
        study.spec.name.clone().unwrap_or_default(),
        String::new(),
        runs(study).to_string(),
        String::new(),
        format!(
            "* = on the Pareto front: no cheaper run is as accurate in depth and width.\n\
             Reference: {}: depth {:.5} um, half-width {:.5} um, peak pressure {:.2} MPa, worn area {:.5e} mm^2;\n\
             its uncertainty, the size of all corrections: {:.3} % of depth, {:.3} % of width, {:.3} % of peak pressure, {:.4} % of area.",
            reference.method,
            UM * reference.max_depth_mm,
            UM * reference.scar_half_width_mm,
            reference.peak_pressure_mpa,
            reference.worn_area_mm2,
            100.0 * reference.uncertainty.depth,
            100.0 * reference.uncertainty.width,
            100.0 * reference.uncertainty.peak_pressure,
            100.0 * reference.uncertainty.area,
        ),
    ];
    if !reference.orders.is_empty() {
        lines.push(String::new());
        lines.push(
            "Observed orders (- where three levels do not approach a limit from one side):"
                .to_owned(),
        );
        lines.push(orders(&reference.orders).to_string());
    }
    if !study.left_out.is_empty() {
        lines.push(format!(
            "Left out, to stay within the budget: {}.",
            study.left_out.join("; ")
        ));
    }
    lines.join("\n")
}

fn runs(study: &Study) -> Table {
    let uncertainty = &study.reference.uncertainty;
    let header = [
        "",
        "tolerance",
        "element, um",
        "elements",
        "increments",
        "jump",
        "sections",
        "depth, %",
        "width, %",
        "peak p, %",
        "area, %",
        "CPU, s",
        "MiB",
    ];
    let mut table = markdown::table(header, 1);
    for run in &study.runs {
        // An error below the uncertainty of the reference is given as that bound.
        let percent = |of: fn(&Errors) -> f64| {
            let Some(errors) = &run.errors else {
                return "failed".to_owned();
            };
            let (error, bound) = (100.0 * of(errors), 100.0 * of(uncertainty));
            if error < bound {
                format!("< {bound:.3}")
            } else {
                format!("{error:.3}")
            }
        };
        let tolerance = run
            .tolerance
            .map(|tolerance| format!("{} %", 100.0 * tolerance));
        table.add_row([
            if run.on_front { "*" } else { "" }.to_owned(),
            tolerance.unwrap_or_else(|| "fixed".to_owned()),
            format!("{:.3}", UM * run.contact_element_mm),
            run.contact_elements.to_string(),
            run.increments_per_cycle.to_string(),
            format!("{:.1}", run.cycle_jump),
            run.stations
                .map_or_else(String::new, |count| count.to_string()),
            percent(|errors| errors.depth),
            percent(|errors| errors.width),
            percent(|errors| errors.peak_pressure),
            percent(|errors| errors.area),
            format!("{:.2}", run.cpu_s),
            format!("{:.0}", run.peak_memory_mb),
        ]);
    }
    if study.runs.iter().all(|run| run.stations.is_none())
        && let Some(sections) = table.column_mut(SECTIONS)
    {
        sections.set_constraint(ColumnConstraint::Hidden);
    }
    table
}

fn orders(orders: &[Orders]) -> Table {
    let header = ["setting", "levels", "depth", "width", "peak p", "area"];
    let mut table = markdown::table(header, 1);
    for row in orders {
        let order =
            |order: Option<f64>| order.map_or_else(|| "-".to_owned(), |p| format!("{p:.2}"));
        let level = |level: &f64| {
            if *level < 1.0 {
                format!("{level:.3e}")
            } else {
                level.to_string()
            }
        };
        let levels: Vec<String> = row.levels.iter().map(level).collect();
        table.add_row([
            row.setting.clone(),
            levels.join(", "),
            order(row.depth),
            order(row.width),
            order(row.peak_pressure),
            order(row.area),
        ]);
    }
    table
}
