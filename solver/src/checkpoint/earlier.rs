//! Earlier runs of a scene, as error control compares them with the present one.

use serde::{Deserialize, Serialize};

use crate::record::{Compared, Summary};
use crate::sides::Sides;

/// Runs of a scene before the present one.
#[derive(Debug, Clone, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct EarlierRuns {
    /// Histories that the error is estimated by; `None` for a run without a solution.
    pub(crate) runs: Vec<Option<Compared>>,
    /// The delivered run, while its companions are solved.
    pub(crate) finished: Option<Box<Finished>>,
}

/// A run that has ended.
#[derive(Debug, Clone, PartialEq, Serialize, Deserialize)]
pub(crate) struct Finished {
    pub(super) summary: Summary,
    /// Ideal areas of its last report, which are not stored with it.
    ideal_area_mm2: Sides<Option<f64>>,
}

impl Finished {
    pub(crate) fn new(summary: Summary) -> Self {
        let last = &summary.last;
        Self {
            ideal_area_mm2: Sides {
                slider: last.slider.ideal_area_mm2,
                receptacle: last.receptacle.ideal_area_mm2,
            },
            summary,
        }
    }

    pub(crate) fn into_summary(self) -> Summary {
        let mut summary = self.summary;
        summary.last.slider.ideal_area_mm2 = self.ideal_area_mm2.slider;
        summary.last.receptacle.ideal_area_mm2 = self.ideal_area_mm2.receptacle;
        summary
    }
}
