//! What the watch says of tops, and of rotors with ports.

use crate::harness::named::Named;
use crate::harness::within;
use oracles::top::Upright;
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
