//! Bearings against the speed: the table in closed form, Jeffcott's rotor in them, the order across nodes, the ledger.

use crate::harness::named::{Named, refusal, toml};
use crate::harness::{Random, at, within};
use nalgebra::{Complex, Normed, Vector3};
use oracles::extrapolation::steps;
use oracles::machine::{self, Bearing, Input, Node, Pace, Run, Start};
use oracles::monotone::curve;
use split_rotor_model::effects::Effects;
use split_rotor_model::linear::{Direction, Machine, Mode};

const ROTOR: &str = "[rotor]\nm = 5.0\nJa = 0.15625\nJt = 0.078125\nl = 0.0\n";

/// Columns of a table whose stiffness first rises and then falls, kyy, kyz, kzy, kzz, cyy, cyz, czy, czz.
const SPEEDS: [f64; 5] = [0.0, 20.0, 50.0, 90.0, 150.0];
const COLUMNS: [(&str, [f64; 5]); 8] = [
    ("kyy", [2e3, 2.4e3, 4e3, 4.2e3, 3e3]),
    ("kyz", [0.0, 10.0, 21.0, 33.0, 41.0]),
    ("kzy", [0.0, -10.0, -21.0, -33.0, -41.0]),
    ("kzz", [2e3, 2.2e3, 3.8e3, 4.4e3, 3.1e3]),
    ("cyy", [6.0, 4.5, 3.0, 2.8, 2.7]),
    ("cyz", [0.1, 0.3, 0.2, 0.0, -0.4]),
    ("czy", [0.1, 0.2, 0.1, 0.0, -0.4]),
    ("czz", [5.5, 4.8, 3.3, 2.8, 2.6]),
];

/// A bearing at c with this table.
fn bearing(speeds: &[f64], columns: &[(&str, [f64; 5])]) -> String {
    let mut text = format!("[[effects.bearing]]\nposition = 0.0\nspeed = {speeds:?}\n");
    for (name, values) in columns {
        text += &format!("{name} = {:?}\n", &values[..speeds.len()]);
    }
    text
}

/// What each column has at a speed of this direction, 1 or -1: where the rotor turns backwards, cross terms have the other sign.
fn expected(speed: f64, direction: f64) -> [f64; 8] {
    COLUMNS.map(|(name, values)| {
        let value = curve(&std::array::from_fn::<_, 5, _>(|n| (SPEEDS[n], values[n])), speed.abs());
        let is_cross = ["kyz", "kzy", "cyz", "czy"].contains(&name);
        if is_cross { direction * value } else { value }
    })
}

/// Force over its size \[1]: measured 2.1e-16.
const FORCE: f64 = 1e-15;

#[test]
fn exact_force_against_the_speed_forward_and_backward() {
    let mut random = Random(100);
    for sample in 0..400 {
        let speed = match sample {
            0..5 => SPEEDS[sample],
            5..10 => -SPEEDS[sample - 5],
            _ => random.within(-200.0, 200.0),
        };
        let [y, z, vy, vz] = std::array::from_fn(|_| random.within(-1.0, 1.0));
        let start = format!(
            "[start]\nr_c = {{ y = {y:?}, z = {z:?} }}\nv_c = {{ y = {vy:?}, z = {vz:?} }}\nomega = {{ x = {speed:?} }}\n"
        );
        let mut rotor = Named::written(&format!("{ROTOR}{start}{}", bearing(&SPEEDS, &COLUMNS)));
        rotor.start();
        let [kyy, kyz, kzy, kzz, cyy, cyz, czy, czz] = expected(speed, if speed < 0.0 { -1.0 } else { 1.0 });
        let force = [kyy * y + kyz * z + cyy * vy + cyz * vz, kzy * y + kzz * z + czy * vy + czz * vz].map(|f| -f);
        let size = (kyy + kzz) * (y.abs() + z.abs()) + (cyy + czz) * (vy.abs() + vz.abs());
        for (name, force) in ["bearing[1].F.y", "bearing[1].F.z"].into_iter().zip(force) {
            within(&format!("{name} at {speed}"), (rotor.get(name) - force).abs() / size, FORCE);
        }
    }
}

