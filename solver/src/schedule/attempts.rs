//! The computed cycle of the longest jump that has a solution and an error that is accepted.

use super::jump::CUT;

/// Remedy of a cycle without a solution.
#[derive(Debug, Clone, Copy, PartialEq, Eq)]
pub(crate) enum Remedy {
    /// The same jump: zones of fine elements have been widened.
    WiderZones,
    /// A shorter jump.
    ShorterJump,
    /// There is none.
    Nothing,
}

/// A contact that attempts cycles, and goes back to the state before them.
pub(crate) trait Attempts {
    /// A copy of what a cycle changes.
    type Saved;
    /// Record of a computed cycle.
    type Record;
    /// Why a cycle has no solution.
    type Error;

    /// Computes a cycle that stands for a jump.
    ///
    /// # Errors
    /// A cycle without a solution; the state is then one within it.
    fn attempt(&mut self, jump: u64) -> Result<Self::Record, Self::Error>;

    /// Measures the error of a jump; a shorter jump where it is too large.
    fn rejected(&mut self, before: &Self::Saved, record: &Self::Record, jump: u64) -> Option<u64>;

    /// A copy of what a cycle changes.
    fn save(&self) -> Self::Saved;

    /// Goes back to a copy, with the work and the limit of the jump as they are.
    fn go_back(&mut self, before: &Self::Saved);

    /// Widens zones if an error needs it, and returns what may help.
    ///
    /// # Errors
    /// Wider zones cannot be built.
    fn remedy(&mut self, error: &Self::Error) -> Result<Remedy, Self::Error>;

    /// Limits the jump to so many cycles; returns the next one to be attempted.
    fn limit(&mut self, most: u64) -> u64;
}

/// Computes a cycle of a jump, or of the longest shorter one that has a solution and is accepted; returns the jump with its record.
///
/// # Errors
/// A single cycle without a solution, or an error that no shorter jump remedies; the state is then as before.
pub(crate) fn longest_accepted_jump<A: Attempts>(
    contact: &mut A,
    mut jump: u64,
) -> Result<(u64, A::Record), A::Error> {
    let mut before = contact.save();
    loop {
        let shorter = match contact.attempt(jump) {
            Ok(record) => {
                let Some(shorter) = contact.rejected(&before, &record, jump) else {
                    return Ok((jump, record));
                };
                contact.go_back(&before);
                shorter
            }
            Err(error) => {
                contact.go_back(&before);
                match contact.remedy(&error)? {
                    Remedy::WiderZones => {
                        before = contact.save();
                        continue;
                    }
                    Remedy::ShorterJump if jump > 1 => jump.div_ceil(CUT),
                    Remedy::ShorterJump | Remedy::Nothing => return Err(error),
                }
            }
        };
        jump = contact.limit(shorter);
    }
}

/// Does work without a jump, again where it needs wider zones.
///
/// # Errors
/// The error of the work, if wider zones are no help.
pub(crate) fn in_wide_zones<A: Attempts>(
    contact: &mut A,
    mut work: impl FnMut(&mut A) -> Result<(), A::Error>,
) -> Result<(), A::Error> {
    loop {
        let before = contact.save();
        let Err(error) = work(contact) else {
            return Ok(());
        };
        contact.go_back(&before);
        if contact.remedy(&error)? != Remedy::WiderZones {
            return Err(error);
        }
    }
}
