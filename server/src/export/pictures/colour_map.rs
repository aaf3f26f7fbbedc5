//! Quantities over an area, in steps of colour from 0 to the largest value, with a scale beside each. Where there is nothing, nothing is drawn.

use plotters::chart::ChartBuilder;
use plotters::prelude::{PathElement, Rectangle, Text};
use plotters::style::Color;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::export::pictures::canvas::{
    AXIS, Area, INK, LABEL, LEGEND_WIDTH, MARGIN, THIN_STROKE, TICK, TITLE_HEIGHT, UNIT, X_TITLE,
    Y_TITLE, drawing, font, px, rgb, titled,
};
use crate::export::pictures::ticks::{self, Ticks};
use crate::export::pictures::{Axis, AxisRange, PlotError, Scale, ramp};
use crate::number::real;

/// Size of a panel with its axis titles.
const PANEL: (u32, u32) = (620 * UNIT, 300 * UNIT);
/// Steps of colour.
const STEPS: usize = 16;
/// Part of the largest value from which on a place is coloured: linear between places, a map is above 0 up to the next place beyond its edge.
const LEAST: f64 = 0.02;
/// Places of the picture along both axes, between which the quantity is linear.
const PLACES: (usize, usize) = (210, 80);
/// Width of the scale, and its distance from the top.
const BAR: (i32, i32) = (px(20), px(40));

/// A picture of quantities over an area.
#[derive(Debug, Clone, PartialEq)]
pub struct ColourMap {
    /// Title.
    pub title: String,
    /// Panels from top to bottom.
    pub panels: Vec<MapPanel>,
}

/// A quantity over an area.
#[derive(Debug, Clone, PartialEq)]
pub struct MapPanel {
    /// Name and unit.
    pub quantity: String,
    /// Title of the horizontal axis.
    pub x: String,
    /// Title of the vertical axis.
    pub y: String,
    /// Ascending places along the horizontal axis.
    pub at_x: Vec<f64>,
    /// Ascending places along the vertical axis.
    pub at_y: Vec<f64>,
    /// A row for each y, with one value for each x.
    pub rows: Vec<Vec<f64>>,
}

/// Draws a picture.
///
/// # Errors
/// [`PlotError`] if the drawing fails.
pub fn svg(picture: &ColourMap) -> Result<String, PlotError> {
    let panels = u32::try_from(picture.panels.len()).unwrap_or(1);
    let size = (PANEL.0 + LEGEND_WIDTH, TITLE_HEIGHT + panels * PANEL.1);
    drawing(size, |root| {
        let body = titled(&picture.title, root)?;
        let areas = body.split_evenly((picture.panels.len(), 1));
        for (panel, area) in picture.panels.iter().zip(&areas) {
            let (map, side) = area.split_horizontally(PANEL.0);
            draw(panel, &map)?;
            scale(panel, &side)?;
        }
        Ok(())
    })
}

fn draw(panel: &MapPanel, area: &Area<'_>) -> Result<(), PlotError> {
    let axis = |places: &[f64]| {
        let ends = places.first().zip(places.last());
        let (from, to) = ends.map_or((0.0, 1.0), |(from, to)| (*from, *to));
        Axis::new("", Scale::Linear).with_range(AxisRange::Fixed(from, to))
    };
    let (x, y) = (axis(&panel.at_x), axis(&panel.at_y));
    let [x, y] = [x, y].map(|axis| ticks::ticks(&axis, std::iter::empty()));
    let mut chart = ChartBuilder::on(area)
        .margin(MARGIN)
        .x_label_area_size(X_TITLE)
        .y_label_area_size(Y_TITLE)
        .build_cartesian_2d(x.clone(), y.clone())?;
    for step in steps(panel, &x, &y) {
        let colour = rgb(ramp(step.colour, STEPS)).filled();
        chart.draw_series([Rectangle::new(step.corners, colour)])?;
    }
    chart
        .configure_mesh()
        .disable_mesh()
        .x_desc(panel.x.clone())
        .y_desc(panel.y.clone())
        .axis_desc_style(font(AXIS))
        .label_style(font(LABEL))
        .x_label_formatter(&|at| ticks::label(Scale::Linear, &x, *at))
        .y_label_formatter(&|at| ticks::label(Scale::Linear, &y, *at))
        .axis_style(INK.stroke_width(THIN_STROKE))
        .set_all_tick_mark_size(TICK)
        .draw()?;
    Ok(())
}

/// Neighbouring places of one step of colour.
struct Step {
    colour: usize,
    corners: [(f64, f64); 2],
}

/// The area in rows of places, of which neighbours of the same colour are one rectangle. Each reaches to the far ends of the next places, which cover
/// that again: no background shows between them.
fn steps(panel: &MapPanel, x: &Ticks, y: &Ticks) -> Vec<Step> {
    let largest = panel.largest();
    let (width, height) = (x.to - x.from, y.to - y.from);
    let column = |index: usize| x.from + width * real(index) / real(PLACES.0);
    let row = |index: usize| y.from + height * real(index) / real(PLACES.1);
    let mut steps: Vec<Step> = Vec::new();
    for j in 0..PLACES.1 {
        let middle = 0.5 * (row(j) + row(j + 1));
        let across = Between::of(&panel.at_y, middle);
        let colours: Vec<Option<usize>> = (0..PLACES.0)
            .map(|i| {
                let along = Between::of(&panel.at_x, 0.5 * (column(i) + column(i + 1)));
                let value = across.value(|j| along.value(|i| panel.rows[j][i]));
                step_of(value, largest)
            })
            .collect();
        let mut begin = 0;
        for i in 1..=PLACES.0 {
            if i < PLACES.0 && colours[i] == colours[begin] {
                continue;
            }
            if let Some(colour) = colours[begin] {
                let is_last = i == PLACES.0 || colours[i].is_none();
                let right = if is_last { i } else { i + 1 };
                let top = if j + 1 == PLACES.1 { j + 1 } else { j + 2 };
                steps.push(Step {
                    colour,
                    corners: [(column(begin), row(j)), (column(right), row(top))],
                });
            }
            begin = i;
        }
    }
    steps
}

