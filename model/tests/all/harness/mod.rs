//! What every test of a whole run needs: a scene as a value, its simulation, and a bound that prints what it measured.

pub mod asymmetric;
pub mod named;
pub mod swinging;

use named::Named;
pub use oracles::bounds::{largest, within};
use oracles::machine::{self, Machine, Start};

use nalgebra::{Vector2, Vector3};
use proptest::strategy::Strategy;
use proptest::test_runner::{Config as ProptestConfig, RngSeed};
use split_rotor_model::body::Body;
use split_rotor_model::effects::drive::Drive;
use split_rotor_model::effects::gravity::Gravity;
use split_rotor_model::effects::support::Support;
use split_rotor_model::effects::{Called, Effects, Entry, named};
use split_rotor_model::integrate::sizes::MOST_GROUPS;
use split_rotor_model::integrate::tableau::{DOP853, DOPRI5, Tableau};
use split_rotor_model::integrate::{Tolerance, explicit::Explicit};
use split_rotor_model::rotation::Chart;
use split_rotor_model::rotor::{Rotor, whole_rates};
use split_rotor_model::scalar::Scalar;
use split_rotor_model::simulation::General;
use split_rotor_model::state::{COORDINATES, Coordinates, Kinematics};
use split_rotor_model::variable::Place;
use split_rotor_model::variables::{Reading, of_scene};

/// Gravity and the support: the paper's effects. Tests of the equations and of single methods take them as a type; whole runs take the
/// list of all effects, which is compiled once.
pub type Supported = (Called<Gravity, 1>, (Called<Support, 1>, ()));

/// The same by their names.
pub const SUPPORTED: &[&str] = &["gravity", "support"];

/// Gravity, the support and the drive.
pub const DRIVEN: &[&str] = &["gravity", "support", "drive"];

/// The drive alone.
pub const DRIVEN_FREE: &[&str] = &["drive"];

/// No effects.
pub const FREE: &[&str] = &[];

/// Where `drive.tau` stands; `drive.phi`, `.w` and `.a` follow.
pub const TORQUE: Place = Place { block: Place::effect_block(Drive::NUMBER, 1), row: 0 };

/// An explicit pair, by its number in the scene.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Method {
    /// Order 5.
    Dopri5 = 2,
    /// Order 8.
    Dop853 = 3,
}

impl Method {
    /// Both.
    pub const PAIRS: [Self; 2] = [Self::Dopri5, Self::Dop853];

    /// Its coefficients.
    pub fn tableau(self) -> &'static Tableau {
        match self {
            Self::Dopri5 => &DOPRI5,
            Self::Dop853 => &DOP853,
        }
    }
}

/// Everything that a scene says, in the units of the variables.
#[derive(Clone, Debug)]
#[allow(missing_docs, reason = "the names of the variables")]
pub struct Scene {
    pub body: Body,
    pub r_c: Vector3<f64>,
    pub v_c: Vector3<f64>,
    pub phi: f64,
    pub gamma: Vector2<f64>,
    pub omega: Vector3<f64>,
    pub g: Vector3<f64>,
    pub c1: f64,
    pub c2: f64,
    pub d1: f64,
    pub d2: f64,
    pub method: Method,
    pub tolerance: f64,
}

impl Scene {
    /// The paper's example (`scenes/paper.toml`).
    pub fn paper() -> Self {
        Self {
            body: Body { m: 5.0, Ja: 0.15625, Jt: 0.078125, l: 0.75 },
            r_c: Vector3::new(0.75, 0.0, 0.0),
            v_c: Vector3::zeros(),
            phi: 0.0,
            gamma: Vector2::zeros(),
            omega: Vector3::new(50.0, 0.0, 0.0),
            g: Vector3::new(0.0, 0.0, -9.81),
            c1: 2000.0,
            c2: 500.0,
            d1: 0.0,
            d2: 0.0,
            method: Method::Dop853,
            tolerance: 1e-10,
        }
    }

    /// The paper's rotor with nothing acting on it.
    pub fn free() -> Self {
        Self { g: Vector3::zeros(), c1: 0.0, c2: 0.0, r_c: Vector3::zeros(), ..Self::paper() }
    }

    /// It as a machine, under these of its effects. What others would do must be zero.
    fn machine(&self, effects: &[&str]) -> Machine {
        let Body { m, Ja, Jt, l } = self.body;
        let support = machine::Support { c: [self.c1, self.c2], d: [self.d1, self.d2] };
        let acts = |effect: &str, is_none: bool| {
            let acts = effects.contains(&effect);
            assert!(acts || is_none, "{effect} is not of this scene");
            acts
        };
        Machine {
            m,
            Ja,
            Jt,
            l,
            start: Start { r_c: self.r_c, v_c: self.v_c, phi: self.phi, gamma: self.gamma, omega: self.omega },
            gravity: acts("gravity", self.g == Vector3::zeros()).then_some(self.g),
            support: acts("support", [support.c, support.d] == [[0.0; 2]; 2]).then_some(support),
            ..Machine::default()
        }
    }

