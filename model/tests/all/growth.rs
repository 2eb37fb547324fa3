//! What the watch says of tops, and of rotors with ports.

use crate::harness::named::Named;
use crate::harness::within;
use crate::random_scenes::dice::Dice;
use oracles::top::Upright;
use split_rotor_model::periodic::{Obstacle, Rotating};
use split_rotor_model::simulation::Integrator;

/// An upright top on an elastic point [kg, kg·m², m, N/m, m/s²].
const TOP: Upright = Upright { m: 0.5, Ja: 2.5e-4, Jt: 2.0e-4, l: 0.04, c1: 1e5, g: 9.81, spin: 0.0 };

/// It, as it begins at this spin [rad/s] with its mass centre at `x` \[m], and what the scene has besides.
fn top(spin: f64, x: f64, rest: &str) -> String {
    let Upright { m, Ja, Jt, l, c1, g, .. } = TOP;
    format!(
        "[rotor]\nm = {m:?}\nJa = {Ja:?}\nJt = {Jt:?}\nl = {l:?}\n[start]\nomega = {{ x = {spin:?} }}\nr_c = {{ x = {x:?} }}\n\
         gamma = {{ z = 1e-4 }}\n[effects.gravity]\ng = {{ x = {:?} }}\n[effects.support]\nc1 = {c1:?}\n{rest}",
        -g
    )
}

/// Of the rate of growth \[1]: measured 7.8e-8.
const TOPS: f64 = 3e-7;

/// A top whose spring has not taken up its weight yet: nothing was reported at 5 to 110 rad/s, and 35.36 s instead of 0.0714 s at rest.
#[test]
fn regress_exact_growth_of_an_upright_top_on_an_unloaded_spring() {
    let Upright { m, l, c1, g, .. } = TOP;
    let mut worst: f64 = 0.0;
    for x in [l, l - m * g / c1, l + 1e-3] {
        for spin in [0.0, 5.0, 40.0, 80.0, 100.0, 110.0, 111.0] {
            for integrator in [Integrator::Method, Integrator::Host] {
                let mut named = Named::written_for(&top(spin, x, ""), integrator);
                named.start();
                let found = named.simulation.growth().expect("a top that falls");
                let exact = -Upright { spin, ..TOP }.fastest_growing().im;
                worst = worst.max((found.rate / exact - 1.0).abs());
            }
        }
        for spin in [113.0, 200.0] {
            assert_eq!(Named::started(&top(spin, x, "")).simulation.growth(), None, "{spin} rad/s");
        }
    }
    within("growth", worst, TOPS);
    // The closed form of the rigid point, by hand: (m g l/(Jt + m l²))^(-1/2) = 0.0714 s.
    let found = Named::started(&top(0.0, l, "")).simulation.growth().expect("a top that falls");
    within("at rest", (found.rate * 0.0714 - 1.0).abs(), 2e-3);
    let found = Named::started(&top(80.0, l, "")).simulation.growth().expect("a top that falls");
    within("at 80 rad/s", (found.rate * 0.102 - 1.0).abs(), 5e-3);
}

/// A top that hangs is stable, whatever its spring holds at the start.
#[test]
fn regress_a_hanging_top_is_not_called_unstable() {
    for spin in [0.0, 5.0, 80.0] {
        let text = top(spin, TOP.l, "").replace("x = -9.81", "x = 9.81");
        assert_eq!(Named::started(&text).simulation.growth(), None, "{spin} rad/s");
    }
}

/// What comes in at ports is taken as held, and the message says so; without ports it does not.
#[test]
fn regress_growth_beside_ports_is_told_with_their_loads_held() {
    let ports = "[[effects.port]]\nposition = 0.1\n[[effects.port]]\nposition = -0.1\n";
    for (rest, says) in [(ports, true), ("", false)] {
        let named = Named::started(&top(80.0, TOP.l, rest));
        let found = named.simulation.growth().expect("a top that falls");
        let message = found.to_string();
        assert_eq!(found.at_ports, says, "{message}");
        assert_eq!(message.contains("unstable with the loads at its ports held: small motions"), says, "{message}");
    }
}

/// A rotor that is not symmetric about its axis, at this spin [rad/s], in bearings of these coefficients at these places.
fn uneven(shape: &str, jt2: f64, spin: f64, places: &[f64], coefficients: &str) -> String {
    let start = format!("[start]\nomega.x = {spin:?}\n[effects.asymmetry]\nJt2 = {jt2:?}\n");
    let bearing = |place: &f64| format!("[[effects.bearing]]\nposition = {place:?}\n{coefficients}");
    format!("[rotor]\n{shape}{start}{}", places.iter().map(bearing).collect::<String>())
}

/// How fast that rotor grows, if it does [1/s], by a run of ours and by a host's.
fn growth_of(text: &str) -> Option<f64> {
    let found = [Integrator::Method, Integrator::Host].map(|integrator| {
        let mut named = Named::written_for(text, integrator);
        named.start();
        named.simulation.growth().map(|found| found.rate)
    });
    assert_eq!(found[0], found[1], "{text}");
    found[0]
}

/// Of the rate of growth \[1]: measured 1.6e-14.
const TURNING: f64 = 1e-13;

