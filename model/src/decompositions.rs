//! Eigenvalues and singular values of small matrices: searches that always end, try several ways, and return None where all of them fail.

use nalgebra::allocator::Allocator;
use nalgebra::linalg::Schur;
use nalgebra::{
    Complex, ComplexField, DefaultAllocator, Dim, DimDiff, DimMin, DimMinimum, DimSub, OMatrix, OVector, SVD, U1,
};

/// Errors of the searches that are tried one after another \[1]: rounding first, and more only where nothing else converges.
const ERRORS: [f64; 4] = [f64::EPSILON, 1e-14, 1e-12, 1e-10];

/// Maximum number of iterations of one search: a Schur form of so few numbers takes about 30.
const ITERATIONS: usize = 500;

/// Each error is tried with the matrix itself, and then with so many reflections of it.
const REFLECTIONS: usize = 8;

/// What is added to all eigenvalues, over the largest entry \[1]: nothing first.
const SHIFTS: [f64; 3] = [0.0, 0.5, -0.3];

/// The eigenvalues of a matrix, in the matrix's unit. None where no search converges, or an entry is not finite.
///
/// nalgebra's QR iteration has no exceptional shifts: of matrices with symmetric spectra, as those of undamped rotors, it may go in circles. A
/// reflection has the same eigenvalues and leads it elsewhere. And it compares what it leaves out with the eigenvalues beside that, which may
/// be 0, several times, where nothing holds a rotor: of the matrix and a multiple of the identity none is.
pub fn eigenvalues<D>(matrix: &OMatrix<f64, D, D>) -> Option<OVector<Complex<f64>, D>>
where
    D: Dim + DimSub<U1>,
    DefaultAllocator: Allocator<D, D> + Allocator<D> + Allocator<D, DimDiff<D, U1>> + Allocator<DimDiff<D, U1>>,
{
    if !matrix.iter().all(|entry| entry.is_finite()) {
        return None;
    }
    let tried = ERRORS.into_iter().flat_map(|error| {
        let of_shift = move |shift: f64| (0..=REFLECTIONS).map(move |number| (error, shift, number));
        SHIFTS.into_iter().flat_map(of_shift)
    });
    let largest = matrix.amax();
    let mut found = tried.filter_map(|(error, share, number)| {
        let (mut shifted, shift) = (matrix.clone(), share * largest);
        (0..matrix.nrows()).for_each(|n| shifted[(n, n)] += shift);
        let form = Schur::try_new(reflected(&shifted, number), error, ITERATIONS)?;
        Some(form.complex_eigenvalues().map(|value| value - Complex::from(shift)))
    });
    found.next()
}

/// The matrix as H A H, H being a fixed reflection with this number; that with number 0 is the matrix itself.
fn reflected<D: Dim>(matrix: &OMatrix<f64, D, D>, number: usize) -> OMatrix<f64, D, D>
where
    DefaultAllocator: Allocator<D, D> + Allocator<D>,
{
    let mut reflected = matrix.clone();
    if number == 0 {
        return reflected;
    }
    // Whole numbers without a pattern: the same bits everywhere.
    let entry = |n: usize| (1 + (n * n * 5 + n * number * 3 + number) % 11) as f64;
    let size = matrix.nrows();
    let twice = 2.0 / (0..size).map(|n| entry(n) * entry(n)).sum::<f64>();
    for column in 0..size {
        let along = twice * (0..size).map(|row| entry(row) * reflected[(row, column)]).sum::<f64>();
        (0..size).for_each(|row| reflected[(row, column)] -= entry(row) * along);
    }
    for row in 0..size {
        let along = twice * (0..size).map(|column| entry(column) * reflected[(row, column)]).sum::<f64>();
        (0..size).for_each(|column| reflected[(row, column)] -= entry(column) * along);
    }
    reflected
}

/// The singular values of a matrix with both sets of vectors. None where no search converges, or an entry is not finite.
pub fn singular_values<T, R, C>(matrix: &OMatrix<T, R, C>) -> Option<SVD<T, R, C>>
where
    T: ComplexField<RealField = f64>,
    R: Dim + DimMin<C>,
    C: Dim,
    DimMinimum<R, C>: DimSub<U1>,
    DefaultAllocator: Allocator<R, C>
        + Allocator<R>
        + Allocator<C>
        + Allocator<DimMinimum<R, C>>
        + Allocator<DimMinimum<R, C>, C>
        + Allocator<R, DimMinimum<R, C>>
        + Allocator<DimDiff<DimMinimum<R, C>, U1>>,
{
    if !matrix.iter().all(|entry| entry.is_finite()) {
        return None;
    }
    ERRORS.into_iter().find_map(|error| SVD::try_new(matrix.clone(), true, true, 5.0 * error, 2 * ITERATIONS))
}