/// Radius and phase of Jeffcott's rotor over its eccentricity, the ledger over the work \[1]: measured 3.3e-13 and 3.2e-16.
const JEFFCOTT: [f64; 2] = [1e-12, 1e-15];

/// With K and C of that speed, the steady whirl is z = M ε ω²/(K − Mω² + iωC) in the frame of the unbalance (Jeffcott 1919), the
/// circulation k turning K to K − ik.
#[test]
fn exact_response_to_unbalance_at_twenty_speeds() {
    let table = "[[effects.bearing]]\nposition = 0.0\nspeed = [10.0, 20.0, 30.0, 55.0]\nkyy = [1e3, 2e3, 3e3, 3.1e3]\n\
                 kzz = [1e3, 2e3, 3e3, 3.1e3]\nkyz = [5.0, 10.0, 30.0, 80.0]\nkzy = [-5.0, -10.0, -30.0, -80.0]\n\
                 cyy = [60.0, 40.0, 30.0, 25.0]\nczz = [60.0, 40.0, 30.0, 25.0]\n";
    let column = |values: [f64; 4]| [10.0, 20.0, 30.0, 55.0].into_iter().zip(values).collect::<Vec<_>>();
    let columns = [[1e3, 2e3, 3e3, 3.1e3], [5.0, 10.0, 30.0, 80.0], [60.0, 40.0, 30.0, 25.0]].map(column);
    let (mass, eccentricity) = (5.1, 0.1 * 0.02 / 5.1);
    for n in 1..=20 {
        let speed = 3.0 * f64::from(n);
        let [k, cross, c] = [0, 1, 2].map(|n| curve(&columns[n], speed));
        // Below the first node what couples goes to 0 with the speed.
        let cross = cross * (speed / 10.0).min(1.0);
        let stiffness = Complex::new(k - mass * speed * speed, c * speed - cross);
        let whirl = Complex::new(mass * eccentricity * speed * speed, 0.0) / stiffness;
        let rate = whirl * Complex::new(0.0, speed);
        let mut rotor = Named::written(&format!(
            "{ROTOR}[start]\nr_c = {{ y = {:?}, z = {:?} }}\nv_c = {{ y = {:?}, z = {:?} }}\nomega = {{ x = {speed:?} }}\n{table}\
             [[effects.unbalance]]\nmass = 0.1\nradius = 0.02\nangle = 0.0\nposition = 0.0\n[effects.imposed_speed]\nw = {speed:?}\n\
             [solver]\nrelative_tolerance = 1e-12\n",
            whirl.re, whirl.im, rate.re, rate.im
        ));
        rotor.start();
        let t = 3.0;
        let reading = at(&mut rotor.simulation, t);
        let turned = whirl * Complex::new(libm::cos(speed * t), libm::sin(speed * t));
        let found = Complex::new(rotor.get("r_c.y"), rotor.get("r_c.z"));
        within(&format!("place at {speed} rad/s"), (found - turned).norm() / eccentricity, JEFFCOTT[0]);
        let work = reading.ledger.supplied.abs() + reading.ledger.dissipated + reading.ledger.kinetic;
        within("ledger", reading.ledger.residual().abs() / work, JEFFCOTT[1]);
    }
}

/// A disk in the bearing, run up through all its nodes at an imposed rate.
const RATE: f64 = 60.0;

fn run_up(solver: &str) -> Named {
    let mut rotor = Named::written(&format!(
        "{ROTOR}[start]\nr_c = {{ y = 0.01 }}\nomega = {{ x = -60.0 }}\n{}[effects.imposed_speed]\nw = -60.0\na = {RATE:?}\n\
         [[effects.port]]\nposition = 0.0\n[solver]\n{solver}",
        bearing(&SPEEDS, &COLUMNS)
    ));
    rotor.start();
    rotor
}

