//! Random sequences of calls: `calls` makes and checks them, the fuzz target in `fuzz/` makes a million more.

use crate::calls::{self, Tally};
use crate::harness::{Life, RULES, Stage};
use proptest::collection::vec;
use proptest::prelude::*;
use proptest::test_runner::{RngSeed, TestError, TestRunner};
use split_rotor::abi::{CO_SIMULATION, MODEL_EXCHANGE, Status};

/// So many sequences on each of so many threads.
const SEQUENCES: u32 = 10_000;
const THREADS: u64 = 2;

/// The longest sequence, in bytes; a call takes some five.
const LONGEST: usize = 600;

fn play_many(seed: u64) {
    let config = ProptestConfig {
        cases: SEQUENCES,
        rng_seed: RngSeed::Fixed(seed),
        failure_persistence: None,
        // What fails may be slow.
        max_shrink_time: 30_000,
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
    let tallies: Vec<_> = std::thread::scope(|scope| {
        let threads: Vec<_> = (1..=THREADS)
            .map(|seed| {
                scope.spawn(move || {
                    play_many(seed);
                    calls::take_tally()
                })
            })
            .collect();
        threads.into_iter().map(|thread| thread.join().expect("told above")).collect()
    });
    let mut all = Tally::new();
    tallies.into_iter().flatten().for_each(|(seen, count)| *all.entry(seen).or_default() += count);
    check_reach(&all);
}

/// Every function is called often in every state of both kinds, and answers where it should: the random calls reach all
/// there is.
fn check_reach(tally: &Tally) {
    const OFTEN: u32 = 5;
    let unanswered = ["fmi2CancelStep", "fmi2GetIntegerStatus", "fmi2GetStringStatus"];
    for (life, rule) in Life::EACH.into_iter().flat_map(|life| RULES.iter().map(move |rule| (life, rule))) {
        let expected = if life.allows(rule) && !unanswered.contains(&rule.name) { Status::Ok } else { Status::Error };
        let count = tally.get(&(rule.name, life.kind, life.stage as u8, expected)).copied().unwrap_or_default();
        assert!(count >= OFTEN, "{} returned {expected:?} {count} times in {life:?}", rule.name);
    }
    for (function, life) in [
        ("fmi2DoStep", Life::new(CO_SIMULATION, Stage::StepComplete)),
        ("fmi2DoStep", Life::new(CO_SIMULATION, Stage::StepFailed)),
        ("fmi2GetReal", Life::new(MODEL_EXCHANGE, Stage::ContinuousTime)),
        ("fmi2GetDerivatives", Life::new(MODEL_EXCHANGE, Stage::ContinuousTime)),
        ("fmi2SetContinuousStates", Life::new(MODEL_EXCHANGE, Stage::ContinuousTime)),
    ] {
        let count = tally.get(&(function, life.kind, life.stage as u8, Status::Discard)).copied().unwrap_or_default();
        assert!(count >= OFTEN, "{function} returned Discard {count} times in {life:?}");
    }
}
