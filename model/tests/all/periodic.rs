//! Motions that repeat with each revolution: against closed forms, against runs that settle, and around a fold.

use crate::harness::named::Named;
use crate::harness::within;
use nalgebra::{Complex, ComplexField, Matrix2, Matrix4};
use oracles::numerics::derivative;
use split_rotor_model::linear::{self, Machine};
use split_rotor_model::periodic::{Branch, End, Loss, Obstacle, Orbit, Rotating};
use std::f64::consts::TAU;

fn rotating(text: &str) -> Rotating {
    Rotating::of(Named::written(text).simulation.parameters()).unwrap_or_else(|obstacle| panic!("{obstacle}"))
}

fn found(rotating: &Rotating, speed: f64, near: Option<&Orbit>) -> Orbit {
    rotating.orbit(speed, near).unwrap_or_else(|obstacle| panic!("{obstacle}"))
}

/// An orbit beside another one, over its size \[1].
fn apart(got: &linear::Orbit, exact: &linear::Orbit) -> f64 {
    ((got.y - exact.y).modulus_squared() + (got.z - exact.z).modulus_squared()).sqrt() / exact.major()
}

/// Of multipliers, the largest distance from those expected \[1].
fn astray(orbit: &Orbit, expected: &[Complex<f64>]) -> f64 {
    let nearest =
        |to: &Complex<f64>| orbit.multipliers.iter().map(|found| (found - to).modulus()).fold(f64::INFINITY, f64::min);
    expected.iter().map(nearest).fold(0.0, f64::max)
}

#[test]
fn exact_orbit_and_multipliers_of_jeffcotts_rotor() {
    let balanced = "[rotor]\nm = 4.9\nJa = 0.15625\nJt = 0.078125\nl = 0.0\n[effects.support]\nc1 = 2000.0\nc2 = 100.0\nd1 = 10.0\nd2 = 0.2\n";
    let unbalance = "[[effects.unbalance]]\nmass = 0.1\nradius = 0.1\nangle = 0.7\nposition = 0.0\n";
    let jeffcott = rotating(&format!("{balanced}{unbalance}"));
    let machine = Machine::of(Named::written(balanced).simulation.parameters()).expect("a machine");
    for speed in [-35.0, 5.0, 19.9, 40.0, 400.0_f64] {
        let orbit = found(&jeffcott, speed, None);
        // (k − mω² + idω) Y = U ω² e^(iα)
        let (sine, cosine) = libm::sincos(0.7);
        let square = speed * speed;
        let y = Complex::new(cosine, sine) * (0.01 * square) / Complex::new(2000.0 - 5.0 * square, 10.0 * speed);
        let exact = linear::Orbit { y, z: y * Complex::new(0.0, -1.0) };
        within(&format!("orbit at {speed} rad/s"), apart(&orbit.path(0.0).once, &exact), 3e-9);
        within("a circle", (orbit.path(0.0).farthest / y.modulus() - 1.0).abs(), 3e-9);
        // e^(λT)
        let modes = machine.modes(speed, None).expect("it is held").1;
        let expected: Vec<_> = modes.iter().map(|mode| (mode.eigenvalue * TAU / speed.abs()).exp()).collect();
        let still = found(&rotating(balanced), speed, None);
        within(&format!("multipliers at {speed} rad/s"), astray(&still, &expected), 3e-8);
        assert_eq!((orbit.loss(), still.loss()), (None, None));
    }
}

/// A speed that the scene runs up with `a` is held here as any other.
#[test]
fn regress_a_run_up_is_off_where_the_spin_is_steady() {
    let text = "[rotor]\nm = 4.9\nJa = 0.15625\nJt = 0.078125\nl = 0.0\n[effects.support]\nc1 = 2000.0\nc2 = 100.0\nd1 = 10.0\nd2 = 0.2\n\
                [[effects.unbalance]]\nmass = 0.1\nradius = 0.1\nposition = 0.0\n";
    let run_up = format!("{text}[effects.imposed_speed]\nw = 3.0\na = 40.0\n");
    for speed in [5.0, 19.9, 40.0] {
        let [held, run_up] = [text, &run_up].map(|text| found(&rotating(text), speed, None).path(0.0).once);
        within(&format!("at {speed} rad/s"), apart(&run_up, &held), 1e-8);
    }
}

