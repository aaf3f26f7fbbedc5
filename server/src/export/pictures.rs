//! Pictures: panels of curves and marks, drawn as SVG and rasterised as PNG from the very same drawing.
//!
//! Text is measured and rasterised with an embedded font, so that no font of the system is needed and the same data
//! give the same picture everywhere. Knows: curves and axes. Does not know: what the numbers mean.

mod axis;
mod canvas;
mod colour;
mod raster;
mod scale;

pub mod run;

pub use axis::{Axis, Scale, Span};
pub use canvas::svg;
pub use colour::{COLOURS, Colour, ramp};
pub use raster::png;

/// A picture: panels one above the other, one legend for all of them.
#[derive(Debug, Clone, PartialEq)]
pub struct Picture {
    /// What it shows.
    pub title: String,
    /// Its panels, from the top.
    pub panels: Vec<Panel>,
}

/// Axes and what is drawn between them.
#[derive(Debug, Clone, PartialEq)]
pub struct Panel {
    /// The horizontal axis.
    pub x: Axis,
    /// The vertical axis.
    pub y: Axis,
    /// What is drawn, the last one on top.
    pub series: Vec<Series>,
}

/// Points that belong together.
#[derive(Debug, Clone, PartialEq)]
pub struct Series {
    /// Its name in the legend; empty for none.
    pub label: String,
    /// How it is drawn.
    pub mark: Mark,
    /// Its colour.
    pub colour: Colour,
    /// Its points.
    pub points: Vec<[f64; 2]>,
}

/// How points are drawn.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Mark {
    /// A line through them.
    Line,
    /// A broken line through them.
    Dashes,
    /// A filled circle at each.
    Dots,
    /// An open circle at each.
    Rings,
    /// A filled circle at each and a line through them.
    Beads,
}

/// Why there is no picture.
#[derive(Debug, thiserror::Error)]
pub enum PlotError {
    /// The drawing failed.
    #[error("drawing a picture: {0}")]
    Drawing(String),
    /// The drawing could not be read as SVG.
    #[error("rasterising a picture: {0}")]
    Raster(String),
}
