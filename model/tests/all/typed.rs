//! A scene as Rust values is the same scene as one in TOML.

use crate::harness::named::Named;
use nalgebra::Vector3;
use split_rotor_model::body::Body;
use split_rotor_model::effects;
use split_rotor_model::effects::Effects;
use split_rotor_model::effects::bearing::Bearing;
use split_rotor_model::effects::drive::Drive;
use split_rotor_model::effects::extrapolation::Extrapolation;
use split_rotor_model::effects::gravity::Gravity;
use split_rotor_model::effects::housing::Moving;
use split_rotor_model::effects::imposed_speed::ImposedSpeed;
use split_rotor_model::effects::motor::Motor;
use split_rotor_model::effects::rub::Rub;
use split_rotor_model::effects::table::Table;
use split_rotor_model::effects::unbalance::Unbalance;
use split_rotor_model::signal::Signal;
use split_rotor_model::simulation::Simulation;
use split_rotor_model::state::WITH_WORK;
use split_rotor_model::variables::{Parameters, Setup};

const SETUP: &str = "
rotor = { m = 12.0, Ja = 0.06, Jt = 0.25, l = 0.0 }
start.omega.x = 20.0
solver.relative_tolerance = 1e-6
effects.unbalance = [{ mass = 0.002, radius = 0.08, angle = 0.3, position = 0.05 }]
";

fn setup() -> Setup {
    let mut setup = Setup::of(Body { m: 12.0, Ja: 0.06, Jt: 0.25, l: 0.0 });
    setup.start.omega.x = 20.0;
    setup.solver.relative_tolerance = 1e-6;
    setup
}

fn unbalance() -> Unbalance {
    Unbalance { mass: 0.002, radius: 0.08, angle: 0.3, position: 0.05 }
}

// A list of effects takes most of a minute to compile with all methods: one is run.

/// What is given of both, bit by bit, under the same names.
fn assert_given<E: Effects>(effects: &E, written: &str) {
    let typed = Parameters { setup: setup(), effects: effects.clone() };
    let written = Named::written(&format!("{SETUP}{written}"));
    for variable in &written.scene.variables {
        assert_eq!(Parameters::<E>::place(&variable.name), Some(variable.place), "{}", variable.name);
        let value = typed.value::<WITH_WORK>(variable.place, 0.0, None);
        let start = written.scene.starts.get(&variable.place.value_reference()).copied();
        assert_eq!(value.map(f64::to_bits), start.map(f64::to_bits), "{}", variable.name);
    }
    assert_eq!(Parameters::<E>::place("rotor.none"), None);
}

/// All that both show over half a second too.
fn assert_same<E: Effects, const N: usize>(effects: E, written: &str) {
    assert_given(&effects, written);
    let mut typed = Simulation::<E, N>::from(Parameters { setup: setup(), effects });
    let mut written = Named::written(&format!("{SETUP}{written}"));
    typed.start(0.0, None).unwrap();
    written.start();
    for t in [0.1, 0.5] {
        typed.advance(t).unwrap();
        written.simulation.advance(t).unwrap();
        for variable in written.scene.variables.clone() {
            let [value, other] = [typed.get(variable.place).unwrap(), Some(written.at(variable.place))];
            assert_eq!(value.map(f64::to_bits), other.map(f64::to_bits), "{} at {t} s", variable.name);
        }
    }
}

#[test]
fn tables_and_two_of_a_kind() {
    let gravity = Gravity { g: Vector3::new(0.0, 0.0, -9.81) };
    let (slow, fast) = ([4e5, 1e4, -2e4, 9e5, 900.0, 0.0, 0.0, 800.0], [3e5, 2e4, -3e4, 4e5, 400.0, 0.0, 0.0, 500.0]);
    let none = [[0.0; 2]; 2];
    let mut tabled = Bearing::new(-0.2, none, none).with_table(Table::new([10.0, 40.0], [slow, fast]));
    (tabled.kxx, tabled.cxx) = (2e5, 300.0);
    let plain = Bearing::<_, 0>::new(0.25, [[3e5, 0.0], [0.0, 3e5]], [[300.0, 0.0], [0.0, 300.0]]);
    let plain = plain.in_housing(Moving { moves: true, ahead: 0.5, ..Moving::default() });
    let drive = Drive::with(Signal::held(3.0));
    assert_given(
        &effects![gravity, drive, unbalance(), tabled => 1, plain => 2],
        "
        effects.gravity.g.z = -9.81
        effects.drive.tau = 3.0
        [[effects.bearing]]
        position = -0.2
        kxx = 2e5
        cxx = 300
        speed = [10, 40]
        kyy = [4e5, 3e5]
        kyz = [1e4, 2e4]
        kzy = [-2e4, -3e4]
        kzz = [9e5, 4e5]
        cyy = [900, 400]
        czz = [800, 500]
        [[effects.bearing]]
        position = 0.25
        kyy = 3e5
        kzz = 3e5
        cyy = 300
        czz = 300
        housing = { ahead = 0.5 }",
    );
}

#[test]
fn a_state_of_an_effect_and_contact() {
    let motor = Motor { stall_torque: 2.0, synchronous_speed: 100.0, time_constant: 0.05, ..Motor::default() };
    let bearing = Bearing::<_, 0>::new(0.0, [[4e5, 0.0], [0.0, 4e5]], [[90.0, 0.0], [0.0, 90.0]]);
    let mut rub = Rub::new(0.0, 2e-6, 1e6);
    (rub.damping, rub.friction, rub.radius) = (50.0, 0.1, 0.02);
    let off = Vector3::new(Signal::held(0.0), Signal::held(1e-6), Signal::held(0.0));
    let rub = rub.in_housing(Moving { moves: true, r: off, ..Moving::default() });
    assert_same::<_, 15>(
        effects![unbalance(), bearing, Extrapolation::new(1, 0.5), motor, rub],
        "
        effects.bearing = [{ position = 0.0, kyy = 4e5, kzz = 4e5, cyy = 90, czz = 90 }]
        effects.extrapolation = { order = 1, lag = 0.5 }
        effects.motor = { stall_torque = 2.0, synchronous_speed = 100.0, time_constant = 0.05 }
        effects.rub = [{ position = 0.0, gap = 2e-6, stiffness = 1e6, damping = 50.0, friction = 0.1, radius = 0.02, v0 = 1.0, housing.r.y = 1e-6 }]",
    );
}

#[test]
fn a_speed_that_is_imposed() {
    assert_given(&effects![unbalance(), ImposedSpeed::new(30.0)], "effects.imposed_speed.w = 30.0");
}
