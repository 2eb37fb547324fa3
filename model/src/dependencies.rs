//! What depends on what: found by changing one thing after another, not written by hand.

use crate::effects::{All, Effects};
use crate::scene::Scene;
use crate::simulation::{Integrator, Simulation};
use crate::state::{WITH_WORK, Whole};
use crate::variable::{Bound, Kind, Place, Role};
use crate::variables::Variable;

/// For each variable of a scene, by its index from 0: the indices of those on which it depends, ascending.
pub struct Dependencies {
    /// At the start: on parameters and inputs.
    pub at_start: Vec<Vec<usize>>,
    /// Later: on states and inputs.
    pub later: Vec<Vec<usize>>,
}

/// So many rotors and motions are tried, in both charts.
const SAMPLES: usize = 64;

impl Dependencies {
    /// Those of a scene.
    pub fn of(scene: &Scene) -> Self {
        let nothing = vec![Vec::new(); scene.variables.len()];
        let mut found = Self { at_start: nothing.clone(), later: nothing };
        let mut random = Random(0x5eed);
        for _ in 0..SAMPLES {
            found.sample(scene, &mut random);
        }
        for list in found.at_start.iter_mut().chain(&mut found.later) {
            list.sort_unstable();
            list.dedup();
        }
        found
    }

    fn sample(&mut self, scene: &Scene, random: &mut Random) {
        let mut simulation = Simulation::with(Integrator::Host, scene.parameters());
        for variable in &scene.variables {
            if let Some(range) = range(variable) {
                set(&mut simulation, variable, random.within(range));
            }
        }
        switch_at_random(&mut simulation, scene, random);
        let before = values(&mut simulation, scene);
        for (index, variable) in scene.variables.iter().enumerate() {
            let old = simulation.get(variable.place).expect("a possible rotor").expect("it is in the list");
            let other = match range(variable) {
                Some(range) => random.within(range),
                None if variable.meta.kind == Kind::Boolean => 1.0 - old,
                None => continue,
            };
            set(&mut simulation, variable, other);
            if simulation.parameters().check().is_err() {
                // It would be switched on beside what it excludes.
                set(&mut simulation, variable, old);
                continue;
            }
            note(&mut self.at_start, index, &before, &values(&mut simulation, scene));
            set(&mut simulation, variable, old);
        }
        simulation.start(0.0, None).expect("a possible rotor");
        let mut state: Whole<f64> = std::array::from_fn(|_| random.within(ANY));
        move_to(&mut simulation, &state);
        let before = values(&mut simulation, scene);
        for n in 0..WITH_WORK {
            let old = std::mem::replace(&mut state[n], random.within(ANY));
            move_to(&mut simulation, &state);
            let place = crate::variables::state_place(n);
            if let Some(index) = scene.variables.iter().position(|variable| variable.place == place) {
                note(&mut self.later, index, &before, &values(&mut simulation, scene));
            }
            state[n] = old;
        }
        move_to(&mut simulation, &state);
        for (index, variable) in scene.variables.iter().enumerate() {
            if let Role::Input { .. } = variable.meta.role {
                let old = simulation.get(variable.place).expect("a possible rotor").expect("it is in the list");
                simulation.set_input(variable.place, random.within(ANY));
                note(&mut self.later, index, &before, &values(&mut simulation, scene));
                simulation.set_input(variable.place, old);
            }
        }
    }
}

/// Switches effects, those that have switches, so that a rotor can exist.
fn switch_at_random(simulation: &mut Simulation<All>, scene: &Scene, random: &mut Random) {
    loop {
        for variable in scene.variables.iter().filter(|variable| variable.meta.kind == Kind::Boolean) {
            // Mostly on, so that what two effects do together is seen.
            set(simulation, variable, f64::from(random.within(ANY) > -1.0));
        }
        if simulation.parameters().check().is_ok() {
            return;
        }
    }
}

/// Where values of any sign are drawn from.
const ANY: (f64, f64) = (-2.0, 2.0);

/// Those that may not be larger than others.
const WITHIN_ONE: (f64, f64) = (-1.0, 1.0);

/// Where the values of a parameter or input are drawn from, so that every rotor can exist; None of other variables, and of
/// those on which no value depends.
fn range(variable: &Variable) -> Option<(f64, f64)> {
    match (variable.meta.kind, variable.meta.role) {
        (Kind::Real, Role::Parameter { bound, .. }) => Some(match bound {
            // Cross damping of a bearing, whose own damping is then from 1.
            Bound::Finite if variable.place.block >= Place::FIRST_EFFECT => WITHIN_ONE,
            Bound::Finite => ANY,
            Bound::Positive | Bound::NotNegative => (1.0, 1.5),
            Bound::Within(low, high) | Bound::ZeroOrWithin(low, high) => (low, high),
            Bound::OneOf(_) => return None,
        }),
        (Kind::Real, Role::Input { .. }) => Some(ANY),
        _ => None,
    }
}

fn set<E: Effects>(simulation: &mut Simulation<E>, variable: &Variable, value: f64) {
    let found = simulation.set_parameter(variable.place, value) || simulation.set_input(variable.place, value);
    assert!(found, "{} can be set", variable.name);
}

fn move_to(simulation: &mut Simulation<All>, state: &Whole<f64>) {
    simulation.open().expect("it was started for a host").set_state(state);
}

/// The values of all calculated variables; 0 of others.
fn values(simulation: &mut Simulation<All>, scene: &Scene) -> Vec<f64> {
    let value = |variable: &Variable| match variable.meta.has_start() {
        true => 0.0,
        false => simulation.get(variable.place).expect("a possible rotor").expect("it is in the list"),
    };
    scene.variables.iter().map(value).collect()
}

/// A change of a value by no more than this, relative to the larger of its size and 1, is rounding: φ passes through the
/// chart from −e and back.
const ROUNDING: f64 = 1e-12;

/// Notes that each variable whose value changed depends on the one with this index.
fn note(lists: &mut [Vec<usize>], index: usize, before: &[f64], after: &[f64]) {
    for ((list, before), after) in lists.iter_mut().zip(before).zip(after) {
        if (after - before).abs() > ROUNDING * before.abs().max(1.0) {
            list.push(index);
        }
    }
}

/// Numbers that look random, the same everywhere (splitmix64; Steele, Lea and Flood 2014).
struct Random(u64);

impl Random {
    fn within(&mut self, (low, high): (f64, f64)) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        low + (high - low) * ((z >> 11) as f64 / (1_u64 << 53) as f64)
    }
}
