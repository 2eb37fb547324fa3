//! Scenes drawn at random: every effect alone and in sets, from micro rotor to turbine, at rest and at any speed.

use super::dice::Dice;
use super::trial::{Partner, Trial};
use nalgebra::{Vector2, Vector3};
use oracles::machine::{Bearing, Machine, Start, Support, Unbalance};
use oracles::rotation;
use std::f64::consts::{PI, TAU};

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

/// From this number on scenes draw the effects of [`newer`](super::newer) as well.
const NEWER: u64 = 200;

/// What a draw goes by: sizes of the rotor and of its motion.
pub(super) struct Draw {
    pub(super) dice: Dice,
    pub(super) trial: Trial,
    /// Radius of gyration across t [m].
    pub(super) radius: f64,
    /// About the rate of its springs, or of its tumbling [rad/s].
    pub(super) rate: f64,
    /// Its spin at the start, and what a torque or a brake adds to it [rad/s].
    pub(super) spin: f64,
    pub(super) gain: f64,
    /// Whether an imposed speed rises from rest with a rate that rises and falls.
    pub(super) smooth: bool,
}

/// The scene of this number of a seed; `attempt` counts those before it that were not fit.
pub fn draw(seed: u64, number: u64, attempt: u64) -> Trial {
    let dice = Dice::new((seed.wrapping_mul(1000).wrapping_add(number)).wrapping_mul(1000).wrapping_add(attempt));
    let mut draw = Draw::new(dice);
    match number {
        ..ALONE => draw.alone(number),
        ALONE..NEWER => draw.set(),
        240 | 245 => draw.smooth_run_up(),
        241 | 246 => draw.stiff_pivot(),
        _ => draw.newer(number - NEWER),
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
        Self { dice, trial, radius, rate: 0.0, spin: 0.0, gain: 0.0, smooth: false }
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
    pub(super) fn set(&mut self) {
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
        } else if (self.trial.machine.drive || !self.trial.machine.ports.is_empty()) && self.dice.chance(0.2) {
            self.extrapolation();
        }
        if self.trial.name.is_empty() {
            self.called("nothing");
        }
        self.start(held != Free);
    }

    pub(super) fn called(&mut self, what: &str) {
        let name = &mut self.trial.name;
        if !name.is_empty() {
            name.push_str(", ");
        }
        name.push_str(what);
    }

    /// Spin and rate of the springs, not below this [rad/s].
    pub(super) fn speeds(&mut self, least: f64) {
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
    pub(super) fn damping(&mut self) -> f64 {
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

    pub(super) fn bearings(&mut self, count: usize) {
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
        self.trial.machine.drive = true;
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

    /// An unbalanced rotor in bearings, from rest to up to three times its critical speed.
    fn smooth_run_up(&mut self) {
        self.speeds(0.0);
        let count = 1 + self.dice.below(2);
        self.bearings(count);
        self.unbalances();
        self.imposed_speed();
        (self.spin, self.smooth) = (0.0, true);
        self.gain = self.rate * self.dice.decades(0.1, 3.0) * self.dice.sign();
        // At rest but for a little way: of what starts with nothing at all the reference knows no size.
        let r_c = self.dice.across() * (1e-6 * self.radius);
        self.trial.machine.start = Start { r_c, ..Start::default() };
    }

    /// A top whose pivot is far stiffer than what it does.
    fn stiff_pivot(&mut self) {
        self.speeds(0.0);
        self.spin = self.spin.abs().max(self.rate);
        let dice = &mut self.dice;
        let (l, tilt) = (self.radius * dice.within(0.5, 3.0), dice.across() * dice.within(0.05, 1.2));
        let rate = (9.81 / self.radius).sqrt() * dice.decades(10.0, 1e3);
        let gamma = Vector2::new(tilt.y, tilt.z);
        let axis = rotation::axis(&gamma);
        let machine = &mut self.trial.machine;
        machine.l = l;
        machine.support = Some(Support { c: [machine.m * rate * rate, 0.0], d: [0.0; 2] });
        machine.gravity = Some(Vector3::x() * -9.81);
        // Half as far as it gives way to the weight.
        let r_c = axis * l - Vector3::x() * (0.5 * 9.81 / (rate * rate));
        machine.start = Start { r_c, gamma, omega: axis * self.spin, ..Start::default() };
        self.called("top on a stiff pivot");
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
    pub(super) fn start(&mut self, held: bool) {
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