/// The same from node to node by extrapolation: y, z [m], and their rates [m/s].
fn ran_up(end: f64) -> [f64; 4] {
    let f = |direction: f64, t: f64, s: &[f64; 4]| {
        let [kyy, kyz, kzy, kzz, cyy, cyz, czy, czz] = expected(RATE * t - 60.0, direction);
        let [y, z, vy, vz] = *s;
        let of = |a: f64| -a / 5.0;
        [vy, vz, of(kyy * y + kyz * z + cyy * vy + cyz * vz), of(kzy * y + kzz * z + czy * vy + czz * vz)]
    };
    let nodes = SPEEDS.iter().flat_map(|speed| [-speed, *speed]).map(|speed| (speed + 60.0) / RATE);
    let mut times: Vec<f64> = nodes.filter(|t| *t > 0.0 && *t < end).chain([end]).collect();
    times.sort_by(f64::total_cmp);
    times.dedup();
    let go = |(t, y): (f64, [f64; 4]), next: &f64| {
        let direction = (0.5 * RATE * (t + next) - 60.0).signum();
        (*next, steps(|t, s| f(direction, t, s), t, &y, next - t, 40))
    };
    times.iter().fold((0.0, [0.01, 0.0, 0.0, 0.0]), go).1
}

/// Place over the size of the motion \[1], in tolerances: measured 17.5 with stiff, 13.5 with dopri5, 5.3 with the others.
const RUN_UP: f64 = 60.0;

#[test]
fn exact_run_up_through_nodes() {
    let [y, z, ..] = ran_up(3.0);
    for method in ["dopri5", "dop853", "auto", "stiff", "taylor"] {
        for tolerance in [1e-6, 1e-9, 1e-12] {
            let mut rotor = run_up(&format!(
                "method = \"{method}\"\nrelative_tolerance = {tolerance:e}\nabsolute_tolerance = 1e-14\n"
            ));
            let reading = at(&mut rotor.simulation, 3.0);
            let error = libm::hypot(rotor.get("r_c.y") - y, rotor.get("r_c.z") - z) / libm::hypot(y, z);
            within(&format!("{method} at {tolerance:e}"), error / tolerance, RUN_UP);
            let residual = reading.ledger.residual().abs() / reading.ledger.dissipated.abs();
            println!("{method} at {tolerance:e}: residual {residual:.1e}, {} evaluations", reading.cost.evaluations);
        }
    }
}

#[test]
fn order_is_kept_across_nodes() {
    /// Steps, and the least order of the error between both.
    const ORDERS: [(&str, f64, f64, f64); 2] = [("dopri5", 400.0, 800.0, 4.5), ("dop853", 100.0, 200.0, 7.0)];
    let [y, z, ..] = ran_up(3.0);
    for (method, few, many, least) in ORDERS {
        let error = |count: f64| {
            let mut rotor = run_up(&format!("method = \"{method}\"\nrelative_tolerance = 1e-2\n"));
            for n in 1..=count as u32 {
                // Who sets an input ends a step; what pulls along the axis does nothing across it.
                rotor.set("port[1].f.x", 1e-9 * f64::from(n % 2));
                at(&mut rotor.simulation, 3.0 * f64::from(n) / count);
            }
            libm::hypot(rotor.get("r_c.y") - y, rotor.get("r_c.z") - z)
        };
        let [coarse, fine] = [few, many].map(error);
        let order = libm::log2(coarse / fine) / libm::log2(many / few);
        println!("{method}: {coarse:.2e}, {fine:.2e}: order {order:.2}");
        assert!(order >= least, "{method}: {order}");
    }
}

