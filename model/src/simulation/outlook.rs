//! What a motion holds in store for a method: how fast it changes, from the linear equations at its start, and what each
//! method would then cost.

use super::drive::LONGEST_TURN;
use super::forces::Forces;
use super::linear::Linear;
use super::start::length;
use crate::effects::Effects;
use crate::integrate::System;
use crate::integrate::composition::Composition;
use crate::integrate::stiff::Differentiable;
use crate::rotor::Rotor;
use crate::variables::Solver;
use libm::pow;
use std::f64::consts::PI;

/// How fast what changes.
#[derive(Clone, Copy, Debug)]
pub(super) struct Outlook {
    /// The largest |λ| of the linear equations [rad/s].
    pub fastest: f64,
    /// The largest |λ| of what has not died out soon [rad/s].
    pub lasting: f64,
    /// The same of what `stiff` must follow where the fastest motion is too small to see, and where it rings [rad/s].
    smooth: f64,
    ringing: f64,
    /// How far the start excites the fastest motion [1].
    excited: f64,
    /// How fast the fastest motion decays, and the slowest of those that are fast [1/s].
    fading: [f64; 2],
    /// Whether what is fast dies out soon.
    pub dies: bool,
    /// The fastest decay, the largest −Re λ [1/s].
    decay: f64,
    /// At which rate its forces make the rotor swing [rad/s].
    swing: f64,
    /// At which rate it moves where it precesses instead, if it spins fast enough for that [rad/s].
    pub precessing: Option<f64>,
    /// At which rate the axis turns about K [rad/s].
    nutation: f64,
    /// At which rate what follows φ changes [rad/s]; 0 where nothing does.
    turning: f64,
    /// Whether drifts are exact, and were measured: those of an uneven body are dearer.
    pub drifts: bool,
    /// How far it nods when its forces set in [rad].
    nods: f64,
    /// How far its axis is off K at the start [rad], and so nods from then on.
    wobble: f64,
    /// How long the run is [rad of what lasts], where that is known.
    pub turns: Option<f64>,
    /// Its length, or a second [s].
    span: f64,
    /// The longest step of an adaptive method that counts the turns of φ [s].
    longest: f64,
    /// The part of the run in which a motion that dies out keeps a method busy [1].
    pub moving: f64,
    /// How often its outputs are read at least [1/s].
    reads: f64,
    works: bool,
    tolerance: f64,
}

/// Steps over many nods err by about what the axis nods, at worst by ten times as much: they are taken where that is at most
/// so many tolerances [1]; measured from 10³ to 10⁵ rad/s.
const NODS: f64 = 3.0;

/// A damper makes it so many times worse [1].
const DAMPED: f64 = 30.0;

/// And a wobble so many times again: the damper pushes with whatever speed the nod has at a kick [1].
const WOBBLING_DAMPED: f64 = 100.0;

/// Kicks that step over the nods of a wobbling axis find it anywhere: r_c errs by up to 50 s times the wobble. They are taken
/// where s times the wobble is at most so many tolerances [1]: measured from 10⁴ to 10⁶ rad/s, up to wobbles of 0.3 rad.
const WOBBLES: f64 = 0.2;

/// Forces also change the rate of the nods, which such steps do not see. Where the axis is off by that anyway, they may err as
/// much, up to so many tolerances [1].
const LOOSER: f64 = 10.0;

/// A conservative run is long beyond so many radians of its fastest motion: then energy counts, which only `symplectic` keeps.
const LONG: f64 = 1e6;

/// A run is read so often, at least. What `symplectic` and `stiff` show between two steps costs them another one.
const READS: f64 = 100.0;

/// No step is taken for longer than this [s].
const LONGEST: f64 = 1.0;

/// Steps of dop853 and of stiff times the rate of what lasts, at a tolerance of 1, and of dop853 where it is held by
/// stability [rad]: measured in the scenes.
const STEP_OF_DOP853: f64 = 13.0;
const STEP_OF_STIFF: f64 = 12.0;
const STABLE: f64 = 6.0;

/// Steps of dop853 times the rate at which a wobbling axis nods, at a tolerance of the wobble [rad]: measured from 3·10³ to
/// 10⁵ rad/s.
const STEP_OF_WOBBLES: f64 = 6.0;

/// The error of dop853 after so many radians of nods is the tolerance [rad].
const ADDED_UP: f64 = 10.0;

