//! Systems of N linear equations: Gauss's elimination with partial pivoting (Golub and Van Loan, Matrix Computations, 3.4).

use nalgebra::{ClosedDivAssign, ClosedMulAssign, ClosedSubAssign, Complex};
use std::ops::Range;

/// A number that equations may be written in.
pub trait Number: Copy + ClosedSubAssign + ClosedMulAssign + ClosedDivAssign {
    /// By which pivots are compared.
    fn size(self) -> f64;
}

impl Number for f64 {
    fn size(self) -> f64 {
        self.abs()
    }
}

impl Number for Complex<f64> {
    fn size(self) -> f64 {
        self.re.abs() + self.im.abs()
    }
}

/// A matrix as the product of a lower and an upper triangle, its rows exchanged.
pub struct Lu<T, const N: usize> {
    /// Both triangles; the lower one has ones on its diagonal.
    rows: [[T; N]; N],
    /// So many columns come first; in the others only the diagonal is not zero.
    size: usize,
    /// Which row came to each place.
    from: [usize; N],
}

impl<T: Number, const N: usize> Lu<T, N> {
    /// Of a matrix, given by its rows, whose columns from `size` on are zero but for the diagonal: quadratures take no more
    /// than a row each. A singular one solves nothing: what it gives is not finite.
    pub fn new(mut rows: [[T; N]; N], size: usize) -> Self {
        let mut from: [usize; N] = std::array::from_fn(|n| n);
        for step in 0..size {
            let reach = |row: &usize| rows[*row][step].size();
            let largest = (step..size).max_by(|a, b| reach(a).total_cmp(&reach(b))).expect("a row is left");
            rows.swap(step, largest);
            from.swap(step, largest);
            let (done, rest) = rows.split_at_mut(step + 1);
            let pivot = &done[step];
            for row in rest {
                let factor = row[step] / pivot[step];
                row[step] = factor;
                if factor.size() != 0.0 {
                    for column in step + 1..size {
                        row[column] -= factor * pivot[column];
                    }
                }
            }
        }
        Self { rows, size, from }
    }

    /// x where the matrix times x is b.
    pub fn solve(&self, b: &[T; N]) -> [T; N] {
        let mut x = self.from.map(|row| b[row]);
        for n in 1..N {
            x[n] = self.less(x[n], n, &x, 0..n.min(self.size));
        }
        for n in (0..N).rev() {
            x[n] = self.less(x[n], n, &x, n + 1..self.size);
            x[n] /= self.rows[n][n];
        }
        x
    }

    /// What is left of `b` less the part of this row over these columns.
    #[inline(always)]
    fn less(&self, mut b: T, row: usize, x: &[T; N], columns: Range<usize>) -> T {
        if columns.start < columns.end {
            for (entry, known) in self.rows[row][columns.clone()].iter().zip(&x[columns]) {
                b -= *entry * *known;
            }
        }
        b
    }
}
