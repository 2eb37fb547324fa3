//! FMU states as bytes: what follows has the same bits in another process (in this one: `state.rs`); what is damaged, or comes
//! from elsewhere, is refused.

use crate::harness::{Instance, Life, Saved, Traveller, inputs, only, reals, scene, tumbling};
use split_rotor::abi::{CO_SIMULATION, MODEL_EXCHANGE, Real, Status};
use split_rotor::scene::values;
use split_rotor_model::section::GUID;
use std::path::{Path, PathBuf};
use std::process::Command;

#[test]
#[cfg_attr(not(scene_has_support), ignore = "needs a scene with support")]
fn fmi_a_warning_comes_once_and_after_a_rollback_as_often_as_it_is_due() {
    let tumbling = tumbling();
    // At 30 rad/s the tilt exceeds π/2 after 0.0524 s; a solver that runs ahead knows before.
    let mut instance = Instance::quiet().started(&tumbling);
    let warnings = |instance: &mut Instance, from: u32, to: u32| {
        for n in from..to {
            assert_eq!(instance.do_step(f64::from(n) * 0.01, 0.01), Status::Ok);
        }
        instance.journal.take().iter().filter(|record| record.message.contains("the tilt")).count()
    };
    let early = instance.serialized();
    assert_eq!(warnings(&mut instance, 0, 8), 1);
    let late = instance.serialized();
    assert_eq!(warnings(&mut instance, 8, 10), 0);
    for mut instance in [instance, Instance::quiet()] {
        Saved::unpack(&instance, &late);
        assert_eq!(warnings(&mut instance, 8, 10), 0);
        Saved::unpack(&instance, &early);
        assert_eq!(warnings(&mut instance, 0, 10), 1);
    }
}

/// What tells this test program that it runs as another process: a folder that holds the bytes.
const CHILD: &str = "SPLIT_ROTOR_TEST_CHILD";

fn bytes_of(folder: &Path, n: usize) -> PathBuf {
    folder.join(format!("{n}.state"))
}

/// Text that tells every bit of a way.
fn told(mut traveller: Traveller) -> String {
    traveller.way_on().iter().map(|step| format!("{step:x?}\n")).collect()
}

