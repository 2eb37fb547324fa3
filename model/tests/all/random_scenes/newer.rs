//! What scenes draw from number 200 on: motors, tables of bearings and rings.

use super::draw::Draw;
use oracles::machine::{Machine, Motor, Node, Rub};

impl Draw {
    /// The scene of this number among them: first each by itself, then some of them beside all else.
    pub(super) fn newer(&mut self, number: u64) {
        match number {
            0 => self.alone_with(0, Self::motor),
            1 => self.alone_with(1, Self::tables),
            2 => self.alone_with(0, Self::rubs),
            _ => self.several(),
        }
    }

    /// On a rotor with so many bearings and nothing else.
    fn alone_with(&mut self, bearings: usize, what: fn(&mut Self)) {
        self.speeds(0.0);
        if bearings > 0 {
            self.bearings(bearings);
        }
        self.start(bearings > 0);
        what(self);
    }

    fn several(&mut self) {
        self.set();
        let Machine { drive, imposed_speed, ref bearings, .. } = self.trial.machine;
        let (driven, held) = (drive || imposed_speed, !bearings.is_empty());
        if !driven && self.dice.chance(0.5) {
            self.motor();
        }
        if held && self.dice.chance(0.5) {
            self.tables();
        }
        if self.dice.chance(0.5) {
            self.rubs();
        }
    }

    /// Its torque and lag are told once the end is known.
    fn motor(&mut self) {
        let dice = &mut self.dice;
        let synchronous_speed = if self.spin != 0.0 && dice.chance(0.5) {
            self.spin.abs() * dice.decades(0.3, 3.0)
        } else {
            dice.decades(3.0, 1e4)
        };
        let time_constant = if dice.chance(0.4) { 0.0 } else { dice.decades(1e-3, 0.3) };
        let stall_torque = dice.decades(0.1, 20.0);
        self.gain = synchronous_speed - self.spin;
        self.trial.machine.motor = Some(Motor { stall_torque, synchronous_speed, time_constant });
        self.called("motor");
    }

    /// A table for one bearing or for all, through most of whose speeds the rotor goes if anything drives or brakes it.
    fn tables(&mut self) {
        let all = self.dice.chance(0.5);
        let count = if all { self.trial.machine.bearings.len() } else { 1 };
        for n in 0..count {
            let table = self.table(n);
            self.trial.machine.bearings[n].table = table;
        }
        self.called(&format!("{count} tables"));
    }

    fn table(&mut self, bearing: usize) -> Vec<Node> {
        let dice = &mut self.dice;
        let reached = self.spin.abs().max((self.spin + self.gain).abs()).max(1.0);
        let on = &self.trial.machine.bearings[bearing];
        let most = |of: &[[f64; 2]; 2]| of.as_flattened().iter().fold(0.0_f64, |most, k| most.max(k.abs()));
        // A damper of a bearing without one.
        let [k, c] = [most(&on.k), most(&on.c).max(0.02 * most(&on.k) / self.rate)];
        let mut speeds: Vec<_> = (0..2 + dice.below(5)).map(|_| reached * dice.within(0.0, 1.2)).collect();
        if dice.chance(0.3) {
            speeds[0] = 0.0;
        }
        speeds.sort_by(f64::total_cmp);
        // Neighbours are not so near that a cubic between them is a jump.
        speeds.dedup_by(|next, before| *next - *before < 0.02 * reached);
        // Between nodes the damping along y and z is at least the least of the nodes, so that what couples them is possible.
        let [least, skew] = [c * dice.decades(0.01, 1.0), if dice.chance(0.3) { c } else { 0.0 }];
        let stands = self.spin == 0.0;
        let node = |speed: f64| {
            let mut along = || k * dice.within(-0.3, 1.0);
            let [kyy, kzz] = [along(), along()];
            let mut cross = if skew == 0.0 { 0.0 } else { k * dice.within(-0.2, 0.2) };
            let [cyy, czz] = [0, 1].map(|_| least + c * dice.within(0.0, 1.0));
            let (mut even, mut skew) = (0.7 * least * dice.within(-1.0, 1.0), skew * dice.within(-1.0, 1.0));
            if stands && speed == 0.0 {
                // What couples jumps there, and a rotor that stands is on neither side.
                (cross, even, skew) = (0.0, 0.0, 0.0);
            }
            Node { speed, k: [[kyy, cross], [-cross, kzz]], c: [[cyy, even + skew], [even - skew, czz]] }
        };
        speeds.into_iter().map(node).collect()
    }

    /// Rings about as wide as the motion.
    fn rubs(&mut self) {
        let count = [1, 1, 1, 2][self.dice.below(4)];
        for _ in 0..count {
            let rub = self.rub();
            self.trial.machine.rubs.push(rub);
        }
        self.called(&format!("{count} rubs"));
    }

    fn rub(&mut self) -> Rub {
        let position = self.radius * if self.dice.chance(0.3) { 0.0 } else { self.dice.within(-2.0, 2.0) };
        let part = self.damping();
        let dice = &mut self.dice;
        let Machine { m, start, gravity, unbalances, .. } = &self.trial.machine;
        let eccentricity = unbalances.iter().map(|one| one.mass / m * one.radius).sum::<f64>();
        let sag = gravity.map_or(0.0, |g| g.norm() / (self.rate * self.rate));
        let speed = start.v_c.norm() + start.omega.yz().norm() * position.abs();
        let ways =
            [sag, 3.0 * eccentricity, start.r_c.yz().norm() + start.gamma.norm() * position.abs(), speed / self.rate];
        let way = ways.into_iter().fold(1e-6 * self.radius, f64::max);
        let gap = way * dice.decades(0.2, 2.0);
        let rate = self.rate * dice.decades(0.5, 10.0);
        let friction = if dice.chance(0.4) { 0.0 } else { dice.decades(0.01, 0.4) };
        let radius = self.radius * dice.within(0.0, 0.5);
        let v0 = dice.decades(0.03, 1.0) * (gap * self.rate + 0.1 * radius * self.spin.abs());
        let damping = 2.0 * part * m * rate;
        Rub { position, gap, stiffness: m * rate * rate, damping, friction, radius, v0 }
    }
}
