//! Retries of an increment that fails: from the last contact, then in halves.

use crate::contact::ContactError;
use crate::number::real;

/// An increment: a displacement of the slider, with a start of the iteration.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct Increment<S> {
    /// Displacement of the slider before and after it, mm.
    pub(crate) from: f64,
    pub(crate) to: f64,
    /// Additional slip of the slider's surface that does not move the contact, mm.
    pub(crate) surface_slip: f64,
    /// Cycles that it stands for.
    pub(crate) cycles: f64,
    /// True if Lemke's method is tried where Newton's method does not converge.
    pub(crate) lemke: bool,
    /// Where the iteration starts; from the last contact if absent.
    pub(crate) start: Option<S>,
}

impl<S: Copy> Increment<S> {
    /// A displacement without wear from the last contact.
    pub(crate) fn new(from: f64, to: f64) -> Self {
        Self {
            from,
            to,
            surface_slip: 0.0,
            cycles: 0.0,
            lemke: false,
            start: None,
        }
    }

    /// Equal parts of a displacement, with the wear of a single cycle.
    pub(crate) fn parts(from: f64, to: f64, count: usize) -> impl Iterator<Item = Self> {
        let end = move |part: usize| from + (to - from) * real(part) / real(count);
        (1..=count).map(move |part| Self {
            cycles: 1.0,
            ..Self::new(end(part - 1), end(part))
        })
    }

    /// Both halves, each from the last contact.
    fn halves(self) -> [Self; 2] {
        let middle = 0.5 * (self.from + self.to);
        [(self.from, middle), (middle, self.to)].map(|(from, to)| Self {
            from,
            to,
            surface_slip: 0.5 * self.surface_slip,
            start: None,
            ..self
        })
    }
}

/// Retries of an increment.
#[derive(Debug, Clone, Copy)]
pub(crate) struct RetryPolicy {
    /// Most halvings before the increment fails.
    pub(crate) halvings: u32,
    /// From this many halvings on, Lemke's method is tried where Newton's method does not converge.
    pub(crate) lemke_from: u32,
    /// True if an increment that fails from another start is repeated from the last contact before it is halved.
    pub(crate) from_last_contact: bool,
}

/// Of an increment that has to be solved.
pub(crate) const RETRY: RetryPolicy = RetryPolicy {
    halvings: 8,
    lemke_from: 2,
    from_last_contact: true,
};

/// Failure of an increment.
pub(crate) trait IncrementError {
    /// Returns `true` if wider zones of fine elements would help, and smaller increments would not.
    fn needs_wider_zones(&self) -> bool;
}

impl IncrementError for ContactError {
    fn needs_wider_zones(&self) -> bool {
        ContactError::needs_wider_zones(*self)
    }
}

/// An increment that failed however small it was.
#[derive(Debug, Clone, Copy, PartialEq)]
pub(crate) struct FailedIncrement<E> {
    /// Number of halvings.
    pub(crate) halvings: u32,
    /// Failure of the smallest increment.
    pub(crate) source: E,
}

/// Takes an increment, in halves if it fails as a whole.
///
/// # Errors
/// [`FailedIncrement`]; the parts before it have been taken.
pub(crate) fn halve_and_retry<S: Copy, E: IncrementError>(
    increment: Increment<S>,
    policy: RetryPolicy,
    mut advance: impl FnMut(Increment<S>) -> Result<(), E>,
) -> Result<(), FailedIncrement<E>> {
    retry(increment, 0, policy, &mut advance)
}

fn retry<S: Copy, E: IncrementError>(
    increment: Increment<S>,
    halvings: u32,
    policy: RetryPolicy,
    advance: &mut impl FnMut(Increment<S>) -> Result<(), E>,
) -> Result<(), FailedIncrement<E>> {
    let tried = Increment {
        lemke: increment.lemke || halvings >= policy.lemke_from,
        ..increment
    };
    let Err(source) = advance(tried) else {
        return Ok(());
    };
    if policy.from_last_contact && increment.start.is_some() {
        let start = None;
        return retry(Increment { start, ..increment }, halvings, policy, advance);
    }
    if halvings == policy.halvings || source.needs_wider_zones() {
        return Err(FailedIncrement { halvings, source });
    }
    for half in increment.halves() {
        retry(half, halvings + 1, policy, advance)?;
    }
    Ok(())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// The increments that are tried where those up to a length have a solution, and `true` if all of it is solved.
    fn tried(policy: RetryPolicy, longest: f64) -> (Vec<Increment<()>>, bool) {
        let whole = Increment {
            surface_slip: 4.0,
            start: Some(()),
            ..Increment::new(1.0, 9.0)
        };
        let mut tried = Vec::new();
        let done = halve_and_retry(whole, policy, |increment| {
            tried.push(increment);
            let is_short = increment.to - increment.from <= longest;
            if is_short {
                Ok(())
            } else {
                Err(ContactError::NoEquilibrium {
                    slider_x_mm: increment.to,
                    active: 0,
                })
            }
        });
        (tried, done.is_ok())
    }

    #[test]
    fn an_increment_is_retried_from_the_last_contact_and_then_in_halves() {
        let (tried, done) = tried(RETRY, 2.0);
        assert!(done);
        let ends: Vec<f64> = tried.iter().map(|increment| increment.to).collect();
        assert_eq!(ends, [9.0, 9.0, 5.0, 3.0, 5.0, 9.0, 7.0, 9.0]);
        let slips: Vec<f64> = tried.iter().map(|one| one.surface_slip).collect();
        assert_eq!(slips, [4.0, 4.0, 2.0, 1.0, 1.0, 2.0, 1.0, 1.0]);
        let warm: Vec<bool> = tried.iter().map(|one| one.start.is_some()).collect();
        assert!(warm[0] && !warm[1..].contains(&true));
        let lemke: Vec<bool> = tried.iter().map(|one| one.lemke).collect();
        let expected = [false, false, false, true, true, false, true, true];
        assert_eq!(lemke, expected);
    }

    #[test]
    fn an_increment_that_fails_however_small_is_given_up() {
        let policy = RetryPolicy {
            halvings: 3,
            from_last_contact: false,
            ..RETRY
        };
        let (tried, done) = tried(policy, 0.0);
        assert!(!done);
        let ends: Vec<f64> = tried.iter().map(|increment| increment.to).collect();
        assert_eq!(ends, [9.0, 5.0, 3.0, 2.0]);
    }

    #[test]
    fn parts_of_a_displacement_are_equal() {
        let parts: Vec<Increment<()>> = Increment::parts(1.0, 3.0, 4).collect();
        let ends: Vec<f64> = parts.iter().map(|part| part.to).collect();
        assert_eq!(ends, [1.5, 2.0, 2.5, 3.0]);
        assert!(parts.iter().all(|part| part.cycles >= 1.0));
        assert!((parts[0].from - 1.0).abs() <= 0.0);
    }
}
