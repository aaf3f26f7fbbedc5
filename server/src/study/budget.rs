//! How much a study may still cost.

/// Processor seconds, asked for and spent.
#[derive(Debug, Clone, PartialEq)]
pub(super) struct Budget {
    total_s: f64,
    spent_s: f64,
    /// What did not fit, in words.
    pub(super) left_out: Vec<String>,
}

impl Budget {
    pub(super) fn new(total_s: f64) -> Self {
        Self {
            total_s,
            spent_s: 0.0,
            left_out: Vec::new(),
        }
    }

    pub(super) fn spend(&mut self, seconds: f64) {
        self.spent_s += seconds;
    }

    /// Whether a run fits into a share of the whole.
    pub(super) fn allows(&self, seconds: f64, share: f64) -> bool {
        self.spent_s + seconds <= share * self.total_s
    }

    pub(super) fn left(&self) -> f64 {
        (self.total_s - self.spent_s).max(0.0)
    }

    pub(super) fn leave_out(&mut self, what: impl std::fmt::Display, seconds: f64) {
        self.left_out.push(format!("{what}: about {seconds:.0} s"));
    }
}
