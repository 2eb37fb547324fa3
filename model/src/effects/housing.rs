//! The housing of a bearing or a ring: fixed to the stator, or moved by another model.

use super::{Act, Effect, Motion, Row, Terminal};
use crate::scalar::Scalar;
use crate::signal::Signal;
use crate::variable::units::{METRE, METRE_PER_SECOND, NEWTON, ONE};
use crate::variable::{Access, Bound, Meta, Role, output};
use nalgebra::Vector3;

/// What a bearing or a ring is fixed to.
pub trait Housing: Clone + std::fmt::Debug + Default + Send + 'static {
    /// Whether it can move.
    const CAN_MOVE: bool;

    /// It, where it can move.
    fn moving(&self) -> Option<&Moving>;

    /// It, where it can move.
    fn moving_mut(&mut self) -> Option<&mut Moving>;

    /// It, where it moves.
    #[inline(always)]
    fn in_motion(&self) -> Option<&Moving> {
        self.moving().filter(|housing| housing.moves)
    }

    /// Whether it moves.
    #[inline(always)]
    fn moves(&self) -> bool {
        self.in_motion().is_some()
    }

    /// Its place \[m] and velocity [m/s]; None where it stands still.
    #[inline(always)]
    fn motion<S: Scalar>(&self, motion: &Motion<S>) -> Option<[Vector3<S>; 2]> {
        let housing = self.in_motion()?;
        if S::SERIES {
            return Some([housing.r, housing.velocity()].map(|of| of.map(|signal| motion.input(&signal))));
        }
        Some(housing.at(motion.t()))
    }

    /// A place relative to it \[m].
    #[inline(always)]
    fn relative<S: Scalar>(&self, motion: &Motion<S>, place: Vector3<S>) -> Vector3<S> {
        self.motion(motion).map_or(place, |[r, _]| place - r)
    }

    /// A velocity relative to it [m/s].
    #[inline(always)]
    fn relative_velocity<S: Scalar>(&self, motion: &Motion<S>, velocity: Vector3<S>) -> Vector3<S> {
        self.motion(motion).map_or(velocity, |[_, v]| velocity - v)
    }

    /// Its place \[m] and velocity [m/s] where they were last set: within a step, errors count beside these.
    #[inline(always)]
    fn last_set(&self) -> [Vector3<f64>; 2] {
        let Some(housing) = self.in_motion() else { return [Vector3::zeros(); 2] };
        [housing.r, housing.velocity()].map(|of| of.map(|signal| signal.at(signal.since())))
    }

    /// What acts on the rotor, with the power that it supplies; `force` is that at the station \[N].
    #[inline(always)]
    fn supplying<S: Scalar>(&self, motion: &Motion<S>, act: Act<S>, force: impl FnOnce() -> Vector3<S>) -> Act<S> {
        let Some([_, v]) = self.motion(motion) else { return act };
        // eq. 128: P = F·v_h
        Act { supply: act.supply + motion.power(1.0, &force(), &v), ..act }
    }

    /// By how much its load is shown ahead at the end of a communication step that began at `from` \[s].
    fn ahead<S: Scalar>(&self, motion: &Motion<S>, from: f64) -> S {
        let Some(housing) = self.moving().filter(|_| from.is_finite()) else { return S::zero() };
        (motion.t() - S::constant(from)) * S::constant(housing.ahead)
    }

    /// At the start `t` \[s] of a communication step its place goes on by its velocity, unless derivatives of the place are in force. A host
    /// of model exchange has no such steps, and holds the place.
    #[inline(always)]
    fn step_from(&mut self, t: f64) {
        if let Some(housing) = self.moving_mut() {
            housing.r.iter_mut().zip(&housing.v).for_each(|(place, velocity)| place.follow(t, velocity));
        }
    }
}

/// The housing is a part of the stator.
#[derive(Clone, Debug, Default)]
pub struct Fixed;

impl Housing for Fixed {
    const CAN_MOVE: bool = false;

    #[inline(always)]
    fn moving(&self) -> Option<&Moving> {
        None
    }

    fn moving_mut(&mut self) -> Option<&mut Moving> {
        None
    }
}

/// The housing moves as inputs say, and does not turn.
#[derive(Clone, Debug, Default)]
pub struct Moving {
    /// Whether it does.
    pub moves: bool,
    /// How far it is from where it stands in the scene \[m].
    pub r: Vector3<Signal>,
    /// Its velocity, by which the place goes on between communication points; where derivatives of the place are sent alone, they tell it [m/s].
    pub v: Vector3<Signal>,
    /// By what part of the last communication step its load is shown ahead \[1].
    pub ahead: f64,
}