/// A rotor that turns backwards, and its mirror image in the plane of x and z: y, the spin, and what turns about x or z change sign.
fn mirror_images(table: &str, speeds: [f64; 2]) -> [String; 2] {
    [1.0, -1.0].map(|side| {
        let [from, to] = speeds.map(|speed| side * speed);
        let (angle, turned) = (if side > 0.0 { 0.4 } else { std::f64::consts::PI - 0.4 }, 3e-3 * side);
        format!(
            "[rotor]\nm = 12.0\nJa = 0.06\nJt = 0.25\nl = 0.0\n[effects.gravity]\n[start]\n\
             r_c = {{ y = {:?}, z = 2e-4 }}\nv_c = {{ y = {:?} }}\ngamma = {{ y = 1e-3, z = {turned:?} }}\n\
             omega = {{ x = {from:?}, y = 0.2, z = {:?} }}\n\
             [[effects.unbalance]]\nmass = 0.01\nradius = 0.05\nangle = {angle:?}\nposition = 0.1\n\
             [[effects.bearing]]\nposition = -0.2\nkxx = 1e5\n{table}\
             [[effects.bearing]]\nposition = 0.25\nkt = 50.0\nct = 0.5\n{table}\
             [effects.imposed_speed]\nw = {from:?}\na = {:?}\n[solver]\nrelative_tolerance = 1e-8\n",
            1e-4 * side,
            0.02 * side,
            -0.3 * side,
            (to - from) / 0.5
        )
    })
}

/// With a first node above 0, with one at rest where cross terms are not 0, and with that node alone.
const FILMS: [&str; 3] = [
    "speed = [100.0, 250.0]\nkyy = [4e5, 3e5]\nkzz = [9e5, 5e5]\nkyz = [5e4, 9e4]\nkzy = [-8e4, -2e5]\ncyy = [900, 500]\n\
     czz = [2400, 1200]\ncyz = [-150, -90]\nczy = [-120, -60]\n",
    "speed = [0.0, 100.0, 250.0]\nkyy = [4e5, 3.5e5, 3e5]\nkzz = [9e5, 6e5, 5e5]\nkyz = [2e4, 5e4, 9e4]\nkzy = [-6e4, -8e4, -2e5]\n\
     cyy = [900, 700, 500]\nczz = [2400, 2000, 1200]\ncyz = [-300, -150, -90]\nczy = [-200, -120, -60]\n",
    "speed = [0.0]\nkyy = [4e5]\nkzz = [9e5]\nkyz = [2e4]\nkzy = [-6e4]\ncyy = [900]\nczz = [2400]\ncyz = [-300]\nczy = [-200]\n",
];

/// Of a motion from its mirror image, over its size \[1]: measured 7.1e-10.
const MIRRORED: f64 = 3e-9;

#[test]
fn exact_the_mirror_image_of_a_rotor_in_films_moves_as_its_mirror_image() {
    for table in FILMS {
        // Backward, forward, and through rest both ways.
        for speeds in [[-300.0, -150.0], [-60.0, -90.0], [-80.0, 160.0], [130.0, -40.0]] {
            let [mut one, mut other] = mirror_images(table, speeds).map(|text| Named::started(&text));
            let (mut size, mut error) = (0.0_f64, 0.0_f64);
            for n in 1..=50 {
                let t = 0.01 * f64::from(n);
                at(&mut one.simulation, t);
                at(&mut other.simulation, t);
                for (name, sign) in [("r_c.y", -1.0), ("r_c.z", 1.0)] {
                    size = size.max(one.get(name).abs());
                    error = error.max((one.get(name) - sign * other.get(name)).abs());
                }
            }
            within(&format!("{speeds:?} rad/s: {} nodes", table.matches(',').count()), error / size, MIRRORED);
        }
    }
}

/// Of the place from that of the machine of all laws, over its size \[1]: measured 6.8e-10.
const OF_MACHINE: f64 = 3e-9;

