//! Products and solutions of a kernel with two kinds of equations.

use super::super::cross_approximation::Entries;
use super::super::hodlr::Approximation;
use super::*;
use crate::number::real;
use std::ops::Range;

/// Two kinds of equations at each place: log |x - y| and a sign, weakly coupled, with a diagonal.
struct Kernel {
    order: usize,
}

impl Kernel {
    fn entry(&self, i: usize, j: usize) -> f64 {
        let distance = real(i / 2) - real(j / 2);
        let own = if i == j { 3.0 } else { 0.0 };
        if i % 2 == j % 2 {
            own + ((real(self.order) + 1.0) / (distance.abs() + 0.5)).ln()
        } else {
            0.3 * distance.signum() * f64::from(u8::from(i / 2 != j / 2))
        }
    }
}

impl Entries for Kernel {
    fn row(&mut self, row: usize, columns: Range<usize>, entries: &mut [f64]) {
        for (column, entry) in columns.zip(entries) {
            *entry = self.entry(row, column);
        }
    }

    fn column(&mut self, column: usize, rows: Range<usize>, entries: &mut [f64]) {
        for (row, entry) in rows.zip(entries) {
            *entry = self.entry(row, column);
        }
    }
}

/// The kernel's product with 1, 2, 3, ..., entries beside the diagonal added.
fn product(order: usize, added: &[(usize, usize, f64)]) -> Vec<f64> {
    let kernel = Kernel { order };
    let rows = 0..order;
    let mut product: Vec<f64> = rows
        .map(|i| {
            (0..order)
                .map(|j| kernel.entry(i, j) * (1.0 + real(j)))
                .sum()
        })
        .collect();
    for (row, column, value) in added {
        product[*row] += value * (1.0 + real(*column));
    }
    product
}

fn to(tolerance: f64, compared: bool) -> Approximation {
    Approximation {
        tolerance,
        compared,
        symmetric: false,
    }
}

#[test]
fn products_and_solutions_are_those_of_the_matrix() {
    for order in [1, 96, 97, 193, 385, 700] {
        let added: Vec<_> = (1..order).map(|j| (j - 1, j, 0.25 * real(j % 3))).collect();
        let mut lu = HodlrLu::default();
        let matrix = lu.matrix();
        matrix.approximate(order, &mut Kernel { order }, &added, to(1e-12, true));
        let exact = product(order, &added);
        let x: Vec<f64> = (0..order).map(|j| 1.0 + real(j)).collect();
        let mut y = vec![0.0; order];
        let all = 0..order;
        matrix.add_product(&all, &x, &all, &mut y);
        let largest = exact.iter().fold(0.0, |m: f64, y| m.max(y.abs()));
        let error = |a: &[f64], b: &[f64]| {
            a.iter()
                .zip(b)
                .fold(0.0, |m: f64, (a, b)| m.max((a - b).abs()))
        };
        assert!(error(&y, &exact) < 1e-11 * largest, "{order}");
        // A part of the rows and columns.
        let (rows, columns) = (order / 5..order / 2 + 1, order / 3..order);
        let mut part = vec![0.0; rows.len()];
        matrix.add_product(&columns, &x[columns.clone()], &rows, &mut part);
        let mut rest = vec![0.0; rows.len()];
        let before = 0..columns.start;
        matrix.add_product(&before, &x[before.clone()], &rows, &mut rest);
        for (i, (a, b)) in rows.clone().zip(part.iter().zip(&rest)) {
            assert!((a + b - exact[i]).abs() < 1e-11 * largest, "{order} {i}");
        }
        let mut two = [exact.clone(), exact.iter().map(|y| 2.0 * y).collect()].concat();
        lu.factor(&mut two);
        let mut one = exact;
        lu.solve(&mut one);
        assert!(
            error(&one, &x) < 1e-8 * real(order),
            "{order}: {:e}",
            error(&one, &x)
        );
        assert!(error(&two[..order], &x) < 1e-8 * real(order), "{order}");
    }
}

/// Cross approximation resolves both kinds of equations, although each row is zero or constant in one of them.
#[test]
fn a_coarse_approximation_sees_both_kinds_of_equations() {
    let order = 700;
    let mut lu = HodlrLu::default();
    lu.matrix()
        .approximate(order, &mut Kernel { order }, &[], to(1e-4, false));
    let blocks = lu.matrix().shape.blocks.iter();
    let rank = blocks.map(|block| block.rank).max().unwrap_or(0);
    assert!((6..30).contains(&rank), "{rank}");
    let mut x = product(order, &[]);
    lu.factor(&mut []);
    lu.solve(&mut x);
    let off = x.iter().enumerate().map(|(j, x)| (x - 1.0 - real(j)).abs());
    let off = off.fold(0.0, f64::max) / real(order);
    assert!(off < 1e-2, "{off:e}");
}

/// The columns of the unit matrix, the second half of them first: regular, but each of its leaves is zero.
struct Exchanged {
    order: usize,
}

impl Entries for Exchanged {
    fn row(&mut self, row: usize, columns: Range<usize>, entries: &mut [f64]) {
        self.column(row, columns, entries);
    }

    fn column(&mut self, column: usize, rows: Range<usize>, entries: &mut [f64]) {
        for (row, entry) in rows.zip(entries) {
            *entry = f64::from(u8::from(row == (column + self.order / 2) % self.order));
        }
    }
}

#[test]
fn a_singular_cluster_of_a_regular_matrix_is_told() {
    let order = 386;
    let mut lu = HodlrLu::default();
    lu.matrix()
        .approximate(order, &mut Exchanged { order }, &[], to(1e-12, true));
    lu.factor(&mut []);
    let mut x = vec![1.0; order];
    lu.solve(&mut x);
    assert!(x.iter().any(|x| !x.is_finite()));
}
