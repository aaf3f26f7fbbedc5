//! Range of the processor time of a solve.
//!
//! A forecast follows the schedule of a run on scars of closed form, which leaves out what costs most in some of them: the edge of a layer
//! that wears through, and a restart because of an error that only the run itself shows.

use std::collections::BTreeMap;

use api::plan::MachineFigures;

use crate::estimate::Estimate;
use crate::estimate::machine::cpu_s;
use crate::estimate::workload::{LeftOut, Workload};
use crate::number::real;

/// Time of the companions over that of the first run. Measured in random plated lives: 0.1 to 0.4.
pub(crate) const COMPANIONS: f64 = 0.25;

/// Time of a restart over that of the first run: four times by design (`error_control`), of sections. Measured: 2.9 to 4.9.
pub(crate) const RESTART: f64 = 4.5;

/// Time of a run over that which is left of it by its course, enough in nine of ten cases.
pub(crate) const MOST_OF_RUN: f64 = 2.5;

/// Upper end of a range over its likely value, at most.
pub(crate) const WIDEST: f64 = 4.0;

/// Time of a solve over its forecast, by what the forecast leaves out: likely, and enough in nine of ten cases. Measured: bare presets 0.6
/// to 1.6, plated ones 0.7 to 1; of 24 random plated lives 1.1 to 2.6 where they did not restart and 4.6 to 6.6 where they did, once 13; 0.4 to 12
/// where most restart, once 21.
fn factors(left_out: LeftOut) -> Factors {
    let (likely, most) = match left_out {
        LeftOut::Little => (1.0, 2.0),
        LeftOut::Restart | LeftOut::Layers => (1.0, 4.0),
        LeftOut::WornLayers => (1.65, 6.6),
        LeftOut::LayersAndRestart => (3.5, 14.0),
    };
    Factors { likely, most }
}

/// Ends of a range over the forecast.
struct Factors {
    likely: f64,
    most: f64,
}

/// Range of the time that a solve takes, or still takes, s.
#[derive(Debug, Clone, Copy, Default, PartialEq)]
pub(crate) struct ExpectedTime {
    /// Likely.
    pub(crate) likely_s: f64,
    /// Enough in nine of ten cases.
    pub(crate) most_s: f64,
}

impl ExpectedTime {
    /// The range of a workload on a machine, processor time.
    pub(crate) fn of(machine: &MachineFigures, workload: &Workload) -> Self {
        let forecast_s = cpu_s(machine, workload);
        let Factors { likely, most } = factors(workload.left_out);
        Self {
            likely_s: likely * forecast_s,
            most_s: most * forecast_s,
        }
    }

    /// The mean of some solves; `None` of no solve, or if the machine is not calibrated.
    pub(crate) fn mean(of: &[Estimate], machine: Option<&MachineFigures>) -> Option<Self> {
        let machine = machine.filter(|_| !of.is_empty())?;
        let each = of.iter().map(|solve| Self::of(machine, &solve.workload));
        let sum = each.fold(Self::default(), |sum, one| Self {
            likely_s: sum.likely_s + one.likely_s,
            most_s: sum.most_s + one.most_s,
        });
        let solves = real(of.len());
        Some(Self {
            likely_s: sum.likely_s / solves,
            most_s: sum.most_s / solves,
        })
    }

    /// The sum over so many solves of this range.
    pub(crate) fn times(self, solves: u64) -> Self {
        let solves = real(solves);
        Self {
            likely_s: solves * self.likely_s,
            most_s: solves * self.most_s,
        }
    }

    /// Estimates of a plan, by name.
    pub(crate) fn estimates(self) -> BTreeMap<String, f64> {
        let named = [("cpu_s", self.likely_s), ("cpu_s_most", self.most_s)];
        named
            .map(|(name, seconds)| (name.to_owned(), seconds))
            .into()
    }
}
