//! What depends on what: found by changing one thing after another, not written by hand.

use crate::scene::Scene;
use crate::simulation::{Any, Integrator};
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

/// Whether a rotor can have these parameters.
type Possible = fn(&mut Any) -> bool;

fn can_start(simulation: &mut Any) -> bool {
    simulation.parameters().check().is_ok() && simulation.read().is_ok()
}

impl Dependencies {
    /// Those of a scene.
    pub fn of(scene: &Scene) -> Self {
        Self::among(scene, can_start)
    }

    /// Those of a scene, found among the rotors that are possible.
    fn among(scene: &Scene, possible: Possible) -> Self {
        let nothing = vec![Vec::new(); scene.variables.len()];
        let mut found = Self { at_start: nothing.clone(), later: nothing };
        let (mut random, mut varied) = (Random(0x5eed), vec![false; scene.variables.len()]);
        for _ in 0..SAMPLES {
            found.sample(scene, &mut random, possible, &mut varied);
        }
        for (index, variable) in scene.variables.iter().enumerate() {
            // What could never be changed alone may matter to everything that is calculated.
            if is_drawn(variable) && !varied[index] {
                let calculated = scene.variables.iter().zip(&mut found.at_start).filter(|(of, _)| !of.meta.has_start());
                calculated.for_each(|(_, list)| list.push(index));
            }
        }
        for list in found.at_start.iter_mut().chain(&mut found.later) {
            list.sort_unstable();
            list.dedup();
        }
        found
    }

    fn sample(&mut self, scene: &Scene, random: &mut Random, possible: Possible, varied: &mut [bool]) {
        let mut simulation = somewhere(scene, random, possible);
        let before = values(&mut simulation, scene);
        for (index, variable) in scene.variables.iter().enumerate().filter(|(_, variable)| is_drawn(variable)) {
            let old = value(&mut simulation, variable);
            if change(&mut simulation, variable, random, possible) {
                varied[index] = true;
                note(&mut self.at_start, index, &before, &values(&mut simulation, scene));
                set(&mut simulation, variable, old);
            }
        }
        simulation.start(0.0, None).unwrap_or_else(|invalid| panic!("of a possible rotor {invalid}"));
        let mut drawn = (0..TRIES).map(|_| std::array::from_fn(|_| random.within(ANY)));
        // Where a law has no limit nothing is shown.
        let Some(mut state) = drawn.find(|state| moves_to(&mut simulation, state)) else { return };
        let before = values(&mut simulation, scene);
        for n in 0..WITH_WORK {
            let old = std::mem::replace(&mut state[n], random.within(ANY));
            let place = crate::variables::state_place(n);
            if moves_to(&mut simulation, &state)
                && let Some(index) = scene.variables.iter().position(|variable| variable.place == place)
            {
                note(&mut self.later, index, &before, &values(&mut simulation, scene));
            }
            state[n] = old;
        }
        moves_to(&mut simulation, &state);
        for (index, variable) in scene.variables.iter().enumerate() {
            if let Role::Input { .. } = variable.meta.role {
                let old = value(&mut simulation, variable);
                simulation.set_input(variable.place, random.within(ANY));
                note(&mut self.later, index, &before, &values(&mut simulation, scene));
                simulation.set_input(variable.place, old);
            }
        }
    }
}

/// Switches are drawn so often before parameters are drawn otherwise, and so often a state.
const TRIES: usize = 64;

/// A rotor with random parameters, effects that have switches mostly on, so that what two of them do together is seen.
fn somewhere(scene: &Scene, random: &mut Random, possible: Possible) -> Any {
    let own = || Any::with(Integrator::Host, scene.parameters());
    let mut simulation = own();
    for variable in &scene.variables {
        if let Some(range) = range(variable) {
            set(&mut simulation, variable, random.within(range));
        }
    }
    for _ in 0..TRIES {
        for variable in scene.variables.iter().filter(|variable| variable.meta.kind == Kind::Boolean) {
            set(&mut simulation, variable, f64::from(random.within(ANY) > -1.0));
        }
        if possible(&mut simulation) {
            return simulation;
        }
    }
    // Some parameters must go together: from the scene's own, which do, one is changed after another.
    let mut simulation = own();
    assert!(possible(&mut simulation), "{}: its own values are not possible", scene.name);
    for variable in scene.variables.iter().filter(|variable| is_drawn(variable)) {
        change(&mut simulation, variable, random, possible);
    }
    simulation
}

/// So often a change is halved before a parameter is left as it is.
const HALVINGS: u32 = 8;

