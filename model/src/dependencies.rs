//! What depends on what: found by calculating with what goes into each value ([`Traced`]), not written by hand.
//!
//! States and inputs are scalars of the physics, and all are followed in one calculation. A parameter is a plain number; one
//! after another is set to what is no number, which every operation passes on, zero times it included, to where it enters the
//! scalars as a constant. So nothing is asked of the values: a law that is zero where it is looked at, or that no random rotor
//! could have, is listed all the same. Each parameter is looked at once for each chart and choice of switches.

use crate::body::ROTOR;
use crate::effects::{All, Effects, Info};
use crate::integrate::Cost;
use crate::rotation::Chart;
use crate::scene::Scene;
use crate::simulation::numbers_of_state;
use crate::simulation::start::Motion;
use crate::state::Kinematics;
use crate::traced::Traced;
use crate::variable::{Bound, Kind, Meta, Place, Role};
use crate::variables::{Instant, Parameters, Variable};
use std::collections::HashSet;

/// For each variable of a scene, by its index from 0: the indices of those on which it depends, ascending.
pub struct Dependencies {
    /// At the start: on parameters and inputs.
    pub at_start: Vec<Vec<usize>>,
    /// Later: on states and inputs.
    pub later: Vec<Vec<usize>>,
}

/// How many numbers the state of any rotor has.
const N: usize = numbers_of_state::<All>();

/// Whether a rotor can have these parameters.
type Possible = fn(&Parameters<All>) -> bool;

impl Dependencies {
    /// Those of a scene.
    pub fn of(scene: &Scene) -> Self {
        Self::among(scene, |parameters| parameters.check().is_ok())
    }

    /// Those of a scene, found with possible rotors where such are drawn.
    fn among(scene: &Scene, possible: Possible) -> Self {
        let nothing = vec![Vec::new(); scene.variables.len()];
        let mut found = Self { at_start: nothing.clone(), later: nothing };
        let mut random = Random(0x5eed);
        for switched in switched(scene) {
            for tilt in [IN_FIRST_CHART, IN_SECOND_CHART] {
                let rotor = somewhere(scene, &switched, tilt, &mut random, possible);
                found.look_at_start(scene, &rotor, &mut random);
                found.look_later(scene, &rotor, &mut random);
            }
        }
        found.follow_blocks(scene);
        for list in found.at_start.iter_mut().chain(&mut found.later) {
            list.sort_unstable();
            list.dedup();
        }
        found
    }

    /// Marks the parameters and inputs one after another.
    fn look_at_start(&mut self, scene: &Scene, rotor: &Parameters<All>, random: &mut Random) {
        let begun = Motion::<N>::at_start(&mut rotor.clone(), 0.0).state;
        for (index, variable) in reals(scene, Meta::has_start) {
            let (mut marked, mut numbers) = (rotor.clone(), [0.0; N]);
            if is_input(&variable.meta) {
                // The state at the start follows an input that imposes it.
                marked.begin_with(variable.place, random.within(ANY));
                let state = Motion::<N>::at_start(&mut marked.clone(), 0.0).state;
                numbers = std::array::from_fn(|n| f64::from(state[n].to_bits() != begun[n].to_bits()));
                ask(&mut marked, variable.place, 1.0);
            } else {
                marked.set(variable.place, f64::NAN);
            }
            let Motion { bodies, state, .. } = Motion::at_start(&mut marked, 0.0);
            let shown = shown(&marked, bodies.frames[ROTOR].chart, &state, &numbers);
            note(&mut self.at_start, scene, &marked, &shown, |_| Some(index));
        }
    }