#[test]
fn exact_what_follows_in_another_process_has_the_same_bits() {
    if let Some(folder) = std::env::var_os(CHILD) {
        return go_on_as_a_child(Path::new(&folder));
    }
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("states-{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("target can be written");
    let mut expected = Vec::new();
    for (n, traveller) in Traveller::all().enumerate() {
        std::fs::write(bytes_of(&folder, n), traveller.instance.serialized()).expect("target can be written");
        expected.push(told(traveller));
    }
    let own = std::env::current_exe().expect("it has a path");
    let name = "serialized::exact_what_follows_in_another_process_has_the_same_bits";
    let status = Command::new(own).args(["--exact", name]).env(CHILD, &folder).status().expect("it can be run");
    assert!(status.success(), "{status}");
    for (n, expected) in expected.iter().enumerate() {
        let found = std::fs::read_to_string(bytes_of(&folder, n)).expect("the child wrote it");
        assert!(found == *expected, "traveller {n} goes another way in another process");
    }
    std::fs::remove_dir_all(folder).expect("target can be written");
}

/// Writes the ways on in the place of the states.
fn go_on_as_a_child(folder: &Path) {
    for (n, mut traveller) in Traveller::all().enumerate() {
        // What this process has of its own is thrown away.
        traveller.instance = Instance::of(traveller.kind);
        let bytes = std::fs::read(bytes_of(folder, n)).expect("the parent wrote it");
        Saved::unpack(&traveller.instance, &bytes);
        std::fs::write(bytes_of(folder, n), told(traveller)).expect("target can be written");
    }
}

/// Offers bytes that must be refused with one log line in these words, and must change nothing; the pointer stays.
#[track_caller]
fn refused(instance: &Instance, own: &[u8], bytes: &[u8], words: &[&str]) {
    assert_eq!(Saved::read(instance, bytes).expect_err("it must be refused"), Status::Error);
    only(&instance.journal.take(), Status::Error, &[&["fmi2DeSerializeFMUstate: "], words].concat());
    assert!(instance.serialized() == own, "{words:?}: nothing changed");
}

/// Where the parts of a serialized state begin: magic, version, GUID, length of the numbers, numbers.
const VERSION: usize = 8;
const SCENE: usize = VERSION + 4;
const LENGTH: usize = SCENE + GUID;
const NUMBERS: usize = LENGTH + 8;
const CHECKSUM: usize = 4;

/// With the checksum that these bytes should have.
fn sealed(mut bytes: Vec<u8>) -> Vec<u8> {
    let end = bytes.len() - CHECKSUM;
    let sum = crc32fast::hash(&bytes[..end]);
    bytes[end..].copy_from_slice(&sum.to_le_bytes());
    bytes
}

#[test]
fn fmi_every_flipped_bit_and_every_cut_is_refused() {
    for life in Life::EACH {
        let instance = life.instance();
        let own = instance.serialized();
        assert!(own.len() > NUMBERS + CHECKSUM);
        for place in 0..own.len() {
            let mut bytes = own.clone();
            bytes[place] ^= 1 << (place % 8);
            let word = match place {
                0..VERSION => "not a serialized state",
                VERSION..SCENE => "version",
                SCENE..LENGTH => "another FMU",
                _ => "damaged",
            };
            refused(&instance, &own, &bytes, &[word]);
        }
        for length in 0..own.len() {
            refused(
                &instance,
                &own,
                &own[..length],
                &[if length < VERSION { "not a serialized state" } else { "damaged" }],
            );
        }
        for more in [1, 7, 8, 4096] {
            refused(&instance, &own, &[&own[..], &vec![0; more]].concat(), &["damaged"]);
        }
        refused(&instance, &own, &vec![0; own.len()], &["not a serialized state"]);
        // Two bytes changed for each other keep sums.
        for place in (LENGTH..own.len() - 1).step_by(7).filter(|place| own[*place] != own[place + 1]) {
            let mut bytes = own.clone();
            bytes.swap(place, place + 1);
            refused(&instance, &own, &bytes, &["damaged"]);
        }
        assert_eq!(life.future(instance), life.future(life.instance()), "{life:?}: the way on is the same");
    }
}

#[test]
fn fmi_states_of_other_versions_scenes_and_kinds_are_refused() {
    for life in Life::EACH {
        let instance = life.instance();
        let own = instance.serialized();
        assert_eq!(sealed(own.clone()), own, "the tests know the checksum");
        for version in [0_u32, 2, u32::MAX] {
            let mut bytes = own.clone();
            bytes[VERSION..SCENE].copy_from_slice(&version.to_le_bytes());
            refused(&instance, &own, &sealed(bytes), &[&format!("version {version}"), "reads version 5"]);
        }
        let other = "{00000000-0000-0000-0000-000000000000}";
        let mut bytes = own.clone();
        bytes[SCENE..LENGTH].copy_from_slice(other.as_bytes());
        refused(&instance, &own, &sealed(bytes), &[other, values().guid()]);
        for other in Life::EACH.into_iter().filter(|other| other.kind != life.kind) {
            let words =
                [format!("instance for {}", other.kind_name()), format!("this one is for {}", life.kind_name())];
            refused(&instance, &own, &other.instance().serialized(), &[&words[0], &words[1]]);
        }
    }
}

#[test]
fn fmi_whole_bytes_that_mean_nothing_are_refused() {
    for life in Life::EACH {
        let instance = life.instance();
        let own = instance.serialized();
        // A length that is not that of the numbers; a number too many, and one too few.
        let with_length = |bytes: &[u8], length: usize| {
            let mut bytes = bytes.to_vec();
            bytes[LENGTH..NUMBERS].copy_from_slice(&(length as u64).to_le_bytes());
            sealed(bytes)
        };
        let length = own.len() - NUMBERS - CHECKSUM;
        refused(&instance, &own, &with_length(&own, length + 8), &["damaged"]);
        let longer = [&own[..NUMBERS + length], &[0; 8 + CHECKSUM]].concat();
        refused(&instance, &own, &with_length(&longer, length + 8), &["damaged"]);
        let shorter = &own[..own.len() - 8];
        refused(&instance, &own, &with_length(shorter, length - 8), &["damaged"]);
        // The first number is the state of life: there is none of these.
        for nonsense in [-1.0, 0.5, 99.0, f64::NAN, f64::INFINITY] {
            let mut bytes = own.clone();
            bytes[NUMBERS..NUMBERS + 8].copy_from_slice(&f64::to_le_bytes(nonsense));
            refused(&instance, &own, &sealed(bytes), &["damaged"]);
        }
    }
}

/// What a number of a saved state may be altered to.
const ALTERED: [Real; 9] = [Real::NAN, Real::INFINITY, -1.0, 0.5, 0.0, 4294967295.0, 9007199254740992.0, 1e300, -1e300];

/// Whatever a host does next with this instance ends, and is not fatal.
#[track_caller]
fn goes_on_soundly(instance: &mut Instance, what: &str) {
    let now = instance.last_successful_time().unwrap_or(0.0);
    let mut statuses = vec![instance.do_step(now, 0.01), instance.do_step(now + 0.01, 0.3)];
    for input in inputs() {
        statuses.push(instance.write(&[input], &[1.0]));
    }
    let now = instance.last_successful_time().unwrap_or(0.0);
    statuses.push(instance.do_step(now, 0.01));
    statuses.push(instance.set_time(0.02));
    statuses.push(instance.rates().err().unwrap_or(Status::Ok));
    let references = reals(scene());
    statuses.push(instance.read(&references, &mut vec![0.0; references.len()]));
    assert!(!statuses.contains(&Status::Fatal), "{what}: {statuses:?} {:?}", instance.journal.take());
    instance.journal.take();
}

#[test]
fn fmi_whichever_number_was_altered_no_call_is_fatal_and_each_ends() {
    let quick = [("solver.max_evaluations", 1e4), ("solver.relative_tolerance", 1e-4)];
    for (kind, method) in [
        (CO_SIMULATION, 1),
        (CO_SIMULATION, 2),
        (CO_SIMULATION, 4),
        (CO_SIMULATION, 5),
        (CO_SIMULATION, 6),
        (MODEL_EXCHANGE, 3),
    ] {
        let mut instance = Instance::of(kind);
        instance.set_method(method);
        let mut instance = instance.started(&quick);
        if kind == CO_SIMULATION {
            instance.run(0.0, 0.01, 3);
        }
        let own = instance.serialized();
        let numbers = (own.len() - NUMBERS - CHECKSUM) / 8;
        let (mut refusals, mut other) = (0, Instance::of(kind));
        for n in 0..numbers {
            for altered in ALTERED {
                let mut bytes = own.clone();
                bytes[NUMBERS + 8 * n..][..8].copy_from_slice(&altered.to_le_bytes());
                let Ok(saved) = Saved::read(&other, &sealed(bytes)) else {
                    refusals += 1;
                    continue;
                };
                saved.restore(&other);
                saved.free(&other);
                goes_on_soundly(&mut other, &format!("number {n} of {numbers}, method {method}, {altered:?}"));
            }
        }
        other.journal.take();
        // What a parameter, a tag, a count or a whole turn cannot be.
        assert!(refusals > 300, "{refusals} of {numbers} times {}", ALTERED.len());
    }
}

#[test]
fn fmi_a_run_that_does_not_fit_its_parameters_is_refused() {
    let mut instance = Instance::quiet().started(&[]);
    instance.run(0.0, 0.01, 3);
    let own = instance.serialized();
    // State of life, kind of instance, and then the parameters in the order of the list, the mass first.
    for wrong in [-1.0, 0.0, Real::NAN, 5.25] {
        let mut bytes = own.clone();
        bytes[NUMBERS + 16..][..8].copy_from_slice(&wrong.to_le_bytes());
        refused(&instance, &own, &sealed(bytes), &["damaged"]);
    }
}
