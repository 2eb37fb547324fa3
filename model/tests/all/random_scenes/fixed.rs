//! Scenes that are always among them: those of which it is known that they went wrong.

use super::trial::{Change, Partner, Trial};
use nalgebra::{Vector2, Vector3};
use oracles::machine::known::{drifting, ordinary};
use oracles::machine::{Bearing, Input, Machine, Start, Support, Unbalance};

/// So many points from 0 to `end` [s], at asymmetric distances.
fn points(end: f64, count: u32) -> Vec<f64> {
    // The golden angle's multiples are spread evenly and never repeat.
    let asymmetric = |k: u32| 0.618_033_988_749_894_9 * f64::from(k) % 1.0 - 0.5;
    let at = |k: u32| end * (f64::from(k) + 0.6 * asymmetric(k)) / f64::from(count);
    (1..count).map(at).chain([end]).collect()
}

/// A bearing with a film of oil: stiffness [N/m] and damping [N·s/m] that differ from y to z and are coupled.
fn oil(position: f64, k: f64, c: f64) -> Bearing {
    let [k, c] = [k, c].map(|of| [[of, 0.1 * of], [-0.2 * of, 0.7 * of]]);
    Bearing { position, k, c, ..Bearing::default() }
}

/// A finely balanced rotor.
fn run_up() -> Machine {
    let [k, c] = [3.007e5, 31.2].map(|of| [[of, 0.0], [0.0, of]]);
    Machine {
        m: 18.0,
        Ja: 0.18,
        Jt: 0.2553,
        bearings: vec![Bearing {
            position: -0.0177,
            k,
            c,
            axial: [3e5, 31.2],
            tilt: [2126.8, 0.08],
            ..Bearing::default()
        }],
        unbalances: vec![Unbalance { mass: 2.786e-6, radius: 0.1, angle: 0.0, position: 0.00876 }],
        imposed_speed: true,
        ..Machine::default()
    }
}

/// Its pivot gives way by micrometres while it falls by centimetres.
fn heavy_top() -> Machine {
    let l = 0.08;
    Machine {
        m: 0.5,
        Ja: 7.5e-4,
        Jt: 5e-4,
        l,
        gravity: Some(Vector3::x() * -9.81),
        support: Some(Support { c: [1e6, 0.0], d: [0.0; 2] }),
        start: Start {
            // Half as far as it gives way to the weight.
            r_c: Vector3::new(libm::cos(0.6), libm::sin(0.6), 0.0) * l - Vector3::x() * (0.25 * 9.81 / 1e6),
            gamma: Vector2::new(0.0, 0.6),
            omega: Vector3::new(libm::cos(0.6), libm::sin(0.6), 0.0) * 300.0,
            ..Start::default()
        },
        ..Machine::default()
    }
}