#[test]
fn exact_a_rotor_driven_from_backward_to_forward_is_the_machine_of_all_laws() {
    let node = |speed: f64, k: [[f64; 2]; 2], c: [[f64; 2]; 2]| Node { speed, k, c };
    let below = vec![
        node(20.0, [[4e4, 2e4], [-3e4, 9e4]], [[90.0, -15.0], [-12.0, 240.0]]),
        node(60.0, [[3e4, 3e4], [-4e4, 5e4]], [[50.0, -9.0], [-6.0, 120.0]]),
    ];
    let jumps = vec![
        node(0.0, [[4e4, 1e4], [-2e4, 9e4]], [[90.0, -30.0], [-20.0, 240.0]]),
        node(50.0, [[3e4, 2e4], [-3e4, 5e4]], [[60.0, -15.0], [-12.0, 150.0]]),
    ];
    let bearing =
        |position: f64, table: Vec<Node>| Bearing { position, table, axial: [1e4, 10.0], ..Bearing::default() };
    let machine = machine::Machine {
        m: 12.0,
        Ja: 0.06,
        Jt: 0.25,
        gravity: Some(Vector3::z() * -9.81),
        bearings: vec![bearing(-0.2, below), bearing(0.25, jumps)],
        start: Start { omega: Vector3::x() * -40.0, r_c: Vector3::new(0.0, 1e-3, -2e-3), ..Start::default() },
        drive: true,
        inputs: vec![(Input::Torque, 24.0)],
        ..machine::Machine::default()
    };
    let text = toml(&machine.settings()) + "[solver]\nrelative_tolerance = 1e-9\n";
    let mut rotor = Named::started(&text);
    let mut run = Run::new(&machine, Pace::Adaptive(1e-11));
    let (mut size, mut error) = (0.0_f64, 0.0_f64);
    for n in 1..=20 {
        let t = 0.013 * f64::from(n);
        at(&mut rotor.simulation, t);
        assert!(run.advance(t), "at {t} s");
        let place = run.show().r_c;
        size = size.max(place.norm());
        error = error.max(libm::hypot(rotor.get("r_c.y") - place.y, rotor.get("r_c.z") - place.z));
    }
    assert!(rotor.get("omega_phi") > 60.0);
    within("place", error / size, OF_MACHINE);
}

/// Eigenvalues at one speed from those at the other, over their size \[1].
const ALIKE: f64 = 1e-12;

#[test]
fn exact_a_film_drives_the_whirl_that_goes_with_the_spin() {
    let film = "speed = [0, 500]\nkyy = [1e6, 1e6]\nkzz = [2e6, 2e6]\nkyz = [0, 1e6]\nkzy = [0, -2e6]\ncyy = [2e3, 2e3]\n\
                cyz = [-500, -500]\nczy = [-500, -500]\nczz = [3e3, 3e3]\nkxx = 1e6\ncxx = 1e3\nkt = 1e5\nct = 100.0\n";
    let text = format!("[rotor]\nm = 10.0\nJa = 0.1\nJt = 0.2\nl = 0.0\n[[effects.bearing]]\nposition = 0.0\n{film}");
    let machine = Machine::of(Named::written(&text).simulation.parameters()).unwrap_or_else(|error| panic!("{error}"));
    let modes = |speed: f64| machine.modes(speed, None).unwrap_or_else(|error| panic!("{error}")).1;
    for speed in [30.0, 200.0, 400.0, 700.0] {
        let (forward, backward) = (modes(speed), modes(-speed));
        assert_eq!(forward.len(), backward.len());
        for mode in &forward {
            let off = |other: &Mode| (other.eigenvalue - mode.eigenvalue).norm() / mode.eigenvalue.norm();
            let other = backward.iter().min_by(|a, b| off(a).total_cmp(&off(b))).expect("modes");
            within(&format!("at {speed} rad/s"), off(other), ALIKE);
            assert_eq!(other.direction, mode.direction, "at {speed} rad/s");
        }
        // It was said to be backward at the negative speed.
        let growing = backward.iter().filter(|mode| mode.grows());
        let directions: Vec<_> = growing.map(|mode| mode.direction).collect();
        assert_eq!(directions, if speed > 319.0 { vec![Direction::Forward] } else { vec![] }, "at {speed} rad/s");
    }
}

