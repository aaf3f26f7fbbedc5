//! The work-precision diagram: errors over processor seconds, both axes logarithmic.

use api::study::{Errors, Study, StudyRun};

use crate::export::pictures::{Axis, COLOURS, Colour, Mark, Panel, Picture, Scale, Series};

/// Labels of the series.
const TOLERANCE: &str = "chosen from a tolerance";
const FRONT: &str = "Pareto front";
const UNCERTAINTY: &str = "uncertainty of the reference";
const BELOW: &str = "error below the uncertainty";

/// Errors of depth and width, and of the peak pressure, over the cost.
pub(crate) fn work_precision(study: &Study) -> Picture {
    let name = study.spec.name.as_deref().unwrap_or_default();
    let uncertainty = &study.reference.uncertainty;
    let mut depth_and_width = panel(
        study,
        "error in worn depth and scar width (%)",
        Errors::tolerance_error,
        uncertainty,
    );
    let front = study.runs.iter().filter(|run| run.on_front);
    let front = front.filter_map(|run| {
        let errors = run.errors?.at_least(uncertainty);
        Some([run.cpu_s, 100.0 * errors.tolerance_error()])
    });
    // Under the tolerances, which are drawn last.
    let front = series(FRONT, Mark::Line, COLOURS[6], front);
    depth_and_width.series.insert(1, front);
    Picture {
        title: format!("What accuracy costs: {name}"),
        panels: vec![
            depth_and_width,
            panel(
                study,
                "error in peak pressure (%)",
                |errors| errors.peak_pressure,
                uncertainty,
            ),
        ],
    }
}

fn panel(study: &Study, title: &str, of: fn(&Errors) -> f64, uncertainty: &Errors) -> Panel {
    let bound = of(uncertainty);
    let point = point(of, bound);
    let at_bound = |cpu_s| [cpu_s, 100.0 * bound];
    let runs = || study.runs.iter();
    let line = cost_range(study).map(at_bound);
    let mut all = vec![series(UNCERTAINTY, Mark::Dashes, COLOURS[6], line)];
    for (index, (label, element)) in elements(study).into_iter().enumerate() {
        let grid = runs().filter(|run| {
            run.tolerance.is_none() && (run.contact_element_mm / element - 1.0).abs() < 1e-6
        });
        let colour = [COLOURS[4], COLOURS[2], COLOURS[5], COLOURS[3]][index % 4];
        all.push(series(
            &label,
            Mark::Circles,
            colour,
            grid.filter_map(&point),
        ));
    }
    let tolerances = runs().filter(|run| run.tolerance.is_some());
    let tolerances = tolerances.filter_map(&point);
    all.push(series(TOLERANCE, Mark::Dots, COLOURS[1], tolerances));
    // Errors below the uncertainty are drawn on its line, as a series of their own.
    let below = runs().filter(|run| run.errors.is_some() && point(run).is_none());
    let below = below.map(|run| at_bound(run.cpu_s));
    all.push(series(BELOW, Mark::Circles, COLOURS[6], below));
    Panel {
        x: Axis::new("processor time (s)", Scale::Logarithmic),
        y: Axis::new(title, Scale::Logarithmic),
        series: all,
    }
}

fn series(
    label: &str,
    mark: Mark,
    colour: Colour,
    points: impl IntoIterator<Item = [f64; 2]>,
) -> Series {
    Series {
        label: label.to_owned(),
        mark,
        colour,
        points: points.into_iter().collect(),
    }
}

/// Returns cost and error of a run that succeeded with an error above the uncertainty.
fn point(of: fn(&Errors) -> f64, uncertainty: f64) -> impl Fn(&StudyRun) -> Option<[f64; 2]> {
    move |run| {
        let error = of(&run.errors?);
        (error >= uncertainty).then_some([run.cpu_s, 100.0 * error])
    }
}

/// Returns the costs of the cheapest and of the most expensive run.
fn cost_range(study: &Study) -> [f64; 2] {
    let cost = |fold: fn(f64, f64) -> f64, from: f64| {
        study.runs.iter().map(|run| run.cpu_s).fold(from, fold)
    };
    [cost(f64::min, f64::INFINITY), cost(f64::max, 0.0)]
}

/// Returns the element sizes of the grid, coarsest first, with their labels.
fn elements(study: &Study) -> Vec<(String, f64)> {
    let fixed = study.runs.iter().filter(|run| run.tolerance.is_none());
    let mut sizes: Vec<f64> = fixed.map(|run| run.contact_element_mm).collect();
    sizes.sort_by(|a, b| b.total_cmp(a));
    sizes.dedup_by(|a, b| (*a / *b - 1.0).abs() < 1e-6);
    let label = |size: f64| format!("grid, elements {:.3} µm", 1e3 * size);
    sizes.into_iter().map(|size| (label(size), size)).collect()
}
