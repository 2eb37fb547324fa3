//! What `dependencies` lists, against random changes of one variable after another: whatever changes another is listed, and at the
//! start nothing else depends on an input.

use crate::harness::Random;
use crate::harness::named::{Named, ascending, names};
use split_rotor_model::dependencies::Dependencies;
use split_rotor_model::simulation::{Any, Integrator};
use split_rotor_model::variable::{Bound, Kind, Place, Role};
use split_rotor_model::variables::Variable;
use std::collections::BTreeSet;

/// So many rotors and motions are drawn, in both charts.
const SAMPLES: usize = 64;

/// So often switches are drawn until a rotor is possible.
const TRIES: usize = 64;

/// A change by no more than this, relative to the larger of the value and 1 [1], is rounding: φ passes through the chart from −e
/// and back.
const ROUNDING: f64 = 1e-12;

/// Where a parameter or an input is drawn from, so that most rotors can exist; None of those on which no value depends.
fn range(variable: &Variable) -> Option<(f64, f64)> {
    match (variable.meta.kind, variable.meta.role) {
        (Kind::Real, Role::Parameter { bound, .. }) => match bound {
            // Cross damping of a bearing, whose own damping is then from 1.
            Bound::Finite if variable.place.block >= Place::FIRST_EFFECT => Some((-1.0, 1.0)),
            Bound::Finite => Some((-2.0, 2.0)),
            Bound::Positive | Bound::NotNegative => {
                Some((1.0 + ascending(&variable.meta), 1.5 + ascending(&variable.meta)))
            }
            Bound::Within(low, high) | Bound::ZeroOrWithin(low, high) => Some((low, high)),
            Bound::OneOf(_) => None,
        },
        (Kind::Real, Role::Input { .. }) => Some((-2.0, 2.0)),
        _ => None,
    }
}

fn is_possible(named: &mut Named) -> bool {
    named.simulation.parameters().check().is_ok() && named.simulation.read().is_ok()
}

/// Of an effect; with `start.at_rest` all that is shown at the start depends on all of it.
fn is_switch(variable: &Variable) -> bool {
    variable.place.row == Place::SWITCH
}

/// A rotor that can exist.
pub fn somewhere(name: &str, random: &mut Random) -> Named {
    let mut named = Named::new(name, Integrator::Host);
    let variables = named.scene.variables.clone();
    // Of most draws the loads do not balance.
    named.set("start.at_rest", 0.0);
    for _ in 0..TRIES {
        for variable in &variables {
            if let Some((low, high)) = range(variable) {
                named.set(&variable.name, random.within(low, high));
            } else if is_switch(variable) {
                named.set(&variable.name, f64::from(random.within(0.0, 1.0) < 0.75));
            }
        }
        if is_possible(&mut named) {
            return named;
        }
    }
    panic!("{name}: no draw is possible");
}

/// The values of all calculated variables; 0 of others.
fn values(named: &mut Named) -> Vec<f64> {
    let variables = named.scene.variables.clone();
    variables.iter().map(|variable| if variable.meta.has_start() { 0.0 } else { named.at(variable.place) }).collect()
}

/// What random changes show, and whether each is listed.
struct Judge {
    name: String,
    listed: Dependencies,
    changes: usize,
    /// What was seen to depend on what at the start.
    at_start: BTreeSet<(usize, usize)>,
}

impl Judge {
    /// Each variable whose value differs depends on the one with this index.
    fn changed(&mut self, later: bool, on: usize, before: &[f64], named: &mut Named) {
        let lists = if later { &self.listed.later } else { &self.listed.at_start };
        for (of, (before, after)) in before.iter().zip(values(named)).enumerate() {
            let change = (after - before).abs();
            let is_rounding = change <= ROUNDING * before.abs().max(1.0);
            if before.to_bits() != after.to_bits() && !is_rounding && named.scene.variables[of].meta.kind == Kind::Real
            {
                let name = |index: usize| &named.scene.variables[index].name;
                assert!(lists[of].contains(&on), "{}: {} on {}, later {later}", self.name, name(of), name(on));
                self.changes += 1;
                if !later {
                    self.at_start.insert((of, on));
                }
            }
        }
    }

