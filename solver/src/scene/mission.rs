//! Mission: blocks of different reciprocating or periodic motions, repeated as a whole.
//!
//! A mission is done in rounds, in each of which every block has some cycles, in turn. In order a round is a repetition.
//! Mixed, the cycles of all repetitions are spread evenly over R rounds: of n cycles in all a block has done
//!   floor(r n/R + 1/2)
//! after r rounds (Bresenham 1965), so that all of them are done after R; a block with fewer cycles than there are rounds is
//! passed over in some. R is the second largest n: more rounds would leave only the block of the largest in some of them.

use super::motion::Motion;
use super::timing::Timing;
use crate::number::{real_cycles, whole_cycles};

/// A block of a mission.
#[derive(Debug, Clone, PartialEq)]
pub struct Block {
    /// Motion, not continuous.
    pub motion: Motion,
    /// The course of that in time.
    pub timing: Timing,
    /// Number of its cycles in one repetition of the mission.
    pub cycles: u64,
}

/// Order of the cycles of a mission.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq)]
pub enum Order {
    /// In each repetition one block after the other.
    #[default]
    InOrder,
    /// The cycles of each block spread evenly over all repetitions.
    Mixed,
}

/// Blocks, repeated.
#[derive(Debug, Clone, PartialEq)]
pub struct Mission {
    /// The blocks; at least two.
    pub blocks: Vec<Block>,
    /// How often all of them are done; at least once.
    pub repeat: u64,
    /// The order of their cycles.
    pub order: Order,
}

impl Mission {
    /// Cycles of one repetition.
    pub fn cycles(&self) -> u64 {
        let cycles = self.blocks.iter().map(|block| block.cycles);
        cycles.fold(0, u64::saturating_add)
    }

    /// Cycles of a block in a round in which it has some.
    pub(crate) fn cycles_at_a_time(&self, block: &Block) -> u64 {
        (self.total(block) / self.rounds().max(1)).max(1)
    }

    /// Number of rounds.
    pub(crate) fn rounds(&self) -> u64 {
        match self.order {
            Order::InOrder => self.repeat,
            Order::Mixed => {
                let totals = self.blocks.iter().map(|block| self.total(block));
                let two = totals.fold((0, 0), |(first, second), total| {
                    if total > first {
                        (total, first)
                    } else {
                        (first, second.max(total))
                    }
                });
                two.1.max(1)
            }
        }
    }

    /// Cycles of a block in all repetitions.
    fn total(&self, block: &Block) -> u64 {
        block.cycles.saturating_mul(self.repeat)
    }

    /// Cycles of a block in the first so many rounds.
    pub(crate) fn cycles_of(&self, block: usize, rounds: u64) -> u64 {
        let block = &self.blocks[block];
        match self.order {
            Order::InOrder => block.cycles.saturating_mul(rounds),
            Order::Mixed => {
                let all = u128::from(self.rounds());
                let done = u128::from(rounds) * u128::from(self.total(block));
                u64::try_from((2 * done + all) / (2 * all)).unwrap_or(u64::MAX)
            }
        }
    }

    /// Cycles of all blocks in the first so many rounds.
    pub(crate) fn cycles_in(&self, rounds: u64) -> u64 {
        let cycles = (0..self.blocks.len()).map(|block| self.cycles_of(block, rounds));
        cycles.fold(0, u64::saturating_add)
    }

    /// Rounds that are whole after so many cycles.
    pub(crate) fn rounds_within(&self, cycles: u64) -> u64 {
        let mean = self.cycles().max(1);
        if self.order == Order::InOrder {
            return cycles / mean;
        }
        let all = u128::from(mean) * u128::from(self.repeat);
        let rounds = u128::from(cycles) * u128::from(self.rounds()) / all;
        let mut rounds = u64::try_from(rounds).unwrap_or(u64::MAX);
        // Rounding leaves a round or two.
        while rounds > 0 && self.cycles_in(rounds) > cycles {
            rounds -= 1;
        }
        while rounds < self.rounds() && self.cycles_in(rounds + 1) <= cycles {
            rounds += 1;
        }
        rounds
    }

    /// The mean cycle: a section that all blocks wear together is as deep as if every cycle had its amplitude, because the depth
    /// of a groove is the number of passes over a place times the depth of one.
    pub fn mean_motion(&self) -> Motion {
        let mean = |of: fn(Motion) -> f64| {
            let sum = self.blocks.iter().fold(0.0, |sum, block| {
                sum + real_cycles(block.cycles) * of(block.motion)
            });
            sum / real_cycles(self.cycles())
        };
        Motion::Reciprocating {
            amplitude_mm: mean(|motion| 0.25 * motion.distance_per_cycle_mm().abs()),
            period_s: mean(|motion| motion.period_s().unwrap_or_default()),
        }
    }

