//! Scenes that differ in one number from another, so that what judges is seen to tell them apart.

use super::trial::Trial;
use oracles::machine::{Input, Machine};

/// A number is off by this part [1].
const OFF: f64 = 0.01;

/// For each effect of a scene, its name and the scene with a number of this effect off.
pub fn of(trial: &Trial) -> Vec<(&'static str, Trial)> {
    let Machine { Jt, gravity, support, drive, Jt2, unbalances, bearings, .. } = &trial.machine;
    let Machine { rotating_damping, drag, ports, imposed_speed, motor, rubs, .. } = &trial.machine;
    let rotor: fn(&mut Trial) = |trial| {
        // All of them, so that the body stays a possible one.
        let Machine { Ja, Jt, Jt2, .. } = &mut trial.machine;
        [Some(Ja), Some(Jt), Jt2.as_mut()].into_iter().flatten().for_each(|inertia| *inertia *= 1.0 + OFF);
    };
    let mut all = vec![("rotor", rotor)];
    let mut with = |is_there: bool, name: &'static str, change: fn(&mut Trial)| {
        if is_there {
            all.push((name, change));
        }
    };
    with(gravity.is_some(), "gravity", |trial| trial.machine.gravity.iter_mut().for_each(|g| *g *= 1.0 + OFF));
    with(support.is_some(), "support", |trial| {
        let support = trial.machine.support.iter_mut();
        support.for_each(|support| (support.c, support.d) = (support.c.map(more), support.d.map(more)));
    });
    with(*drive, "drive", |trial| scale(trial, |input| input == Input::Torque));
    with(Jt2.is_some_and(|other| other != *Jt), "asymmetry", |trial| {
        let Machine { Jt, Jt2, .. } = &mut trial.machine;
        Jt2.iter_mut().for_each(|other| *other += OFF * (*Jt - *other));
    });
    with(!unbalances.is_empty(), "unbalance", |trial| {
        trial.machine.unbalances.iter_mut().for_each(|unbalance| unbalance.mass *= 1.0 + OFF);
    });
    with(!bearings.is_empty(), "bearing", |trial| {
        for bearing in &mut trial.machine.bearings {
            (bearing.k, bearing.c) = (bearing.k.map(|row| row.map(more)), bearing.c.map(|row| row.map(more)));
        }
    });
    with(rotating_damping.is_some(), "rotating damping", |trial| {
        trial.machine.rotating_damping.iter_mut().for_each(|[d, _]| *d *= 1.0 + OFF);
    });
    with(drag.is_some(), "drag", |trial| trial.machine.drag.iter_mut().for_each(|drag| *drag = drag.map(more)));
    with(!ports.is_empty() && trial.partner.is_none(), "port", |trial| {
        scale(trial, |input| matches!(input, Input::Force(..) | Input::Moment(..)));
    });
    with(motor.is_some(), "motor", |trial| {
        trial.machine.motor.iter_mut().for_each(|motor| motor.stall_torque *= 1.0 + OFF);
    });
    with(!rubs.is_empty(), "rub", |trial| trial.machine.rubs.iter_mut().for_each(|rub| rub.gap *= 1.0 + OFF));
    with(bearings.iter().any(|bearing| !bearing.table.is_empty()), "table", |trial| {
        for node in trial.machine.bearings.iter_mut().flat_map(|bearing| &mut bearing.table) {
            (node.k, node.c) = (node.k.map(|row| row.map(more)), node.c.map(|row| row.map(more)));
        }
    });
    with(*imposed_speed, "imposed speed", |trial| scale(trial, |input| input == Input::Acceleration));
    with(trial.partner.is_some(), "partner", |trial| {
        let partner = trial.partner.iter_mut();
        partner.for_each(|partner| partner.springs.iter_mut().for_each(|spring| *spring = spring.map(more)));
    });
    all.into_iter()
        .map(|(name, change)| {
            let mut mutant = trial.clone();
            change(&mut mutant);
            (name, mutant)
        })
        .collect()
}

fn more(value: f64) -> f64 {
    value * (1.0 + OFF)
}

/// Scales what comes in through these inputs.
fn scale(trial: &mut Trial, which: fn(Input) -> bool) {
    let at_start = trial.machine.inputs.iter_mut().filter(|(input, _)| which(*input));
    at_start.for_each(|(_, value)| *value = more(*value));
    let later = trial.changes.iter_mut().filter(|change| which(change.input));
    later.for_each(|change| change.terms = change.terms.map(more));
}
