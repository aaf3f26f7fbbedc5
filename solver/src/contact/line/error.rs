//! Failures of an increment.

/// Why an increment could not be solved.
#[derive(Debug, Clone, Copy, PartialEq, thiserror::Error)]
pub enum ContactError {
    /// The active set did not converge.
    #[error(
        "no contact state after {iterations} iterations at x = {slider_x_mm:.6} mm: relative gap residual {residual:.1e} (tolerance {tolerance:.1e}), {changes} nodes still changing"
    )]
    NotConverged {
        /// Imposed displacement, mm.
        slider_x_mm: f64,
        /// Iterations done.
        iterations: usize,
        /// Relative gap residual.
        residual: f64,
        /// Tolerance.
        tolerance: f64,
        /// Nodes whose status changed in the last iteration.
        changes: usize,
    },
    /// The linear system has no finite solution: sliding up a wall that is too steep, or no load at all.
    #[error("no equilibrium at x = {slider_x_mm:.6} mm with {active} nodes in contact")]
    NoEquilibrium {
        /// Imposed displacement, mm.
        slider_x_mm: f64,
        /// Nodes in contact.
        active: usize,
    },
    /// The active set did not converge where friction holds the slider against a wall.
    #[error(
        "jammed at x = {slider_x_mm:.6} mm: the load stands on a slope of {slope:.2}, and friction lets nothing climb beyond {limit:.2}"
    )]
    Jammed {
        /// Imposed displacement, mm.
        slider_x_mm: f64,
        /// Mean slope under the load.
        slope: f64,
        /// 1 / mu: beyond it only wear or yielding lets a contact climb.
        limit: f64,
    },
    /// The contact does not lie within any zone in which the mesh is fine.
    #[error(
        "the contact at x = {slider_x_mm:.6} mm needs {nodes} nodes of the {body} in one of its finely meshed zones of {zone}"
    )]
    WiderThanZone {
        /// Imposed displacement, mm.
        slider_x_mm: f64,
        /// Nodes that the contact needs.
        nodes: usize,
        /// Which body.
        body: &'static str,
        /// Nodes of its largest zone.
        zone: usize,
    },
    /// An increment removes more than implicit wear can integrate.
    #[error(
        "the step to x = {slider_x_mm:.6} mm wears off {share:.2} of what is left of a body (at most {limit})"
    )]
    TooMuchWear {
        /// Imposed displacement, mm.
        slider_x_mm: f64,
        /// Wear of the increment over the remaining height there.
        share: f64,
        /// Largest accepted value.
        limit: f64,
    },
}

impl ContactError {
    /// Returns `true` if wider zones of fine elements would help.
    pub(crate) fn needs_wider_zones(self) -> bool {
        matches!(self, Self::WiderThanZone { .. })
    }
}
