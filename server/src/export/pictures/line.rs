//! Pictures of a contact along a line: line load and deepest worn depth of its sections at stored cycles.

use solver::along_line::Along;
use solver::record::{LineColumns, Record, Side};

use crate::export::pictures::{Axis, AxisRange, Colour, Mark, Panel, Scale, Series};

/// A cycle to be drawn, with the label and the colour of its curves.
pub(super) struct Drawn<'a> {
    pub(super) cycle: u64,
    pub(super) label: &'a str,
    pub(super) colour: Colour,
}

/// The panels; none of a contact that is not along a line.
pub(super) fn panels(record: &Record, drawn: &[Drawn<'_>]) -> Vec<Panel> {
    let Some(first) = record.line.first() else {
        return Vec::new();
    };
    let place = match first.at {
        Along::AngleDeg(_) => "angle from the direction of motion (deg)",
        Along::DistanceMm(_) => "distance from the middle (mm)",
    };
    let panel = |y: Axis, of: &dyn Fn(&LineColumns) -> (&[f64], f64)| Panel {
        x: Axis::new(place, Scale::Linear),
        y,
        series: drawn
            .iter()
            .filter_map(|drawn| curve(record, drawn, of))
            .collect(),
    };
    let load = Axis::new("line load (N/mm)", Scale::Linear).with_range(AxisRange::DataAndZero);
    let mut panels = vec![panel(load, &|station| (&station.line_load_n_per_mm, 1.0))];
    for side in [Side::Receptacle, Side::Slider] {
        let mut depths = record
            .line
            .iter()
            .flat_map(|station| station.max_depth_mm.of(side));
        if depths.any(|depth| *depth > 0.0) {
            let title = format!("deepest wear of the {} (µm)", side.name());
            let depth = Axis::new(title, Scale::Downward).with_range(AxisRange::DataAndZero);
            panels.push(panel(depth, &|station| {
                (station.max_depth_mm.of(side), 1e3)
            }));
        }
    }
    panels
}

/// A quantity along the line at a cycle, in the unit of its axis.
fn curve(
    record: &Record,
    drawn: &Drawn<'_>,
    of: &dyn Fn(&LineColumns) -> (&[f64], f64),
) -> Option<Series> {
    let row = record
        .cycle
        .iter()
        .position(|cycle| *cycle == drawn.cycle)?;
    let points = record.line.iter().map(|station| {
        let place = match station.at {
            Along::AngleDeg(place) | Along::DistanceMm(place) => place,
        };
        let (values, factor) = of(station);
        [place, factor * values[row]]
    });
    Some(Series {
        label: drawn.label.to_owned(),
        mark: Mark::Line,
        colour: drawn.colour,
        points: points.collect(),
    })
}

#[cfg(test)]
mod tests {
    use solver::sides::Sides;

    use super::*;

    #[test]
    fn sections_are_drawn_at_stored_cycles_with_the_sides_that_wear() {
        let station = |theta: f64| LineColumns {
            at: Along::AngleDeg(theta),
            line_load_n_per_mm: vec![1.0, 2.0],
            max_depth_mm: Sides {
                slider: vec![0.0, 0.0],
                receptacle: vec![0.0, 1e-3 * theta],
            },
        };
        let record = Record {
            cycle: vec![0, 9],
            line: vec![station(0.0), station(90.0)],
            ..Record::default()
        };
        let drawn = [5, 9].map(|cycle| Drawn {
            cycle,
            label: "a cycle",
            colour: crate::export::pictures::COLOURS[0],
        });
        let panels = panels(&record, &drawn);
        assert_eq!(panels.len(), 2);
        let [load, depth] = [&panels[0], &panels[1]].map(|panel| &panel.series);
        assert_eq!((load.len(), depth.len()), (1, 1));
        assert_eq!(load[0].points, [[0.0, 2.0], [90.0, 2.0]]);
        assert_eq!(depth[0].points, [[0.0, 0.0], [90.0, 90.0]]);
        assert!(super::panels(&Record::default(), &drawn).is_empty());
    }
}
