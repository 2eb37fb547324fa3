//! What a scene can be, but is hardly meant to be.

use super::Scene;
use super::input::Input;
use crate::variable::{Place, Role};
use crate::variables::Variable;
use std::f64::consts::TAU;

/// So many radii of gyration from c, a place on the axis is taken for a slip, of mm for m \[1].
const FAR: f64 = 30.0;

/// The effect that imposes a speed, its speed, and that of the start, which then does not count.
const IMPOSED: &str = "imposed_speed";
const IMPOSED_SPEED: &str = "imposed_speed.w";
const START: &str = "start.omega.x";

impl Scene {
    /// What its author may not have meant, in words.
    pub fn warnings(&self) -> Vec<String> {
        let places_and_masses = self.far_places().chain(self.heavy_unbalances());
        let others = self.large_angles().chain(self.idle_spin());
        let names = self.names_of_other_axes();
        places_and_masses.chain(others).chain(names).chain(self.idle_effects()).chain(self.idle_inputs()).collect()
    }

    /// Names and values of the parameters whose names end so; of what is switched off too.
    fn given(&self, end: &str) -> impl Iterator<Item = (&str, f64)> {
        let of_end = self.variables.iter().filter(move |variable| variable.name.ends_with(end));
        of_end.filter_map(|variable| Some((&*variable.name, *self.starts.get(&variable.place.value_reference())?)))
    }

    fn far_places(&self) -> impl Iterator<Item = String> {
        let rotor = self.parameters().setup.rotor;
        let gyration = libm::sqrt(rotor.Jt / rotor.m);
        self.given(".position").filter(move |(_, x)| x.abs() > FAR * gyration).map(move |(name, x)| {
            let times = (x.abs() / gyration).round();
            format!("{name} = {x:?} m is {times} radii of gyration, {gyration:.3} m, from c: are these mm?")
        })
    }

    fn heavy_unbalances(&self) -> impl Iterator<Item = String> {
        let m = self.parameters().setup.rotor.m;
        let masses = self.given(".mass").filter(move |(name, mass)| name.starts_with("unbalance") && *mass > m);
        masses.map(move |(name, mass)| format!("{name} = {mass:?} kg is more than rotor.m = {m:?} kg: are these g?"))
    }

    fn large_angles(&self) -> impl Iterator<Item = String> {
        let large = self.given(".angle").filter(|(_, angle)| angle.abs() > TAU);
        large.map(|(name, angle)| format!("{name} = {angle:?} rad is more than a turn: are these degrees?"))
    }

    /// A spin at the start, where another one is imposed.
    fn idle_spin(&self) -> Option<String> {
        let [own, given] = [START, IMPOSED_SPEED].map(|name| self.given(name).next().map_or(0.0, |(_, speed)| speed));
        let imposes = |input: &&Input| input.name == IMPOSED_SPEED && input.time[0] <= self.experiment.start;
        let imposed = self.inputs.iter().find(imposes).map_or(given, |input| input.value[0]);
        // The same speed may be written in two units.
        let is_idle = own != 0.0 && (own - imposed).abs() > 1e-9 * imposed.abs();
        (is_idle && self.acting().any(|(info, _)| info.name == IMPOSED))
            .then(|| format!("{START} = {own:?} rad/s does not count: {IMPOSED_SPEED} begins with {imposed:?} rad/s"))
    }

    /// Coefficients by the names of programs whose lateral directions are x and y: of a bearing, those along z are missing.
    fn names_of_other_axes(&self) -> impl Iterator<Item = String> {
        self.acting().filter_map(|(info, index)| {
            let block = Place::effect_block(info.number, index);
            // Nodes of a table too.
            let is_given = |name: &str| {
                let own = self.variables.iter().filter(|variable| variable.place.block == block);
                let mut named = own.filter(|variable| variable.meta.name.split('[').next() == Some(name));
                named.any(|variable| self.starts.get(&variable.place.value_reference()).is_some_and(|value| *value != 0.0))
            };
            let lacks = |kind: &&str| {
                ["xx", "yy"].iter().all(|of| is_given(&format!("{kind}{of}"))) && !is_given(&format!("{kind}zz"))
            };
            let kinds: Vec<_> = ["k", "c"].into_iter().filter(lacks).collect();
            let name = info.block_name(index);
            let list = |of: &[&str]| {
                kinds.iter().flat_map(|kind| of.iter().map(move |of| format!("{kind}{of}"))).collect::<Vec<_>>().join(", ")
            };
            (!kinds.is_empty()).then(|| {
                format!(
                    "{name} has {} and no {}: here x is the axis of the rotor, and y and z lie across it; where the lateral directions \
                     are x and y (ROSS, API data sheets, DyRoBeS), write {} for them",
                    list(&["xx", "yy"]),
                    list(&["zz"]),
                    list(&["yy", "zz"]),
                )
            })
        })
    }

    /// What acts has a mass, a stiffness or a damping, whose unit holds kg. What has an input is left to its host.
    fn idle_effects(&self) -> impl Iterator<Item = String> {
        self.acting().filter_map(|(info, index)| {
            let block = Place::effect_block(info.number, index);
            let own = || self.variables.iter().filter(move |variable| variable.place.block == block);
            let is_driven = own().any(|variable| matches!(variable.meta.role, Role::Input { .. }));
            let is_strength = |variable: &&Variable| {
                matches!(variable.meta.role, Role::Parameter { .. }) && variable.meta.unit.exponents[0] != 0
            };
            let names: Vec<_> = own().filter(is_strength).map(|variable| variable.meta.name).collect();
            let is_zero = |variable: &Variable| self.starts.get(&variable.place.value_reference()) == Some(&0.0);
            let is_idle = !is_driven && !names.is_empty() && own().filter(is_strength).all(is_zero);
            let verb = if names.len() == 1 { "is" } else { "are" };
            is_idle.then(|| format!("{} does nothing: {} {verb} 0", info.block_name(index), names.join(", ")))
        })
    }

    fn idle_inputs(&self) -> impl Iterator<Item = String> {
        let [start, stop] = [self.experiment.start, self.experiment.stop];
        self.inputs.iter().filter_map(move |input| {
            let ([first, last], name) = ([input.time[0], input.time[input.time.len() - 1]], &input.name);
            if first >= stop {
                Some(format!("the input {name} begins at {first:?} s, and the run ends at {stop:?} s"))
            } else if input.time.len() > 1 && last <= start {
                Some(format!("the input {name} ends at {last:?} s, and the run begins at {start:?} s"))
            } else {
                None
            }
        })
    }
}
