//! Pictures of a run: wear history, profiles, tractions, friction loops.

use api::results::{PressurePosition, SideProfile, SlidePosition, Snapshot};
use solver::record::{Column, Record, Side};

use crate::export::pictures::line::{self, Drawn};
use crate::export::pictures::{
    Axis, AxisRange, COLOURS, Colour, Mark, Panel, Picture, Scale, Series, ramp,
};
use crate::number::real;

/// Most snapshots in one picture; of more, every n-th is drawn, the last one included.
const MOST_SNAPSHOTS: usize = 12;

/// A snapshot with the label and the colour of its curves.
struct Shown<'a> {
    label: String,
    colour: Colour,
    snapshot: &'a Snapshot,
}

/// The pictures of a run with their file names. `name` is the name of the specification.
pub fn pictures(
    name: &str,
    record: &Record,
    snapshots: &[Snapshot],
) -> Vec<(&'static str, Picture)> {
    let shown = every_nth(snapshots);
    let pictures = [
        ("wear-history", "Wear history", wear_history(record)),
        ("profiles", "Worn profiles", profiles(&shown)),
        (
            "pressure",
            "Contact at the neutral position",
            tractions(&shown),
        ),
        ("loops", "Friction loops", loops(&shown)),
        (
            "sections",
            "Sections along the line",
            sections(record, &shown),
        ),
    ];
    let drawn = pictures
        .into_iter()
        .filter(|(_, _, panels)| !panels.is_empty());
    let titled = |(file, what, panels)| {
        let title = titled(what, name);
        (file, Picture { title, panels })
    };
    drawn.map(titled).collect()
}

fn every_nth(snapshots: &[Snapshot]) -> Vec<Shown<'_>> {
    let every = snapshots.len().div_ceil(MOST_SNAPSHOTS).max(1);
    let shown = snapshots.iter().rev().step_by(every);
    let count = shown.len();
    let shown = shown.rev().enumerate().map(|(index, snapshot)| Shown {
        label: format!("cycle {}", snapshot.profile.cycle),
        colour: ramp(index, count),
        snapshot,
    });
    shown.collect()
}

/// The unit for lengths up to `largest_mm`: its name and the factor from mm.
pub(super) fn unit(largest_mm: f64) -> (&'static str, f64) {
    match largest_mm {
        small if small < 2e-4 => ("nm", 1e6),
        medium if medium < 0.5 => ("µm", 1e3),
        _ => ("mm", 1.0),
    }
}

pub(super) fn largest<'a>(values: impl IntoIterator<Item = &'a f64>) -> f64 {
    let sizes = values.into_iter().map(|value| value.abs());
    sizes.fold(0.0, f64::max)
}

fn curve_of(label: impl Into<String>, colour: Colour, x: &[f64], y: &[f64]) -> Series {
    Series {
        label: label.into(),
        mark: Mark::Line,
        colour,
        points: x.iter().zip(y).map(|(x, y)| [*x, *y]).collect(),
    }
}

fn scaled(values: &[f64], factor: f64) -> Vec<f64> {
    values.iter().map(|value| factor * value).collect()
}

fn place_axis(what: &str, unit: &str) -> Axis {
    Axis::new(format!("{what} ({unit})"), Scale::Linear)
}

fn depth_axis(unit: &str) -> Axis {
    let axis = Axis::new(format!("worn depth ({unit})"), Scale::Downward);
    axis.with_range(AxisRange::DataAndZero)
}

