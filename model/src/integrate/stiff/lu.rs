//! Systems of N linear equations: Gauss's elimination with partial pivoting (Golub and Van Loan, Matrix Computations, 3.4).

use nalgebra::{ClosedDivAssign, ClosedMulAssign, ClosedSubAssign, Complex};

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
    /// Which row came to each place.
    from: [usize; N],
}

impl<T: Number, const N: usize> Lu<T, N> {
    /// Of a matrix, given by its rows. A singular one solves nothing: what it gives is not finite.
    pub fn new(mut rows: [[T; N]; N]) -> Self {
        let mut from: [usize; N] = std::array::from_fn(|n| n);
        for step in 0..N {
            let size = |row: &usize| rows[*row][step].size();
            let largest = (step..N).max_by(|a, b| size(a).total_cmp(&size(b))).expect("a row is left");
            rows.swap(step, largest);
            from.swap(step, largest);
            let (done, rest) = rows.split_at_mut(step + 1);
            let pivot = &done[step];
            for row in rest {
                let factor = row[step] / pivot[step];
                row[step] = factor;
                if factor.size() != 0.0 {
                    for column in step + 1..N {
                        row[column] -= factor * pivot[column];
                    }
                }
            }
        }
        Self { rows, from }
    }

    /// x where the matrix times x is b.
    pub fn solve(&self, b: &[T; N]) -> [T; N] {
        let mut x = self.from.map(|row| b[row]);
        for n in 1..N {
            for i in 0..n {
                let known = x[i];
                x[n] -= self.rows[n][i] * known;
            }
        }
        for n in (0..N).rev() {
            for i in n + 1..N {
                let known = x[i];
                x[n] -= self.rows[n][i] * known;
            }
            x[n] /= self.rows[n][n];
        }
        x
    }
}
