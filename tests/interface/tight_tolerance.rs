//! What becomes of a tolerance that no arithmetic of doubles can keep: it is refused, or the step is given up, with a
//! message that names it, and soon. `arguments.rs` says which are refused.

use crate::harness::Instance;
use split_rotor::abi::Status;
use std::sync::mpsc::channel;
use std::thread;
use std::time::Duration;

/// dopri5, dop853 and stiff.
const METHODS: [i32; 3] = [2, 3, 5];

const ABSOLUTE: &str = "solver.absolute_tolerance";

/// A run [s], and its communication step [s].
const STOP: f64 = 10.0;
const STEP: f64 = 0.01;

/// Attempts of a whole run: measured 210 850 where one is done (dop853 at 1e-10 and 1e-30, `paper`).
const ATTEMPTS: f64 = 1e6;

/// A run that takes longer hangs: one of so many attempts takes some seconds, also on a busy machine.
const PATIENCE: Duration = Duration::from_secs(120);

fn last_message(instance: &Instance) -> String {
    instance.journal.take().pop().expect("a refusal has a message").message
}

/// A whole run with these tolerances: Ok where it was done, else what was said of it.
fn run(method: i32, relative: f64, absolute: f64) -> Result<(), String> {
    let mut instance = Instance::quiet();
    instance.set_method(method);
    instance.set_all(&[("solver.relative_tolerance", relative), (ABSOLUTE, absolute)]);
    assert_eq!(instance.enter_initialization(), Status::Ok);
    if instance.exit_initialization() != Status::Ok {
        return Err(last_message(&instance));
    }
    for n in 0..(STOP / STEP) as u32 {
        if instance.do_step(f64::from(n) * STEP, STEP) != Status::Ok {
            return Err(last_message(&instance));
        }
        let attempts = instance.get("solver.steps") + instance.get("solver.rejected");
        assert!(attempts <= ATTEMPTS, "{attempts} attempts until {} s", f64::from(n + 1) * STEP);
    }
    Ok(())
}

#[test]
fn fmi_an_absolute_tolerance_below_rounding_ends_soon_and_is_named() {
    let mut wrong = Vec::new();
    for method in METHODS {
        for (relative, absolute) in
            [(1e-14, 0.0), (1e-14, 1e-16), (1e-14, 1e-20), (1e-10, 1e-30), (1e-14, 1e-30), (1e-10, 1e-300)]
        {
            let (tell, told) = channel();
            // A thread of its own, which can be left alone where it hangs.
            thread::spawn(move || tell.send(run(method, relative, absolute)));
            let what = format!("method {method}, relative {relative:e}, absolute {absolute:e}");
            match told.recv_timeout(PATIENCE) {
                Ok(Ok(())) => {}
                Ok(Err(message)) if message.contains(ABSOLUTE) => {}
                Ok(Err(message)) => wrong.push(format!("{what}: {message}")),
                Err(_) => wrong.push(format!("{what}: hangs, or takes too many attempts")),
            }
        }
    }
    assert!(wrong.is_empty(), "{wrong:#?}");
}