    /// Its simulation under these effects, started at time 0.
    pub fn started(&self, effects: &[&str]) -> General {
        let mut named = Named::general(&self.machine(effects));
        effects.iter().for_each(|effect| named.set(&format!("effects.{effect}"), 1.0));
        named.set("solver.method", f64::from(self.method as i32));
        named.set("solver.relative_tolerance", self.tolerance);
        named.start();
        named.simulation
    }

    /// What its simulation under these effects shows at each of these times [s].
    pub fn run(&self, effects: &[&str], times: impl IntoIterator<Item = f64>) -> Vec<Reading> {
        let mut simulation = self.started(effects);
        times.into_iter().map(|t| at(&mut simulation, t)).collect()
    }

    /// A list of effects that holds gravity and the support, as they act here.
    pub fn effects<E: Effects>(&self) -> E {
        let (mut effects, first) = (E::default(), Place::effect_block(1, 1));
        let variables = of_scene(&[(named("gravity").unwrap(), 1), (named("support").unwrap(), 1)]);
        for (name, value) in self.machine(SUPPORTED).settings() {
            let of_effect = variables.iter().find(|v| v.name == name && v.place.block >= first);
            assert!(of_effect.is_none_or(|variable| effects.set_parameter(variable.place, value)), "{name}");
        }
        effects
    }

    /// Its equations of motion with gravity and the support.
    pub fn rotor(&self) -> Rotor<'static, Supported> {
        Rotor::new(self.body.into(), kept(self.effects()), Chart::FromE, 0.0)
    }

    /// The rates of these coordinates.
    pub fn rates<S: Scalar>(&self, y: &[S; COORDINATES]) -> [S; COORDINATES] {
        let rotor = self.rotor();
        whole_rates(rotor.effects, &rotor.motion(0.0, y), y)
    }

    /// Its state at the start, in the order of the coordinates.
    pub fn state(&self) -> [f64; 12] {
        let axis = oracles::rotation::axis(&self.gamma);
        let k_c = self.omega * self.body.Jt + axis * ((self.body.Ja - self.body.Jt) * self.omega.dot(&axis));
        let at = Coordinates { r: self.r_c, v: self.v_c, k: k_c, gamma: self.gamma, phi: self.phi };
        let mut y = [0.0; 12];
        at.write(&mut y);
        y
    }

    /// The method by itself, to take steps of a given size.
    pub fn stepper(&self) -> Explicit<12> {
        Explicit::start(self.method.tableau(), tolerance(1.0), &self.rotor(), 0.0, self.state())
    }
}

/// Effects that a rotor borrows for as long as the test runs.
pub fn kept<E>(effects: E) -> &'static E {
    Box::leak(Box::new(effects))
}

/// This relative tolerance [1], of a motion that is of size 1 in each group.
pub fn tolerance(relative: f64) -> Tolerance {
    Tolerance { relative, absolute: [0.0; MOST_GROUPS], nominal: [1.0; MOST_GROUPS] }
}

/// What the simulation shows at time `t` [s].
pub fn at(simulation: &mut General, t: f64) -> Reading {
    simulation.advance(t).expect("a possible motion");
    *simulation.read().expect("possible parameters")
}

/// Total angular momentum about e through O [kg·m²/s].
pub fn momentum_about_e(motion: &Kinematics<f64>) -> f64 {
    (motion.at.r.cross(&motion.at.v) * motion.body.m + motion.at.k).x
}

/// Times from 0 to `end` [s], `parts` + 1 of them.
pub fn times(end: f64, parts: u32) -> impl Iterator<Item = f64> {
    (0..=parts).map(move |i| end * f64::from(i) / f64::from(parts))
}

/// A property is tried on `cases` cases, the same in every run; PROPTEST_CASES and PROPTEST_RNG_SEED ask for others.
pub fn properties(cases: u32) -> ProptestConfig {
    let asked = ProptestConfig::default();
    ProptestConfig {
        cases: if std::env::var_os("PROPTEST_CASES").is_some() { asked.cases } else { cases },
        rng_seed: if asked.rng_seed == RngSeed::Random { RngSeed::Fixed(2018) } else { asked.rng_seed },
        failure_persistence: None,
        ..asked
    }
}

/// A vector whose components are no larger than this.
pub fn vector(size: f64) -> impl Strategy<Value = Vector3<f64>> {
    [-size..size, -size..size, -size..size].prop_map(Vector3::from)
}

/// Numbers that look random, the same in every run (Knuth's multiplier).
pub struct Random(pub u64);

impl Random {
    /// One from `low` to `high`.
    pub fn within(&mut self, low: f64, high: f64) -> f64 {
        self.0 = self.0.wrapping_mul(6_364_136_223_846_793_005).wrapping_add(1_442_695_040_888_963_407);
        low + (high - low) * ((self.0 >> 11) as f64 / (1_u64 << 53) as f64)
    }
}
