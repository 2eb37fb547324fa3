//! What a run remembers, as a row of numbers: written down once, by the same walk that reads it back. (serde derives nothing for arrays
//! whose length is generic.)

use nalgebra::SMatrix;

/// Walks past every number that somebody remembers: to write it down, or to put another in its place.
pub trait Walk {
    /// Past one number.
    fn number(&mut self, number: &mut f64) -> Result<(), Damaged>;
}

/// The numbers are too few, or mean nothing.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Damaged;

/// Something whose numbers can be walked past.
pub trait Stored {
    /// Shows each number that it holds, in the same order always.
    fn walk(&mut self, walk: &mut impl Walk) -> Result<(), Damaged>;
}

/// Shows the fields of a struct, which must all be named: a new one cannot be forgotten.
macro_rules! stored {
    ($type:ident<$generic:ident: $bound:ident> { $($field:ident),* $(,)? }) => {
        $crate::stored::stored!(@ [$generic: $bound], $type<$generic>, $($field)*);
    };
    ($type:ident<$generic:ident: $bound:ident, const $n:ident: usize> { $($field:ident),* $(,)? }) => {
        $crate::stored::stored!(@ [$generic: $bound, const $n: usize], $type<$generic, $n>, $($field)*);
    };
    ($type:ident<const $n:ident: usize> { $($field:ident),* $(,)? }) => {
        $crate::stored::stored!(@ [const $n: usize], $type<$n>, $($field)*);
    };
    ($type:ident { $($field:ident),* $(,)? }) => {
        $crate::stored::stored!(@ [], $type, $($field)*);
    };
    (@ [$($generics:tt)*], $type:ty, $($field:ident)*) => {
        impl<$($generics)*> $crate::stored::Stored for $type {
            fn walk(&mut self, walk: &mut impl $crate::stored::Walk) -> Result<(), $crate::stored::Damaged> {
                let Self { $($field),* } = self;
                $($crate::stored::Stored::walk($field, walk)?;)*
                Ok(())
            }
        }
    };
}

pub(crate) use stored;

/// Shows one of a few things as its number in `these`, counted from 0.
pub fn choice<T: Copy + PartialEq>(chosen: &mut T, these: &[T], walk: &mut impl Walk) -> Result<(), Damaged> {
    let mut number = these.iter().position(|one| one == chosen).map_or(f64::NAN, |number| number as f64);
    number.walk(walk)?;
    *chosen = *(0..).map(f64::from).zip(these).find(|(one, _)| *one == number).ok_or(Damaged)?.1;
    Ok(())
}

/// Shows a whole number of either sign.
pub fn whole(number: &mut f64, walk: &mut impl Walk) -> Result<(), Damaged> {
    number.walk(walk)?;
    // Of what is not finite, nothing is left over that could be compared.
    if *number % 1.0 == 0.0 { Ok(()) } else { Err(Damaged) }
}

/// Shows a number that counts something, and has room to count on by ones.
pub fn count(number: &mut f64, walk: &mut impl Walk) -> Result<(), Damaged> {
    const MOST: f64 = (1_u64 << 52) as f64;
    whole(number, walk)?;
    if (0.0..=MOST).contains(number) { Ok(()) } else { Err(Damaged) }
}

impl Stored for f64 {
    fn walk(&mut self, walk: &mut impl Walk) -> Result<(), Damaged> {
        walk.number(self)
    }
}

impl Stored for u32 {
    fn walk(&mut self, walk: &mut impl Walk) -> Result<(), Damaged> {
        let mut number = f64::from(*self);
        number.walk(walk)?;
        *self = number as u32;
        if f64::from(*self) == number { Ok(()) } else { Err(Damaged) }
    }
}

impl Stored for bool {
    fn walk(&mut self, walk: &mut impl Walk) -> Result<(), Damaged> {
        choice(self, &[false, true], walk)
    }
}

impl<T: Stored, const N: usize> Stored for [T; N] {
    fn walk(&mut self, walk: &mut impl Walk) -> Result<(), Damaged> {
        self.iter_mut().try_for_each(|one| one.walk(walk))
    }
}

impl<A: Stored, B: Stored> Stored for (A, B) {
    fn walk(&mut self, walk: &mut impl Walk) -> Result<(), Damaged> {
        self.0.walk(walk)?;
        self.1.walk(walk)
    }
}

impl<T: Stored + Default> Stored for Option<T> {
    fn walk(&mut self, walk: &mut impl Walk) -> Result<(), Damaged> {
        let mut is_some = self.is_some();
        is_some.walk(walk)?;
        if !is_some {
            *self = None;
            return Ok(());
        }
        self.get_or_insert_default().walk(walk)
    }
}

impl<const R: usize, const C: usize> Stored for SMatrix<f64, R, C> {
    fn walk(&mut self, walk: &mut impl Walk) -> Result<(), Damaged> {
        self.iter_mut().try_for_each(|one| one.walk(walk))
    }
}

/// All numbers as bytes, little-endian.
pub fn to_bytes(stored: &mut impl Stored) -> Vec<u8> {
    struct Writer(Vec<u8>);
    impl Walk for Writer {
        fn number(&mut self, number: &mut f64) -> Result<(), Damaged> {
            self.0.extend(number.to_le_bytes());
            Ok(())
        }
    }
    let mut writer = Writer(Vec::new());
    // What is in memory is whole: no walk past it fails.
    let _ = stored.walk(&mut writer);
    writer.0
}

/// Puts the numbers of [`to_bytes`] in place; an error where they are too few, too many, or mean nothing.
pub fn from_bytes(stored: &mut impl Stored, bytes: &[u8]) -> Result<(), Damaged> {
    struct Reader<'b>(std::slice::Iter<'b, [u8; 8]>);
    impl Walk for Reader<'_> {
        fn number(&mut self, number: &mut f64) -> Result<(), Damaged> {
            *number = f64::from_le_bytes(*self.0.next().ok_or(Damaged)?);
            Ok(())
        }
    }
    let (numbers, rest) = bytes.as_chunks();
    let mut reader = Reader(numbers.iter());
    stored.walk(&mut reader)?;
    if rest.is_empty() && reader.0.next().is_none() { Ok(()) } else { Err(Damaged) }
}
