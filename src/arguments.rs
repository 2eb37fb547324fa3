//! Arrays, places and strings of a host: what is null or cannot be is refused, and what it lends to be written is never
//! read, since nobody need have initialised it.
#![allow(unsafe_code)]

use crate::instance::{Failure, Room};
use std::ffi::{CStr, c_char};
use std::mem::MaybeUninit;

/// Whether `n` values of type T can stand at `first`.
fn check_array<T>(first: *const T, n: usize, what: &str) -> Result<(), Failure> {
    if first.is_null() {
        return Err(Failure::Error(format!("{what} is a null pointer")));
    }
    if n > isize::MAX as usize / size_of::<T>() {
        return Err(Failure::Error(format!("{n} of {what} cannot be")));
    }
    Ok(())
}

/// `n` values to read.
///
/// # Safety
/// `first` is null or points to `n` values that nobody writes while they are used.
pub unsafe fn values<'a, T>(first: *const T, n: usize, what: &str) -> Result<&'a [T], Failure> {
    if n == 0 {
        return Ok(&[]);
    }
    check_array(first, n, what)?;
    // SAFETY: see above.
    Ok(unsafe { std::slice::from_raw_parts(first, n) })
}

/// Room for `n` values.
///
/// # Safety
/// `first` is null or points to room for `n` values that nobody else uses meanwhile.
pub unsafe fn room<'a, T>(first: *mut T, n: usize, what: &str) -> Result<Room<'a, T>, Failure> {
    if n == 0 {
        return Ok(&mut []);
    }
    check_array(first, n, what)?;
    // SAFETY: see above; what is not initialised may stand in a MaybeUninit.
    Ok(unsafe { std::slice::from_raw_parts_mut(first.cast(), n) })
}

/// Room for one value.
///
/// # Safety
/// As [`room`].
pub unsafe fn place<'a, T>(place: *mut T, what: &str) -> Result<&'a mut MaybeUninit<T>, Failure> {
    check_array(place, 1, what)?;
    // SAFETY: see above.
    Ok(unsafe { &mut *place.cast() })
}

/// A C string.
///
/// # Safety
/// `text` is null or points to a string that ends with a zero and outlives its use.
pub unsafe fn text<'a>(text: *const c_char, what: &str) -> Result<&'a CStr, Failure> {
    check_array(text, 1, what)?;
    // SAFETY: see above.
    Ok(unsafe { CStr::from_ptr(text) })
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::instance::fill;

    #[test]
    fn what_a_host_lends_may_be_uninitialised() {
        // Neither the types nor the calls let anything be read from it.
        let mut lent = [const { MaybeUninit::<f64>::uninit() }; 3];
        let first = lent.as_mut_ptr().cast::<f64>();
        // SAFETY: room for three values, which only this thread uses.
        let places: &mut [MaybeUninit<f64>] = unsafe { room(first, 2, "value") }.expect("it is not null");
        fill(places, &[1.0, 2.0]);
        // SAFETY: the first two were written.
        assert_eq!(unsafe { [lent[0].assume_init(), lent[1].assume_init()] }, [1.0, 2.0]);
        // SAFETY: null, or no room at all, which is not looked at.
        let refusals = unsafe {
            assert_eq!(room::<f64>(std::ptr::null_mut(), 0, "value").expect("nothing is asked for").len(), 0);
            let null = room::<f64>(std::ptr::null_mut(), 1, "value").expect_err("it is null");
            [null, room(first, usize::MAX / 8, "value").expect_err("so much cannot be")]
        };
        let [Failure::Error(null), Failure::Error(much)] = refusals else { panic!("{refusals:?}") };
        assert_eq!(null, "value is a null pointer");
        assert!(much.ends_with("of value cannot be"), "{much}");
    }
}