    /// Marks all states and inputs at once, each with its number.
    fn look_later(&mut self, scene: &Scene, rotor: &Parameters<All>, random: &mut Random) {
        let mut marked = rotor.clone();
        let Motion { bodies, .. } = Motion::<N>::at_start(&mut marked, 0.0);
        let mut state: [f64; N] = std::array::from_fn(|_| random.within(ANY));
        state[All::layout::<N>().gamma(ROTOR)].fill_with(|| random.within(IN_FIRST_CHART));
        let is_state = |n| move |v: &Variable| rotor.number_in_state::<N>(v.place) == Some(n);
        let mut sources: Vec<Option<usize>> = (0..N).map(|n| scene.variables.iter().position(is_state(n))).collect();
        for (index, variable) in reals(scene, is_input) {
            sources.push(Some(index));
            ask(&mut marked, variable.place, sources.len() as f64);
        }
        let numbers = std::array::from_fn(|n| (n + 1) as f64);
        let shown = shown(&marked, bodies.frames[ROTOR].chart, &state, &numbers);
        note(&mut self.later, scene, &marked, &shown, |number| sources[number.checked_sub(1)?]);
    }

    /// What is no real number cannot be marked, and a comparison of parameters may hide a mark. A switch, a whole number, or a
    /// parameter that was seen nowhere may matter to the outputs of its effect, and wherever that matters.
    fn follow_blocks(&mut self, scene: &Scene) {
        let is_of = |block: u32, index: usize| scene.variables[index].place.block == block;
        let seen: HashSet<usize> = self.at_start.iter().chain(&self.later).flatten().copied().collect();
        for (index, variable) in scene.variables.iter().enumerate() {
            let block = variable.place.block;
            if seen.contains(&index) || !variable.meta.has_start() || block < Place::FIRST_EFFECT {
                continue;
            }
            for (of, list) in self.at_start.iter_mut().enumerate() {
                let is_shown = is_of(block, of) && is_calculated(&scene.variables[of]);
                if is_shown || list.iter().any(|on| is_of(block, *on)) {
                    list.push(index);
                }
            }
        }
    }
}

/// Notes for each calculated variable what went into it; `index` tells which variable a source is.
fn note(
    lists: &mut [Vec<usize>],
    scene: &Scene,
    rotor: &Parameters<All>,
    shown: &Instant<N, Traced>,
    index: impl Fn(usize) -> Option<usize>,
) {
    let rates = shown.rates(&rotor.effects);
    for (variable, list) in scene.variables.iter().zip(lists).filter(|(variable, _)| is_calculated(variable)) {
        let value = rotor.traced(variable.place, shown, &rates);
        list.extend(value.into_iter().flat_map(|value| value.sources().numbers()).filter_map(&index));
    }
}

/// Whether a variable follows from others; the chart is known at events only.
fn is_calculated(variable: &Variable) -> bool {
    matches!(variable.meta.role, Role::Output | Role::State)
}

fn is_input(meta: &Meta) -> bool {
    matches!(meta.role, Role::Input { .. })
}

/// The real variables that are wanted, with their indices.
fn reals(scene: &Scene, is_wanted: impl Fn(&Meta) -> bool) -> impl Iterator<Item = (usize, &Variable)> {
    let all = scene.variables.iter().enumerate();
    all.filter(move |(_, variable)| variable.meta.kind == Kind::Real && is_wanted(&variable.meta))
}

/// Marks an input as the source of this number.
fn ask(rotor: &mut Parameters<All>, input: Place, number: f64) {
    rotor.effects.signal_mut(input).expect("an input").ask(number);
}

/// What a state in a chart shows, its parts being the sources of these numbers.
fn shown(rotor: &Parameters<All>, chart: Chart, state: &[f64; N], numbers: &[f64; N]) -> Instant<N, Traced> {
    let motion = Kinematics::new(rotor.shape().inertia(), chart, All::layout::<N>().read(state, ROTOR));
    Instant::new(motion, *state, &rotor.effects, 0.0, Cost::default()).moving(numbers, 0.0, &rotor.effects)
}

