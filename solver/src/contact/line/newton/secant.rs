//! Broyden's method on chord steps: what a step left of the residual corrects the inverse Jacobian by a rank (Kelley 1995,
//! algorithm 7.3). Chord steps leave mostly one mode, and the same part of it each time.

use crate::linear::vector::{add_scaled, vectorized};

/// Most of its length that a step may repeat of the last one: beyond it the step would be more than doubled. Arbitrary: 0.3
/// takes as long, to 1 %.
const MOST_REPEATED: f64 = 0.5;

/// The steps since the last factorisation or change of a status.
#[derive(Debug, Default)]
pub(super) struct Secant {
    steps: Vec<f64>,
    /// Squares of their lengths.
    squares: Vec<f64>,
}

impl Secant {
    /// Forgets all steps.
    pub(super) fn restart(&mut self) {
        self.steps.clear();
        self.squares.clear();
    }

    /// Turns a chord step into one of Broyden's.
    pub(super) fn accelerate(&mut self, step: &mut [f64]) {
        let (steps, squares) = (&self.steps, &self.squares);
        vectorized(
            #[inline(always)]
            || {
                let mut earlier = steps.chunks_exact(step.len()).zip(squares).peekable();
                while let Some((before, square)) = earlier.next() {
                    let repeated = product(before, step) / square;
                    if let Some((next, _)) = earlier.peek() {
                        add_scaled(step, repeated, next);
                    } else {
                        let factor = 1.0 / (1.0 - repeated.min(MOST_REPEATED));
                        for s in step.iter_mut() {
                            *s *= factor;
                        }
                    }
                }
            },
        );
        self.squares
            .push(product(step, step).max(f64::MIN_POSITIVE));
        self.steps.extend_from_slice(step);
    }
}

/// Product of the tractions of two steps; the height is their last entry, in another unit.
fn product(a: &[f64], b: &[f64]) -> f64 {
    let tractions = a.len() - 1;
    let pairs = a[..tractions].iter().zip(&b[..tractions]);
    pairs.map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::*;

    /// One wrong direction of the Jacobian takes two corrections: one that shows it and one that removes it.
    #[test]
    fn one_wrong_direction_is_corrected_at_once() {
        let residual = |x: &[f64; 3]| [1.4 * x[0] + 0.2 * x[1] - 1.0, x[1] - 2.0, x[2] - 3.0];
        let mut secant = Secant::default();
        for start in [0.0, 5.0] {
            secant.restart();
            let mut x = [start, 0.0, 0.0];
            let mut sizes = Vec::new();
            for _ in 0..5 {
                let mut step = residual(&x).map(|r| -r);
                secant.accelerate(&mut step);
                x = [x[0] + step[0], x[1] + step[1], x[2] + step[2]];
                sizes.push(residual(&x).iter().fold(0.0, |m: f64, r| m.max(r.abs())));
            }
            // A chord step alone leaves 0.4 of the residual.
            assert!(sizes[0] > 0.1 && sizes[4] < 1e-12, "{sizes:?}");
        }
    }
}
