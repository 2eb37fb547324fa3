//! How long a drawn scene lasts, when it is looked at, and what comes in from outside until then.

use super::dice::Dice;
use super::draw::Draw;
use super::trial::{Change, Partner, Trial};
use oracles::machine::{Input, Machine, Node};
use std::f64::consts::TAU;

/// So many periods of its fastest motion, and revolutions, a scene may last.
const PERIODS: [f64; 2] = [2.0, 2000.0];
const REVOLUTIONS: f64 = 1e4;

/// The fastest decay over the end [1]: what a reference in explicit steps can afford.
const STIFF: [f64; 2] = [1e2, 6e4];

/// So many periods of its springs a scene with rings may last.
const CONTACTS: [f64; 2] = [1.0, 30.0];

/// So often loads are exchanged at most.
const EXCHANGES: f64 = 600.0;

impl Draw {
    /// The fastest whirl and decay that springs and dampers give a body at rest, or somewhat more [rad/s].
    fn rates(&self) -> [f64; 2] {
        let Machine { m, Jt, l, bearings, support, rotating_damping, rubs, .. } = &self.trial.machine;
        let most = |of: &[[f64; 2]; 2], axial: f64| of.as_flattened().iter().fold(axial, |most, k| most.max(k.abs()));
        let at = |p: f64, by: f64, tilt: f64| by / m + (by * p * p + tilt) / Jt;
        let held = support.iter().map(|on| [0, 1].map(|n| at(*l, [on.c, on.d][n][0], [on.c, on.d][n][1])));
        let held = held.chain(
            bearings.iter().map(|on| [0, 1].map(|n| at(on.position, most(&[on.k, on.c][n], on.axial[n]), on.tilt[n]))),
        );
        let held = held.chain(bearings.iter().flat_map(|on| {
            // The largest of its nodes.
            let of_node = |node: &Node| [0, 1].map(|n| at(on.position, most(&[node.k, node.c][n], 0.0), 0.0));
            on.table.iter().map(of_node).reduce(|a, b| [a[0].max(b[0]), a[1].max(b[1])])
        }));
        let held = held.chain(rubs.iter().map(|on| [on.stiffness, on.damping].map(|by| at(on.position, by, 0.0))));
        let held = held.chain(rotating_damping.iter().map(|[d, p]| [0.0, at(*p, *d, 0.0)]));
        let [stiffness, damping] = held.fold([0.0; 2], |sum, more| [sum[0] + more[0], sum[1] + more[1]]);
        [stiffness.sqrt(), damping]
    }

    /// With an end, what is set until then, and when it is looked at.
    pub(super) fn timed(mut self) -> Trial {
        let [whirling, decay] = self.rates();
        let machine = &self.trial.machine;
        let asymmetric = !machine.unbalances.is_empty() || machine.Jt2.is_some();
        let reached = self.spin.abs().max((self.spin + self.gain).abs());
        let turning = machine.start.omega.norm().max(reached);
        let partners = if self.trial.partner.is_some() { 2.0 * self.rate } else { 0.0 };
        let nutation = machine.Ja / machine.Jt * turning;
        let fastest = whirling.max(partners).max(nutation).max(if asymmetric { turning } else { 0.0 }).max(0.1);
        let dice = &mut self.dice;
        let mut end = TAU * dice.decades(PERIODS[0], PERIODS[1]) / fastest;
        end = end.min(TAU * REVOLUTIONS / reached.max(0.1));
        if decay * end > STIFF[0] {
            end = end.min(dice.decades(STIFF[0], STIFF[1]) / decay);
        }
        if let Some(Partner { every, .. }) = self.trial.partner {
            end = end.min(EXCHANGES * every);
        }
        let machine = &mut self.trial.machine;
        if !machine.rubs.is_empty() {
            // Bounces make what is off grow.
            end = end.min(TAU * dice.decades(CONTACTS[0], CONTACTS[1]) / self.rate);
        }
        if let Some(motor) = &mut machine.motor {
            // Drawn as parts of the end, in which it runs the rotor up.
            motor.stall_torque *= machine.Ja * motor.synchronous_speed / end;
            motor.time_constant *= end;
        }
        if let Some([linear, quadratic]) = &mut machine.drag {
            // Drawn as a part of what stops it until the end.
            *linear *= machine.Ja / end;
            *quadratic *= machine.Ja / (end * turning.max(1.0));
        }
        let count = 60 + dice.below(41);
        let at = |k: usize, dice: &mut Dice| end * (k as f64 + dice.within(-0.3, 0.3)) / count as f64;
        let points = (1..count).map(|k| at(k, dice)).collect::<Vec<_>>();
        self.trial.points = points.into_iter().chain([end]).collect();
        self.trial.knows_end = dice.chance(0.8);
        self.inputs(end);
        self.trial.changes.sort_by(|a, b| a.t.total_cmp(&b.t));
        self.trial
    }

