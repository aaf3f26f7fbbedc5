//! Pictures as SVG.

use std::sync::Once;

use plotters::chart::{ChartBuilder, ChartContext};
use plotters::coord::Shift;
use plotters::prelude::{
    Cartesian2d, Circle, DashedLineSeries, DrawingArea, IntoDrawingArea, IntoFont, LineSeries,
    PathElement, RGBColor, SVGBackend, Text,
};
use plotters::style::{Color, FontStyle, ShapeStyle, TextStyle, WHITE, register_font};

use crate::export::pictures::ticks;
use crate::export::pictures::ticks::Ticks;
use crate::export::pictures::{Colour, Mark, Panel, Picture, PlotError, Series};

/// Drawing units per pixel: the backend rounds coordinates to whole units, which must not be visible in curves.
pub(super) const UNIT: u32 = 4;

/// Size of a panel with its axis titles, and of title, legend and margins around it.
const PANEL: (u32, u32) = (620 * UNIT, 380 * UNIT);
pub(super) const TITLE_HEIGHT: u32 = 40 * UNIT;
pub(super) const LEGEND_WIDTH: u32 = 190 * UNIT;
pub(super) const MARGIN: u32 = 14 * UNIT;
pub(super) const X_TITLE: u32 = 46 * UNIT;
pub(super) const Y_TITLE: u32 = 68 * UNIT;

/// Sizes of text, strokes and marks.
const TITLE: u32 = 18 * UNIT;
pub(super) const AXIS: u32 = 15 * UNIT;
pub(super) const LABEL: u32 = 13 * UNIT;
const STROKE: u32 = 2 * UNIT;
pub(super) const THIN_STROKE: u32 = UNIT;
const DOT: u32 = 4 * UNIT;
pub(super) const TICK: u32 = 5 * UNIT;

/// The legend: first line, line spacing, end of the markers, start of the labels, height of a label above its line.
const LEGEND_TOP: i32 = px(24);
const LEGEND_LINE: i32 = px(22);
const LEGEND_MARK: i32 = px(26);
const LEGEND_LABEL: i32 = px(36);
const LEGEND_RISE: i32 = px(7);

pub(super) const INK: RGBColor = RGBColor(30, 30, 30);
const GRID: RGBColor = RGBColor(222, 222, 222);
const FAINT: RGBColor = RGBColor(240, 240, 240);
/// Font family in the SVG: a viewer substitutes its own, text is measured with the embedded one.
const FAMILY: &str = "sans-serif";

pub(super) type Area<'a> = DrawingArea<SVGBackend<'a>, Shift>;
type Chart<'a, 'b> = ChartContext<'a, SVGBackend<'b>, Cartesian2d<Ticks, Ticks>>;

/// Draws a picture.
///
/// # Errors
/// [`PlotError`] if the drawing fails.
pub fn svg(picture: &Picture) -> Result<String, PlotError> {
    let panels = u32::try_from(picture.panels.len()).unwrap_or(1);
    let size = (PANEL.0 + LEGEND_WIDTH, TITLE_HEIGHT + panels * PANEL.1);
    drawing(size, |root| draw(picture, root, size))
}

/// Returns an SVG with an area of a size in drawing units, filled by `draw`.
pub(super) fn drawing(
    size: (u32, u32),
    draw: impl FnOnce(&Area<'_>) -> Result<(), PlotError>,
) -> Result<String, PlotError> {
    static FONT: Once = Once::new();
    FONT.call_once(|| {
        // The embedded font is valid; otherwise measuring text below returns an error.
        let _ = register_font(FAMILY, FontStyle::Normal, notosans::REGULAR_TTF);
    });
    let mut text = String::new();
    {
        let root = SVGBackend::with_string(&mut text, size).into_drawing_area();
        root.fill(&WHITE)?;
        draw(&root)?;
        root.present()?;
    }
    // A name may contain characters that XML cannot.
    let text = text.replace(|character| !is_xml(character), "\u{fffd}");
    Ok(sized_in_pixels(&text, size))
}

/// Returns `true` if XML 1.0 allows a character (section 2.2).
fn is_xml(character: char) -> bool {
    matches!(character, '\t' | '\n' | '\r' | ' '..='\u{d7ff}' | '\u{e000}'..='\u{fffd}' | '\u{10000}'..)
}

/// The SVG with its size in pixels; its `viewBox` stays in drawing units.
fn sized_in_pixels(text: &str, (width, height): (u32, u32)) -> String {
    let header = |width, height| format!("width=\"{width}\" height=\"{height}\"");
    text.replacen(
        &header(width, height),
        &header(width / UNIT, height / UNIT),
        1,
    )
}

fn draw(picture: &Picture, root: &Area<'_>, size: (u32, u32)) -> Result<(), PlotError> {
    let body = titled(&picture.title, root)?;
    let (panels, side) = body.split_horizontally(size.0 - LEGEND_WIDTH);
    let areas = panels.split_evenly((picture.panels.len(), 1));
    for (panel, area) in picture.panels.iter().zip(&areas) {
        draw_panel(panel, area)?;
    }
    legend(picture, &side)
}

/// Draws the title; returns the area below it.
pub(super) fn titled<'a>(title: &str, root: &Area<'a>) -> Result<Area<'a>, PlotError> {
    let (head, body) = root.split_vertically(TITLE_HEIGHT);
    let title = Text::new(title.to_owned(), (px(14), px(14)), font(TITLE));
    head.draw(&title)?;
    Ok(body)
}