/// Which switches are on: as many as go together, so often that each effect is on once.
fn switched(scene: &Scene) -> Vec<Vec<Place>> {
    let excludes = |a: &Info, b: &Info| a.excludes.contains(&b.name) || b.excludes.contains(&a.name);
    let together = |mut on: Vec<(&'static Info, u32)>, one: &(&'static Info, u32)| {
        let is_on = |other: &(&Info, u32)| (other.0.number, other.1) == (one.0.number, one.1);
        if !on.iter().any(|other| is_on(other) || excludes(one.0, other.0)) {
            on.push(*one);
        }
        on
    };
    let places = |on: Vec<(&Info, u32)>| {
        on.into_iter().map(|(info, index)| Place::switch(Place::effect_block(info.number, index))).collect()
    };
    let mut sets: Vec<Vec<(&'static Info, u32)>> = Vec::new();
    for one in &scene.effects {
        let is_on = |set: &Vec<(&Info, u32)>| set.iter().any(|(info, _)| info.number == one.0.number);
        if !sets.iter().any(is_on) {
            sets.push(scene.effects.iter().fold(vec![*one], together));
        }
    }
    if sets.is_empty() { vec![Vec::new()] } else { sets.into_iter().map(places).collect() }
}

/// Each part of γ \[rad], so that the motion starts in the first chart, and stays in either.
const IN_FIRST_CHART: (f64, f64) = (0.5, 1.0);

/// Each part of γ \[rad], so that the motion starts in the second.
const IN_SECOND_CHART: (f64, f64) = (1.3, 1.7);

/// A rotor with random parameters and these switches on: possible where that can be had by changing one parameter after another,
/// since laws of impossible rotors may show numbers that are none.
fn somewhere(
    scene: &Scene,
    switched: &[Place],
    tilt: (f64, f64),
    random: &mut Random,
    possible: Possible,
) -> Parameters<All> {
    let mut rotor = scene.parameters();
    for switch in scene.variables.iter().filter(|variable| variable.meta.kind == Kind::Boolean) {
        rotor.set(switch.place, f64::from(switched.contains(&switch.place)));
    }
    let mut was_possible = possible(&rotor);
    for (_, variable) in reals(scene, Meta::has_start) {
        let old = rotor.value::<N>(variable.place, 0.0, None).expect("a parameter or an input");
        let is_tilt = ["start.gamma.y", "start.gamma.z"].contains(&variable.name.as_str());
        rotor.begin_with(variable.place, random.within(if is_tilt { tilt } else { range(variable) }));
        let is_possible = possible(&rotor);
        if was_possible && !is_possible {
            rotor.begin_with(variable.place, old);
        }
        was_possible |= is_possible;
    }
    rotor
}

/// Where values of any sign are drawn from.
const ANY: (f64, f64) = (-2.0, 2.0);

/// Where the values of a parameter or an input are drawn from.
fn range(variable: &Variable) -> (f64, f64) {
    let Role::Parameter { bound, .. } = variable.meta.role else { return ANY };
    match bound {
        // Cross damping of a bearing, whose own damping is then from 1.
        Bound::Finite if variable.place.block >= Place::FIRST_EFFECT => (-1.0, 1.0),
        Bound::Finite => ANY,
        Bound::Positive | Bound::NotNegative => (1.0, 1.5),
        Bound::Within(low, high) | Bound::ZeroOrWithin(low, high) => (low, high),
        Bound::OneOf(these) => (these[0], these[0]),
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
    use std::sync::atomic::{AtomicUsize, Ordering::Relaxed};

    fn scenes() -> impl Iterator<Item = Scene> {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
        let scene = move |name: &String| Scene::find(name, &folder).unwrap_or_else(|error| panic!("{error}"));
        ["driven", "jeffcott", "rotor"].map(str::to_owned).into_iter().map(move |name| scene(&name))
    }

    /// How often a check was asked that no draw meets.
    static ASKED: AtomicUsize = AtomicUsize::new(0);

    #[test]
    fn regress_a_check_that_no_draw_meets_ends() {
        for scene in scenes() {
            let free = Dependencies::of(&scene);
            ASKED.store(0, Relaxed);
            let never = Dependencies::among(&scene, |_| {
                ASKED.fetch_add(1, Relaxed);
                false
            });
            assert!(ASKED.load(Relaxed) <= 4 * (1 + scene.variables.len()), "once a variable, in each chart");
            let apart = Dependencies::among(&scene, |rotor| rotor.setup.rotor.m == 5.0 && rotor.check().is_ok());
            for found in [never, apart] {
                assert_eq!((&found.at_start, &found.later), (&free.at_start, &free.later), "{}", scene.name);
            }
        }
    }
}