/// Errors of compositions of orders 2, 4, 6, 8 over those powers of step times rate of the forces [1]: measured in `paper`.
const ERRORS: [f64; 4] = [3e-3, 2.2e-5, 4.3e-7, 1.3e-8];

/// The longest step of a composition times the rate of the forces, or of what decays, and times that of nods which it
/// follows [rad].
const COMPOSED: f64 = 2.0;
const FOLLOWED: f64 = 3.0;

/// A step of dop853 and one of stiff, and a point between two steps of each [µs], measured; only their ratios count.
const PRICE_OF_DOP853: f64 = 0.6;
const PRICE_OF_STIFF: f64 = 5.0;
const READING_OF_DOP853: f64 = 0.3;
const READING_OF_STIFF: f64 = 3.0;

impl Outlook {
    /// Of a rotor at time `t` [s] and state `y`, which runs for `span` [s], where that is known.
    pub fn new<E: Effects, const N: usize>(
        solver: &Solver,
        rotor: &Rotor<E>,
        t: f64,
        y: &[f64; N],
        span: Option<f64>,
    ) -> Self {
        let linear = Linear::new(&rotor.jacobian(t, y), &rotor.rates(t, y), length(rotor.body.l));
        let motion = rotor.motion(t, y);
        let drifts = motion.body.uneven.is_none() && motion.impulse.is_none();
        let forces = Forces::new(rotor, t, y);
        // Kicks of an uneven body are not spread, so nothing is stepped over.
        let (swing, precessing, nutation) = (forces.swing(), forces.precession().filter(|_| drifts), forces.nutation());
        let (nods, wobble) = (forces.nods(), forces.wobble());
        let turning = if rotor.effects.follows_phi() { motion.omega.norm() } else { 0.0 };
        let tilts = motion.axis_rate().norm();
        let all = linear.lasting().max(tilts);
        let excited = linear.excited();
        // eq. 84: the fastest motion counts aᵖ times beside the slower ones, since it is small
        let among = |part: f64| {
            let passing = |slower: f64| slower.max(tilts).max(part * linear.fastest());
            linear.slower().map_or(all, |slower| all.min(passing(slower))).max(turning)
        };
        let lasting = among(pow(excited.max(nods), 1.0 / 8.0));
        let works = rotor.effects.works();
        Self {
            fastest: linear.fastest().max(lasting),
            lasting,
            smooth: among(0.0),
            ringing: pow(excited, 1.0 / 6.0) * linear.fastest(),
            excited,
            fading: linear.fading(),
            dies: linear.lasting() < linear.fastest(),
            decay: linear.decay(),
            swing,
            precessing,
            nutation,
            turning,
            drifts,
            nods,
            wobble,
            turns: span.map(|span| lasting * span),
            moving: span.map_or(1.0, |span| (linear.waning() / span).min(1.0)),
            span: span.unwrap_or(1.0),
            longest: LONGEST.min(LONGEST_TURN / motion.phi_rate().abs()),
            reads: span.map_or(0.0, |span| READS / span),
            works,
            tolerance: solver.relative_tolerance,
        }
    }

    /// Whether the run is so long that only energy counts.
    pub fn long(&self) -> bool {
        self.drifts && !self.works && self.turns.is_some_and(|turns| turns > LONG)
    }

    /// At which rate forces move the rotor [rad/s].
    pub fn pushes(&self) -> f64 {
        self.precessing.unwrap_or(self.swing)
    }

    /// The step of a composition that keeps about the tolerance [s], and whether it steps over nods of the axis.
    fn composed(&self, composition: &Composition) -> (f64, bool) {
        let order = f64::from(composition.order);
        let coefficient = ERRORS[composition.order as usize / 2 - 1];
        // eq. 45: ωh = (tol/C)^(1/p)
        let way = |tolerance: f64| pow(tolerance / coefficient, 1.0 / order);
        let most = (COMPOSED / self.decay).min(LONGEST);
        if let Some(rate) = self.precessing.filter(|_| self.lets_nods_pass()) {
            let over =
                (way(self.unseen().clamp(self.tolerance, LOOSER * self.tolerance)).min(COMPOSED) / rate).min(most);
            if over * self.nutation > PI {
                return (over, true);
            }
        }
        if self.swing == 0.0 && self.turning == 0.0 {
            return (most, false);
        }
        // eq. 86: νh = (tol/(C s²))^(1/p), kicks that are weak beside the nods err less
        let strength = self.strength().min(1.0);
        let followed = way(self.tolerance / (strength * strength)).min(COMPOSED / strength).min(FOLLOWED);
        ((followed / self.swing.max(self.nutation).max(self.turning)).min(most), false)
    }

