//! What an error is held against.

/// The largest, or NaN where there is one.
pub fn largest(values: impl IntoIterator<Item = f64>) -> f64 {
    values.into_iter().fold(0.0, |most, value| if value > most || value.is_nan() { value } else { most })
}

/// Asserts measured ≤ allowed (NaN fails); `cargo test -- --nocapture` shows what was measured.
#[track_caller]
pub fn within(what: &str, measured: f64, allowed: f64) {
    println!("{what}: measured {measured:.2e}, allowed {allowed:.1e}");
    assert!(measured <= allowed, "{what}: measured {measured:e}, allowed {allowed:e}");
}
