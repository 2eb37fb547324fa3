//! One call, and everything that must hold of it whatever it is.

use super::Actor;
use crate::harness::{Instance, Record};
use split_rotor::abi::Status;

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

/// Makes the call; it returns what it may, tells so, and a refusal changes nothing.
pub fn call(actor: &mut Actor, told: &Told, call: impl FnOnce(&mut Instance) -> Status) -> Status {
    let Actor { instance, mind } = actor;
    let may = if mind.allows(told.function) { told.may } else { ERROR };
    let before = (may != OK).then(|| instance.serialized());
    instance.journal.take();
    let status = call(instance);
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
