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

#[cfg(test)]
mod tests {
    use super::*;

    /// A contact whose jumps have a solution up to a length, and an accepted error up to another one; jumps need zones of some width.
    #[derive(Default)]
    struct Trial {
        longest_solved: u64,
        longest_accepted: u64,
        widest_jump_per_zone: u64,
        zones: u64,
        /// Cycles done, which an attempt changes and a return restores.
        done: u64,
        attempts: Vec<u64>,
    }

    #[derive(Debug, PartialEq)]
    enum Unsolved {
        NarrowZones,
        Diverged,
    }

    impl Attempts for Trial {
        type Saved = u64;
        type Record = u64;
        type Error = Unsolved;

        fn attempt(&mut self, jump: u64) -> Result<u64, Unsolved> {
            self.attempts.push(jump);
            self.done += jump;
            if jump > self.zones * self.widest_jump_per_zone {
                Err(Unsolved::NarrowZones)
            } else if jump > self.longest_solved {
                Err(Unsolved::Diverged)
            } else {
                Ok(self.done)
            }
        }

        fn rejected(&mut self, _: &u64, _: &u64, jump: u64) -> Option<u64> {
            (jump > self.longest_accepted).then_some(jump - 1)
        }

        fn save(&self) -> u64 {
            self.done
        }

        fn go_back(&mut self, before: &u64) {
            self.done = *before;
        }

        fn remedy(&mut self, error: &Unsolved) -> Result<Remedy, Unsolved> {
            if *error == Unsolved::Diverged {
                return Ok(Remedy::ShorterJump);
            }
            self.zones += 1;
            Ok(Remedy::WiderZones)
        }

        fn limit(&mut self, most: u64) -> u64 {
            most
        }
    }

    #[test]
    fn a_jump_is_shortened_until_it_has_a_solution_and_is_accepted() {
        let mut contact = Trial {
            longest_solved: 12,
            longest_accepted: 8,
            widest_jump_per_zone: 30,
            zones: 1,
            done: 100,
            ..Trial::default()
        };
        let found = longest_accepted_jump(&mut contact, 40);
        assert_eq!(found, Ok((8, 108)));
        // In wider zones first, then a quarter of it, then what the error allows.
        assert_eq!(contact.attempts, [40, 40, 10, 9, 8]);
        assert_eq!(contact.done, 108);
    }

    #[test]
    fn a_single_cycle_without_a_solution_leaves_the_state_before_it() {
        let mut contact = Trial {
            widest_jump_per_zone: 9,
            zones: 1,
            done: 7,
            ..Trial::default()
        };
        let found = longest_accepted_jump(&mut contact, 5);
        assert_eq!(found, Err(Unsolved::Diverged));
        assert_eq!(contact.attempts, [5, 2, 1]);
        assert_eq!(contact.done, 7);
    }

    #[test]
    fn work_is_repeated_only_where_it_needs_wider_zones() {
        let mut contact = Trial {
            longest_solved: 9,
            widest_jump_per_zone: 3,
            ..Trial::default()
        };
        assert!(in_wide_zones(&mut contact, |contact| contact.attempt(8).map(|_| ())).is_ok());
        assert_eq!(contact.attempts, [8, 8, 8, 8]);
        let failed = in_wide_zones(&mut contact, |contact| contact.attempt(10).map(|_| ()));
        assert_eq!(failed, Err(Unsolved::Diverged));
        assert_eq!(contact.done, 8);
    }
}