/// What is said of a run at ω_φ from the first to the second of these speeds.
fn doubts(text: &str, speeds: [f64; 2]) -> Vec<String> {
    let [from, to] = speeds;
    let mut rotor = Named::started(&format!(
        "{ROTOR}{text}[effects.imposed_speed]\nw = {from:?}\na = {:?}\n[start]\nomega = {{ x = {from:?} }}\n",
        to - from
    ));
    at(&mut rotor.simulation, 1.0);
    let mut all = Vec::new();
    if let Some(met) = rotor.simulation.speeds_met() {
        rotor.simulation.parameters().effects.doubts(met, None, &mut |name, doubt| all.push(doubt.words(name)));
        // Once said, nothing of it is new.
        rotor.simulation.parameters().effects.doubts(met, Some(met), &mut |name, _| panic!("{name} again"));
    }
    all
}

#[test]
fn regress_speeds_for_which_no_coefficient_is_known_are_told() {
    let table = format!("[[effects.bearing]]\nposition = 0.0\n{}", FILMS[0]);
    let below = "bearing[1]: speeds down to 50.0 rad/s (477.46 rpm) are below its table, which is known from 100.0 rad/s \
                 (954.93 rpm) to 250.0 rad/s (2387.3 rpm): there the coefficients of its first node are held, and cross terms go to 0 with \
                 the speed";
    let beyond = "bearing[1]: speeds up to 260.0 rad/s (2482.8 rpm) are beyond its table, which is known from 100.0 rad/s \
                  (954.93 rpm) to 250.0 rad/s (2387.3 rpm): there the coefficients of its last node are held";
    assert_eq!(doubts(&table, [100.0, 250.0]), [""; 0]);
    assert_eq!(doubts(&table, [-250.0, -120.0]), [""; 0]);
    assert_eq!(doubts(&table, [50.0, 90.0]), [below]);
    assert_eq!(doubts(&table, [240.0, 260.0]), [beyond]);
    assert_eq!(doubts(&table, [-240.0, -260.0]), [beyond]);
    let both = doubts(&table, [-50.0, 260.0]);
    assert!(both.len() == 2 && both[0].starts_with("bearing[1]: speeds down to ") && both[1] == beyond, "{both:?}");
    // Constants keep their sign; where kyz = kzy nothing is driven either way.
    let constant =
        |kzy: f64| format!("[[effects.bearing]]\nposition = 0.0\nkyy = 1e4\nkzz = 1e4\nkyz = 5.0\nkzy = {kzy:?}\n");
    assert_eq!(doubts(&constant(-5.0), [0.0, 100.0]), [""; 0]);
    assert_eq!(doubts(&constant(5.0), [-100.0, 100.0]), [""; 0]);
    let backward = doubts(&constant(-5.0), [20.0, -40.0]);
    assert!(
        backward.len() == 1 && backward[0].contains("turns backwards, at -40.0 rad/s (-381.97 rpm)"),
        "{backward:?}"
    );
}

