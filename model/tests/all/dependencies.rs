//! What `dependencies` lists, against derivatives at random motions, by dual numbers of states and inputs. Nothing is missing, and
//! of inputs nothing is too much: a partner's solver would see an algebraic loop. At the start: `dependencies_of_draws.rs`.

use crate::dependencies_of_draws::somewhere;
use crate::harness::Random;
use crate::harness::named::{Named, names};
use split_rotor_model::dependencies::Dependencies;
use split_rotor_model::simulation::{Any, Integrator};
use split_rotor_model::variable::{Kind, Role};
use split_rotor_model::variables::Variable;
use std::collections::{BTreeMap, BTreeSet};

/// Pairs of names: what depends, and on what.
type Pairs = BTreeSet<(String, String)>;

/// So many motions in each chart.
const SAMPLES: u32 = 24;

/// A derivative below the first, relative to the largest of the variable and 1, is none, and one above the second is one.
/// Measured 4.2e-12 and less for those that are none, 6.7e-6 and more for the others.
const NONE: (f64, f64) = (1e-10, 1e-7);

/// At 0 a motor's law is another one.
const MOTOR: &str = "motor.time_constant";

/// Few motions touch a ring, and fewer while a speed is imposed; whether they do jumps.
fn is_of_contact(of: &str) -> bool {
    of.starts_with("rub[")
}

fn is_calculated(variable: &Variable) -> bool {
    variable.meta.kind == Kind::Real && matches!(variable.meta.role, Role::Output | Role::State)
}

fn calculated(named: &Named) -> Vec<Variable> {
    named.scene.variables.iter().filter(|variable| is_calculated(variable)).cloned().collect()
}

/// A rotor with parameters and inputs that have no symmetry, in the chart 1 or 2.
fn tilted(name: &str, chart: u32, random: &mut Random) -> Named {
    let mut named = somewhere(name, random);
    let theta = if chart == 1 { random.within(0.3, 1.4) } else { random.within(1.8, 2.7) };
    let psi = random.within(-3.0, 3.0);
    named.set("start.gamma.y", theta * libm::cos(psi));
    named.set("start.gamma.z", theta * libm::sin(psi));
    named
}

/// What the whole turns depend on is what φ does: their own derivatives are zero.
fn with_turns(mut pairs: Pairs) -> Pairs {
    let of_phi: Vec<_> = pairs.iter().filter(|(of, _)| of == "phi").map(|(_, on)| on.clone()).collect();
    pairs.extend(of_phi.into_iter().map(|on| ("turns".to_owned(), on)));
    pairs
}

/// The pairs that `dependencies` found among what is calculated.
fn found(named: &Named, lists: &[Vec<usize>]) -> Pairs {
    let variables = &named.scene.variables;
    let of = |(variable, list): (&Variable, &Vec<usize>)| -> Vec<(String, String)> {
        list.iter().map(|on| (variable.name.clone(), variables[*on].name.clone())).collect()
    };
    let pairs = variables.iter().zip(lists).filter(|(variable, _)| is_calculated(variable)).flat_map(of);
    // Switches have no derivatives.
    pairs.filter(|(_, on)| !on.starts_with("effects.")).collect()
}

/// States that cancel: a force along e has no moment about it; nothing is unbalanced; the axial rate is imposed.
const CANCELLED: [(&[&str], &[&str], &[&str]); 4] = [
    (&["driven", "overhung"], &["drive.a"], &["state.r.x", "state.v.x"]),
    (
        &["dzhanibekov"],
        &["r_c.x", "r_c.y", "r_c.z", "v_c.x", "v_c.y", "v_c.z"],
        &["state.gamma.y", "state.gamma.z", "state.phi"],
    ),
    (&["dzhanibekov"], &["v_c.x", "v_c.y", "v_c.z"], &["state.K.x", "state.K.y", "state.K.z"]),
    (
        &["jeffcott", "washing_machine"],
        &["omega_phi"],
        &["state.K.x", "state.K.y", "state.K.z", "state.gamma.y", "state.gamma.z", "state.phi"],
    ),
];

/// What is listed and was not seen; all that was seen is listed.
fn too_many(named: &Named, listed: Pairs, seen: &Pairs) -> Pairs {
    let missing: Vec<_> = seen.difference(&listed).collect();
    assert!(missing.is_empty(), "{}: {missing:?}", named.scene.name);
    listed.difference(seen).cloned().collect()
}

/// Pairs of which a motion says that they are so, and what it says of those of which it does not know.
#[derive(Default)]
struct Noted {
    pairs: Pairs,
    doubtful: BTreeMap<(String, String), f64>,
}

impl Noted {
    fn note(&mut self, variables: &[Variable], columns: &[(String, Vec<f64>)]) {
        for (i, variable) in variables.iter().enumerate() {
            let size = columns.iter().map(|(_, column)| column[i].abs()).fold(1.0, f64::max);
            for (on, column) in columns {
                let (part, pair) = (column[i].abs() / size, (variable.name.clone(), on.clone()));
                if part > NONE.1 {
                    self.pairs.insert(pair);
                } else if part >= NONE.0 {
                    self.doubtful.insert(pair, part);
                }
            }
        }
    }

    /// What every doubtful pair is, some other motion knows.
    fn pairs(self, scene: &str) -> Pairs {
        let Self { pairs, doubtful } = self;
        for (pair, part) in doubtful {
            assert!(pairs.contains(&pair), "{scene}: {} by {}: {part:e} is neither", pair.0, pair.1);
        }
        pairs
    }
}

#[test]
fn exact_dependencies_later_are_those_of_dual_numbers() {
    for name in names() {
        let mut noted = Noted::default();
        for chart in [1, 2] {
            let mut random = Random(u64::from(chart));
            for _ in 0..SAMPLES {
                let mut named = tilted(&name, chart, &mut random);
                if named.scene.variables.iter().any(|v| v.name == MOTOR) && random.within(0.0, 1.0) < 0.5 {
                    named.set(MOTOR, 0.0);
                }
                named.start();
                let state: [f64; Any::STATES] = std::array::from_fn(|_| random.within(-1.5, 1.5));
                named.host().set_state(&state);
                let is_state = |v: &&Variable| named.simulation.is_state(v.place);
                let states: Vec<_> = named.scene.variables.iter().filter(is_state).collect();
                let knowns: Vec<Variable> = states.into_iter().cloned().chain(named.inputs().cloned()).collect();
                let variables = calculated(&named);
                let column = |on: &Variable| {
                    let tangents = named.simulation.tangents([(on.place, 1.0)].into_iter()).expect("possible");
                    let derivative = |of: &Variable| tangents.of(of.place).expect("calculated");
                    (on.name.clone(), variables.iter().map(derivative).collect())
                };
                let columns: Vec<_> = knowns.iter().map(column).collect();
                noted.note(&variables, &columns);
            }
        }
        let named = Named::new(&name, Integrator::Host);
        let dependencies = Dependencies::of(&named.scene);
        let mut too_many = too_many(&named, found(&named, &dependencies.later), &with_turns(noted.pairs(&name)));
        too_many.retain(|(of, _)| !is_of_contact(of));
        let cancelled: Pairs = CANCELLED
            .iter()
            .flat_map(|(scenes, of, on)| {
                let these = if scenes.contains(&name.as_str()) { *of } else { &[] };
                these.iter().flat_map(|of| on.iter().map(|on| ((*of).to_owned(), (*on).to_owned())))
            })
            .collect();
        assert_eq!(too_many, cancelled, "{name}");
    }
}
