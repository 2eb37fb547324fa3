//! `rub`: contact of a station with a ring around it, with Coulomb friction.

use super::housing::{self, Fixed, Housed, Housing, Moving};
use super::{Act, Change, Effect, Facts, MOST_LOADS, Motion, Pose, Row, Wrench};
use crate::error::Invalid;
use crate::scalar::Scalar;
use crate::variable::units::{METRE, METRE_PER_SECOND, NEWTON, NEWTON_PER_METRE, NEWTON_SECOND_PER_METRE, ONE};
use crate::variable::{Bound, output, parameter};
use nalgebra::{Vector2, Vector3};

/// A ring on the stator line or in a housing, which the shaft touches where it is as far off its centre as the gap.
#[derive(Clone, Debug, Default)]
pub struct Rub<H: Housing = Fixed> {
    /// Where it is, along t from c \[m].
    pub position: f64,
    /// Radial gap between shaft and ring \[m].
    pub gap: f64,
    /// Stiffness of the ring [N/m].
    pub stiffness: f64,
    /// Damping of the ring [N·s/m].
    pub damping: f64,
    /// Coefficient of friction \[1].
    pub friction: f64,
    /// Radius of the shaft there \[m].
    pub radius: f64,
    /// Speed of sliding at which friction has reached tanh 1 of its strength [m/s].
    pub v0: f64,
    /// What it is fixed to.
    pub housing: H,
    /// The branch of the law: whether the ring presses on the shaft, and whether the shaft is within it, 1 or 0; then when
    /// the communication step began \[s].
    memory: [f64; BRANCH + 1],
}

/// So many numbers say which branch the law is in.
const BRANCH: usize = 2;

/// What a contact is made of.
struct Contact<S: Scalar> {
    /// r̂, away from the centre of the ring, and t̂ = e×r̂ \[1].
    outward: Vector3<S>,
    along: Vector3<S>,
    /// How far the shaft is in the ring \[m], and the rate of that [m/s].
    depth: S,
    rate: S,
    /// Normal force \[N].
    normal: S,
    /// Speed of sliding [m/s], and the part of the friction that it has \[1].
    sliding: S,
    part: S,
}

impl Rub {
    /// A ring at `position` along t from c \[m] with a radial gap \[m] to the shaft and a stiffness [N/m], without damping and friction.
    pub fn new(position: f64, gap: f64, stiffness: f64) -> Self {
        Self { position, gap, stiffness, v0: 1.0, ..Self::default() }
    }

    /// The same in a housing that moves.
    pub fn in_housing(self, housing: Moving) -> Rub<Moving> {
        let Self { position, gap, stiffness, damping, friction, radius, v0, housing: _, memory } = self;
        Rub { position, gap, stiffness, damping, friction, radius, v0, housing, memory }
    }
}

impl<H: Housing> Rub<H> {
    /// Below this square of its distance from the stator line, the shaft has no direction \[m²].
    #[inline(always)]
    fn least_square(&self) -> f64 {
        0.25 * self.gap * self.gap
    }

    /// Place \[m] and velocity [m/s] of the station relative to the ring.
    #[inline(always)]
    fn relative<S: Scalar>(&self, motion: &Motion<S>) -> [Vector3<S>; 2] {
        [
            self.housing.relative(motion, motion.station(self.position)),
            self.housing.relative_velocity(motion, motion.station_velocity(self.position)),
        ]
    }

    /// Away from the centre of the ring, depth and its rate, at this place and velocity.
    #[inline(always)]
    fn approach<S: Scalar>(&self, [r, v]: [Vector3<S>; 2]) -> (Vector3<S>, S, S) {
        let (q, rate) = (Vector3::new(S::zero(), r.y, r.z), Vector3::new(S::zero(), v.y, v.z));
        // Near the line nothing touches, and a direction is not needed.
        let least = S::constant(self.least_square());
        let distance = q.dot(&q).max(least).sqrt();
        let outward = q * (S::one() / distance);
        // eq. 97: δ = |q| − g, dδ/dt = r̂·dq/dt
        (outward, distance - S::constant(self.gap), outward.dot(&rate))
    }

    /// k δ + c dδ/dt \[N].
    #[inline(always)]
    fn pressure<S: Scalar>(&self, depth: S, rate: S) -> S {
        depth * S::constant(self.stiffness) + rate * S::constant(self.damping)
    }

    /// How far the shaft is in the ring while that presses \[m], and away from its centre \[1].
    #[inline(always)]
    fn pressed(&self, at: &Pose) -> Option<(f64, Vector2<f64>)> {
        if self.memory[0] == 0.0 {
            return None;
        }
        let q = (at.station(self.position) - self.housing.last_set()[0]).yz();
        let distance = q.norm_squared().max(self.least_square()).sqrt();
        Some((distance - self.gap, q * (1.0 / distance)))
    }