    /// Sliding distance, mm, and time, s, after a number of cycles.
    pub fn elapsed(&self, cycles: f64) -> (f64, f64) {
        let (mut distance, mut time) = (0.0, 0.0);
        let whole = self.rounds_within(whole_cycles(cycles));
        let mut left = cycles - real_cycles(self.cycles_in(whole));
        for (number, block) in self.blocks.iter().enumerate() {
            let before = self.cycles_of(number, whole);
            let of_block = real_cycles(self.cycles_of(number, whole + 1) - before);
            let here = real_cycles(before) + left.min(of_block);
            left = (left - of_block).max(0.0);
            distance += here * block.motion.distance_per_cycle_mm();
            time += here * block.motion.period_s().unwrap_or_default();
        }
        (distance, time)
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 30 cycles of 0.01 mm in 1 s each, then 10 of 0.05 mm in 2 s each, a hundred times.
    fn mission() -> Mission {
        let block = |amplitude_mm, period_s, cycles| Block {
            motion: Motion::Reciprocating {
                amplitude_mm,
                period_s,
            },
            timing: Timing::Sine,
            cycles,
        };
        Mission {
            blocks: vec![block(0.01, 1.0, 30), block(0.05, 2.0, 10)],
            repeat: 100,
            order: Order::InOrder,
        }
    }

    #[test]
    fn distance_and_time_follow_the_order_of_the_blocks() {
        let mission = mission();
        let close = |cycles, (distance, time): (f64, f64)| {
            let (d, t) = mission.elapsed(cycles);
            assert!(
                (d - distance).abs() < 1e-12 && (t - time).abs() < 1e-9,
                "{cycles}: {d} {t}"
            );
        };
        close(0.0, (0.0, 0.0));
        close(15.0, (15.0 * 0.04, 15.0));
        close(35.0, (30.0 * 0.04 + 5.0 * 0.2, 40.0));
        close(4_000.0, (100.0 * (1.2 + 2.0), 5_000.0));
        close(4_010.0, (100.0 * (1.2 + 2.0) + 0.4, 5_010.0));
    }

    /// Blocks of so many cycles, mixed.
    fn mixed(cycles: &[u64], repeat: u64) -> Mission {
        let block = |&cycles: &u64| Block {
            cycles,
            ..mission().blocks[0].clone()
        };
        Mission {
            blocks: cycles.iter().map(block).collect(),
            repeat,
            order: Order::Mixed,
        }
    }

    #[test]
    fn the_cycles_of_mixed_blocks_are_spread_evenly_and_add_up() {
        for (cycles, repeat, rounds) in [
            (&[7, 1_000][..], 1, 7),
            (&[7, 1_000], 3, 21),
            (&[1, 1_000, 360], 1, 360),
            (&[4, 2_000_000_000, 7], 520, 3_640),
            (&[5, 5], 2, 10),
            (&[1, 1], 1, 1),
        ] {
            let mission = mixed(cycles, repeat);
            assert_eq!(mission.rounds(), rounds, "{cycles:?}");
            for (block, cycles) in cycles.iter().enumerate() {
                let total = cycles * repeat;
                let done = |round| mission.cycles_of(block, round);
                assert_eq!((done(0), done(rounds)), (0, total));
                let mut per_round = (1..=rounds).map(|round| done(round) - done(round - 1));
                let (least, most) = (total / rounds, total.div_ceil(rounds));
                assert!(per_round.all(|n| (least..=most).contains(&n)), "{cycles}");
            }
        }
        // A single cycle is in the middle.
        let single = mixed(&[1, 1_000, 360], 1);
        assert_eq!([179, 180].map(|round| single.cycles_of(0, round)), [0, 1]);
    }

    #[test]
    fn whole_rounds_are_found_from_their_cycles() {
        for mission in [mixed(&[7, 1_000], 3), mixed(&[1, 1_000, 360], 1), mission()] {
            for rounds in 0..=mission.rounds() {
                let cycles = mission.cycles_in(rounds);
                assert_eq!(mission.rounds_within(cycles), rounds);
                if let Some(before) = rounds.checked_sub(1) {
                    assert_eq!(mission.rounds_within(cycles - 1), before);
                }
            }
        }
    }

    #[test]
    fn mixed_distance_and_time_are_those_of_all_blocks_together() {
        let mixed = Mission {
            order: Order::Mixed,
            ..mission()
        };
        // Rounds of three cycles and one.
        assert_eq!(mixed.rounds(), 1_000);
        let (distance, time) = mixed.elapsed(4_000.0);
        assert!((distance - 320.0).abs() < 1e-9 && (time - 5_000.0).abs() < 1e-9);
        let (distance, time) = mixed.elapsed(5.5);
        assert!((distance - (4.5 * 0.04 + 0.2)).abs() < 1e-12, "{distance}");
        assert!((time - 6.5).abs() < 1e-12, "{time}");
    }

    #[test]
    fn the_mean_cycle_has_the_path_and_the_time_of_all() {
        let mission = mission();
        let mean = mission.mean_motion();
        let (distance, time) = mission.elapsed(40.0);
        assert!((40.0 * mean.distance_per_cycle_mm() - distance).abs() < 1e-12);
        assert!((40.0 * mean.period_s().unwrap_or_default() - time).abs() < 1e-12);
        assert_eq!(mission.cycles(), 40);
    }
}
