//! Whether the linear motion about where a rotor is grows: what an unstable machine does is right, but its user should know.

use super::rest::settled;
use crate::body::{Asymmetric, Inertia, ROTOR};
use crate::decompositions::eigenvalues;
use crate::effects::Effects;
use crate::integrate::System;
use crate::integrate::stiff::Differentiable;
use crate::log::shown;
use crate::rotation::Chart;
use crate::rotor::{Frame, Rotor};
use crate::state::{BODY, GAMMA, Kinematics};
use crate::stored::stored;
use nalgebra::{Complex, Normed, SMatrix, Vector3};
use std::f64::consts::FRAC_PI_2;
use std::fmt::{self, Display, Formatter};

/// A motion that grows, as it was when that was found.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Growth {
    /// How fast [1/s]: by a factor of e in the inverse of it.
    pub rate: f64,
    /// When \[s].
    pub t: f64,
    /// ω_φ there [rad/s].
    pub speed: f64,
    /// Whether the rotor has ports: their loads count as held, and a partner that answers the motion may change the growth.
    pub at_ports: bool,
}

stored!(Growth { rate, t, speed, at_ports });

impl Display for Growth {
    /// What to warn of.
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let Self { rate, t, speed, at_ports } = self;
        let [t, time] = [*t, 1.0 / rate].map(shown);
        let held = if *at_ports { " with the loads at its ports held" } else { "" };
        write!(
            f,
            "the rotor is unstable{held}: small motions about its state at t = {t:?} s, at {speed:.1} rad/s, grow by a factor of e \
             every {time:?} s"
        )
    }
}

/// A state whose linear equations were not solved: whether small motions about it grow is not known.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Unjudged {
    /// When \[s].
    pub t: f64,
    /// ω_φ there [rad/s].
    pub speed: f64,
}

stored!(Unjudged { t, speed });

impl Display for Unjudged {
    /// What to warn of.
    fn fmt(&self, f: &mut Formatter) -> fmt::Result {
        let Self { t, speed } = self;
        let t = shown(*t);
        write!(
            f,
            "whether the rotor is stable is not known: the search for the eigenvalues of its linear equations at t = {t:?} s, at {speed:.1} \
             rad/s, did not converge; the motion itself does not depend on it, and the next look is \
             where the spin has changed"
        )
    }
}

/// Looks at the linear equations whenever the spin has changed much, or a tilt has died out that made them doubtful.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Watch {
    /// Between these K·e nothing new is expected [kg·m²/s].
    known: [f64; 2],
    /// What grows, since it began to.
    found: Option<Growth>,
    /// What would grow, were the tilt less.
    doubted: Seen,
    /// Where nobody knows what grows, since that is so.
    unjudged: Option<Unjudged>,
}

stored!(Watch { known, found, doubted, unjudged });

/// A motion among those of the linear equations.
#[derive(Clone, Copy, Debug, Default)]
struct Seen {
    /// The fastest of them [rad/s].
    fastest: f64,
    /// |λ| of this one [rad/s].
    size: f64,
    /// How fast it grows [1/s].
    by: f64,
}

stored!(Seen { fastest, size, by });

impl Seen {
    /// Whether it grows by more than the tilt may have made of it: a small whirl changes the rates by its square; a large one leaves true
    /// what grows before the axis has gone far.
    fn exceeds(&self, motion: &Kinematics<f64>) -> bool {
        let Self { fastest, size, by } = *self;
        let (lean, moves) = (motion.tilt.gamma().norm(), motion.gamma_rate().norm());
        by > fastest * lean * lean + moves * moves / size || (by > FAST * size && by > STILL * moves)
    }
}

/// The equations without φ, the work and the own states, which hold on their own: a motor does not make a whirl grow at a
/// steady speed.
pub const LINEAR: usize = BODY;

/// Such equations.
pub type Linear = SMatrix<f64, LINEAR, LINEAR>;

/// Where the velocities begin, and the angular momentum.
const VELOCITY: usize = 3;
const MOMENTUM: usize = 6;

/// K·e has changed much by this part of |K|, and of Ja times the slowest whirl \[1].
const MUCH: f64 = 0.05;

/// A motion grows if it does so by this part of its own rate, and of the fastest one: what is less may be rounding, which
/// parts equal eigenvalues by the root of ε \[1].
const GROWS: f64 = 1e-6;
const ROUNDING: f64 = 1e-7;

/// A tilt that is no small motion [rad].
const FAR: f64 = 0.1;

/// At any tilt the equations hold for what grows by this part of its own rate, and so much faster than the axis moves \[1].
const FAST: f64 = 0.01;
const STILL: f64 = 3.0;

