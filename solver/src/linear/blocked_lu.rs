//! LU factorisation with partial pivoting in place of larger dense blocks, by the library's blocked elimination.

use faer::dyn_stack::{MemBuffer, MemStack};
use faer::linalg::lu::partial_pivoting::{factor, solve};
use faer::perm::PermRef;
use faer::{Conj, MatMut, MatRef, Par, Spec};

/// Working memory for blocks up to an order; grows with the largest.
#[derive(Default)]
pub(super) struct BlockedLu {
    /// Largest order or number of right-hand sides that the memory serves.
    largest: usize,
    memory: Option<MemBuffer>,
}

/// Row exchanges of a factored block, and their inverse.
#[derive(Debug, Default, Clone)]
pub(super) struct Exchanges {
    pub(super) forward: Vec<usize>,
    backward: Vec<usize>,
}

impl BlockedLu {
    /// Overwrites a block with its factors. Where it is singular, solutions are not finite.
    pub(super) fn factor(&mut self, mut block: MatMut<'_, f64>, exchanges: &mut Exchanges) {
        let order = block.nrows();
        let Exchanges { forward, backward } = exchanges;
        forward.resize(order, 0);
        backward.resize(order, 0);
        let stack = MemStack::new(self.memory(order, 1));
        let spec = Spec::default();
        factor::lu_in_place(block.as_mut(), forward, backward, Par::Seq, stack, spec);
    }

    /// Overwrites right-hand sides with the solutions for a factored block.
    pub(super) fn solve(
        &mut self,
        factors: MatRef<'_, f64>,
        exchanges: &Exchanges,
        rhs: MatMut<'_, f64>,
    ) {
        let order = factors.nrows();
        let rows = PermRef::new_checked(&exchanges.forward, &exchanges.backward, order);
        let stack = MemStack::new(self.memory(order, rhs.ncols()));
        solve::solve_in_place_with_conj(factors, factors, rows, Conj::No, rhs, Par::Seq, stack);
    }

    fn memory(&mut self, order: usize, columns: usize) -> &mut MemBuffer {
        let needed = order.max(columns);
        if needed > self.largest {
            (self.largest, self.memory) = (needed, None);
        }
        self.memory.get_or_insert_with(|| {
            let spec = Spec::default();
            let n = self.largest;
            let factor = factor::lu_in_place_scratch::<usize, f64>(n, n, Par::Seq, spec);
            let solve = solve::solve_in_place_scratch::<usize, f64>(n, n, Par::Seq);
            MemBuffer::new(factor.or(solve))
        })
    }
}
