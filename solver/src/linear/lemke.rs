//! Linear complementarity problems by Lemke's method (Cottle, Pang and Stone, *The Linear Complementarity Problem*,
//! 2009, section 4.4): w = M z + q, w >= 0, z >= 0, w'z = 0.
//!
//! An artificial unknown z0 is added to every row and removed by complementary pivots. Where M is copositive
//! and q does not oppose its kernel, the method terminates at a solution; otherwise it may terminate on a ray.

use super::SquareMatrix;

/// Smallest pivot over the largest entry of its column.
const PIVOT: f64 = 1e-11;
/// Relative difference below which ratios are ties; the row with the largest pivot is chosen among them.
const TIE: f64 = 1e-12;
/// z0 is taken as zero below this part of its initial value.
const NEARLY_OUT: f64 = 1e-5;
/// Most pivots per unknown; two or three are usual.
const MOST_PIVOTS: usize = 30;

/// Solves complementarity problems; its buffers are reused from call to call.
#[derive(Debug, Default)]
pub(crate) struct Lemke {
    order: usize,
    /// Rows of the dictionary: coefficients of the nonbasic unknowns, of z0 at the end, then the constant.
    rows: Vec<f64>,
    pivot_row: Vec<f64>,
    basic: Vec<usize>,
    nonbasic: Vec<usize>,
    solution: Vec<f64>,
}

impl Lemke {
    /// Returns z, or `None` if the method terminates on a ray. Ties and round-off can end it shortly before the
    /// solution: the result is a starting point for a method that checks the residual.
    pub(crate) fn solve(&mut self, matrix: &SquareMatrix, q: &[f64]) -> Option<&[f64]> {
        let n = matrix.order();
        debug_assert!(q.len() == n, "one constant a row");
        self.assemble(matrix, q);
        let (lowest, constant) = q
            .iter()
            .enumerate()
            .fold((0, 0.0), |m, (i, q)| if *q < m.1 { (i, *q) } else { m });
        if constant < 0.0 {
            let mut entering = self.pivot(lowest, n);
            let mut left = MOST_PIVOTS * n;
            while entering != 2 * n {
                let column = self.nonbasic.iter().position(|v| *v == entering)?;
                let Some(row) = self.leaving(column) else {
                    // A ray that begins this close to a solution is due to round-off.
                    if self.artificial() <= NEARLY_OUT * -constant {
                        break;
                    }
                    return None;
                };
                let leaving = self.basic[row];
                self.pivot(row, column);
                entering = if leaving == 2 * n {
                    leaving
                } else {
                    complement(leaving, n)
                };
                left = left.checked_sub(1)?;
            }
        }
        Some(self.read())
    }

    /// The dictionary of the slack basis; unknowns are w (0..n), z (n..2n) and z0 (2n).
    fn assemble(&mut self, matrix: &SquareMatrix, q: &[f64]) {
        let n = matrix.order();
        self.order = n;
        self.rows.clear();
        for (i, q) in q.iter().enumerate() {
            self.rows.extend((0..n).map(|j| matrix.get(i, j)));
            self.rows.extend([1.0, *q]);
        }
        self.basic.clear();
        self.basic.extend(0..n);
        self.nonbasic.clear();
        self.nonbasic.extend(n..=2 * n);
    }

    /// Ratio test: the row whose unknown falls to zero first as a nonbasic one grows; z0 before any other.
    fn leaving(&self, column: usize) -> Option<usize> {
        let n = self.order;
        let rows = || self.rows.chunks_exact(n + 2).enumerate();
        let largest = rows().fold(0.0, |m: f64, (_, row)| m.max(row[column].abs()));
        let falls = |row: &[f64]| row[column] < -PIVOT * largest;
        let ratio = |row: &[f64]| (row[n + 1] / -row[column]).max(0.0);
        let smallest = rows()
            .filter(|(_, row)| falls(row))
            .fold(f64::INFINITY, |m, (_, row)| m.min(ratio(row)));
        let mut best: Option<(usize, f64)> = None;
        for (i, row) in rows().filter(|(_, row)| falls(row)) {
            if ratio(row) > smallest * (1.0 + TIE) {
                continue;
            }
            if self.basic[i] == 2 * n {
                return Some(i);
            }
            if best.is_none_or(|(_, size)| -row[column] > size) {
                best = Some((i, -row[column]));
            }
        }
        best.map(|(i, _)| i)
    }

    /// The value of z0.
    fn artificial(&self) -> f64 {
        let n = self.order;
        let place = self.basic.iter().position(|v| *v == 2 * n);
        place.map_or(0.0, |row| self.rows[row * (n + 2) + n + 1])
    }

    /// Exchanges a basic and a nonbasic unknown; returns the complement of the one that left the basis.
    fn pivot(&mut self, row: usize, column: usize) -> usize {
        let width = self.order + 2;
        let pivot = self.rows[row * width + column];
        self.pivot_row.clear();
        self.pivot_row.extend(
            self.rows[row * width..(row + 1) * width]
                .iter()
                .map(|a| -a / pivot),
        );
        self.pivot_row[column] = 1.0 / pivot;
        for (i, target) in self.rows.chunks_exact_mut(width).enumerate() {
            if i == row {
                target.copy_from_slice(&self.pivot_row);
                continue;
            }
            let factor = target[column];
            if factor == 0.0 {
                continue;
            }
            target[column] = 0.0;
            for (a, p) in target.iter_mut().zip(&self.pivot_row) {
                *a += factor * p;
            }
        }
        std::mem::swap(&mut self.basic[row], &mut self.nonbasic[column]);
        complement(self.nonbasic[column], self.order)
    }

    fn read(&mut self) -> &[f64] {
        let n = self.order;
        self.solution.clear();
        self.solution.resize(n, 0.0);
        for (unknown, row) in self.basic.iter().zip(self.rows.chunks_exact(n + 2)) {
            if (n..2 * n).contains(unknown) {
                self.solution[unknown - n] = row[n + 1].max(0.0);
            }
        }
        &self.solution
    }
}

fn complement(unknown: usize, order: usize) -> usize {
    if unknown < order {
        unknown + order
    } else {
        unknown - order
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn matrix(rows: &[&[f64]]) -> SquareMatrix {
        let mut matrix = SquareMatrix::zeros(rows.len());
        for (i, row) in rows.iter().enumerate() {
            for (j, a) in row.iter().enumerate() {
                *matrix.at(i, j) = *a;
            }
        }
        matrix
    }

    #[test]
    fn a_solution_is_complementary() {
        let m = matrix(&[&[2.0, 1.0, 0.0], &[1.0, 2.0, 1.0], &[0.0, 1.0, 2.0]]);
        let q = [-1.0, 3.0, -4.0];
        let mut lemke = Lemke::default();
        let z = lemke
            .solve(&m, &q)
            .expect("the matrix is positive definite");
        for (i, q) in q.iter().enumerate() {
            let w: f64 = q + (0..3).map(|j| m.get(i, j) * z[j]).sum::<f64>();
            assert!(
                w >= -1e-12 && z[i] >= 0.0 && (w * z[i]).abs() < 1e-12,
                "{z:?}"
            );
        }
    }

    #[test]
    fn a_problem_without_a_solution_ends_on_a_ray() {
        let m = matrix(&[&[-1.0]]);
        assert!(Lemke::default().solve(&m, &[-1.0]).is_none());
    }
}