    #[inline(always)]
    fn contact<S: Scalar>(&self, motion: &Motion<S>) -> Contact<S> {
        self.contact_at(motion, self.relative(motion))
    }

    /// The same at this place and velocity relative to the ring.
    #[inline(always)]
    fn contact_at<S: Scalar>(&self, motion: &Motion<S>, [r, v]: [Vector3<S>; 2]) -> Contact<S> {
        let (outward, depth, rate) = self.approach([r, v]);
        let along = Vector3::new(S::zero(), -outward.z, outward.y);
        // eq. 97: N = k δ + c dδ/dt while the ring presses
        let normal = S::zero().where_less(S::constant(self.memory[0]), self.pressure(depth, rate), S::zero());
        // eq. 98: v_t = t̂·dq/dt + R ω_φ
        let sliding = along.dot(&v) + motion.omega_phi() * S::constant(self.radius);
        let part = (sliding * S::constant(1.0 / self.v0)).tanh();
        Contact { outward, along, depth, rate, normal, sliding, part }
    }

    /// Force on the rotor at the station \[N].
    #[inline(always)]
    fn force<S: Scalar>(&self, contact: &Contact<S>) -> Vector3<S> {
        let friction = contact.normal * contact.part * S::constant(self.friction);
        // eq. 98: F = −N r̂ − μ N tanh(v_t/v₀) t̂
        -(contact.outward * contact.normal + contact.along * friction)
    }
}

impl<H: Housing> Housed for Rub<H> {
    type Housing = H;

    fn housing(&self) -> &H {
        &self.housing
    }

    fn housing_mut(&mut self) -> &mut H {
        &mut self.housing
    }

    fn force_on_housing<S: Scalar>(&self, motion: &Motion<S>) -> Vector3<S> {
        let ([r, v], ahead) = (self.relative(motion), self.housing.ahead(motion, self.memory[BRANCH]));
        -self.force(&self.contact_at(motion, [r + v * ahead, v]))
    }
}

impl<H: Housing> Effect for Rub<H> {
    const LAW: &'static str =
        "δ = |q| − gap > 0: N = stiffness δ + damping dδ/dt ≥ 0, and friction N tanh(v_t/v0) against the sliding v_t";

