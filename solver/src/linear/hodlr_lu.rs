//! Factors of a HODLR matrix (Ambikasaran and Darve 2013): from the leaves up,
//!   [D_a  U_a V_a^T; U_b V_b^T  D_b] = diag(D_a, D_b) (I + [0  Y_a V_a^T; Y_b V_b^T  0]),  Y = D^-1 U,
//! and with z_b = V_b^T x_a and z_a = V_a^T x_b the system of the ranks is left:
//!   [I  V_b^T Y_a; V_a^T Y_b  I] [z_b; z_a] = [V_b^T D_a^-1 f_a; V_a^T D_b^-1 f_b],
//!   x_a = D_a^-1 f_a - Y_a z_a,  x_b = D_b^-1 f_b - Y_b z_b.

use super::blocked_lu::{BlockedLu, Exchanges};
use super::hodlr::{Hodlr, Shape};
use faer::linalg::matmul::matmul;
use faer::prelude::{Reborrow, ReborrowMut};
use faer::{Accum, MatMut, MatRef, Par};

/// Factors in place of a matrix. Buffers are reused.
#[derive(Default)]
pub(crate) struct HodlrLu {
    /// Leaves hold their factors, blocks Y instead of U.
    matrix: Hodlr,
    leaf_exchanges: Vec<Exchanges>,
    /// Factors of the systems of the ranks, in the order in which they are factored.
    ranks: Vec<f64>,
    rank_starts: Vec<usize>,
    rank_exchanges: Vec<Exchanges>,
    lu: BlockedLu,
    z: Vec<f64>,
}

/// Two sibling clusters: their sizes and the factors of the blocks in their rows.
struct Pair<'a> {
    y_a: MatRef<'a, f64>,
    v_a: MatRef<'a, f64>,
    y_b: MatRef<'a, f64>,
    v_b: MatRef<'a, f64>,
}

impl<'a> Pair<'a> {
    /// From the factors of its level and those below, which begin at `begin` among all.
    fn of(shape: &Shape, level: u32, pair: usize, factors: &'a [f64], begin: usize) -> Self {
        let siblings = [2 * pair, 2 * pair + 1];
        let [a, b] = siblings.map(|j| shape.cluster(level, j).len());
        let [of_a, of_b] = siblings.map(|j| shape.block(level, j));
        let view = |at: usize, rows: usize, rank: usize| {
            let at = at - begin;
            MatRef::from_column_major_slice(&factors[at..at + rows * rank], rows, rank)
        };
        Self {
            y_a: view(of_a.u, a, of_a.rank),
            v_a: view(of_a.v, b, of_a.rank),
            y_b: view(of_b.u, b, of_b.rank),
            v_b: view(of_b.v, a, of_b.rank),
        }
    }

    /// Order of the system of its ranks.
    fn order(&self) -> usize {
        self.y_a.ncols() + self.y_b.ncols()
    }

    /// Writes the system of its ranks.
    fn assemble(&self, mut system: MatMut<'_, f64>) {
        let first = self.y_b.ncols();
        system.fill(0.0);
        system.rb_mut().diagonal_mut().column_vector_mut().fill(1.0);
        let (_, upper, lower, _) = system.split_at_mut(first, first);
        let (accum, par) = (Accum::Replace, Par::Seq);
        matmul(upper, accum, self.v_b.transpose(), self.y_a, 1.0, par);
        matmul(lower, accum, self.v_a.transpose(), self.y_b, 1.0, par);
    }

    /// Overwrites D^-1 f of both clusters with the solution.
    fn reduce(
        &self,
        lu: &mut BlockedLu,
        z: &mut Vec<f64>,
        factors: MatRef<'_, f64>,
        exchanges: &Exchanges,
        target: MatMut<'_, f64>,
    ) {
        let (order, columns, first) = (self.order(), target.ncols(), self.y_b.ncols());
        if order == 0 || columns == 0 {
            return;
        }
        let (mut top, mut bottom) = target.split_at_row_mut(self.y_a.nrows());
        z.clear();
        z.resize(order * columns, 0.0);
        let mut z = MatMut::from_column_major_slice_mut(z, order, columns);
        let (mut z_b, mut z_a) = z.rb_mut().split_at_row_mut(first);
        let (replace, add, par) = (Accum::Replace, Accum::Add, Par::Seq);
        matmul(
            z_b.rb_mut(),
            replace,
            self.v_b.transpose(),
            top.rb(),
            1.0,
            par,
        );
        matmul(
            z_a.rb_mut(),
            replace,
            self.v_a.transpose(),
            bottom.rb(),
            1.0,
            par,
        );
        lu.solve(factors, exchanges, z.rb_mut());
        let (z_b, z_a) = z.rb().split_at_row(first);
        matmul(top.rb_mut(), add, self.y_a, z_a, -1.0, par);
        matmul(bottom.rb_mut(), add, self.y_b, z_b, -1.0, par);
    }
}

