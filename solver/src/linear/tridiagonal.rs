//! Symmetric positive definite tridiagonal systems.

/// Solves A x = b by the factorization A = L D L^T; the diagonal is overwritten by D, b by x. The first and last entries
/// beside the diagonal are `beside[0]` and `beside[n - 2]` for n unknowns.
pub(crate) fn solve_tridiagonal(diagonal: &mut [f64], beside: &[f64], b: &mut [f64]) {
    for i in 1..b.len() {
        let factor = beside[i - 1] / diagonal[i - 1];
        diagonal[i] -= factor * beside[i - 1];
        b[i] -= factor * b[i - 1];
    }
    let mut next = 0.0;
    for i in (0..b.len()).rev() {
        let coupled = beside.get(i).map_or(0.0, |beside| beside * next);
        b[i] = (b[i] - coupled) / diagonal[i];
        next = b[i];
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_solution_satisfies_the_system() {
        let (diagonal, beside) = ([4.0, 3.0, 5.0, 2.0], [-1.0, 0.5, -1.5]);
        let x = [1.0, -2.0, 0.5, 3.0];
        let mut b = [0.0; 4];
        for i in 0..4 {
            b[i] += diagonal[i] * x[i];
            if i < 3 {
                b[i] += beside[i] * x[i + 1];
                b[i + 1] += beside[i] * x[i];
            }
        }
        solve_tridiagonal(&mut diagonal.clone(), &beside, &mut b);
        assert!(b.iter().zip(x).all(|(b, x)| (b - x).abs() < 1e-14));
        let mut single = [6.0];
        solve_tridiagonal(&mut [3.0], &[], &mut single);
        assert!((single[0] - 2.0).abs() < 1e-15);
    }
}
