//! Pictures of a run: wear history, profiles, tractions, friction loops.

use api::results::{PressurePosition, SideProfile, SlidePosition, Snapshot};
use solver::record::{Column, Record, Side};

use crate::export::pictures::{
    Axis, AxisRange, COLOURS, Colour, Mark, Panel, Picture, Scale, Series, ramp,
};

/// Most snapshots in one picture; of more, every n-th is drawn, the last one included.
const MOST_SNAPSHOTS: usize = 12;

/// The pictures of a run with their file names. `name` is the name of the specification.
pub fn pictures(
    name: &str,
    record: &Record,
    snapshots: &[Snapshot],
) -> Vec<(&'static str, Picture)> {
    let shown = every_nth(snapshots);
    let mut pictures = Vec::new();
    if record.cycle.len() > 1 {
        pictures.push(("wear-history", wear_history(name, record)));
    }
    if !shown.is_empty() {
        pictures.extend(profiles(name, &shown).map(|picture| ("profiles", picture)));
        pictures.push(("pressure", tractions(name, &shown)));
        pictures.extend(loops(name, &shown).map(|picture| ("loops", picture)));
    }
    pictures
}

fn every_nth(snapshots: &[Snapshot]) -> Vec<&Snapshot> {
    let every = snapshots.len().div_ceil(MOST_SNAPSHOTS).max(1);
    let mut shown: Vec<_> = snapshots.iter().rev().step_by(every).collect();
    shown.reverse();
    shown
}

/// The unit for lengths up to `largest_mm`: its name and the factor from mm.
fn unit(largest_mm: f64) -> (&'static str, f64) {
    match largest_mm {
        small if small < 2e-4 => ("nm", 1e6),
        medium if medium < 0.5 => ("µm", 1e3),
        _ => ("mm", 1.0),
    }
}

fn largest<'a>(values: impl Iterator<Item = &'a f64>) -> f64 {
    values.fold(0.0, |largest: f64, value| largest.max(value.abs()))
}