/// Changes one variable, by less where that much is not possible; false, and all is as it was, where no change is.
fn change(simulation: &mut Any, variable: &Variable, random: &mut Random, possible: Possible) -> bool {
    let old = value(simulation, variable);
    let Some(range) = range(variable) else {
        // Of a switch there is one.
        set(simulation, variable, 1.0 - old);
        let is_possible = possible(simulation);
        if !is_possible {
            set(simulation, variable, old);
        }
        return is_possible;
    };
    let (drawn, mut part) = (random.within(range), 1.0);
    for _ in 0..=HALVINGS {
        // The first time what was drawn, to the last bit.
        set(simulation, variable, if part == 1.0 { drawn } else { old + (drawn - old) * part });
        if possible(simulation) {
            return true;
        }
        part *= 0.5;
    }
    set(simulation, variable, old);
    false
}

/// Whether a variable is one that is changed.
fn is_drawn(variable: &Variable) -> bool {
    range(variable).is_some() || variable.meta.kind == Kind::Boolean
}

fn value(simulation: &mut Any, variable: &Variable) -> f64 {
    let value = simulation.get(variable.place).unwrap_or_else(|invalid| panic!("of a possible rotor {invalid}"));
    value.unwrap_or_else(|| panic!("{} is in the list, and has no value", variable.name))
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

fn set(simulation: &mut Any, variable: &Variable, value: f64) {
    let found = simulation.set_parameter(variable.place, value) || simulation.set_input(variable.place, value);
    assert!(found, "{} can be set", variable.name);
}

/// Moves to a state; whether it can be calculated there.
fn moves_to(simulation: &mut Any, state: &Whole<f64>) -> bool {
    simulation.exchange().expect("it was started for a host").set_state(state);
    simulation.admits().is_ok()
}

/// The values of all calculated variables; 0 of others.
fn values(simulation: &mut Any, scene: &Scene) -> Vec<f64> {
    let value = |variable: &Variable| if variable.meta.has_start() { 0.0 } else { value(simulation, variable) };
    scene.variables.iter().map(value).collect()
}

/// A change of a value by no more than this, relative to the larger of its size and 1, is rounding: φ passes through the
/// chart from −e and back.
const ROUNDING: f64 = 1e-12;

/// Whether a value changed. What is infinite or not a number is another unless it has the same bits.
fn differ(before: f64, after: f64) -> bool {
    let change = (after - before).abs();
    let is_rounding = change.is_finite() && change <= ROUNDING * before.abs().max(1.0);
    before.to_bits() != after.to_bits() && !is_rounding
}

/// Notes that each variable whose value changed depends on the one with this index.
fn note(lists: &mut [Vec<usize>], index: usize, before: &[f64], after: &[f64]) {
    for ((list, before), after) in lists.iter_mut().zip(before).zip(after) {
        if differ(*before, *after) {
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

#[cfg(test)]
mod tests {
    use super::*;
    use std::path::Path;

    fn driven() -> Scene {
        let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
        Scene::find("driven", &scenes).unwrap_or_else(|error| panic!("{error}"))
    }

    fn parameters(simulation: &mut Any) -> crate::variables::Setup {
        simulation.parameters().setup.clone()
    }

    #[test]
    fn regress_parameters_that_must_go_together_are_drawn_in_a_bounded_time() {
        let scene = driven();
        let free = Dependencies::of(&scene);
        // One below the other, as an effect's `check` may ask, and so far apart as no two draws are.
        let below = Dependencies::among(&scene, |s| can_start(s) && parameters(s).rotor.Jt < parameters(s).rotor.Ja);
        let apart =
            Dependencies::among(&scene, |s| can_start(s) && parameters(s).rotor.m > 2.0 * parameters(s).rotor.Ja);
        for found in [below, apart] {
            assert_eq!((&found.at_start, &found.later), (&free.at_start, &free.later));
        }
    }

    #[test]
    fn regress_what_cannot_be_changed_alone_may_matter_to_everything() {
        let scene = driven();
        let found = Dependencies::among(&scene, |s| can_start(s) && parameters(s).rotor.m == 5.0);
        let index = scene.variables.iter().position(|variable| variable.name == "rotor.m").expect("each has one");
        for (variable, list) in scene.variables.iter().zip(&found.at_start) {
            assert_eq!(list.contains(&index), !variable.meta.has_start(), "{}", variable.name);
        }
    }

    #[test]
    fn regress_what_is_not_a_number_depends() {
        let [nan, inf] = [f64::NAN, f64::INFINITY];
        for (before, after) in [(nan, 1.0), (1.0, nan), (inf, 1.0), (1.0, inf), (inf, -inf), (1.0, 1.0 + 1e-11)] {
            assert!(differ(before, after), "{before} and {after}");
        }
        for (before, after) in [(nan, nan), (inf, inf), (1.0, 1.0), (0.0, 1e-13), (-0.0, 0.0)] {
            assert!(!differ(before, after), "{before} and {after}");
        }
    }
}
