//! One increment of a cycle, and the positions that are named in one.

/// Most steps a quarter of a cycle: an arbitrary bound on the length of a computed cycle.
pub(crate) const MOST_STEPS: usize = 50_000;

/// Named positions of a cycle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub enum Position {
    /// Slider at x = 0 on its way to +x.
    Neutral,
    /// Slider at its rightmost position.
    Rightmost,
    /// Slider at its leftmost position.
    Leftmost,
}

/// One increment of a cycle.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Step {
    /// Displacement of the slider at its end, mm.
    pub(crate) slider_x: f64,
    /// Additional slip of the slider's surface that does not move the contact, mm.
    pub(crate) surface_slip: f64,
    /// The named position at its end, if there is one.
    pub(crate) at: Option<Position>,
    /// Number of the stroke between two turning points that it belongs to.
    pub(crate) stroke: usize,
}

/// A named position in a cycle.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) struct Named {
    /// The first step from which increments may lead to it.
    pub(crate) from: usize,
    /// The step that ends at it.
    pub(crate) end: usize,
}