impl Housing for Moving {
    const CAN_MOVE: bool = true;

    #[inline(always)]
    fn moving(&self) -> Option<&Moving> {
        Some(self)
    }

    fn moving_mut(&mut self) -> Option<&mut Moving> {
        Some(self)
    }
}

impl Moving {
    #[inline(always)]
    fn velocity(&self) -> Vector3<Signal> {
        self.r.zip_map(&self.v, |r, v| if r.has_later_derivatives_than(&v) { r.rate() } else { v })
    }

    /// Place and velocity at time `t` \[s]: called, so that a housing that stands still costs little.
    #[inline(never)]
    fn at<S: Scalar>(&self, t: S) -> [Vector3<S>; 2] {
        [self.r, self.velocity()].map(|of| of.map(|signal| signal.at(t)))
    }
}

/// When a communication step began, of who knows of none.
pub const NO_STEP: f64 = f64::INFINITY;

/// An effect in a housing.
pub trait Housed: Effect {
    /// What it is fixed to.
    type Housing: Housing;

    /// See there.
    fn housing(&self) -> &Self::Housing;

    /// See there.
    fn housing_mut(&mut self) -> &mut Self::Housing;

    /// The force on the housing, as it is shown \[N].
    fn force_on_housing<S: Scalar>(&self, motion: &Motion<S>) -> Vector3<S>;
}

/// The variables of the housing of an effect.
pub const fn rows<E: Housed>() -> &'static [Row<E>] {
    if E::Housing::CAN_MOVE { Rows::<E>::ALL } else { &[] }
}

/// Where a model of it is connected. What it shows is the load on the housing, which flows out of the rotor.
pub const TERMINAL: Terminal = Terminal { kind: "split-rotor.Housing", flows: &[] };

/// Only a housing that can move has variables.
const CAN_MOVE: &str = "it can move";

fn moving<E: Housed>(effect: &E) -> &Moving {
    effect.housing().moving().expect(CAN_MOVE)
}

fn moving_mut<E: Housed>(effect: &mut E) -> &mut Moving {
    effect.housing_mut().moving_mut().expect(CAN_MOVE)
}

/// An input: a signal of [`Moving`].
macro_rules! signal {
    ($of:ident.$axis:ident, $unit:expr, $description:literal) => {
        Row {
            meta: Meta::real(
                concat!("housing.", stringify!($of), ".", stringify!($axis)),
                $unit,
                Role::Input { start: 0.0 },
                concat!($description, ", ", stringify!($axis)),
            ),
            access: Access::Input {
                get: |effect| &moving(effect).$of.$axis,
                get_mut: |effect| &mut moving_mut(effect).$of.$axis,
            },
        }
    };
}

struct Rows<E>(std::marker::PhantomData<E>);

impl<E: Housed> Rows<E> {
    const ALL: &'static [Row<E>] = &[
        Row {
            meta: Meta::boolean(
                "housing.moves",
                false,
                "whether the housing moves as its inputs say, as in a scene that names it without this; if not, it stands still",
            ),
            access: Access::Parameter {
                get: |effect| f64::from(moving(effect).moves),
                set: |effect, value| moving_mut(effect).moves = value != 0.0,
            },
        },
        signal!(r.x, &METRE, "displacement of the housing"),
        signal!(r.y, &METRE, "displacement of the housing"),
        signal!(r.z, &METRE, "displacement of the housing"),
        signal!(v.x, &METRE_PER_SECOND, "velocity of the housing, by which its displacement goes on"),
        signal!(v.y, &METRE_PER_SECOND, "velocity of the housing, by which its displacement goes on"),
        signal!(v.z, &METRE_PER_SECOND, "velocity of the housing, by which its displacement goes on"),
        output!("housing.F.x", &NEWTON, "force on the housing, x", |e, m| e.force_on_housing(m).x),
        output!("housing.F.y", &NEWTON, "force on the housing, y", |e, m| e.force_on_housing(m).y),
        output!("housing.F.z", &NEWTON, "force on the housing, z", |e, m| e.force_on_housing(m).z),
        Row {
            meta: Meta::parameter(
                "housing.ahead",
                &ONE,
                Some(0.0),
                Bound::Within(-1.0, 2.0),
                "the force on the housing is shown ahead by this part of the last communication step, for a partner that holds it",
            ),
            access: Access::Parameter {
                get: |effect| moving(effect).ahead,
                set: |effect, value| moving_mut(effect).ahead = value,
            },
        },
    ];
}
