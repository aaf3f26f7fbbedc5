//! Remaining budget of a study.

/// Processor seconds.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Budget {
    total: f64,
    /// Expected time of the runs so far.
    expected: f64,
    /// Measured time of the runs so far.
    spent: f64,
}

impl Budget {
    pub(crate) fn new(total_s: f64) -> Self {
        Self {
            total: total_s,
            expected: 0.0,
            spent: 0.0,
        }
    }

    pub(crate) fn spend(&mut self, expected_s: f64, spent_s: f64) {
        self.expected += expected_s;
        self.spent += spent_s;
    }

    /// Expected time of a run, corrected by the ratio of measured to expected time of the runs so far.
    pub(crate) fn likely_s(&self, expected_s: f64) -> f64 {
        let ratio = if self.expected > 0.0 {
            self.spent / self.expected
        } else {
            1.0
        };
        ratio * expected_s
    }

    /// Checks whether a run of so many seconds fits.
    pub(crate) fn allows(&self, likely_s: f64) -> bool {
        self.spent + likely_s <= self.total
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn expected_times_are_corrected_by_the_runs_before() {
        let mut budget = Budget::new(10.0);
        assert!(budget.allows(budget.likely_s(8.0)));
        budget.spend(1.0, 2.0);
        assert!(budget.allows(budget.likely_s(4.0)));
        assert!(!budget.allows(budget.likely_s(4.1)));
    }
}