    /// What comes in from outside until the end [s].
    fn inputs(&mut self, end: f64) {
        let Machine { m, Ja, drive, imposed_speed, .. } = self.trial.machine;
        if self.trial.machine.motor.is_some() && self.dice.chance(0.5) {
            let command = self.dice.within(0.3, 1.2);
            self.load(Input::Command, command, end);
        }
        if drive {
            self.load(Input::Torque, Ja * self.gain / end, end);
        }
        if imposed_speed {
            self.speed(end);
        }
        if self.trial.partner.is_some() {
            return;
        }
        let held = self.trial.machine.support.is_some() || !self.trial.machine.bearings.is_empty();
        for port in 0..self.trial.machine.ports.len() {
            // As far as the load would move it.
            let way = self.radius * self.dice.decades(1e-6, 0.1);
            let force = m * way * if held { self.rate * self.rate } else { 4.0 / (end * end) };
            for axis in 0..3 {
                // Nothing holds it along x.
                if self.dice.chance(if axis == 0 { 0.1 } else { 0.6 }) {
                    let force = force * self.dice.within(-1.0, 1.0);
                    self.load(Input::Force(port, axis), force, end);
                }
                if self.dice.chance(0.3) {
                    let moment = force * self.radius * self.dice.within(-1.0, 1.0);
                    self.load(Input::Moment(port, axis), moment, end);
                }
            }
        }
    }

    /// A load of about this size: from the start, later, with derivatives, or one after the other.
    fn load(&mut self, input: Input, size: f64, end: f64) {
        if let Some([order, lag]) = self.trial.machine.extrapolation {
            return self.late(input, size, order, lag);
        }
        let dice = &mut self.dice;
        let changes = &mut self.trial.changes;
        let mut set = |t: f64, terms: [f64; 3]| changes.push(Change { t, input, terms });
        match dice.below(5) {
            0 | 1 => self.trial.machine.inputs.push((input, size)),
            2 => set(end * dice.within(0.02, 0.5), [size, 0.0, 0.0]),
            3 => {
                let t = end * dice.within(0.02, 0.3);
                let [slope, curvature] = [dice.within(-1.0, 1.0) / end, dice.within(-1.0, 1.0) / (end * end)];
                set(t, [0.5 * size, slope * size, curvature * size]);
            }
            _ => {
                self.trial.machine.inputs.push((input, 0.3 * size));
                for n in 0..2 + dice.below(5) {
                    let value = size * dice.within(-1.0, 1.0);
                    set(end * (0.05 + 0.15 * n as f64), [value, 0.0, 0.0]);
                }
            }
        }
    }

    /// A load that is told at every point, so many of them late. It moves only once there are values enough.
    fn late(&mut self, input: Input, size: f64, order: usize, lag: usize) {
        let times: Vec<_> = [0.0].into_iter().chain(self.trial.points.iter().copied()).collect();
        let end = times[times.len() - 1];
        let rate = TAU * self.dice.within(0.5, 3.0) / end;
        let first = order + lag + 1;
        self.trial.machine.inputs.push((input, size));
        for n in first..times.len() - 1 {
            let since = times[n - lag] - times[first - lag - 1];
            let value = size * libm::cos(rate * since);
            self.trial.changes.push(Change { t: times[n], input, terms: [value, 0.0, 0.0] });
        }
    }

    /// A speed whose rate rises in the first part of the run and falls to nothing in the second.
    fn smooth_speed(&mut self, end: f64) {
        let half = end * self.dice.within(0.1, 0.45);
        // ∫a dt = half · most
        let most = self.gain / half;
        for (t, terms) in [(0.0, [0.0, most / half, 0.0]), (half, [most, -most / half, 0.0]), (2.0 * half, [0.0; 3])] {
            self.trial.changes.push(Change { t, input: Input::Acceleration, terms });
        }
    }

    /// A speed that is bent, and jumps.
    fn speed(&mut self, end: f64) {
        if self.smooth {
            return self.smooth_speed(end);
        }
        let spin = self.spin;
        let dice = &mut self.dice;
        let jump = if dice.chance(0.5) { 1.0 } else { dice.within(0.8, 1.2) };
        let w = if spin == 0.0 { dice.decades(1.0, 100.0) } else { spin } * jump;
        let mut a = || w * dice.within(-0.5, 0.5) / end;
        let [first, second, third] = [a(), a(), a()];
        self.trial.machine.inputs.extend([(Input::Speed, w), (Input::Acceleration, first)]);
        let mut set = |part: f64, input: Input, terms: [f64; 3]| {
            self.trial.changes.push(Change { t: part * end, input, terms });
        };
        set(0.21, Input::Acceleration, [second, 0.0, 0.0]);
        if self.dice.chance(0.6) {
            let other = w * self.dice.within(0.9, 1.1);
            set(0.43, Input::Speed, [other, 0.0, 0.0]);
        }
        if self.dice.chance(0.6) {
            set(0.71, Input::Acceleration, [third, -third / end, 0.0]);
        }
    }
}
