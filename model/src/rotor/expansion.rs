//! The series of a symmetric rotor's motion, in the axis t: a spherical pendulum with a gyroscopic term. In t the motion is regular
//! everywhere, forces at stations are linear, and a chart concerns φ alone.

mod axis;
mod lean;
mod triple;

use super::{Rotor, groups};
use crate::body::ROTOR;
use crate::coefficient::Coefficient;
use crate::effects::series::{MOST_POWER, Now, Row, Series};
use crate::effects::{Change, Effects, Motion};
use crate::integrate::sizes::{Squares, largest_square};
use crate::integrate::taylor::{Analytic, Room, Scratch, Seed, Terms};
use crate::rotation::Tilt;
use crate::state::{Coordinates, Kinematics};
use axis::{Axis, Lower, Pairs};
use lean::Lean;
use nalgebra::Vector3;
use num_traits::Zero;
use triple::Triple;
use wide::{f64x2, f64x4};

/// Where the numbers stand: place, axis, S = K·t, φ, own states, and then the work.
const PLACE: usize = 0;
const AXIS: usize = 3;
const SPIN: usize = 6;
const ANGLE: usize = 7;
const OWN: usize = 8;

/// In a step e·t changes by at most so many times as much as is seen in some places of it \[1].
const MARGIN: f64 = 2.0;

/// Coefficients of higher powers hardly add to that.
const SEEN: usize = 8;

/// The coefficients of what acts, at one power.
struct Load {
    force: Vector3<f64>,
    /// M×t but for multiples of t, and M·t [N·m].
    across: Vector3<f64>,
    along: f64,
    /// Power supplied and lost \[W].
    work: [f64; 2],
}

/// Three numbers of these.
#[inline(always)]
fn vector(of: &[f64]) -> Vector3<f64> {
    Vector3::new(of[0], of[1], of[2])
}