/// Line load and deepest wear along the line; nothing of another contact.
fn sections(record: &Record, shown: &[Shown<'_>]) -> Vec<Panel> {
    let drawn: Vec<Drawn<'_>> = shown
        .iter()
        .map(|shown| Drawn {
            cycle: shown.snapshot.profile.cycle,
            label: &shown.label,
            colour: shown.colour,
        })
        .collect();
    line::panels(record, &drawn)
}

/// Depth over cycles: the stations, and the channels that have a curve, of each side that wears.
fn wear_history(record: &Record) -> Vec<Panel> {
    if record.cycle.len() < 2 {
        return Vec::new();
    }
    let columns = record.columns.iter();
    let named = columns.filter(|column| !column.curve.is_empty());
    let drawn: Vec<(&Column, Colour)> = named
        .zip(COLOURS.into_iter().cycle())
        .filter(|(column, _)| largest(&column.values) > 0.0)
        .collect();
    let depths = drawn.iter().flat_map(|(column, _)| &column.values);
    let (depth_unit, depth) = unit(largest(depths));
    let cycles: Vec<f64> = record.cycle.iter().map(|cycle| real(*cycle)).collect();
    let curve = |label: String, colour, column: &Column| {
        curve_of(label, colour, &cycles, &scaled(&column.values, depth))
    };
    let stations: Vec<_> = record
        .columns
        .iter()
        .filter_map(|column| Some((column, column.place_mm?)))
        .collect();
    let mut series = Vec::new();
    for (index, (column, x_mm)) in stations.iter().enumerate() {
        let (place_unit, place) = unit(x_mm.abs().max(1e-3));
        let label = format!("x = {} {place_unit}", trimmed(place * x_mm));
        series.push(Series {
            mark: Mark::Dashes,
            ..curve(label, ramp(index, stations.len()), column)
        });
    }
    for (column, colour) in drawn {
        let side = column.side.map_or("contact", Side::name);
        series.push(curve(format!("{side}, {}", column.curve), colour, column));
    }
    vec![Panel {
        x: Axis::new("cycle", Scale::Linear),
        y: depth_axis(depth_unit),
        series,
    }]
}

/// Worn depth along each side that wears.
fn profiles(shown: &[Shown<'_>]) -> Vec<Panel> {
    let panels = [
        profile_panel("receptacle", shown, |snapshot| &snapshot.profile.receptacle),
        profile_panel("slider", shown, |snapshot| &snapshot.profile.slider),
    ];
    panels.into_iter().flatten().collect()
}

/// Worn depth along a side, around its scar; `None` if it does not wear.
fn profile_panel(
    side: &str,
    shown: &[Shown<'_>],
    of: fn(&Snapshot) -> &SideProfile,
) -> Option<Panel> {
    let profiles = || shown.iter().map(|shown| of(shown.snapshot));
    let deepest = largest(profiles().flat_map(|profile| &profile.depth_mm));
    if deepest <= 0.0 {
        return None;
    }
    let (depth_unit, depth) = unit(deepest);
    let extent = profiles().map(scar_extent).fold(0.0, f64::max);
    let (place_unit, place) = unit(extent);
    let curve = |shown: &Shown<'_>| {
        let profile = of(shown.snapshot);
        let (x, y) = (
            scaled(&profile.x_mm, place),
            scaled(&profile.depth_mm, depth),
        );
        let mut curve = curve_of(&*shown.label, shown.colour, &x, &y);
        let shown_extent = 1.15 * place * extent;
        curve.points.retain(|point| point[0].abs() <= shown_extent);
        curve
    };
    Some(Panel {
        x: place_axis(&format!("place along the {side}"), place_unit),
        y: depth_axis(depth_unit),
        series: shown.iter().map(curve).collect(),
    })
}

/// Largest distance of the scar from x = 0, mm, to the first node beyond it.
fn scar_extent(profile: &SideProfile) -> f64 {
    let limit = 1e-3 * largest(&profile.depth_mm);
    let worn = |depth: &f64| *depth > limit;
    let first = profile.depth_mm.iter().position(worn);
    let last = profile.depth_mm.iter().rposition(worn);
    let (Some(first), Some(last)) = (first, last) else {
        return 0.0;
    };
    let scar = profile
        .x_mm
        .iter()
        .take(last + 2)
        .skip(first.saturating_sub(1));
    largest(scar)
}

/// Pressure and shear at the neutral position.
fn tractions(shown: &[Shown<'_>]) -> Vec<Panel> {
    let neutral = |shown| {
        let Shown {
            label,
            colour,
            snapshot,
        }: &Shown<'_> = shown;
        let mut positions = snapshot.pressure.positions.iter();
        let at = positions.find(|at| at.phase == SlidePosition::Neutral)?;
        Some((label, *colour, at))
    };
    let fields: Vec<_> = shown.iter().filter_map(neutral).collect();
    let (place_unit, place) = unit(largest(fields.iter().flat_map(|(.., at)| &at.x_mm)));
    let panel = |title: &str, of: fn(&PressurePosition) -> &Vec<f64>| Panel {
        x: place_axis("place along the receptacle", place_unit),
        y: Axis::new(title, Scale::Linear).with_range(AxisRange::DataAndZero),
        series: fields
            .iter()
            .map(|(label, colour, at)| curve_of(*label, *colour, &scaled(&at.x_mm, place), of(at)))
            .collect(),
    };
    let mut panels = Vec::new();
    if !shown.is_empty() {
        panels.push(panel("pressure (MPa)", |at| &at.pressure_mpa));
    }
    if largest(fields.iter().flat_map(|(.., at)| &at.shear_mpa)) > 0.0 {
        panels.push(panel("shear on the receptacle (MPa)", |at| &at.shear_mpa));
    }
    panels
}

/// Friction force over the imposed displacement, from the first cycle.
fn loops(shown: &[Shown<'_>]) -> Vec<Panel> {
    let closed = |shown: &&Shown<'_>| shown.snapshot.friction_loop.displacement_mm.len() > 1;
    let drawn: Vec<_> = shown.iter().filter(closed).collect();
    if drawn.is_empty() {
        return Vec::new();
    }
    let displacements = drawn
        .iter()
        .flat_map(|shown| &shown.snapshot.friction_loop.displacement_mm);
    let (place_unit, place) = unit(largest(displacements));
    let curve = |shown: &&Shown<'_>| {
        let friction_loop = &shown.snapshot.friction_loop;
        let x = scaled(&friction_loop.displacement_mm, place);
        let force = &friction_loop.tangential_force_n_per_mm;
        let mut curve = curve_of(&*shown.label, shown.colour, &x, force);
        // Closes the loop.
        curve.points.extend(curve.points.first().copied());
        curve
    };
    vec![Panel {
        x: place_axis("imposed displacement", place_unit),
        y: Axis::new("friction force (N per mm of depth)", Scale::Linear),
        series: drawn.iter().map(curve).collect(),
    }]
}

fn titled(what: &str, name: &str) -> String {
    if name.is_empty() {
        what.to_owned()
    } else {
        format!("{what}: {name}")
    }
}

fn trimmed(value: f64) -> String {
    let text = format!("{value:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[cfg(test)]
mod tests;