/// An asymmetric body, whose equations turn with it: its inertias across t differ by more than this \[1].
const ASYMMETRIC: f64 = 1e-3;

/// So much of the equations turns at least, over their size \[1]: what nothing holds has equal eigenvalues, which rounding parts.
const TURNS: f64 = 1e-12;

/// Numbers of y and z, which turn with what they belong to.
const TURNING: [[usize; 2]; 4] = [[1, 2], [4, 5], [7, 8], [9, 10]];

/// The linear equations of a balanced rotor.
struct Equations {
    /// What of them is constant, scaled [rad/s].
    matrix: Linear,
    /// The size of what turns with the body or against its supports [rad/s]; 0 for a symmetric body.
    turning: f64,
}

/// The effect that passes on the loads of other models.
pub(super) const PORT: &str = "port";

/// The linear equations of a rotor about this state at time `t` \[s].
pub(super) fn linear<E: Effects, const N: usize>(rotor: &Rotor<'_, E>, t: f64, y: &[f64; N]) -> Linear {
    let (jacobian, first) = (rotor.jacobian(t, y), E::layout::<N>().body(ROTOR).start);
    Linear::from_fn(|i, j| jacobian[first + i][first + j])
}

impl Watch {
    /// What grows, as it was when it was seen first; None where nothing does any more.
    pub fn found(&self) -> Option<Growth> {
        self.found
    }

    /// Where it could not be found whether anything grows; None where that is known again.
    pub fn unjudged(&self) -> Option<Unjudged> {
        self.unjudged
    }

    /// Looks at the rotor at time `t` \[s] and state `y`, if that is due.
    pub fn look<E: Effects, const N: usize>(&mut self, rotor: &Rotor<'_, E>, t: f64, y: &[f64; N]) {
        // The state lacks what an imposed speed passed on.
        let momentum = if E::FACTS.imposes { rotor.motion(t, y).momentum() } else { rotor.at(y).k };
        let [low, high] = self.known;
        let is_settled = || self.doubted.by > 0.0 && self.doubted.exceeds(&rotor.motion(t, y));
        // What the axis does across e is no spin.
        if (low..high).contains(&momentum.x) && !is_settled() {
            return;
        }
        let Inertia { per_jt, spin, .. } = rotor.frame.body;
        let Some(Equations { matrix, turning }) = Self::equations(rotor, t, y) else {
            let much = MUCH * momentum.norm();
            self.known = [momentum.x - much, momentum.x + much];
            return;
        };
        let rates = eigenvalues(&matrix);
        let fastest = rates.map_or(matrix.norm(), |rates| rates.iter().map(|rate| rate.norm()).fold(0.0, f64::max));
        let whirls = rates.iter().flatten().map(|rate| rate.im.abs()).filter(|size| *size > ROUNDING * fastest);
        let slowest = whirls.fold(fastest, f64::min);
        let much = MUCH * (momentum.norm() + slowest / (per_jt + spin));
        self.known = [momentum.x - much, momentum.x + much];
        let motion = rotor.motion(t, y);
        let Some(rates) = rates else {
            // Where forces overflow the motion itself cannot go on, and says so.
            if matrix.iter().all(|entry| entry.is_finite()) {
                let unjudged = Unjudged { t, speed: motion.axial_rate() };
                self.unjudged.get_or_insert(unjudged);
            }
            return;
        };
        self.unjudged = None;
        // M·t, by which a spin that nothing imposes changes.
        let moment = rotor.at(&System::rates::<true, false>(rotor, t, y)).k;
        let torque = if motion.impulse.is_some() { 0.0 } else { moment.dot(motion.axis()).abs() };
        // What turns is left out: it may part two motions that are nearly one by its root.
        let least = (turning * fastest).sqrt().max(ROUNDING * fastest);
        let grows = |seen: &Seen| seen.by > GROWS * seen.size && seen.by > least;
        let seen = |rate: &Complex<f64>| Seen { fastest, size: rate.norm(), by: rate.re };
        let growing = || rates.iter().map(seen).filter(grows);
        let largest = |a: Seen, b: Seen| if b.by > a.by { b } else { a };
        self.doubted = growing().filter(|seen| !seen.exceeds(&motion)).fold(Seen::default(), largest);
        // With the spin held fixed, half of a torque that follows the axis would seem to drive a whirl: by half of this at most. While a
        // motion grows, it may well come to move fast.
        let holds = |seen: &Seen| seen.exceeds(&motion) && seen.by > torque * per_jt / seen.size;
        let rate = growing().filter(|seen| holds(seen) || self.found.is_some()).fold(Seen::default(), largest).by;
        let at_ports = rotor.effects.active().any(|block| block.kind().name == PORT);
        let found = || Growth { rate, t, speed: motion.axial_rate(), at_ports };
        // What has grown until the axis leans far is one growth, whatever is seen of it there.
        let still = self.found.filter(|_| rate > 0.0 || motion.tilt.gamma().norm() > FAR);
        self.found = still.or_else(|| (rate > 0.0).then(found));
    }