#[test]
fn exact_multipliers_of_a_body_that_is_not_symmetric() {
    let [a, b, c, spring] = [0.08, 0.05, 0.06, 100.0];
    let text = format!(
        "[rotor]\nm = 5.0\nJa = {c}\nJt = {a}\n[effects.asymmetry]\nJt2 = {b}\n\
         [[effects.bearing]]\nposition = 0.0\nkyy = 1e4\nkzz = 1e4\ncyy = 30.0\nczz = 30.0\nkxx = 1e4\ncxx = 30.0\nkt = {spring}\n"
    );
    let rotor = rotating(&text);
    let mut lost = 0;
    for speed in [20.0, 45.0, 60.0, 150.0] {
        // In axes that turn with the body, θ = (α, β):
        // A(α̈ − ωβ̇) + (C − B)ω(β̇ + ωα) + kα = 0, B(β̈ + ωα̇) − (C − A)ω(α̇ − ωβ) + kβ = 0
        let mass = Matrix2::new(a, 0.0, 0.0, b);
        let turning = Matrix2::new(0.0, -a + c - b, b - c + a, 0.0) * speed;
        let springs = Matrix2::new((c - b) * speed * speed + spring, 0.0, 0.0, (c - a) * speed * speed + spring);
        let inverse = mass.try_inverse().expect("it has mass");
        let mut matrix = Matrix4::zeros();
        matrix.fixed_view_mut::<2, 2>(0, 2).fill_with_identity();
        matrix.fixed_view_mut::<2, 2>(2, 0).copy_from(&(-inverse * springs));
        matrix.fixed_view_mut::<2, 2>(2, 2).copy_from(&(-inverse * turning));
        let expected: Vec<_> = matrix.complex_eigenvalues().iter().map(|value| (value * (TAU / speed)).exp()).collect();
        let orbit = found(&rotor, speed, None);
        let largest = expected.iter().map(|value| value.modulus()).fold(0.0, f64::max);
        within(&format!("multipliers at {speed} rad/s"), astray(&orbit, &expected) / largest, 5e-9);
        assert_eq!(orbit.loss().is_some(), largest > 1.0 + 1e-5, "at {speed} rad/s: {largest}");
        lost += u32::from(orbit.loss().is_some());
    }
    assert!((1..4).contains(&lost), "one of them lasts, and one does not: {lost}");
}

#[test]
fn what_does_not_come_back_is_not_found() {
    let bearing =
        "[[effects.bearing]]\nposition = 0.0\nkyy = 1e4\nkzz = 1e4\ncyy = 30.0\nczz = 30.0\nkt = 100.0\nct = 0.1\n";
    let rotor =
        "[rotor]\nm = 4.9\nJa = 0.05\nJt = 0.08\n[[effects.unbalance]]\nmass = 0.1\nradius = 0.1\nposition = 0.0\n";
    let falls = format!("{rotor}{bearing}[effects.gravity]\ng = {{ x = -9.81 }}\n");
    let resonates =
        rotor.replace("Jt = 0.08\n", "Jt = 0.08\nl = 0.0\n") + "[effects.support]\nc1 = 2000.0\nc2 = 100.0\n";
    for (text, speed) in [(falls, 50.0), (resonates, 20.0)] {
        assert_eq!(rotating(&text).orbit(speed, None).err(), Some(Obstacle::NotFound { speed }), "{text}");
    }
    // Held across the axis alone, it stays where it is along it.
    let orbit = found(&rotating(&format!("{rotor}{bearing}")), 50.0, None);
    assert_eq!(orbit.loss(), None);
}

/// A rotor that runs against a ring as it whirls: above its critical speed it whirls within, or far out on it.
const RING: &str = "[rotor]\nm = 5.0\nJa = 0.05\nJt = 0.08\n\
    [[effects.bearing]]\nposition = -0.2\nkyy = 1e5\nkzz = 1e5\ncyy = 60.0\nczz = 60.0\nkxx = 1e5\ncxx = 300.0\n\
    [[effects.bearing]]\nposition = 0.2\nkyy = 1e5\nkzz = 1e5\ncyy = 60.0\nczz = 60.0\n\
    [[effects.unbalance]]\nmass = 1e-2\nradius = 5e-2\nposition = 0.0\n\
    [[effects.rub]]\nposition = 0.0\ngap = 3e-4\nstiffness = 4e5\nradius = 0.05\nv0 = 0.01\n";

