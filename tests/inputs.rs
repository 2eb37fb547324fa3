//! Inputs: what is held, what derivatives add, what belongs together, and what is forgotten when. They run where the scene
//! has an input.
#![allow(unsafe_code, reason = "the exported functions are those of a C interface")]

mod harness;

use harness::{Instance, inputs};
use split_rotor::abi::{Real, Status};

/// 2 + 3 s + 5 s²/2 and its derivatives, sent to the first input.
const POLYNOMIAL: [Real; 3] = [2.0, 3.0, 5.0];

#[test]
fn regress_a_refused_start_leaves_the_inputs_as_they_were() {
    let Some(input) = inputs().first().copied() else { return };
    let mut instance = Instance::quiet();
    assert_eq!(instance.setup(None, 4.0, None), Status::Ok);
    assert_eq!(instance.send(input, 1, POLYNOMIAL[1]), Status::Ok);
    assert_eq!(instance.send(input, 2, POLYNOMIAL[2]), Status::Ok);
    let right = instance.get("rotor.m");
    instance.set_all(&[("rotor.m", -1.0)]);
    assert_eq!(instance.enter_initialization(), Status::Ok);
    let before = instance.serialized();
    assert_eq!(instance.exit_initialization(), Status::Error);
    assert!(instance.serialized() == before, "nothing changed");
    // A value sent now still belongs to the derivatives.
    instance.set_all(&[("rotor.m", right)]);
    assert_eq!(instance.write(&[input], &POLYNOMIAL[..1]), Status::Ok);
    assert_eq!(instance.exit_initialization(), Status::Ok);
    assert_eq!(instance.do_step(4.0, 0.25), Status::Ok);
    let mut value = [Real::NAN];
    assert_eq!(instance.read(&[input], &mut value), Status::Ok);
    assert_eq!(value[0], 2.0 + 0.25 * 3.0 + 0.5 * 0.25 * 0.25 * 5.0);
}