/// All of them.
pub fn all() -> Vec<Trial> {
    let alone = |name: &str, change: fn(&mut Machine)| {
        let mut machine = drifting();
        change(&mut machine);
        Trial::new(name, machine, points(2.0, 60))
    };
    let later = |mut trial: Trial, input: Input, value: f64| {
        trial.changes.push(Change { t: 0.1, input, terms: [value, 0.0, 0.0] });
        trial
    };
    let run_down = Machine { drag: Some([0.001, 0.0]), ..drifting() };
    let held = Machine {
        ports: vec![-0.2, 0.25],
        start: Start { r_c: Vector3::new(0.0, 1e-3, -2e-3), omega: Vector3::new(50.0, 5.0, 0.0), ..Start::default() },
        ..drifting()
    };
    let partners = Partner { every: 0.002, springs: vec![[2e4, 100.0], [3e4, 150.0]], from_start: false };
    let sagging = Machine {
        m: 12.0,
        Ja: 0.04,
        Jt: 0.12,
        gravity: Some(Vector3::z() * -9.81),
        bearings: vec![Bearing { k: [[1e5, 0.0], [0.0, 1e5]], c: [[200.0, 0.0], [0.0, 200.0]], ..Bearing::default() }],
        // 3.3 µm of the whole.
        unbalances: vec![Unbalance { mass: 0.002, radius: 3.3e-6 * 12.002 / 0.002, angle: 0.0, position: 0.0 }],
        start: Start { omega: Vector3::x() * 1000.0, ..Start::default() },
        ..Machine::default()
    };
    let turbine = Machine {
        m: 5e4,
        Ja: 2.5e4,
        Jt: 9e4,
        gravity: Some(Vector3::z() * -9.81),
        bearings: [-2.2, 2.4].map(|position| oil(position, 1e9, 2e7)).into(),
        unbalances: vec![Unbalance { mass: 0.05, radius: 0.8, angle: 1.0, position: 0.7 }],
        start: Start { omega: Vector3::x() * 314.0, ..Start::default() },
        ..Machine::default()
    };
    let micro = Machine {
        m: 1e-6,
        Ja: 1.2e-13,
        Jt: 1e-13,
        bearings: [-4e-4, 4e-4].map(|position| oil(position, 1000.0, 1e-2)).into(),
        unbalances: vec![Unbalance { mass: 1e-12, radius: 5e-4, angle: 0.0, position: 1e-4 }],
        start: Start { omega: Vector3::x() * 1e5, ..Start::default() },
        ..Machine::default()
    };
    // 1000 turns of a nutation that is a hundred thousandth of the sag: the method must follow it where the tolerance asks for it.
    let nutating = [(-0.02, [400.0, 440.0]), (0.005, [1400.0, 1540.0])].map(|(position, [kyy, kzz])| Bearing {
        position,
        k: [[kyy, 0.0], [0.0, kzz]],
        c: [[10.0, 0.0], [0.0, 10.0]],
        ..Bearing::default()
    });
    let nutating = Machine {
        m: 0.25,
        Ja: 0.025,
        Jt: 0.014,
        gravity: Some(Vector3::z() * -9.81),
        bearings: nutating.into(),
        start: Start { omega: Vector3::x() * 3000.0, ..Start::default() },
        ..Machine::default()
    };
    // A bearing at one place, nearly at the mass centre, and a rate of the speed that rises and falls.
    let mut smoothly = Trial::new("run up without a jerk", run_up(), points(2.0, 100));
    let slopes = [(0.0, [0.0, 250.0 / 0.6, 0.0]), (0.6, [250.0, -250.0 / 0.6, 0.0]), (1.2, [0.0; 3])];
    smoothly.changes = slopes.map(|(t, terms)| Change { t, input: Input::Acceleration, terms }).into();
    vec![
        alone("drag alone", |machine| machine.drag = Some([0.01, 0.0])),
        alone("rotating damping alone", |machine| machine.rotating_damping = Some([1.0, 0.2])),
        alone("support.d2 alone", |machine| machine.support = Some(Support { c: [0.0; 2], d: [0.0, 0.05] })),
        alone("moment at a port", |machine| {
            machine.ports = vec![0.0];
            machine.inputs = vec![(Input::Moment(0, 1), 2.0)];
        }),
        later(alone("force at a port, later", |machine| machine.ports = vec![0.3]), Input::Force(0, 1), 20.0),
        later(alone("torque, later", |machine| machine.drive = true), Input::Torque, 0.5),
        alone("bearing with skew C alone", |machine| {
            machine.bearings = vec![Bearing { position: 0.3, c: [[0.0, 10.0], [-10.0, 0.0]], ..Bearing::default() }];
        }),
        Trial::new("run-down", run_down, points(60.0, 100)),
        Trial { partner: Some(partners), ..Trial::new("held by partners", held, points(1.0, 80)) },
        Trial::new("the ordinary rotor", ordinary(), points(3.3, 200)),
        Trial::new("sag and whirl", sagging.clone(), points(5.0, 200)),
        Trial::new("turbine", turbine, points(1.0, 100)),
        Trial::new("micro rotor", micro, points(0.05, 100)),
        Trial::new("a small nutation", nutating, points(1.2, 100)),
        Trial { judged_from: 4.0, ..Trial::new("the whirl after a sag", sagging, points(5.0, 200)) },
        smoothly,
        Trial::new("a heavy top on a stiff elastic pivot", heavy_top(), points(1.0, 100)),
    ]
}
