//! The largest difference of two runs' outputs.

use solver::record::Summary;

/// Tolerance of pressures and of the contact's width over that of depth, width and area, as in error control.
const PRESSURE: f64 = 3.0;

/// The largest relative difference of an output over what the tolerance allows it, and its name: depths of both sides over
/// the deepest, areas over their sum.
pub(super) fn largest(run: &Summary, reference: &Summary) -> (f64, &'static str) {
    let (a, b) = (&run.last, &reference.last);
    let sides = |of: fn(&Summary) -> [f64; 2]| (of(run), of(reference));
    let (depth, depth_reference) =
        sides(|s| [s.last.slider.max_depth_mm, s.last.receptacle.max_depth_mm]);
    let (area, area_reference) =
        sides(|s| [s.last.slider.worn_area_mm2, s.last.receptacle.worn_area_mm2]);
    let (width, width_reference) = sides(|s| {
        [
            s.last.slider.scar_half_width_mm,
            s.last.receptacle.scar_half_width_mm,
        ]
    });
    // A width is read between nodes.
    let half_element = 0.5 * reference.resolution.contact_element_mm;
    let between_nodes = |difference: f64| (difference.abs() - half_element).max(0.0);
    let deepest = depth_reference[0].max(depth_reference[1]);
    let widest = width_reference[0].max(width_reference[1]);
    let whole = area_reference[0] + area_reference[1];
    [
        ("depth", over(apart(depth, depth_reference), deepest)),
        // The width of the wider scar: that of a scar without depth says nothing.
        (
            "width",
            over(between_nodes(width[0].max(width[1]) - widest), widest),
        ),
        ("area", over(apart(area, area_reference), whole)),
        (
            "peak pressure",
            relative(a.peak_pressure_mpa, b.peak_pressure_mpa) / PRESSURE,
        ),
        (
            "half-width",
            relative(a.contact_half_width_mm, b.contact_half_width_mm) / PRESSURE,
        ),
        (
            "unworn peak pressure",
            relative(
                run.initial.peak_pressure_mpa,
                reference.initial.peak_pressure_mpa,
            ) / PRESSURE,
        ),
        (
            "energy",
            relative(a.dissipated_energy_mj_per_mm, b.dissipated_energy_mj_per_mm),
        ),
    ]
    .into_iter()
    .fold((0.0, "none"), |most, (name, difference)| {
        if difference > most.0 {
            (difference, name)
        } else {
            most
        }
    })
}

/// The larger difference of either side.
fn apart(values: [f64; 2], reference: [f64; 2]) -> f64 {
    let apart = values.iter().zip(reference).map(|(a, b)| (a - b).abs());
    apart.fold(0.0, f64::max)
}

/// A difference over a scale; none of nothing is none.
fn over(difference: f64, scale: f64) -> f64 {
    assert!(difference.is_finite(), "an output is not finite");
    if difference > 0.0 {
        difference / scale
    } else {
        0.0
    }
}

fn relative(value: f64, reference: f64) -> f64 {
    over((value - reference).abs(), reference)
}