    /// Changes each parameter, switch and input of a rotor that has not started.
    fn look_at_start(&mut self, named: &mut Named, random: &mut Random) {
        let before = values(named);
        for (index, variable) in named.scene.variables.clone().iter().enumerate() {
            let old = match range(variable) {
                Some(_) => named.at(variable.place),
                None if is_switch(variable) => named.at(variable.place),
                None => continue,
            };
            let new = range(variable).map_or(1.0 - old, |(low, high)| random.within(low, high));
            named.set(&variable.name, new);
            if is_possible(named) {
                self.changed(false, index, &before, named);
            }
            named.set(&variable.name, old);
        }
    }

    /// Of inputs nothing is listed at the start that no change showed: a partner's solver would see an algebraic loop.
    fn lists_no_more(&self, variables: &[Variable]) {
        // The same total twice; a motor starts on its characteristic; few motions touch a ring.
        let is_exempt = |of: &str| ["energy.residual", "der(motor.state.tau)"].contains(&of) || of.starts_with("rub[");
        for (of, list) in
            variables.iter().enumerate().filter(|(_, of)| of.meta.kind == Kind::Real && !is_exempt(&of.name))
        {
            // Of states and parameters what cancels is listed too.
            let is_input = |on: &&usize| matches!(variables[**on].meta.role, Role::Input { .. });
            for on in self.listed.at_start[of].iter().filter(is_input) {
                assert!(self.at_start.contains(&(of, *on)), "{}: {} on {}", self.name, list.name, variables[*on].name);
            }
        }
    }

    /// Changes each state and input of a motion.
    fn look_later(&mut self, named: &mut Named, random: &mut Random) {
        named.start();
        let mut state: [f64; Any::STATES] = std::array::from_fn(|_| random.within(-2.0, 2.0));
        if !moves_to(named, &state) {
            return;
        }
        let before = values(named);
        let is_state = |(_, v): &(usize, &Variable)| named.simulation.is_state(v.place);
        let states: Vec<_> =
            named.scene.variables.iter().enumerate().filter(is_state).map(|(index, _)| index).collect();
        for n in 0..Any::STATES {
            let old = std::mem::replace(&mut state[n], random.within(-2.0, 2.0));
            // States of effects that this scene has not stand last.
            if let (true, Some(index)) = (moves_to(named, &state), states.get(n)) {
                self.changed(true, *index, &before, named);
            }
            state[n] = old;
        }
        moves_to(named, &state);
        for (index, variable) in named.scene.variables.clone().iter().enumerate() {
            if let Role::Input { .. } = variable.meta.role {
                let old = named.at(variable.place);
                named.set(&variable.name, random.within(-2.0, 2.0));
                self.changed(true, index, &before, named);
                named.set(&variable.name, old);
            }
        }
    }
}

/// Moves to a state; whether it can be calculated there.
fn moves_to(named: &mut Named, state: &[f64; Any::STATES]) -> bool {
    named.simulation.exchange().expect("it was started for a host").set_state(state);
    named.simulation.admits().is_ok()
}

#[test]
fn exact_dependencies_hold_whatever_random_changes_show() {
    for name in names() {
        let mut random = Random(0x5eed);
        let scene = Named::new(&name, Integrator::Host).scene;
        let listed = Dependencies::of(&scene);
        let mut judge = Judge { name: name.clone(), listed, changes: 0, at_start: BTreeSet::new() };
        for _ in 0..SAMPLES {
            let mut named = somewhere(&name, &mut random);
            judge.look_at_start(&mut named, &mut random);
            judge.look_later(&mut named, &mut random);
        }
        println!("{name}: {} changes", judge.changes);
        assert!(judge.changes > 1000, "{name}");
        judge.lists_no_more(&scene.variables);
    }
}
