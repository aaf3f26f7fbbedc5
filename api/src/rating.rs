//! Ratings: the wear coefficients that a rated number of cycles implies.

use serde::{Deserialize, Serialize};

use crate::spec::{Criterion, Spec};

/// A rated life, and the coefficients that it implies.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Rating {
    /// Criterion that ends the life.
    pub criterion: Criterion,
    /// The rated cycles.
    pub rated_cycles: u64,
    /// Part of the contacts that may have failed by then.
    pub failing: f64,
    /// Life of the median contact that the rating implies, by the scatter of the specification, cycles.
    pub median_cycles: f64,
    /// Factor on the given coefficients.
    pub factor: f64,
    /// Each coefficient.
    pub coefficients: Vec<Coefficient>,
    /// The runs; the last one has the implied coefficients.
    pub runs: Vec<RatingRun>,
    /// The specification with the implied coefficients.
    pub spec: Spec,
}

/// A wear coefficient.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub struct Coefficient {
    /// JSON pointer of its field, which names its unit.
    pub pointer: String,
    /// Name of the material that wears.
    pub material: Option<String>,
    /// Value in the specification.
    pub given: f64,
    /// Value that the rating implies.
    pub implied: f64,
}

/// A run that the coefficients were found by.
#[derive(Debug, Clone, Copy, PartialEq, Serialize, Deserialize)]
pub struct RatingRun {
    /// Factor on the given coefficients.
    pub factor: f64,
    /// Cycles until the criterion was reached; if it was not, the cycles of the run in proportion to how far it was.
    pub cycles: f64,
    /// True if it was reached.
    pub is_reached: bool,
}