    /// The rate of the forces over that of the nods, s [1].
    fn strength(&self) -> f64 {
        self.swing / self.nutation
    }

    /// Whether steps over the nods err no more than steps of dop853, which follow them.
    fn lets_nods_pass(&self) -> bool {
        let nods = if self.works { DAMPED * self.nods.max(WOBBLING_DAMPED * self.wobble) } else { self.nods };
        nods <= NODS * self.tolerance && self.strength() * self.wobble <= WOBBLES * self.tolerance
    }

    /// How far the axis is off in the end where steps over the nods do not see how forces change their rate [rad].
    fn unseen(&self) -> f64 {
        let strength = self.strength();
        // eq. 85: a min(1, s² ν T/2)
        self.wobble * (0.5 * strength * strength * self.nutation * self.span).min(1.0)
    }

    /// The step of a composition that keeps about the tolerance [s].
    pub fn drift(&self, composition: &Composition) -> f64 {
        self.composed(composition).0
    }

    /// What a composition would take [µs a second]; no bound where that was not measured, as with an
    /// uneven body.
    pub fn price_of_drifts(&self, composition: &Composition) -> f64 {
        if !self.drifts {
            return f64::INFINITY;
        }
        let (h, over_nods) = self.composed(composition);
        let stages = composition.parts().count() as f64;
        // A kick that is spread is two, and one where an effect works is a step of a pair: measured.
        let stage = match (self.works, composition.order <= 4) {
            (true, true) => 0.5,
            (true, false) => 1.1,
            (false, _) if over_nods => 0.2,
            (false, _) => 0.08,
        };
        (0.15 + stage * stages) * (1.0 / h + self.reads)
    }

    /// The part of the run that a method of this order spends on a fast motion of this size [1] and decay [1/s], as if it kept its
    /// size.
    fn rings(&self, size: f64, fading: f64, order: f64) -> f64 {
        if size <= self.tolerance {
            return 0.0;
        }
        // eq. 87: ∫ e^(−δt/p) dt, until a e^(−δt) = tol
        (order * (1.0 - pow(self.tolerance / size, 1.0 / order)) / (fading * self.span)).min(1.0)
    }

    /// What dop853 would take [µs a second]; no bound where only energy counts.
    pub fn price_of_dop853(&self) -> f64 {
        if self.long() {
            return f64::INFINITY;
        }
        let stable = (STABLE / self.fastest).min(self.longest);
        let followed = (STEP_OF_DOP853 * pow(self.tolerance, 1.0 / 8.0) / self.lasting).min(stable);
        let mut steps = self.moving / followed + (1.0 - self.moving) / stable;
        if self.precessing.is_some() {
            let rings = self.rings(self.wobble, self.fading[0], 8.0);
            // In νT rad of nods errors add up.
            let tolerance = self.tolerance / (self.nutation * self.span * rings / ADDED_UP).max(1.0);
            let nodding = STEP_OF_WOBBLES * pow(tolerance / self.wobble, 1.0 / 8.0) / self.nutation;
            // No wobble asks for no step.
            steps = rings / followed.min(nodding) + (1.0 - rings) * steps;
        }
        PRICE_OF_DOP853 * steps + READING_OF_DOP853 * self.reads
    }

    /// What stiff would take [µs a second]: next to nothing once all has died out; no bound where only energy counts.
    pub fn price_of_stiff(&self) -> f64 {
        if self.long() {
            return f64::INFINITY;
        }
        let step = |rate: f64| (STEP_OF_STIFF * pow(self.tolerance, 1.0 / 6.0) / rate).min(self.longest);
        let (rings, smooth) = (self.rings(self.excited, self.fading[1], 6.0), step(self.smooth));
        let steps = rings / step(self.ringing).min(smooth) + (1.0 - rings) * self.moving / smooth;
        PRICE_OF_STIFF * steps + READING_OF_STIFF * self.reads
    }
}
