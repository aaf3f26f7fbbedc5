//! How much a study may still cost.

/// Processor seconds.
#[derive(Debug, Clone, PartialEq)]
pub(crate) struct Budget {
    total: f64,
    /// What the runs so far were expected to take, and took.
    expected: f64,
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

    /// What a run will take if expectations go on being as wrong as they were.
    pub(crate) fn likely_s(&self, expected_s: f64) -> f64 {
        let wrong = if self.expected > 0.0 {
            self.spent / self.expected
        } else {
            1.0
        };
        wrong * expected_s
    }

    /// Whether a run of so many likely seconds fits.
    pub(crate) fn allows(&self, likely_s: f64) -> bool {
        self.spent + likely_s <= self.total
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_run_is_judged_by_how_wrong_the_ones_before_it_were() {
        let mut budget = Budget::new(10.0);
        assert!(budget.allows(budget.likely_s(8.0)));
        budget.spend(1.0, 2.0);
        assert!(budget.allows(budget.likely_s(4.0)));
        assert!(!budget.allows(budget.likely_s(4.1)));
    }
}
