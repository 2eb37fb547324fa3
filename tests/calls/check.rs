//! One call, and everything that must hold of it whatever it is.

use super::Actor;
use crate::harness::{Instance, Life, Record};
use split_rotor::abi::{Choice, Status};
use std::cell::RefCell;
use std::collections::BTreeMap;

/// What is known of a call beforehand.
pub struct Told {
    /// Its function.
    pub function: &'static str,
    /// What it may return, if it is legal where the instance stands.
    pub may: &'static [Status],
}

pub const OK: &[Status] = &[Status::Ok];
pub const ERROR: &[Status] = &[Status::Error];
pub const OK_OR_DISCARD: &[Status] = &[Status::Ok, Status::Discard];
pub const ANY: &[Status] = &[Status::Ok, Status::Discard, Status::Error];
pub const DISCARD: &[Status] = &[Status::Discard];

/// How often the present thread saw a function return a status, by kind and stage of the instance.
pub type Tally = BTreeMap<(&'static str, Choice, u8, Status), u32>;

thread_local! {
    static TALLY: RefCell<Tally> = const { RefCell::new(Tally::new()) };
}

/// The tally so far; a new one begins.
pub fn take_tally() -> Tally {
    TALLY.take()
}

fn count(function: &'static str, Life { kind, stage }: Life, status: Status) {
    TALLY.with_borrow_mut(|tally| *tally.entry((function, kind, stage as u8, status)).or_default() += 1);
}

/// Makes the call; it returns what it may, tells so, and a refusal changes nothing.
pub fn call(actor: &mut Actor, told: &Told, call: impl FnOnce(&mut Instance) -> Status) -> Status {
    let Actor { instance, mind } = actor;
    let may = if mind.allows(told.function) { told.may } else { ERROR };
    let before = (may != OK).then(|| instance.serialized());
    instance.journal.take();
    let status = call(instance);
    count(told.function, mind.memory.life, status);
    let records = instance.journal.take();
    let shown = || format!("{} in {:?}: {status:?}, {records:?}", told.function, mind.memory.life);
    assert!(may.contains(&status), "{}, not one of {may:?}", shown());
    if status == Status::Error {
        assert!(before == Some(instance.serialized()), "a refusal changed something: {}", shown());
    }
    let lines = |status: Status| records.iter().filter(|record| record.status == status).count();
    let expected = |of: Status, hears: bool| usize::from(status == of && hears);
    assert_eq!(lines(Status::Error), expected(Status::Error, mind.hears_errors), "{}", shown());
    assert_eq!(lines(Status::Discard), expected(Status::Discard, mind.hears_discards), "{}", shown());
    assert_eq!(lines(Status::Fatal), 0, "{}", shown());
    for record in &records {
        check_record(record, told.function);
    }
    status
}

fn check_record(record: &Record, function: &str) {
    let is_failure = matches!(record.status, Status::Error | Status::Discard);
    let rest = record.message.strip_prefix(function).and_then(|rest| rest.strip_prefix(": "));
    assert!(!is_failure || rest.is_some_and(|rest| !rest.is_empty()), "{function} must be named: {record:?}");
    assert!(!record.message.replace("%%", "").contains('%'), "a format: {record:?}");
}