/// Supports that are alike all round: as the body sees them the equations are constant. About the two axes of the body, with
/// g = (Ja − Jt − Jt2) Ω:  (Jt s² + k − (Jt2 − Ja) Ω²)(Jt2 s² + k − (Jt − Ja) Ω²) + g² s² = 0.
#[test]
fn regress_exact_growth_of_an_asymmetric_body_in_round_supports() {
    let [ja, jt, jt2, k] = [0.05, 0.1, 0.13, 2e5];
    let rotor =
        |spin| uneven("m = 10.0\nJa = 0.05\nJt = 0.1\n", jt2, spin, &[-0.1, 0.1], "kyy = 1e7\nkzz = 1e7\nkxx = 1e5\n");
    for spin in [1620.0, 1800.0, -1800.0, 1960.0] {
        let (a, b) = (k - (jt2 - ja) * spin * spin, k - (jt - ja) * spin * spin);
        let g = (ja - jt - jt2) * spin;
        let middle = jt * b + jt2 * a + g * g;
        let exact = ((-middle + (middle * middle - 4.0 * jt * jt2 * a * b).sqrt()) / (2.0 * jt * jt2)).sqrt();
        let found = growth_of(&rotor(spin)).unwrap_or_else(|| panic!("{spin} rad/s: it grows by {exact} 1/s"));
        within(&format!("{spin} rad/s"), (found / exact - 1.0).abs(), TURNING);
    }
    for spin in [0.0, 100.0, 1560.0, 2040.0, 5000.0] {
        assert_eq!(growth_of(&rotor(spin)), None, "{spin} rad/s");
    }
}

/// A body that is hardly asymmetric grows as the symmetric one does \[1]: 329 1/s, measured 2.9e-4 beside it.
const HARDLY: f64 = 1e-3;

/// It left by 5 m in 50 ms, and nothing was reported.
#[test]
fn regress_growth_of_a_hardly_asymmetric_body_is_that_of_the_symmetric_one() {
    for coefficients in ["kyy = -2e5\nkzz = -2e5\n", "kyy = -2e5\nkzz = -3e5\n"] {
        let rotor = uneven("m = 6.0\nJa = 0.01\nJt = 0.06\n", 0.0601, 100.0, &[0.15], coefficients);
        let symmetric = rotor.replace("[effects.asymmetry]\nJt2 = 0.0601\n", "");
        let exact = growth_of(&symmetric).expect("a spring that pushes away");
        let found = growth_of(&rotor).unwrap_or_else(|| panic!("it grows by {exact} 1/s"));
        within("growth", (found / exact - 1.0).abs(), HARDLY);
    }
}

/// Bodies and supports that are more and less alike all round, of either sign: what is reported grows by the multipliers of a revolution too.
#[test]
fn exact_no_asymmetric_body_is_called_unstable_that_is_not() {
    let (mut reported, mut silent, mut stable) = (0, 0, 0);
    for number in 0..150 {
        let mut dice = Dice::new(0x40_a5 + number);
        let [body, supports] = [(); 2].map(|()| if dice.chance(0.2) { 0.0 } else { dice.decades(1e-3, 0.5) });
        let (m, jt, rate) = (10.0, 0.1, dice.decades(100.0, 1000.0));
        let part = body.max(2e-3);
        // Between the two across, or beside them.
        let axial = if dice.chance(0.5) { 1.0 + part * dice.within(-0.5, 1.5) } else { dice.within(0.6, 1.6) };
        let (ja, jt2) = (jt * axial, jt * (1.0 + part));
        let spin = rate * dice.decades(0.3, 5.0) * dice.sign();
        let damping = if dice.chance(0.5) { m * rate * dice.decades(1e-4, 0.1) } else { 0.0 };
        let sign = if dice.chance(0.3) { -1.0 } else { 1.0 };
        let kyy = sign * m * rate * rate;
        let coefficients = format!(
            "kyy = {kyy:?}\nkzz = {:?}\nkxx = 1e5\ncyy = {damping:?}\nczz = {damping:?}\n",
            kyy * (1.0 + supports)
        );
        let shape = format!("m = {m:?}\nJa = {ja:?}\nJt = {jt:?}\n");
        let rotor = uneven(&shape, jt2, spin, &[-0.1, dice.within(0.0, 0.2)], &coefficients);
        let exact =
            match Rotating::of(Named::started(&rotor).simulation.parameters()).expect("a rotor").orbit(spin, None) {
                Ok(orbit) => orbit.exponents().iter().map(|exponent| exponent.re).fold(0.0, f64::max),
                Err(Obstacle::Grows { rate, .. }) => rate,
                Err(obstacle) => panic!("{obstacle}\n{rotor}"),
            };
        let grows = exact > 1e-5 * spin.abs();
        match growth_of(&rotor) {
            Some(found) => {
                reported += 1;
                assert!(grows && (0.5..2.0).contains(&(found / exact)), "{found} 1/s reported, {exact} 1/s\n{rotor}");
            }
            None if grows => silent += 1,
            None => stable += 1,
        }
    }
    println!("{reported} reported, {silent} not, {stable} stable");
    assert!(reported > 30 && stable > 30, "{reported} reported, {silent} not, {stable} stable");
}

/// Neither the body nor its supports are alike all round: what is less than either may make of it is not reported.
#[test]
fn an_asymmetric_body_that_is_stable_is_not_called_unstable() {
    for spin in [0.0, 50.0, 300.0, 1500.0, 2500.0, 5000.0] {
        for damping in [0.0, 50.0] {
            let springs = format!("kyy = 2e6\nkzz = 1e6\nkxx = 1e5\ncyy = {damping:?}\nczz = {damping:?}\n");
            let rotor = uneven("m = 10.0\nJa = 0.05\nJt = 0.1\n", 0.102, spin, &[-0.1, 0.13], &springs);
            assert_eq!(growth_of(&rotor), None, "{rotor}");
        }
    }
}