/// The step of a value; none of one that is next to nothing.
fn step_of(value: f64, largest: f64) -> Option<usize> {
    if value <= LEAST * largest {
        return None;
    }
    let limits = (1..STEPS).map(|step| largest * real(step) / real(STEPS));
    Some(limits.take_while(|limit| value > *limit).count())
}

/// A place between two others of a line.
struct Between {
    left: usize,
    right: usize,
    share: f64,
}

impl Between {
    fn of(places: &[f64], at: f64) -> Self {
        let last = places.len().saturating_sub(1);
        let right = places
            .partition_point(|place| *place < at)
            .clamp(last.min(1), last);
        let left = right.saturating_sub(1);
        let length = places[right] - places[left];
        let share = if length > 0.0 {
            ((at - places[left]) / length).clamp(0.0, 1.0)
        } else {
            0.0
        };
        Self { left, right, share }
    }

    fn value(&self, of: impl Fn(usize) -> f64) -> f64 {
        (1.0 - self.share) * of(self.left) + self.share * of(self.right)
    }
}

impl MapPanel {
    fn largest(&self) -> f64 {
        let values = self.rows.iter().flatten();
        values.fold(0.0, |most: f64, value| most.max(*value))
    }
}

/// The scale of a panel: steps from 0 at its lower end to the largest value.
fn scale(panel: &MapPanel, side: &Area<'_>) -> Result<(), PlotError> {
    let largest = panel.largest();
    let title = Text::new(panel.quantity.clone(), (0, px(14)), font(AXIS));
    side.draw(&title)?;
    // As long as the axis beside it.
    let bottom = PANEL.1.cast_signed() - (MARGIN + X_TITLE).cast_signed();
    let (width, top) = BAR;
    let at = |share: f64| {
        let length = f64::from(bottom - top);
        bottom - pixels(share * length)
    };
    for step in 0..STEPS {
        let ends = [step, step + 1].map(|step| at(real(step) / real(STEPS)));
        let colour = rgb(ramp(step, STEPS)).filled();
        side.draw(&Rectangle::new([(0, ends[1]), (width, ends[0])], colour))?;
    }
    let frame = INK.stroke_width(THIN_STROKE);
    side.draw(&Rectangle::new([(0, top), (width, bottom)], frame))?;
    let axis = Axis::new("", Scale::Linear).with_range(AxisRange::Fixed(0.0, largest));
    let ticks = ticks::ticks(&axis, std::iter::empty());
    for value in &ticks.major {
        let y = at(value / largest);
        let end = width + TICK.cast_signed();
        side.draw(&PathElement::new(vec![(width, y), (end, y)], frame))?;
        let label = ticks::label(Scale::Linear, &ticks, *value);
        let style = font(LABEL).pos(Pos::new(HPos::Left, VPos::Center));
        side.draw(&Text::new(label, (end + px(4), y), style))?;
    }
    Ok(())
}

#[expect(
    clippy::cast_possible_truncation,
    reason = "places within the picture, some thousand units"
)]
fn pixels(length: f64) -> i32 {
    length.round() as i32
}

#[cfg(test)]
mod tests {
    use super::*;

    fn panel(rows: Vec<Vec<f64>>) -> MapPanel {
        MapPanel {
            quantity: "worn depth (µm)".to_owned(),
            x: "angle (deg)".to_owned(),
            y: "across (µm)".to_owned(),
            at_x: vec![0.0, 1.0, 4.0],
            at_y: vec![-1.0, 1.0],
            rows,
        }
    }

    #[test]
    fn a_constant_quantity_is_one_rectangle_a_row_of_the_highest_colour() {
        let panel = panel(vec![vec![2.0; 3]; 2]);
        let axis = |from, to| {
            let axis = Axis::new("", Scale::Linear).with_range(AxisRange::Fixed(from, to));
            ticks::ticks(&axis, std::iter::empty())
        };
        let steps = steps(&panel, &axis(0.0, 4.0), &axis(-1.0, 1.0));
        assert_eq!(steps.len(), PLACES.1);
        assert!(steps.iter().all(|step| step.colour == STEPS - 1));
        assert!(steps.iter().all(|step| step.corners[1].1 <= 1.0 + 1e-12));
    }

    #[test]
    fn nothing_is_not_drawn_and_values_lie_on_lines_between_places() {
        assert_eq!(step_of(0.0, 1.0), None);
        assert_eq!(
            (step_of(0.03, 1.0), step_of(1.0, 1.0)),
            (Some(0), Some(STEPS - 1))
        );
        let between = Between::of(&[0.0, 1.0, 4.0], 2.5);
        assert!((between.value(real) - 1.5).abs() < 1e-15);
        assert!((Between::of(&[3.0], 9.0).value(|_| 7.0) - 7.0).abs() < 1e-15);
        let text = svg(&ColourMap {
            title: "Worn".to_owned(),
            panels: vec![panel(vec![vec![0.0, 1.0, 0.5]; 2])],
        });
        let text = text.expect("it is drawn");
        assert!(text.contains("worn depth (µm)") && text.contains("across (µm)"));
    }
}
