//! What every effect must keep, with any parameters and inputs, in any motion of either chart: the power of its load is what
//! it supplies, less what it loses and what its potential gains; and that it is analytic where it says so. A new effect needs no word
//! about it. A program of its own: who adds an effect runs it without compiling all other tests.

#[allow(dead_code, reason = "what the other tests need of it")]
#[path = "all/harness/mod.rs"]
mod harness;

use harness::named::ascending;
use harness::{Random, Scene, largest, within};
use nalgebra::{Vector2, Vector3};
use split_rotor_model::body::{Inertia, Shape};
use split_rotor_model::dual::Tangent;
use split_rotor_model::effects::{Act, All, CATALOGUE, Effects, Info, MOST_INDICATORS, Motion};
use split_rotor_model::rotation::Chart;
use split_rotor_model::rotor::{Rotor, whole_rates};
use split_rotor_model::simulation::Any;
use split_rotor_model::state::{Coordinates, Kinematics};
use split_rotor_model::variable::{Bound, Place, Role};
use std::f64::consts::PI;

/// So many motions in each chart.
const SAMPLES: u32 = 400;

/// So likely is a number that may be zero \[1].
const ABSENT: f64 = 0.4;

/// The powers' sum over the largest of them [1]: measured 1.5e-14.
const BALANCE: f64 = 5e-14;

/// The effect alone, with random parameters and inputs, and with a table, if it may have one, or without.
fn drawn(info: &Info, random: &mut Random) -> All {
    let has_table = random.within(0.0, 1.0) < 0.5;
    drawn_with(info, random, has_table).unwrap_or_else(|| drawn(info, random))
}

/// The same with a table or without; None of what cannot be.
fn drawn_with(info: &Info, random: &mut Random, has_table: bool) -> Option<All> {
    let mut effects = All::default();
    let block = Place::effect_block(info.number, 1);
    effects.switch_on(block);
    for (row, meta) in (info.metas)() {
        let place = Place { block, row };
        // Often a part of the law is not there; a table is, or it is not.
        let is_absent = if meta.node().is_some() { !has_table } else { random.within(0.0, 1.0) < ABSENT };
        match meta.role {
            Role::Parameter { bound: Bound::Finite | Bound::NotNegative, .. } if is_absent => {
                effects.set_parameter(place, ascending(&meta));
            }
            Role::Parameter { bound: Bound::Finite, .. } => {
                effects.set_parameter(place, random.within(-1.0, 1.0));
            }
            Role::Parameter { .. } => {
                effects.set_parameter(place, random.within(1.0, 2.0) + ascending(&meta));
            }
            Role::Input { .. } => effects.signal_mut(place).expect("an input").set(0.0, random.within(-2.0, 2.0)),
            _ => {}
        }
    }
    effects.check().is_ok().then_some(effects)
}

fn motion(chart: Chart, random: &mut Random) -> Coordinates<f64> {
    let mut vector = |size: f64| Vector3::from_fn(|_, _| random.within(-size, size));
    let (r, v, k) = (vector(1.0), vector(3.0), vector(4.0));
    let (theta, psi) = (random.within(0.3, if chart == Chart::FromE { 2.5 } else { 2.2 }), random.within(-3.0, 3.0));
    let gamma = Vector2::new(libm::cos(psi), libm::sin(psi)) * theta;
    Coordinates { r, v, k, gamma, phi: random.within(-3.0, 3.0) }
}

/// The paper's rotor of another Jt2, with a mass on it.
fn asymmetric() -> Inertia {
    let mut shape = Shape::of(Scene::paper().body);
    shape.Jt2 = Some(0.1);
    shape.add(0.5, &Vector3::new(0.2, 0.1, -0.15));
    shape.inertia()
}

/// The same motion, its place and housings moving with time.
fn moving(motion: &Kinematics<f64>) -> Kinematics<Tangent> {
    let at = &motion.at;
    let still = |v: &Vector3<f64>| v.map(|x| Tangent::along(x, 0.0));
    let moving = Kinematics::new(
        motion.body,
        motion.tilt.chart(),
        Coordinates {
            r: at.r.zip_map(&at.v, Tangent::along),
            v: still(&at.v),
            k: still(&at.k),
            gamma: at.gamma.zip_map(&motion.gamma_rate(), Tangent::along),
            phi: Tangent::along(at.phi, motion.phi_rate()),
        },
    );
    Kinematics { t: Tangent::along(motion.t, 1.0), ..moving }
}