fn line(label: impl Into<String>, colour: Colour, x: &[f64], y: &[f64]) -> Series {
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

/// Depth over cycles: the stations, and the channels that have a curve, of each side that wears.
fn wear_history(name: &str, record: &Record) -> Picture {
    let drawn = record
        .columns
        .iter()
        .filter(|column| !column.curve.is_empty());
    let drawn: Vec<(&Column, Colour)> = drawn
        .zip(COLOURS.into_iter().cycle())
        .filter(|(column, _)| largest(column.values.iter()) > 0.0)
        .collect();
    let deepest = drawn
        .iter()
        .map(|(column, _)| largest(column.values.iter()));
    let (depth_unit, depth) = unit(deepest.fold(0.0, f64::max));
    let cycles: Vec<f64> = record.cycle.iter().map(|cycle| count(*cycle)).collect();
    let curve = |label: String, colour, column: &Column| {
        line(label, colour, &cycles, &scaled(&column.values, depth))
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
    Picture {
        title: titled("Wear history", name),
        panels: vec![Panel {
            x: Axis::new("cycle", Scale::Linear),
            y: Axis::new(format!("worn depth ({depth_unit})"), Scale::Downward)
                .with_range(AxisRange::DataAndZero),
            series,
        }],
    }
}

/// Worn depth along each side that wears; `None` if neither does.
fn profiles(name: &str, snapshots: &[&Snapshot]) -> Option<Picture> {
    type Side = fn(&Snapshot) -> &SideProfile;
    let sides: [(&str, Side); 2] = [
        ("receptacle", |snapshot| &snapshot.profile.receptacle),
        ("slider", |snapshot| &snapshot.profile.slider),
    ];
    let panels = sides.into_iter().filter_map(|(side, of)| {
        let depths = snapshots.iter().flat_map(|snapshot| &of(snapshot).depth_mm);
        let deepest = largest(depths);
        if deepest <= 0.0 {
            return None;
        }
        let (depth_unit, depth) = unit(deepest);
        let extent = snapshots.iter().fold(0.0_f64, |extent, snapshot| {
            extent.max(scar_extent(of(snapshot)))
        });
        let (place_unit, place) = unit(extent);
        let curve = |(index, snapshot): (usize, &&Snapshot)| {
            let (label, colour) = (cycle_label(snapshot), ramp(index, snapshots.len()));
            let profile = of(snapshot);
            let (x, y) = (
                scaled(&profile.x_mm, place),
                scaled(&profile.depth_mm, depth),
            );
            let mut curve = line(label, colour, &x, &y);
            curve
                .points
                .retain(|point| point[0].abs() <= 1.15 * place * extent);
            curve
        };
        Some(Panel {
            x: Axis::new(
                format!("place along the {side} ({place_unit})"),
                Scale::Linear,
            ),
            y: Axis::new(format!("worn depth ({depth_unit})"), Scale::Downward)
                .with_range(AxisRange::DataAndZero),
            series: snapshots.iter().enumerate().map(curve).collect(),
        })
    });
    let panels: Vec<_> = panels.collect();
    (!panels.is_empty()).then(|| Picture {
        title: titled("Worn profiles", name),
        panels,
    })
}

/// Largest distance of the scar from x = 0, mm, to the first node beyond it.
fn scar_extent(profile: &SideProfile) -> f64 {
    let limit = 1e-3 * largest(profile.depth_mm.iter());
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
fn tractions(name: &str, snapshots: &[&Snapshot]) -> Picture {
    let neutral = |snapshot: &Snapshot| -> Option<PressurePosition> {
        let mut positions = snapshot.pressure.positions.iter();
        positions
            .find(|at| at.phase == SlidePosition::Neutral)
            .cloned()
    };
    let fields: Vec<_> = snapshots
        .iter()
        .enumerate()
        .filter_map(|(index, snapshot)| {
            let colour = ramp(index, snapshots.len());
            Some((cycle_label(snapshot), colour, neutral(snapshot)?))
        })
        .collect();
    let (place_unit, place) = unit(largest(fields.iter().flat_map(|(_, _, at)| &at.x_mm)));
    let panel = |title: &str, of: fn(&PressurePosition) -> &Vec<f64>| Panel {
        x: Axis::new(
            format!("place along the receptacle ({place_unit})"),
            Scale::Linear,
        ),
        y: Axis::new(title, Scale::Linear).with_range(AxisRange::DataAndZero),
        series: fields
            .iter()
            .map(|(label, colour, at)| line(label, *colour, &scaled(&at.x_mm, place), of(at)))
            .collect(),
    };
    let mut panels = vec![panel("pressure (MPa)", |at| &at.pressure_mpa)];
    if largest(fields.iter().flat_map(|(_, _, at)| &at.shear_mpa)) > 0.0 {
        panels.push(panel("shear on the receptacle (MPa)", |at| &at.shear_mpa));
    }
    Picture {
        title: titled("Contact at the neutral position", name),
        panels,
    }
}

/// Friction force over the imposed displacement; `None` before the first cycle.
fn loops(name: &str, snapshots: &[&Snapshot]) -> Option<Picture> {
    let drawn: Vec<_> = snapshots
        .iter()
        .enumerate()
        .filter(|(_, snapshot)| snapshot.friction_loop.displacement_mm.len() > 1)
        .collect();
    let displacements = drawn
        .iter()
        .flat_map(|(_, snapshot)| &snapshot.friction_loop.displacement_mm);
    let (place_unit, place) = unit(largest(displacements));
    let curve = |(index, snapshot): &(usize, &&Snapshot)| {
        let friction_loop = &snapshot.friction_loop;
        let mut curve = line(
            cycle_label(snapshot),
            ramp(*index, snapshots.len()),
            &scaled(&friction_loop.displacement_mm, place),
            &friction_loop.tangential_force_n_per_mm,
        );
        // Closes the loop.
        curve.points.extend(curve.points.first().copied());
        curve
    };
    (!drawn.is_empty()).then(|| Picture {
        title: titled("Friction loops", name),
        panels: vec![Panel {
            x: Axis::new(
                format!("imposed displacement ({place_unit})"),
                Scale::Linear,
            ),
            y: Axis::new("friction force (N per mm of depth)", Scale::Linear),
            series: drawn.iter().map(curve).collect(),
        }],
    })
}

fn titled(what: &str, name: &str) -> String {
    if name.is_empty() {
        what.to_owned()
    } else {
        format!("{what}: {name}")
    }
}

fn cycle_label(snapshot: &Snapshot) -> String {
    format!("cycle {}", snapshot.profile.cycle)
}

fn trimmed(value: f64) -> String {
    let text = format!("{value:.3}");
    text.trim_end_matches('0').trim_end_matches('.').to_owned()
}

#[expect(clippy::cast_precision_loss, reason = "cycles stay below 1e9")]
fn count(cycles: u64) -> f64 {
    cycles as f64
}

#[cfg(test)]
mod tests;