impl<E: Effects> Rotor<'_, E> {
    /// What acts, at the power at hand, of place, velocity, axis and own states with these coefficients.
    #[inline(always)]
    fn loads<const N: usize, const HIGHER: bool>(
        &self,
        series: &Series,
        [place, speed, axis]: [Vector3<f64>; 3],
        own_states: &[f64],
        own_rates: &mut [f64],
        per_next: f64,
    ) -> Load {
        let none = Coefficient::<HIGHER>::NONE;
        let varying = |v: Vector3<f64>| v.map(Coefficient::varying);
        let at = Coordinates {
            r: varying(place),
            v: varying(speed),
            k: Vector3::repeat(none),
            gamma: nalgebra::Vector2::repeat(none),
            phi: none,
        };
        let kinematics = Kinematics {
            body: self.frame.body.symmetric(),
            t: none,
            turns: 0.0,
            at,
            tilt: Tilt::of_axis(self.frame.chart, varying(axis)),
            swing: Vector3::repeat(none),
            spin: none,
            omega: Vector3::repeat(none),
            to_centre: None,
            impulse: None,
        };
        // Where there are no own states, nothing is made of them.
        let states: [Coefficient<HIGHER>; N];
        let seen_own = if E::FACTS.own > 0 {
            states = std::array::from_fn(|n| own_states.get(n).map_or(none, |state| Coefficient::varying(*state)));
            &states[E::layout::<N>().own()]
        } else {
            &[]
        };
        let seen = Motion::of_series(&kinematics, seen_own, series);
        let act = self.effects.act(&seen);
        let load = if series.works() { act.load + act.damping } else { act.load };
        if E::FACTS.own > 0 {
            let mut rates = [Coefficient::zero(); N];
            self.effects.own_rates(&seen, &mut rates[E::layout::<N>().own()]);
            for (to, rate) in own_rates.iter_mut().zip(rates) {
                *to = rate.coefficient() * per_next;
            }
        }
        Load {
            force: load.force.map(Coefficient::coefficient),
            across: load.moment.map(Coefficient::coefficient),
            along: load.along.coefficient(),
            work: [act.supply.coefficient(), act.loss.coefficient()],
        }
    }

    #[inline(always)]
    fn expanded<const N: usize>(
        &self,
        series: &mut Series,
        scratch: &mut Scratch,
        levels: u32,
        (t, y, seed): (f64, &[f64; N], &Seed),
        order: usize,
        terms: &mut Terms<N>,
    ) {
        let own = E::FACTS.own;
        let body = self.frame.body;
        let at = self.at(y);
        let sign = f64x2::splat(self.frame.chart.sign());
        let per_ja = body.spin + body.per_jt;
        let works = series.works() && E::layout::<N>().has_work();
        let [first, second] = [0, 3].map(|n| Triple::of(vector(&seed[n..])));
        let along = seed[0];
        let per_divisor = f64x2::ONE / (f64x2::ONE + sign * f64x2::splat(along));
        let mut momentum = seed[6];
        let mut axis = Axis::new(&mut scratch.axis, first, second, momentum);
        let mut lean = Lean::new(&mut scratch.lean, levels);
        let steepness = lean.begin(along);

        let begin = &mut terms[0];
        begin[OWN..][..own].copy_from_slice(&y[..own]);
        begin[PLACE..][..3].copy_from_slice(at.r.as_slice());
        begin[AXIS..][..3].copy_from_slice(&seed[..3]);
        (begin[SPIN], begin[ANGLE]) = (momentum, at.phi);
        if works {
            begin[OWN + own..][..2].copy_from_slice(&E::layout::<N>().read_work(y));
        }
        terms[1][PLACE..][..3].copy_from_slice(at.v.as_slice());
        terms[1][AXIS..][..3].copy_from_slice(&seed[3..6]);
        let (mut at, mut coming) = (first, second);
        let mut turn = first.cross(second);

        for n in 0..order.min(MOST_POWER) {
            let [next, both, per_next, per_both] = FACTORS[n];
            let t_n = at.vector();
            let Lower { pulled, divided, lean: higher } = axis.lower(n, &mut lean, t_n.x);
            // eq. 104: dφ/dt = S/Ja ± e·(t×dt/dt)/(1 ± e·t)
            let quotient = (turn.zx - divided * sign) * per_divisor;
            let [_, rate] = (quotient * sign).to_array();
            let spin = momentum * per_ja;
            let phi_rate = spin + rate;
            let lean_n = if n == 0 { steepness } else { higher };
            let [axis_rate, turn_n] = [coming * f64x2::splat(next), turn].map(Triple::vector);
            series.go_on(Now { power: n, t, axis_rate, turn: turn_n, spin, lean: lean_n }, t_n.x);
            let [term, after, beyond, ..] = &mut terms[n..] else { break };
            let (r, v) = (vector(&term[PLACE..]), vector(&after[PLACE..]) * next);
            let load = if n == 0 {
                self.loads::<N, false>(series, [r, v, t_n], &term[OWN..][..own], &mut after[OWN..][..own], per_next)
            } else {
                self.loads::<N, true>(series, [r, v, t_n], &term[OWN..][..own], &mut after[OWN..][..own], per_next)
            };
            // eq. 105: d²t/dt² = λ t + (M×t + S t×dt/dt)/Jt
            let rest = (Triple::of(load.across) + axis.gyroscopic(n, turn)) * f64x2::splat(body.per_jt) + pulled;
            // eq. 105: d²r/dt² = F/m, dS/dt = M·t
            momentum = load.along * per_next;
            after[ANGLE] = phi_rate * per_next;
            after[SPIN] = momentum;
            if works {
                after[OWN + own] = load.work[0] * per_next;
                after[OWN + own + 1] = load.work[1] * per_next;
            }
            beyond[PLACE..][..3].copy_from_slice((load.force * (body.per_m * per_both)).as_slice());
            // eq. 106: λ from |t| = 1, t₀·t_m = −½ Σ t_i·t_(m−i), 0 < i < m
            let m = n + 2;
            let Pairs { crossed, square, along } = axis.pairs_of(m);
            let pull = -(square * f64x2::splat(both)) - first.dot(rest);
            let t_m = (rest + first * pull) * f64x2::splat(per_both);
            axis.push(n, pull, quotient, momentum);
            axis.put(m, t_m);
            lean.put_square(m, along + along);
            beyond[AXIS..][..3].copy_from_slice(t_m.vector().as_slice());
            turn = crossed + first.cross(t_m * f64x2::splat(m as f64));
            (at, coming) = (coming, t_m);
        }
    }
}

/// The axis, its rate and S.
#[inline(always)]
fn seed(axis: &Vector3<f64>, rate: &Vector3<f64>, momentum: f64) -> Seed {
    [axis.x, axis.y, axis.z, rate.x, rate.y, rate.z, momentum]
}

/// n + 1 and (n + 1)(n + 2), and 1 over each.
const FACTORS: [[f64; 4]; MOST_POWER] = {
    let mut factors = [[0.0; 4]; MOST_POWER];
    let mut n = 0;
    while n < MOST_POWER {
        let [next, both] = [(n + 1) as f64, ((n + 1) * (n + 2)) as f64];
        factors[n] = [next, both, 1.0 / next, 1.0 / both];
        n += 1;
    }
    factors
};

#[inline(never)]
fn with_rows<const ROWS: usize>(works: bool, expand: &mut dyn FnMut(&mut Series) -> Room) -> Room {
    expand(&mut Series::<[Row; ROWS]>::new(works))
}