impl HodlrLu {
    /// The matrix to be approximated, as one that is not symmetric, and factored then.
    pub(crate) fn matrix(&mut self) -> &mut Hodlr {
        &mut self.matrix
    }

    /// Factors the matrix and overwrites right-hand sides, by columns, with the solutions. Where it is singular, these are not
    /// finite.
    pub(crate) fn factor(&mut self, rhs: &mut [f64]) {
        let Self {
            matrix,
            leaf_exchanges,
            ranks,
            rank_starts,
            rank_exchanges,
            lu,
            z,
        } = self;
        let Hodlr {
            shape,
            leaves,
            factors,
            level_starts,
            ..
        } = matrix;
        let columns = rhs.len() / shape.order.max(1);
        let mut rhs = MatMut::from_column_major_slice_mut(rhs, shape.order, columns);
        leaf_exchanges.resize(1 << shape.levels, Exchanges::default());
        let mut begin = 0;
        for (number, exchanges) in leaf_exchanges.iter_mut().enumerate() {
            let rows = shape.cluster(shape.levels, number);
            let n = rows.len();
            let leaf = &mut leaves[begin..begin + n * n];
            begin += n * n;
            let mut leaf = MatMut::from_column_major_slice_mut(leaf, n, n);
            lu.factor(leaf.rb_mut(), exchanges);
            for_each_ancestor(shape, shape.levels, number, factors, |u| {
                lu.solve(leaf.rb(), exchanges, u);
            });
            let rhs = rhs.rb_mut().subrows_mut(rows.start, n);
            lu.solve(leaf.rb(), exchanges, rhs);
        }
        ranks.clear();
        rank_starts.clear();
        rank_exchanges.resize((1 << shape.levels) - 1, Exchanges::default());
        let mut next = rank_exchanges.iter_mut();
        for level in (1..=shape.levels).rev() {
            let start = level_starts[level as usize - 1];
            let (above, own) = factors.split_at_mut(start);
            for (number, exchanges) in (0..1 << (level - 1)).zip(&mut next) {
                let pair = Pair::of(shape, level, number, own, start);
                let (order, at) = (pair.order(), ranks.len());
                rank_starts.push(at);
                ranks.resize(at + order * order, 0.0);
                let mut system =
                    MatMut::from_column_major_slice_mut(&mut ranks[at..], order, order);
                pair.assemble(system.rb_mut());
                lu.factor(system.rb_mut(), exchanges);
                let system = system.rb();
                for_each_ancestor(shape, level - 1, number, above, |u| {
                    pair.reduce(lu, z, system, exchanges, u);
                });
                let rows = shape.cluster(level - 1, number);
                let rhs = rhs.rb_mut().subrows_mut(rows.start, rows.len());
                pair.reduce(lu, z, system, exchanges, rhs);
            }
        }
    }

    /// Overwrites a right-hand side with the solution.
    pub(crate) fn solve(&mut self, rhs: &mut [f64]) {
        let Self {
            matrix,
            leaf_exchanges,
            ranks,
            rank_starts,
            rank_exchanges,
            lu,
            z,
        } = self;
        let Hodlr {
            shape,
            leaves,
            factors,
            ..
        } = matrix;
        let mut rhs = MatMut::from_column_major_slice_mut(rhs, shape.order, 1);
        let mut begin = 0;
        for (number, exchanges) in leaf_exchanges.iter().enumerate() {
            let rows = shape.cluster(shape.levels, number);
            let n = rows.len();
            let leaf = MatRef::from_column_major_slice(&leaves[begin..begin + n * n], n, n);
            begin += n * n;
            lu.solve(leaf, exchanges, rhs.rb_mut().subrows_mut(rows.start, n));
        }
        let mut systems = rank_starts.iter().zip(&*rank_exchanges);
        for level in (1..=shape.levels).rev() {
            for (number, (at, exchanges)) in (0..1 << (level - 1)).zip(&mut systems) {
                let pair = Pair::of(shape, level, number, factors, 0);
                let order = pair.order();
                let system = &ranks[*at..at + order * order];
                let system = MatRef::from_column_major_slice(system, order, order);
                let rows = shape.cluster(level - 1, number);
                let rhs = rhs.rb_mut().subrows_mut(rows.start, rows.len());
                pair.reduce(lu, z, system, exchanges, rhs);
            }
        }
    }
}

/// Gives the rows that a cluster has of U of the blocks of all clusters that hold it, itself included.
fn for_each_ancestor(
    shape: &Shape,
    level: u32,
    number: usize,
    factors: &mut [f64],
    mut apply: impl FnMut(MatMut<'_, f64>),
) {
    let rows = shape.cluster(level, number);
    for above in 1..=level {
        let ancestor = number >> (level - above);
        let whole = shape.cluster(above, ancestor);
        let block = shape.block(above, ancestor);
        let u = &mut factors[block.u..block.u + whole.len() * block.rank];
        let u = MatMut::from_column_major_slice_mut(u, whole.len(), block.rank);
        apply(u.subrows_mut(rows.start - whole.start, rows.len()));
    }
}

#[cfg(test)]
mod tests;
