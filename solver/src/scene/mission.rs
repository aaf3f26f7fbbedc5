//! Mission: blocks of different reciprocating motions, one after the other, repeated as a whole.

use super::motion::Motion;
use super::timing::Timing;
use crate::number::real_cycles;

/// A block of a mission.
#[derive(Debug, Clone, Copy, PartialEq)]
pub struct Block {
    /// Its reciprocating motion.
    pub motion: Motion,
    /// The course of that in time.
    pub timing: Timing,
    /// Number of its cycles in one repetition of the mission.
    pub cycles: u64,
}

/// Blocks in their order, repeated.
#[derive(Debug, Clone, PartialEq)]
pub struct Mission {
    /// The blocks; at least two.
    pub blocks: Vec<Block>,
    /// How often all of them are done; at least once.
    pub repeat: u64,
}

impl Mission {
    /// Cycles of one repetition.
    pub fn cycles(&self) -> u64 {
        let cycles = self.blocks.iter().map(|block| block.cycles);
        cycles.fold(0, u64::saturating_add)
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
            amplitude_mm: mean(|motion| motion.amplitude_mm().abs()),
            period_s: mean(|motion| motion.period_s().unwrap_or_default()),
        }
    }

    /// Sliding distance, mm, and time, s, after a number of cycles.
    pub fn elapsed(&self, cycles: f64) -> (f64, f64) {
        let in_one = real_cycles(self.cycles());
        let (mut distance, mut time) = (0.0, 0.0);
        let whole = (cycles / in_one).floor();
        let mut left = cycles - whole * in_one;
        for block in &self.blocks {
            let of_block = real_cycles(block.cycles);
            let here = whole * of_block + left.min(of_block);
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