impl<E: Effects, const N: usize> Analytic<N> for Rotor<'_, E> {
    const RATED: usize = SPIN;

    const NUMBERS: usize = N - 4;

    fn seed(&self, t: f64, y: &[f64; N]) -> Seed {
        let motion: Kinematics<f64> = self.motion(t, y);
        seed(motion.axis(), &motion.axis_rate(), motion.at.k.dot(motion.axis()))
    }

    #[inline(never)]
    fn expand(
        &self,
        start: (f64, &[f64; N], &Seed),
        order: usize,
        room: Room,
        scratch: &mut Scratch,
        terms: &mut Terms<N>,
    ) -> Room {
        let works = self.active.works;
        let mut expand = |series: &mut Series| {
            self.expanded(series, scratch, room.levels, start, order, terms);
            Room {
                rows: series.count() as u32,
                levels: if series.leans() { room.levels.max(1) } else { 0 },
                horizon: series.horizon(order - 1),
            }
        };
        // Each by itself: room on the stack that is not needed is not touched.
        match room.rows {
            0 => with_rows::<0>(works, &mut expand),
            1..=8 => with_rows::<8>(works, &mut expand),
            9..=16 => with_rows::<16>(works, &mut expand),
            17..=32 => with_rows::<32>(works, &mut expand),
            33..=96 => with_rows::<96>(works, &mut expand),
            _ => with_rows::<400>(works, &mut expand),
        }
    }

    fn levels(&self, terms: &[[f64; N]], s: f64, least: f64) -> u32 {
        let along = |n: usize| terms[n][AXIS];
        let places = [0.25, 0.5, 0.75, 1.0].map(|part| part * s);
        let mut changes = f64x4::ZERO;
        for n in (1..terms.len()).take(SEEN).rev() {
            changes = (changes + f64x4::splat(along(n))) * f64x4::new(places);
        }
        // eq. 102: f_(k+1) is to f_k about as −1 to 1 + e·t
        let ratio =
            MARGIN * changes.to_array().into_iter().fold(0.0, |most, change| change.abs().max(most)) / (1.0 + along(0));
        let (mut part, mut levels) = (1.0, 0);
        // Of no more powers than there are coefficients anything is left out.
        while part > least && levels < MOST_POWER as u32 {
            (part, levels) = (part * ratio, levels + 1);
        }
        lean::room(levels)
    }

    #[inline(always)]
    fn state_of(&self, numbers: &[f64; N], rates: &[f64; N]) -> ([f64; N], Seed) {
        let own = E::FACTS.own;
        let [of, rate] = [numbers, rates];
        // Rounding leaves t beside the sphere, and dt/dt beside its tangent plane.
        let axis = vector(&of[AXIS..]).normalize();
        let axis_rate = vector(&rate[AXIS..]);
        let axis_rate = axis_rate - axis * axis.dot(&axis_rate);
        let body = self.frame.body;
        let mut y = [0.0; N];
        y[..own].copy_from_slice(&numbers[OWN..][..own]);
        let coordinates = Coordinates {
            r: vector(&of[PLACE..]),
            v: vector(&rate[PLACE..]),
            // eq. 11: K = Jt t×dt/dt + S t
            k: axis.cross(&axis_rate) * (1.0 / body.per_jt) + axis * of[SPIN],
            gamma: self.frame.chart.gamma_of(&axis),
            phi: of[ANGLE],
        };
        let layout = E::layout::<N>();
        layout.write(&mut y, ROTOR, &coordinates);
        if layout.has_work() {
            layout.write_work(&mut y, [of[OWN + own], of[OWN + own + 1]]);
        }
        (y, seed(&axis, &axis_rate, of[SPIN]))
    }

    #[inline(always)]
    fn term(&self, y: &[f64; N], terms: &Terms<N>, power: usize, weights: &Squares) -> f64 {
        let own = E::FACTS.own;
        let first = &terms[0];
        let [of, above] = [power, power + 1].map(|power| &terms[power]);
        let (axis, next) = (vector(&of[AXIS..]), (power + 1) as f64);
        let mut change = [0.0; N];
        change[..own].copy_from_slice(&of[OWN..][..own]);
        let start = vector(&first[AXIS..]);
        let swing = start.cross(&vector(&above[AXIS..])) * (next / self.frame.body.per_jt);
        let coordinates = Coordinates {
            r: vector(&of[PLACE..]),
            v: vector(&above[PLACE..]) * next,
            k: swing + start * of[SPIN] + axis * first[SPIN],
            gamma: nalgebra::Vector2::new(axis.norm(), 0.0),
            phi: 0.0,
        };
        let layout = E::layout::<N>();
        layout.write(&mut change, ROTOR, &coordinates);
        if layout.has_work() {
            layout.write_work(&mut change, [of[OWN + own], of[OWN + own + 1]]);
        }
        let mut parts = self.parts_of_motion(y, &change);
        if self.has_loads() {
            let axis_rate = vector(&above[AXIS..]) * next;
            let speed = coordinates.k.dot(&start) * (self.frame.body.per_jt + self.frame.body.spin);
            let loaded = Change { r_c: coordinates.r, axis, v_c: coordinates.v, axis_rate, speed };
            let at = self.at(y);
            let tilt = Tilt::of_axis(self.frame.chart, start);
            self.change_loads::<N>(&at, &tilt, &at.k, &loaded, &mut parts);
        }
        let norm = largest_square::<_, N>(self, &parts, weights);
        // φ has no part in the error; but its series has an end of its own, near where its chart is singular.
        let angle = of[ANGLE] * of[ANGLE] * weights[own + groups::PHI];
        if angle > norm { angle } else { norm }
    }
}