/// The speed above which no circle of the radius A lasts on the ring: the largest ω of
/// (K − mω²)² + (cω)² = (U ω²/A)², K = k + k_ring (1 − g/A).
fn exact_fold() -> f64 {
    let (m, c, first, gap) = (5.01, 120.0, 5e-4, 3e-4);
    let speed = |size: f64| {
        let k = 2e5 + 4e5 * (1.0 - gap / size);
        let [square, line] = [m * m - first * first / (size * size), c * c - 2.0 * k * m];
        ((-line + (line * line - 4.0 * square * k * k).sqrt()) / (2.0 * square)).sqrt()
    };
    let slope = |size: f64| derivative(|size| [speed(size)], size, 1e-5)[0];
    let (mut low, mut high) = (1.0e-3, 1.3e-3);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if slope(middle) > 0.0 { low = middle } else { high = middle }
    }
    speed(low)
}

/// The harmonic of a run at this speed once it has settled, which begins at a hundredth more than `near`.
fn settled(speed: f64, near: linear::Orbit) -> linear::Orbit {
    let [y, z] = [near.y.re, near.z.re].map(|at| 1.01 * at);
    let [vy, vz] = [-z * speed, y * speed];
    let start =
        format!("[start]\nr_c = {{ y = {y}, z = {z} }}\nv_c = {{ y = {vy}, z = {vz} }}\nomega = {{ x = {speed} }}\n");
    let mut run = Named::written(&format!("{RING}{start}[effects.imposed_speed]\nw = {speed}\n"));
    run.set("solver.relative_tolerance", 1e-9);
    run.start();
    const POINTS: u32 = 64;
    let mut seen = [Complex::from(0.0); 2];
    for n in 0..POINTS {
        let turns = 150.0 + f64::from(n) / f64::from(POINTS);
        run.simulation.advance(TAU / speed * turns).expect("a calm run");
        let (sine, cosine) = libm::sincos(TAU * turns);
        let c = run.simulation.read().expect("a motion").motion.r_c();
        seen[0] += Complex::new(cosine, -sine) * (2.0 / f64::from(POINTS)) * c.y;
        seen[1] += Complex::new(cosine, -sine) * (2.0 / f64::from(POINTS)) * c.z;
    }
    linear::Orbit { y: seen[0], z: seen[1] }
}

/// The motion of a branch at a speed: by those beside it that last, or do not.
fn at(ring: &Rotating, branch: &Branch, speed: f64, lasts: bool) -> Orbit {
    let like = branch.orbits.iter().filter(|orbit| orbit.loss().is_none() == lasts);
    let nearest = like.min_by(|a, b| (a.speed - speed).abs().total_cmp(&(b.speed - speed).abs()));
    found(ring, speed, nearest)
}

#[test]
fn motions_on_a_ring_are_those_that_runs_settle_to() {
    let ring = rotating(RING);
    let up = ring.branch([150.0, 380.0], 40).expect("it begins within the ring");
    let down = ring.branch([380.0, 200.0], 40).expect("it begins within the ring");
    // Up it goes around a fold, and back until it leaves the ring; down it goes until it meets that.
    let folds: Vec<_> = up.folds().map(|n| up.orbits[n].speed).collect();
    let [fold] = folds[..] else { panic!("{folds:?}") };
    let [met, meets] = [&up, &down].map(|branch| branch.orbits.last().expect("it has some"));
    within("fold", (fold / exact_fold() - 1.0).abs(), 1e-9);
    within(
        "both end at the gap",
        (met.path(0.0).farthest / 3e-4 - 1.0).abs().max((meets.path(0.0).farthest / 3e-4 - 1.0).abs()),
        2e-3,
    );
    within("in one place", (met.speed / meets.speed - 1.0).abs(), 2e-3);
    assert!(matches!(up.end, End::Lost(_)) && fold > 1.2 * met.speed, "{:?}", up.end);
    // Ten speeds at which there is one motion, ten at which there are three: within and far out runs settle.
    let middle = 0.5 * (fold + met.speed);
    for n in 0..10 {
        let single = 160.0 + 8.0 * f64::from(n);
        let bistable = middle + 0.045 * (fold - met.speed) * f64::from(2 * n - 9);
        for (speed, branch) in [(single, &up), (bistable, &up), (bistable, &down)] {
            let once = at(&ring, branch, speed, true).path(0.0).once;
            // From near it: a run from rest may settle to either.
            within(&format!("at {speed} rad/s"), apart(&settled(speed, once), &once), 1e-6);
        }
        let between = at(&ring, &up, bistable, false);
        assert_eq!(between.loss(), Some(Loss::Away), "at {bistable} rad/s");
        let [inner, outer] = [&down, &up].map(|branch| at(&ring, branch, bistable, true).path(0.0).farthest);
        let size = between.path(0.0).farthest;
        assert!(inner < size && size < outer, "at {bistable} rad/s: {inner}, {size}, {outer}");
    }
}