    const ROWS: &'static [Row<Self>] = &[
        parameter!(position, &METRE, None, Bound::Finite, "axial position from the mass centre"),
        parameter!(gap, &METRE, None, Bound::Positive, "radial gap between shaft and ring"),
        parameter!(stiffness, &NEWTON_PER_METRE, Some(0.0), Bound::NotNegative, "stiffness of the ring"),
        parameter!(damping, &NEWTON_SECOND_PER_METRE, Some(0.0), Bound::NotNegative, "damping of the ring"),
        parameter!(friction, &ONE, Some(0.0), Bound::NotNegative, "coefficient of friction"),
        parameter!(radius, &METRE, None, Bound::NotNegative, "radius of the shaft at the ring"),
        parameter!(v0, &METRE_PER_SECOND, None, Bound::Positive, "speed of sliding below which friction fades"),
        output!("F.y", &NEWTON, "force of the ring on the rotor at the station, along y", |r, m| {
            r.force(&r.contact(m)).y
        }),
        output!("F.z", &NEWTON, "force of the ring on the rotor at the station, along z", |r, m| {
            r.force(&r.contact(m)).z
        }),
        output!("contact", &ONE, "1 while the ring presses on the shaft, else 0", |r, m| {
            let (zero, one) = (Scalar::constant(0.0), Scalar::constant(1.0));
            Scalar::where_less(zero, r.contact(m).normal, one, zero)
        }),
    ];

    const HOUSING: &'static [Row<Self>] = housing::rows::<Self>();

    // It touches, or it does not.
    const FACTS: Facts = Facts { indicators: 2, analytic: false, loads: 1, tells_rates: H::CAN_MOVE, ..Facts::USUAL };

    #[inline(always)]
    fn load_changes(&self, at: &Pose, change: &Change) -> [f64; MOST_LOADS] {
        let Some((depth, outward)) = self.pressed(at) else { return [0.0; MOST_LOADS] };
        let [v, way, faster] = [
            at.station_velocity(self.position) - self.housing.last_set()[1],
            change.station(self.position),
            change.station_velocity(self.position),
        ]
        .map(|v| v.yz());
        let along = Vector2::new(-outward.y, outward.x);
        let normal = self.pressure(depth, outward.dot(&v));
        let part = Scalar::tanh((along.dot(&v) + self.radius * at.speed) / self.v0);
        let normal_change = self.pressure(outward.dot(&way), outward.dot(&faster));
        let sliding_change = along.dot(&faster) + self.radius * change.speed;
        // d(μ N tanh(v_t/v₀)) = μ (dN tanh + N (1 − tanh²) dv_t/v₀)
        let friction = self.friction * (normal_change * part + normal * (1.0 - part * part) * sliding_change / self.v0);
        [normal_change * normal_change + friction * friction, 0.0]
    }

    #[inline(always)]
    fn load_sizes(&self, at: &Pose, _excursion: &Change) -> [f64; MOST_LOADS] {
        let Some((depth, outward)) = self.pressed(at) else { return [0.0; MOST_LOADS] };
        let v = at.station_velocity(self.position) - self.housing.last_set()[1];
        let normal = self.pressure(depth, outward.dot(&v.yz()));
        [normal * normal, 0.0]
    }

    #[inline(always)]
    fn act<S: Scalar>(&self, motion: &Motion<S>) -> Act<S> {
        if S::SERIES {
            // Asked for only while the shaft is clear of the ring.
            return Act::none();
        }
        let contact = self.contact(motion);
        let Contact { depth, rate, normal, sliding, part, .. } = contact;
        let friction = normal * part * S::constant(self.friction);
        // eq. 98: M = −μ N R tanh(v_t/v₀) n
        let couple = Wrench::along_joint(motion, friction * S::constant(-self.radius));
        let stiffness = S::constant(self.stiffness);
        let within = depth.positive_part();
        let pressed = S::zero().where_less(S::constant(self.memory[0]), depth, within);
        let act = Act {
            load: Wrench::at_station(motion, self.position, self.force(&contact)) + couple,
            // eq. 99: V = ½ k δ² where δ > 0
            stored: within * within * (stiffness * S::constant(0.5)),
            // eq. 99: P = (N − k δ) dδ/dt + μ N v_t tanh(v_t/v₀)
            loss: (normal - pressed * stiffness) * rate + friction * sliding,
            ..Act::none()
        };
        self.housing.supplying(motion, act, || self.force(&contact))
    }

    fn indicator(&self, n: usize, motion: &Motion<f64>) -> f64 {
        let [r, v] = self.relative(motion);
        let (outward, depth, rate) = self.approach([r, v]);
        // eq. 113: smooth where a shaft goes past the centre of the ring, or its way through the gap could be too short to be seen
        let distance = outward.dot(&r);
        match n {
            0 => depth * (distance + self.gap),
            // Without damping both would change at once.
            _ if self.damping == 0.0 => 1.0,
            // The ring lets go as N = 0; it goes on below that where δ < 0, or its way through 0 could be too short to be seen.
            _ => self.pressure(depth, rate) * distance,
        }
    }

    fn switch(&mut self, positive: &[bool], _motion: &Motion<f64>) {
        let branch = [positive.iter().all(|positive| *positive), positive[0]].map(f64::from);
        self.memory[..BRANCH].copy_from_slice(&branch);
    }

    fn check(&self) -> Result<(), Invalid> {
        // A square that underflows would divide zero by zero where the shaft is on the line.
        if self.least_square().is_normal() {
            return Ok(());
        }
        Err(Invalid::new("gap", self.gap, "neither so small nor so large that its square is lost"))
    }

    fn begin(&mut self, _start: &Motion<f64>) {
        self.memory = [0.0, 0.0, housing::NO_STEP];
    }

    #[inline(always)]
    fn step_from(&mut self, t: f64) {
        self.housing.step_from(t);
        self.memory[BRANCH] = t;
    }

    fn memory(&mut self) -> &mut [f64] {
        &mut self.memory[..if H::CAN_MOVE { BRANCH + 1 } else { BRANCH }]
    }

    fn restored(&mut self) -> bool {
        self.memory[..BRANCH].iter().all(|part| *part == 0.0 || *part == 1.0)
    }

    fn no_limit(&self) -> Option<&'static str> {
        (self.friction != 0.0 && self.radius != 0.0 && self.memory[0] != 0.0)
            .then_some(no_limit!("the friction of rub, which a joint passes on,"))
    }

    fn is_analytic(&self) -> bool {
        // A ring that has let go still gives way where the shaft is within it.
        self.memory[..BRANCH] == [0.0; BRANCH]
    }

    fn works(&self) -> bool {
        self.damping != 0.0 || self.friction != 0.0 || self.housing.moves()
    }
}