/// An ordinary rotor in two film bearings, drawn: from 1 to 50 kg, at rest or at speed, at a node or between two, run up or down.
fn drawn(random: &mut Random, speed: f64) -> String {
    let m = libm::exp(random.within(0.0, 4.0));
    let k = m * libm::pow(random.within(100.0, 2000.0), 2.0);
    let mut bearing = |position: f64| {
        let nodes = random.within(1.0, 7.0) as usize;
        let first = if random.within(0.0, 1.0) < 0.5 { 0.0 } else { 30.0 };
        let speeds: Vec<f64> = (0..nodes)
            .map(|n| first + 90.0 * n as f64 + random.within(0.0, 60.0) * f64::from(u8::from(n > 0)))
            .collect();
        let mut column = |low: f64, high: f64| (0..nodes).map(|_| k * random.within(low, high)).collect::<Vec<_>>();
        let (kyy, kzz, kyz, kzy) = (column(0.3, 0.5), column(0.5, 0.8), column(0.0, 0.05), column(-0.1, 0.0));
        let (cyy, czz, cyz) = (column(4e-4, 8e-4), column(6e-4, 9e-4), column(-2e-4, 0.0));
        format!(
            "[[effects.bearing]]\nposition = {position:?}\nspeed = {speeds:?}\nkyy = {kyy:?}\nkzz = {kzz:?}\nkyz = {kyz:?}\n\
             kzy = {kzy:?}\ncyy = {cyy:?}\nczz = {czz:?}\ncyz = {cyz:?}\nczy = {cyz:?}\n"
        )
    };
    let bearings = bearing(-0.2) + &bearing(0.25);
    format!(
        "[rotor]\nm = {m:?}\nJa = {:?}\nJt = {:?}\nl = 0.0\n[start]\nomega = {{ x = {speed:?} }}\n[effects.gravity]\n\
         [effects.drive]\ntau = {:?}\n[[effects.unbalance]]\nmass = {:?}\nradius = 0.05\nangle = 0.0\nposition = 0.1\n{bearings}",
        5e-3 * m,
        0.02 * m,
        m * random.within(-1.0, 1.0),
        1e-3 * m,
    )
}

/// Place off its line, over the largest, in tolerances \[1]: measured 2.5e-2.
const ORDINARY: f64 = 0.1;

#[test]
fn ordinary_rotors_in_film_bearings_keep_the_tolerance() {
    let mut random = Random(7);
    let mut worst: f64 = 0.0;
    for sample in 0..24 {
        let speed = [0.0, 30.0, -120.0, 300.0][sample % 4] * if sample < 8 { 1.0 } else { random.within(0.5, 1.5) };
        let text = drawn(&mut random, speed);
        let run = |solver: &str| {
            let mut rotor = Named::written(&format!("{text}[solver]\n{solver}"));
            rotor.start();
            let places = (1..=40).map(|n| {
                at(&mut rotor.simulation, 0.0125 * f64::from(n));
                [rotor.get("r_c.y"), rotor.get("r_c.z")]
            });
            let places: Vec<_> = places.collect();
            (places, rotor.get("solver.evaluations"))
        };
        let (exact, _) = run("method = \"dop853\"\nrelative_tolerance = 1e-12\n");
        let size = exact.iter().map(|[y, z]| libm::hypot(*y, *z)).fold(0.0, f64::max);
        for tolerance in [1e-4, 1e-6] {
            let (found, evaluations) = run(&format!("relative_tolerance = {tolerance:e}\n"));
            let off = |(one, other): (&[f64; 2], &[f64; 2])| libm::hypot(one[0] - other[0], one[1] - other[1]);
            let error = found.iter().zip(&exact).map(off).fold(0.0, f64::max) / size / tolerance;
            println!("{sample} at {speed:.0} rad/s, {tolerance:e}: {error:.2e} tolerances, {evaluations} evaluations");
            worst = worst.max(error);
        }
    }
    within("ordinary rotors", worst, ORDINARY);
}

/// What the reader of scenes says of a table.
fn refused(table: &str) -> String {
    refusal(&format!("{ROTOR}[[effects.bearing]]\nposition = 0.0\n{table}"))
}