fn draw_panel(panel: &Panel, area: &Area<'_>) -> Result<(), PlotError> {
    let along = |axis: usize| {
        panel
            .series
            .iter()
            .flat_map(move |series| series.points.iter().map(move |point| point[axis]))
    };
    let x = ticks::ticks(&panel.x, along(0));
    let y = ticks::ticks(&panel.y, along(1));
    let mut chart = ChartBuilder::on(area)
        .margin(MARGIN)
        .x_label_area_size(X_TITLE)
        .y_label_area_size(Y_TITLE)
        .build_cartesian_2d(x.clone(), y.clone())?;
    chart
        .configure_mesh()
        .x_desc(panel.x.title.clone())
        .y_desc(panel.y.title.clone())
        .axis_desc_style(font(AXIS))
        .label_style(font(LABEL))
        .x_label_formatter(&|x_tick| ticks::label(panel.x.scale, &x, *x_tick))
        .y_label_formatter(&|y_tick| ticks::label(panel.y.scale, &y, *y_tick))
        .bold_line_style(GRID.stroke_width(THIN_STROKE))
        .light_line_style(FAINT.stroke_width(THIN_STROKE))
        .axis_style(INK.stroke_width(THIN_STROKE))
        .set_all_tick_mark_size(TICK)
        .draw()?;
    for series in &panel.series {
        draw_series(panel, series, &mut chart)?;
    }
    Ok(())
}

fn draw_series(panel: &Panel, series: &Series, chart: &mut Chart<'_, '_>) -> Result<(), PlotError> {
    let coordinates = |point: &[f64; 2]| {
        Some((
            panel.x.scale.coordinate(point[0])?,
            panel.y.scale.coordinate(point[1])?,
        ))
    };
    let points: Vec<(f64, f64)> = series.points.iter().filter_map(coordinates).collect();
    let colour = rgb(series.colour);
    let stroke = colour.stroke_width(STROKE);
    match series.mark {
        Mark::Line => chart
            .draw_series(LineSeries::new(points.clone(), stroke))
            .map(drop),
        Mark::Dashes => chart
            .draw_series(DashedLineSeries::new(
                points.clone(),
                7 * UNIT,
                5 * UNIT,
                stroke,
            ))
            .map(drop),
        Mark::Dots | Mark::Circles => Ok(()),
    }?;
    if let Some(style) = marker(series.mark, colour) {
        let circles = points.into_iter().map(|at| Circle::new(at, DOT, style));
        chart.draw_series(circles)?;
    }
    Ok(())
}

fn marker(mark: Mark, colour: RGBColor) -> Option<ShapeStyle> {
    match mark {
        Mark::Line | Mark::Dashes => None,
        Mark::Dots => Some(colour.filled()),
        Mark::Circles => Some(colour.stroke_width(STROKE)),
    }
}

/// Draws every label once, in order of appearance, beside the panels.
fn legend(picture: &Picture, side: &Area<'_>) -> Result<(), PlotError> {
    let mut shown: Vec<&Series> = Vec::new();
    for series in picture.panels.iter().flat_map(|panel| &panel.series) {
        if !series.label.is_empty() && shown.iter().all(|other| other.label != series.label) {
            shown.push(series);
        }
    }
    let mut y = LEGEND_TOP;
    for series in shown {
        let colour = rgb(series.colour);
        let stroke = colour.stroke_width(STROKE);
        let dashes: &[[i32; 2]] = match series.mark {
            Mark::Line => &[[0, LEGEND_MARK]],
            Mark::Dashes => &[[0, px(7)], [px(10), px(17)], [px(19), LEGEND_MARK]],
            Mark::Dots | Mark::Circles => &[],
        };
        for [from, to] in dashes {
            let line = PathElement::new(vec![(*from, y), (*to, y)], stroke);
            side.draw(&line)?;
        }
        if let Some(style) = marker(series.mark, colour) {
            side.draw(&Circle::new((LEGEND_MARK / 2, y), DOT, style))?;
        }
        let label = Text::new(
            series.label.clone(),
            (LEGEND_LABEL, y - LEGEND_RISE),
            font(LABEL),
        );
        side.draw(&label)?;
        y += LEGEND_LINE;
    }
    Ok(())
}

pub(super) fn font(size: u32) -> TextStyle<'static> {
    (FAMILY, size).into_font().color(&INK)
}

pub(super) fn rgb([red, green, blue]: Colour) -> RGBColor {
    RGBColor(red, green, blue)
}

/// Pixels in drawing units.
pub(super) const fn px(pixels: i32) -> i32 {
    pixels * UNIT.cast_signed()
}
