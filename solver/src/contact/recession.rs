//! What wear takes from both surfaces, and how far that opens the gap.

use super::mortar::Coupling;
use super::newton::Problem;

/// Gap opened at each coupled node by wear of a path p |sigma| there, on both sides, mm.
pub(super) fn opened_by_wear(
    problem: &Problem<'_>,
    path: &[f64],
    recession: &mut Vec<f64>,
    opened: &mut Vec<f64>,
) {
    let [receptacle, slider] = problem.kappa;
    opened.clear();
    opened.extend(path.iter().map(|e| receptacle * e));
    if slider <= 0.0 {
        return;
    }
    let coupling = problem.coupling;
    slider_recession(coupling, problem.slider_width, slider, path, recession);
    for (i, opened) in opened.iter_mut().enumerate() {
        let (from, weights) = coupling.dual_row(coupling.first + i);
        let recession = &recession[from - coupling.slider_range.0..];
        *opened += weights
            .iter()
            .zip(recession)
            .map(|(m, r)| m * r)
            .sum::<f64>();
    }
}

/// Vertical recession of the slider's nodes in the coupled range for p |sigma| at the coupled nodes, mm.
pub(super) fn slider_recession(
    coupling: &Coupling,
    slider_width: &[f64],
    kappa: f64,
    path: &[f64],
    recession: &mut Vec<f64>,
) {
    let (begin, end) = coupling.slider_range;
    recession.clear();
    recession.resize(end - begin, 0.0);
    for (l, e) in path.iter().enumerate().filter(|(_, e)| **e != 0.0) {
        let (from, weights) = coupling.standard_row(coupling.first + l);
        for (offset, weight) in weights.iter().enumerate() {
            recession[from + offset - begin] += weight * e;
        }
    }
    for (r, width) in recession.iter_mut().zip(&slider_width[begin..end]) {
        *r *= kappa / width;
    }
}