#[test]
fn tables_that_are_not_right_are_refused() {
    for (table, message) in [
        (
            "kyy = [1.0, 2.0]\n",
            "line 8: effects.bearing[1].kyy is a table without speeds: give the speeds of its nodes in rad/s as `speed = [...]`",
        ),
        (
            "speed = [1.0, 2.0]\nkyy = [1.0]\n",
            "line 9: effects.bearing[1].kyy is 1 long: it must be as long as speed, 2",
        ),
        ("speed = []\n", "line 8: effects.bearing[1].speed is 0 long: it must be from 1 to 16 numbers long"),
        (
            "speed = 3.0\n",
            "line 8: effects.bearing[1].speed = 3.0 is not possible: it must be an array of numbers in rad/s",
        ),
        ("position = [1.0]\n", "key `position` stands twice"),
        ("kxx = [1.0]\n", "line 8: effects.bearing[1].kxx = [1.0] is not possible: it must be a number in N/m"),
        (
            "speed = [1.0, inf]\nkyy = [1.0, 2.0]\n",
            "line 8: effects.bearing[1].speed[2] = inf is not possible: it must be a finite number >= 0",
        ),
        (
            "speed = [0.0, 2.0, 2.0]\nkyy = [1.0, 2.0, 3.0]\n",
            "line 8: bearing[1].speed[3] = 2.0 is not possible: it must be more than that of the node before, 2.0 rad/s",
        ),
        (
            "speed = [0.0, 100.0]\ncyy = [4.0, 0.0]\nczz = [4.0, 0.0]\ncyz = [0.0, 1.0]\n",
            "line 11: bearing[1].cyz with its table = 0.",
        ),
        (
            "speed = [0.0, 100.0]\ncyy = [4.0, 0.0]\nczz = [4.0, 0.0]\ncyz = [0.0, 1.0]\n",
            "in size at 81.81818181818183 rad/s, or the bearing would drive what it damps",
        ),
        (
            "speed = [0.0, 1e-300]\nkyy = [1.0, 2e9]\n",
            "line 8: bearing[1].speed[2] = 1e-300 is not possible: it must be nearer to or further from that of the node before, \
             0.0: the curve of kyy between them overflows",
        ),
        (
            // With the sign that it has where the rotor turns backwards, besides a constant.
            "speed = [0.0, 100.0]\ncyy = [4.0, 4.0]\nczz = [4.0, 4.0]\ncyz = [-6.0, -6.0]\nczy = [-6.0, -6.0]\n",
            "in size at 0.0 rad/s, or the bearing would drive what it damps",
        ),
        (
            "speed = [1e-300, 1.0]\nkyz = [1e9, 1e9]\n",
            "bearing[1].speed[1] = 1e-300 is not possible: it must be 0 or larger",
        ),
        ("speed = [0.0, 1e-160, 1.0]\nczz = [1.0, 2.0, 3.0]\n", "bearing[1].speed[2] = 1e-160 is not possible"),
        ("speed = [0.0, 1.0, 1e308]\nkyy = [1.0, 2.0, 3.0]\n", "bearing[1].speed[3] = 1e308 is not possible"),
        ("speed = [0.0, 1.0, 2.0]\nkzz = [1.0, 1e308, -1e308]\n", "bearing[1].kzz[3] = -1e308 is not possible"),
        ("speed = [0.0, 1e-9]\nkyz = [0.0, 1e300]\n", "bearing[1].kyz[2] = 1e300 is not possible"),
    ] {
        let found = refused(table);
        println!("{found}");
        assert!(found.contains(message), "{found}\n{message}");
    }
    // Nodes that nobody gave are no harm, however many they are.
    for nodes in 1..=16 {
        let (speeds, falling): (Vec<_>, Vec<_>) = (0..nodes).map(|n| (f64::from(n), 1e9 - f64::from(n))).unzip();
        Named::started(&format!("{ROTOR}[[effects.bearing]]\nposition = 0.0\nspeed = {speeds:?}\nkyy = {falling:?}\n"));
    }
    let many: Vec<f64> = (0..17).map(f64::from).collect();
    assert!(refused(&format!("speed = {many:?}\n")).contains("speed is 17 long"));
}
