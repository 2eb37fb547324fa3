//! Scenes drawn at random: every effect alone and in sets, from micro rotor to turbine, at rest and at any speed.

use super::trial::{Change, Partner, Trial};
use crate::oracles::machine::{Bearing, Input, Machine, Pace, Run, Start, Support, Unbalance};
use nalgebra::{Vector2, Vector3};
use std::f64::consts::{PI, TAU};

/// Numbers that look random, the same in every run.
///
/// Source: Steele, Lea and Flood, "Fast splittable pseudorandom number generators" (2014).
pub struct Dice(u64);

impl Dice {
    /// From this seed.
    pub fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn bits(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mixed = (self.0 ^ (self.0 >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        let mixed = (mixed ^ (mixed >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        mixed ^ (mixed >> 31)
    }

    /// Of any size from `low` to `high`.
    fn within(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.bits() >> 11) as f64 / (1_u64 << 53) as f64)
    }

    /// Of any order of magnitude from `low` to `high`.
    fn decades(&mut self, low: f64, high: f64) -> f64 {
        libm::exp(self.within(libm::log(low), libm::log(high)))
    }

    fn chance(&mut self, part: f64) -> bool {
        self.within(0.0, 1.0) < part
    }

    /// From 0 up to, but without, `end`.
    fn below(&mut self, end: usize) -> usize {
        (self.bits() % end as u64) as usize
    }

    fn sign(&mut self) -> f64 {
        if self.chance(0.5) { 1.0 } else { -1.0 }
    }

    /// A direction across e.
    fn across(&mut self) -> Vector3<f64> {
        let azimuth = self.within(0.0, TAU);
        Vector3::new(0.0, libm::cos(azimuth), libm::sin(azimuth))
    }
}

/// What holds a rotor.
#[derive(Clone, Copy, PartialEq)]
enum Held {
    Free,
    Support,
    Bearings,
    Both,
    Partners,
}

/// So many of a seed's first scenes have one effect each.
const ALONE: u64 = 13;

/// What a draw goes by: sizes of the rotor and of its motion.
struct Draw {
    dice: Dice,
    trial: Trial,
    /// Radius of gyration across t [m].
    radius: f64,
    /// About the rate of its springs, or of its tumbling [rad/s].
    rate: f64,
    /// Its spin at the start, and what a torque or a brake adds to it [rad/s].
    spin: f64,
    gain: f64,
}

/// The scene of this number of a seed; `attempt` counts those before it that were not fit.
pub fn draw(seed: u64, number: u64, attempt: u64) -> Option<Trial> {
    let dice = Dice::new((seed.wrapping_mul(1000).wrapping_add(number)).wrapping_mul(1000).wrapping_add(attempt));
    let mut draw = Draw::new(dice);
    if number < ALONE {
        draw.alone(number);
    } else {
        draw.set();
    }
    draw.timed()
}

impl Draw {
    /// A rotor of any size.
    fn new(mut dice: Dice) -> Self {
        let m = dice.decades(1e-6, 5e4);
        let radius = 0.05 * libm::cbrt(m) * dice.decades(0.5, 2.0);
        let transverse = m * radius * radius;
        let thin = dice.chance(0.1);
        let axial = if thin { 2.0 } else { dice.decades(0.02, 2.0) };
        let machine = Machine { m, Ja: axial * transverse, Jt: transverse, ..Machine::default() };
        let trial = Trial::new("", machine, vec![1.0]);
        Self { dice, trial, radius, rate: 0.0, spin: 0.0, gain: 0.0 }
    }

    /// One effect by itself, on a rotor that nothing holds unless the effect does.
    fn alone(&mut self, number: u64) {
        self.speeds(0.0);
        match number {
            0 => self.gravity(),
            1 => self.support(false),
            2 => self.support(true),
            3 => self.bearings(1),
            4 => self.asymmetry(),
            5 => self.unbalances(),
            6 => self.rotating_damping(),
            7 => self.drag(),
            8 => self.torque(),
            9 => self.ports(1),
            10 => {
                self.ports(1);
                self.extrapolation();
            }
            11 => self.imposed_speed(),
            _ => {
                self.trial.probes = vec![self.radius];
                self.trial.name = "probe".into();
            }
        }
        let held = matches!(number, 1..=3);
        self.start(held);
    }

    /// Several effects.
    fn set(&mut self) {
        use Held::*;
        let held = [Free, Support, Support, Bearings, Bearings, Bearings, Bearings, Both, Both, Partners];
        let held = held[self.dice.below(held.len())];
        // Where nothing of that weight is held, springs may be soft.
        let weighed = self.dice.chance(0.6);
        self.speeds(if weighed && held != Free { (10.0 * 9.81 / self.radius).sqrt() } else { 0.0 });
        let damped = self.dice.chance(0.6);
        match held {
            Free => {}
            Support => self.support(damped),
            Bearings => {
                let count = 1 + self.dice.below(4);
                self.bearings(count.max(2));
            }
            Both => {
                self.support(damped);
                let count = 1 + self.dice.below(2);
                self.bearings(count);
            }
            Partners => self.partners(),
        }
        if weighed {
            self.gravity();
        }
        if self.dice.chance(0.45) {
            self.unbalances();
        }
        if self.dice.chance(0.15) {
            self.asymmetry();
        }
        if self.dice.chance(0.15) {
            self.rotating_damping();
        }
        if self.dice.chance(0.2) {
            self.drag();
        }
        match self.dice.below(8) {
            0 | 1 => self.torque(),
            2 => self.imposed_speed(),
            _ => {}
        }
        if held != Partners && self.dice.chance(0.25) {
            let count = 1 + self.dice.below(2);
            self.ports(count);
        }
        if self.dice.chance(0.1) {
            self.trial.probes = vec![self.radius];
        }
        if self.trial.partner.is_some() && self.dice.chance(0.3) {
            // What a partner answers is not late; it may be extrapolated.
            self.trial.machine.extrapolation = Some([self.dice.below(3), 0]);
        } else if (self.trial.machine.shaft || !self.trial.machine.ports.is_empty()) && self.dice.chance(0.2) {
            self.extrapolation();
        }
        if self.trial.name.is_empty() {
            self.called("nothing");
        }
        self.start(held != Free);
    }

    fn called(&mut self, what: &str) {
        let name = &mut self.trial.name;
        if !name.is_empty() {
            name.push_str(", ");
        }
        name.push_str(what);
    }

    /// Spin and rate of the springs, not below this [rad/s].
    fn speeds(&mut self, least: f64) {
        let size = 0.05 / self.radius;
        let dice = &mut self.dice;
        self.rate = dice.decades(3.0, 3e3) * size.clamp(0.1, 30.0).sqrt();
        self.rate = self.rate.max(least * dice.decades(1.0, 10.0));
        self.spin = if dice.chance(0.15) { 0.0 } else { dice.decades(1.0, 1e5) * dice.sign() };
    }

    fn gravity(&mut self) {
        let dice = &mut self.dice;
        let g = if dice.chance(0.8) { Vector3::z() * -9.81 } else { dice.across() * 9.81 };
        self.trial.machine.gravity = Some(g);
        self.called("gravity");
    }

    /// A part of critical damping: none, little, or more than all.
    fn damping(&mut self) -> f64 {
        match self.dice.below(8) {
            0 | 1 => 0.0,
            2 => self.dice.decades(1.0, 30.0),
            _ => self.dice.decades(1e-3, 0.5),
        }
    }

    /// The rate of a single spring [rad/s].
    fn one_rate(&mut self) -> f64 {
        self.rate * self.dice.decades(0.2, 5.0)
    }

    fn support(&mut self, damped: bool) {
        let [place, tilt] = [self.one_rate(), self.one_rate()];
        let Machine { m, Jt, .. } = self.trial.machine;
        let parts = [self.damping(), self.damping()].map(|part| if damped { part } else { 0.0 });
        let c = [m * place * place, if self.dice.chance(0.7) { Jt * tilt * tilt } else { 0.0 }];
        let d = [2.0 * parts[0] * m * place, 2.0 * parts[1] * Jt * tilt];
        let machine = &mut self.trial.machine;
        machine.l = self.radius * if self.dice.chance(0.3) { 0.0 } else { self.dice.within(0.3, 4.0) };
        machine.support = Some(Support { c, d });
        self.called("support");
    }

    fn bearings(&mut self, count: usize) {
        for n in 0..count {
            let place = if n == 2 { 0.0 } else { self.dice.within(0.3, 4.0) };
            let position = self.radius * if n % 2 == 0 { -place } else { place };
            let bearing = self.bearing(position, count as f64);
            self.trial.machine.bearings.push(bearing);
        }
        self.called(&format!("{count} bearings"));
    }

    /// One of so many bearings.
    fn bearing(&mut self, position: f64, count: f64) -> Bearing {
        let Machine { m, Jt, .. } = self.trial.machine;
        let (rate, part) = (self.one_rate(), self.damping());
        let (stiffness, damping) = (m * rate * rate / count, 2.0 * part * m * rate / count);
        let dice = &mut self.dice;
        let [ky, kz] = [dice.decades(0.5, 2.0), dice.decades(0.5, 2.0)].map(|part| stiffness * part);
        let kz = if dice.chance(0.5) { ky } else { kz };
        let mut k = [[ky, 0.0], [0.0, kz]];
        if dice.chance(0.25) {
            let cross = dice.sign() * dice.decades(1e-3, 0.2) * stiffness;
            (k[0][1], k[1][0]) = if dice.chance(0.7) { (cross, -cross) } else { (cross, cross) };
        }
        let [cy, cz] = [1.0, dice.within(0.5, 1.5)].map(|part| damping * part);
        let mut c = [[cy, 0.0], [0.0, cz]];
        if dice.chance(0.2) {
            // Skew damping does no work; of the even one only so much is possible.
            let skew = dice.sign() * dice.decades(1e-2, 1.0) * m * rate / count;
            let even = dice.within(-0.7, 0.7) * (cy * cz).sqrt();
            (c[0][1], c[1][0]) = (even + skew, even - skew);
        }
        let mut bearing = Bearing { position, k, c, ..Bearing::default() };
        if dice.chance(0.5) {
            bearing.axial = [dice.decades(0.1, 3.0) * stiffness, dice.within(0.0, 1.0) * damping];
        }
        if dice.chance(0.2) {
            let rate = rate * dice.decades(0.3, 1.0);
            let damping = if dice.chance(0.5) { 0.0 } else { dice.decades(1e-3, 0.3) };
            bearing.tilt = [Jt * rate * rate / count, 2.0 * damping * Jt * rate / count];
        }
        bearing
    }

    fn asymmetry(&mut self) {
        let Machine { Ja, Jt, .. } = self.trial.machine;
        let most = self.dice.decades(0.01, 0.5);
        self.trial.machine.Jt2 = Some((Jt * (1.0 + self.dice.sign() * most)).clamp((Ja - Jt).abs(), Ja + Jt));
        self.called("asymmetry");
    }

    fn unbalances(&mut self) {
        let count = [1, 1, 1, 2, 3, 4][self.dice.below(6)];
        for _ in 0..count {
            let dice = &mut self.dice;
            let mass = self.trial.machine.m * dice.decades(1e-7, 1e-2);
            let radius = self.radius * dice.within(0.2, 1.5);
            let position = self.radius * if dice.chance(0.3) { 0.0 } else { dice.within(-2.0, 2.0) };
            let angle = dice.within(0.0, TAU);
            self.trial.machine.unbalances.push(Unbalance { mass, radius, angle, position });
        }
        self.called(&format!("{count} unbalances"));
    }

    fn rotating_damping(&mut self) {
        let d = 2.0 * self.dice.decades(1e-4, 0.3) * self.trial.machine.m * self.rate;
        let position = self.radius * self.dice.within(-1.0, 1.0);
        self.trial.machine.rotating_damping = Some([d, position]);
        self.called("rotating damping");
    }

    fn drag(&mut self) {
        // Its size is that of the time that the run will take.
        let both = self.dice.below(3);
        let [linear, quadratic] = [0, 1].map(|_| self.dice.decades(1e-3, 3.0));
        self.trial.machine.drag = Some([if both == 1 { 0.0 } else { linear }, if both == 0 { 0.0 } else { quadratic }]);
        self.called("drag");
    }

    fn torque(&mut self) {
        self.trial.machine.shaft = true;
        self.gain = self.dice.decades(3.0, 1e4) * self.dice.sign();
        if self.dice.chance(0.4) {
            // A run-up from rest.
            self.spin = 0.0;
        }
        self.called("torque");
    }

    fn imposed_speed(&mut self) {
        self.trial.machine.imposed_speed = true;
        self.called("imposed speed");
    }

    fn ports(&mut self, count: usize) {
        let positions = (0..count).map(|_| self.radius * self.dice.within(-3.0, 3.0));
        self.trial.machine.ports = positions.collect();
        self.called(&format!("{count} ports"));
    }

    fn extrapolation(&mut self) {
        self.trial.machine.extrapolation = Some([self.dice.below(3), self.dice.below(3)]);
        self.called("extrapolation");
    }

    fn partners(&mut self) {
        let m = self.trial.machine.m;
        let [near, far] = [-1.0, 1.0].map(|side| side * self.radius * self.dice.within(0.3, 4.0));
        self.trial.machine.ports = vec![near, far];
        let part = self.dice.decades(0.03, 0.5);
        let springs = [0, 1].map(|_| {
            let rate = self.one_rate();
            [0.5 * m * rate * rate, part * m * rate]
        });
        // What is held between two exchanges drives what it should damp unless they are this near.
        let stable = springs.iter().map(|[k, c]| (2.0 * c / k).min(m / c)).fold(f64::INFINITY, f64::min);
        let every = stable * self.dice.within(0.05, 0.3);
        self.trial.partner = Some(Partner { every, springs: springs.into(), from_start: self.dice.chance(0.5) });
        self.called("partners");
    }

    /// Where it begins.
    fn start(&mut self, held: bool) {
        let dice = &mut self.dice;
        let mut start = Start { phi: dice.within(-PI, PI), ..Start::default() };
        if dice.chance(0.5) {
            start.phi = 0.0;
        }
        start.omega.x = self.spin;
        // Half of what is held is let go where its springs are loose, if something then moves it.
        let Machine { gravity, unbalances, ports, .. } = &self.trial.machine;
        let pushed = gravity.is_some() || !unbalances.is_empty() || (!ports.is_empty() && self.trial.partner.is_none());
        if held && pushed && dice.chance(0.5) {
            self.trial.machine.start = start;
            return;
        }
        let most = if held { 0.3 } else { 2.0 };
        let tilt = dice.across() * if dice.chance(0.3) { 0.0 } else { dice.decades(1e-6, most) };
        start.gamma = Vector2::new(tilt.y, tilt.z);
        let way = self.radius * dice.decades(1e-6, 0.3);
        start.r_c = dice.across() * way;
        start.v_c = dice.across() * (way * self.rate * dice.within(0.0, 1.0));
        if dice.chance(0.3) {
            start.r_c.x = self.trial.machine.l;
        }
        let turning = if held { self.rate * dice.decades(1e-5, 0.1) } else { self.rate * dice.decades(1e-3, 1.0) };
        start.omega += dice.across() * turning;
        self.trial.machine.start = start;
    }
}

/// So many periods of its fastest motion, and revolutions, a scene may last.
const PERIODS: [f64; 2] = [2.0, 2000.0];
const REVOLUTIONS: f64 = 1e4;

/// The fastest decay over the end [1]: what a reference in explicit steps can afford.
const STIFF: [f64; 2] = [1e2, 6e4];

/// So often loads are exchanged at most.
const EXCHANGES: f64 = 600.0;

impl Draw {
    /// With an end, what is set until then, and when it is looked at.
    fn timed(mut self) -> Option<Trial> {
        // Only its springs and inertia tell how long it lasts, and what drag is to it.
        let drag = self.trial.machine.drag.take();
        let spectrum = Run::new(&self.trial.machine, Pace::Adaptive(1.0)).spectrum()?;
        let machine = &self.trial.machine;
        let uneven = !machine.unbalances.is_empty() || machine.Jt2.is_some();
        let reached = self.spin.abs().max((self.spin + self.gain).abs());
        let turning = machine.start.omega.norm().max(reached);
        let whirling = spectrum.values.iter().map(|value| value.im).fold(0.0, f64::max);
        let partners = if self.trial.partner.is_some() { 2.0 * self.rate } else { 0.0 };
        let nods = machine.Ja / machine.Jt * turning;
        let fastest = whirling.max(partners).max(nods).max(if uneven { turning } else { 0.0 }).max(0.1);
        let decay = spectrum.values.iter().map(|value| -value.re).fold(0.0, f64::max);
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
        machine.drag = drag
            .map(|[linear, quadratic]| [linear * machine.Ja / end, quadratic * machine.Ja / (end * turning.max(1.0))]);
        let count = 60 + dice.below(41);
        let at = |k: usize, dice: &mut Dice| end * (k as f64 + dice.within(-0.3, 0.3)) / count as f64;
        let points = (1..count).map(|k| at(k, dice)).collect::<Vec<_>>();
        self.trial.points = points.into_iter().chain([end]).collect();
        self.trial.knows_end = dice.chance(0.8);
        self.inputs(end);
        self.trial.changes.sort_by(|a, b| a.t.total_cmp(&b.t));
        Some(self.trial)
    }

    /// What comes in from outside until the end [s].
    fn inputs(&mut self, end: f64) {
        let Machine { m, Ja, shaft, imposed_speed, .. } = self.trial.machine;
        if shaft {
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

    /// A speed that is bent, and jumps.
    fn speed(&mut self, end: f64) {
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