    /// The linear equations with velocities that count as much as places do: lengths in radii of gyration, and both beside the largest
    /// rate of what acts. In units of m and s rounding would count beside these, and what hardly moves would seem to grow. Zeros where
    /// nothing acts: rates that are constant grow by no power of e.
    ///
    /// Several are scaled as the first is.
    pub(super) fn scaled<const M: usize>(matrices: [Linear; M], body: &Inertia) -> [Linear; M] {
        let matrix = matrices[0];
        let is_rate = |n: usize| (VELOCITY..GAMMA.start).contains(&n);
        let radius = body.radius();
        let unit = |n: usize| match n {
            0..MOMENTUM => radius,
            n if is_rate(n) => 1.0 / body.per_jt,
            _ => 1.0,
        };
        let in_units = |matrix: Linear| Linear::from_fn(|i, j| matrix[(i, j)] * (unit(j) / unit(i)));
        let plain = in_units(matrix);
        let largest = |of: fn(bool, bool) -> bool| {
            let entry = |i, j| if of(is_rate(i), is_rate(j)) { plain[(i, j)].abs() } else { 0.0 };
            Linear::from_fn(entry).max()
        };
        // Springs tell the square of a rate, dampers and what turns the rate itself.
        let rate = largest(|of, by| of && !by).sqrt().max(largest(|of, by| of == by));
        let part = |n: usize| if is_rate(n) { rate } else { 1.0 };
        matrices.map(|matrix| {
            let plain = in_units(matrix);
            if rate == 0.0 { Linear::zeros() } else { Linear::from_fn(|i, j| plain[(i, j)] * (part(j) / part(i))) }
        })
    }

    /// The scaled linear equations; None where nothing is known of an asymmetric body.
    ///
    /// Those of an asymmetric body turn with it as the stator sees them, and with its supports as the body does: which of the two turns less
    /// counts. What turns does so twice a revolution, so that the mean of φ = 0 and a quarter turn is without it.
    fn equations<E: Effects, const N: usize>(rotor: &Rotor<'_, E>, t: f64, y: &[f64; N]) -> Option<Equations> {
        // The balanced rotor: what an unbalance adds turns with it.
        let Frame { body, chart, turns } = rotor.frame;
        let balanced = Rotor::new(body.symmetric(), rotor.effects, chart, turns);
        let state = settled(&balanced, t, y);
        let uneven = |of: &Asymmetric| E::FACTS.shapes && of.excess.abs() > ASYMMETRIC * body.per_jt;
        let Some(uneven) = body.asymmetric.filter(uneven) else {
            let [matrix] = Self::scaled([linear(&balanced, t, &state)], &body);
            return Some(Equations { matrix, turning: 0.0 });
        };
        // In the chart from −e the axis is that which the body turns about the other way round.
        let across = uneven.axes[1].yz().try_normalize(f64::EPSILON).filter(|_| chart == Chart::FromE)?;
        let axes = [Vector3::x(), Vector3::new(0.0, across.x, across.y)];
        let balanced = Inertia { asymmetric: Some(Asymmetric { centre: Vector3::zeros(), axes, ..uneven }), ..body };
        let balanced = Rotor::new(balanced, rotor.effects, chart, turns);
        let at = |phi: f64| {
            let mut state = state;
            state[E::layout::<N>().phi(ROTOR)] = phi;
            linear(&balanced, t, &state)
        };
        let [start, quarter] = [0.0, FRAC_PI_2].map(at);
        let (mut turn, mut rate) = (Linear::identity(), Linear::zeros());
        for [y, z] in TURNING {
            (turn[(y, y)], turn[(z, z)]) = (0.0, 0.0);
            (turn[(y, z)], turn[(z, y)]) = (-1.0, 1.0);
            (rate[(y, z)], rate[(z, y)]) = (-1.0, 1.0);
        }
        // What the stator sees as y = R(φ) x: dx/dt = (Rᵀ A R − Rᵀ dR/dt) x
        let rate = rate * rotor.motion(t, y).axial_rate();
        let seen = [[start, quarter], [start - rate, turn.tr_mul(&quarter) * turn - rate]].map(|[start, quarter]| {
            let [matrix, turning] = Self::scaled([(start + quarter) * 0.5, (start - quarter) * 0.5], &body);
            Equations { matrix, turning: turning.norm() + TURNS * matrix.norm() }
        });
        seen.into_iter().min_by(|a, b| a.turning.total_cmp(&b.turning))
    }
}