#[test]
fn exact_power_of_each_effect() {
    for info in CATALOGUE {
        let mut random = Random(u64::from(info.number));
        let (mut worst, mut worked, mut denied) = (0.0, 0.0, 0);
        for sample in 0..2 * SAMPLES {
            let chart = if sample % 2 == 0 { Chart::FromE } else { Chart::FromMinusE };
            let mut effects = drawn(info, &mut random);
            let body = if sample % 4 < 2 { Scene::paper().body.into() } else { asymmetric() };
            let at = motion(chart, &mut random);
            let faster = Coordinates { v: at.v * 2.0, k: at.k * -3.0, ..at };
            let [motion, faster] = [at, faster].map(|at| Kinematics::new(body, chart, at));
            let own: [f64; All::FACTS.own] = std::array::from_fn(|_| random.within(-2.0, 2.0));
            effects.begin(&motion, &mut own.clone(), &mut own.clone());
            effects.step_from(motion.t);
            let mut sides = [1.0; MOST_INDICATORS];
            effects.indicators(&motion, &own, &mut sides);
            effects.switch(&sides.map(|side| side > 0.0), &motion, &own);
            let Act { load, damping, supply, loss, .. } = effects.act(&Motion::new(&motion, &own));
            let (load_alone, load) = (load, load + damping);
            let mut rates = [0.0; All::FACTS.own];
            effects.own_rates(&Motion::new(&motion, &own), &mut rates);
            let moving_own: [Tangent; All::FACTS.own] = std::array::from_fn(|n| Tangent::along(own[n], rates[n]));
            let [of_potential] = effects.stored(&Motion::new(&moving(&motion), &moving_own)).eps;
            let powers = [load.force.dot(&motion.v_c()), load.moment.dot(&motion.omega), of_potential, loss, -supply];
            let size = largest(powers.map(f64::abs)).max(1.0);
            worst = largest([worst, powers.iter().sum::<f64>().abs() / size]);
            worked = largest([worked, size]);
            assert!(loss >= 0.0, "{} loses {loss:e} W", info.name);
            assert!(effects.works() || (loss == 0.0 && supply == 0.0), "{} works and denies it", info.name);
            let there = effects.act(&Motion::new(&faster, &own));
            let same = there.load == load_alone && there.damping == damping;
            assert!(effects.follows_speed() || same, "{} follows the speed and denies it", info.name);
            denied += u32::from(!effects.follows_speed());
        }
        within(&format!("{}, of up to {worked:.0} W", info.name), worst, BALANCE);
        println!("{denied} of {} do not follow the speed", 2 * SAMPLES);
    }
}

/// Along so many lines.
const LINES: u32 = 20;

/// Chebyshev coefficients along each, of which the last quarter tells whether they fall as those of an analytic function.
const COEFFICIENTS: usize = 64;

/// The last quarter over the largest \[1]: of what is analytic measured 3.9e-15, of what is not at least 2.7e-6.
const SMOOTH: f64 = 2e-14;
const BENT: f64 = 5e-7;

/// The rates of the rotor under these effects where a line of motions from one to the other is at `s` from −1 to 1.
fn rates_on_line(effects: &mut All, ends: &[Coordinates<f64>; 2], s: f64) -> [f64; Any::STATES] {
    let mut shape = Shape::of(Scene::paper().body);
    effects.shape(&mut shape);
    let mut y = [[0.0; Any::STATES]; 2];
    for (y, end) in y.iter_mut().zip(ends) {
        y[..All::FACTS.own].fill(0.5);
        end.write(&mut y[All::FACTS.own..]);
    }
    let y: [f64; Any::STATES] = std::array::from_fn(|n| 0.5 * ((1.0 - s) * y[0][n] + (1.0 + s) * y[1][n]));
    let own = &y[..All::FACTS.own];
    let motion = Rotor::new(shape.inertia(), effects, Chart::FromE, 0.0).motion(0.0, &y);
    let mut sides = [1.0; MOST_INDICATORS];
    effects.indicators(&motion, own, &mut sides);
    effects.switch(&sides.map(|side| side > 0.0), &motion, own);
    whole_rates(effects, &motion, &y)
}

/// The largest of the last quarter of Chebyshev coefficients along a line, over the largest of all \[1].
fn tail(effects: &mut All, ends: &[Coordinates<f64>; 2]) -> f64 {
    let angle = |n: usize| PI * (n as f64 + 0.5) / COEFFICIENTS as f64;
    let samples: Vec<_> = (0..COEFFICIENTS).map(|n| rates_on_line(effects, ends, libm::cos(angle(n)))).collect();
    let coefficient = |(rate, k): (usize, usize)| {
        let terms = samples.iter().enumerate().map(|(n, rates)| rates[rate] * libm::cos(k as f64 * angle(n)));
        terms.sum::<f64>().abs()
    };
    let most = |from: usize| {
        largest((from..COEFFICIENTS).flat_map(|k| (0..Any::STATES).map(move |rate| (rate, k))).map(coefficient))
    };
    most(COEFFICIENTS * 3 / 4) / most(0)
}

/// Along lines that lead through rest, through the nodes of tables and into rings.
#[test]
fn exact_laws_are_analytic_where_they_say_so() {
    for info in CATALOGUE {
        for (has_table, analytic) in [(false, info.facts.analytic), (true, info.facts_with_table.analytic)] {
            let mut random = Random(u64::from(info.number));
            let mut worst: f64 = 0.0;
            for _ in 0..LINES {
                let Some(mut effects) = drawn_with(info, &mut random, has_table) else { continue };
                let mut end = || {
                    let mut at = motion(Chart::FromE, &mut random);
                    at.gamma *= 0.4;
                    Coordinates { r: at.r * 3.0, ..at }
                };
                let ends = [end(), end()];
                worst = worst.max(tail(&mut effects, &ends));
            }
            println!("{} with a table {has_table}: {worst:.1e}, analytic {analytic}", info.name);
            assert!(if analytic { worst < SMOOTH } else { worst > BENT }, "{}: {worst:e}", info.name);
        }
    }
}
