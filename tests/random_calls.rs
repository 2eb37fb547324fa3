//! Random sequences of calls: `calls` makes and checks them, the fuzz target in `fuzz/` makes a million more.
#![allow(unsafe_code, reason = "the exported functions are those of a C interface")]

mod calls;
mod harness;

use proptest::collection::vec;
use proptest::prelude::*;
use proptest::test_runner::{RngSeed, TestError, TestRunner};

/// So many sequences on each of so many threads.
const SEQUENCES: u32 = 10_000;
const THREADS: u64 = 2;

/// The longest sequence, in bytes; a call takes some five.
const LONGEST: usize = 300;

fn play_many(seed: u64) {
    let config = ProptestConfig {
        cases: SEQUENCES,
        rng_seed: RngSeed::Fixed(seed),
        failure_persistence: None,
        ..ProptestConfig::default()
    };
    let outcome = TestRunner::new(config).run(&vec(any::<u8>(), 0..LONGEST), |bytes| {
        calls::play(&bytes);
        Ok(())
    });
    match outcome {
        Ok(()) => {}
        Err(TestError::Fail(reason, bytes)) => panic!("{reason}\ncalls::play(&{bytes:?})"),
        Err(abort) => panic!("{abort}"),
    }
}

#[test]
fn fmi_random_calls_keep_the_rules() {
    std::thread::scope(|scope| {
        for seed in 1..=THREADS {
            scope.spawn(move || play_many(seed));
        }
    });
}
