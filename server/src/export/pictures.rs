//! Plots: panels of curves and markers, drawn as SVG.
//!
//! Text is measured with an embedded font, so that no system font is needed and the same data give the
//! same picture on every machine. Apart from `run`, `line`, `life` and `maps`, nothing here knows the meaning of the numbers.

mod axis;
mod canvas;
mod colour;
mod colour_map;
mod ticks;

pub mod life;
mod line;
pub mod maps;
pub mod run;

use plotters::drawing::DrawingAreaErrorKind;

pub use axis::{Axis, AxisRange, Scale};
pub use canvas::svg;
pub use colour::{COLOURS, Colour, ramp};
pub use colour_map::{ColourMap, MapPanel, svg as colour_map};

/// A picture: panels one above the other with a common legend.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// Title.
    pub title: String,
    /// Panels from top to bottom.
    pub panels: Vec<Panel>,
}

/// A pair of axes with its series.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// Series, the last one on top.
    pub series: Vec<Series>,
}

/// A curve or a set of points.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Label in the legend; empty for none.
    pub label: String,
    /// Line and marker style.
    pub mark: Mark,
    /// Colour.
    pub colour: Colour,
    /// Points.
    pub points: Vec<[f64; 2]>,
}

/// Line and marker style of a series.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// A solid line.
    Line,
    /// A dashed line.
    Dashes,
    /// Filled circles.
    Dots,
    /// Open circles.
    Circles,
}

/// Why a picture could not be rendered.
#[derive(Debug, thiserror::Error)]
pub enum PlotError {
    /// SVG could not be written.
    #[error("drawing a picture: {0}")]
    Drawing(#[from] DrawingAreaErrorKind<std::io::Error>),
}
