//! From parameters to the motion at the start and the tolerance of its integration.

use super::events::Events;
use super::nominals::Nominals;
use super::rest;
use crate::body::ROTOR;
use crate::effects::Effects;
use crate::error::Invalid;
use crate::integrate::{Cost, Tolerance};
use crate::rotation::Tilt;
use crate::rotor::{Active, Bodies, Frame};
use crate::state::Coordinates;
use crate::variables::{Instant, Parameters, Setup, Solver, Start};

/// Where a rotor is, and how that is written.
pub(crate) struct Motion<const N: usize> {
    /// With the chart of the state and the whole turns of φ.
    pub bodies: Bodies,
    /// φ wrapped, no work done yet.
    pub state: [f64; N],
    /// What the own states count with until they have been larger.
    pub own_nominal: [f64; N],
    /// On which side the effects' indicators are.
    pub events: Events,
}

impl<const N: usize> Motion<N> {
    /// The motion with which a run begins at time `t` \[s]; the parameters were checked.
    ///
    /// # Errors
    /// Where it is to begin at rest, and nothing balances what acts.
    pub(super) fn begins<E: Effects>(parameters: &mut Parameters<E>, t: f64) -> Result<Self, Invalid> {
        if !parameters.setup.start.at_rest {
            return Ok(Self::at_start(parameters, t));
        }
        let rest = rest::start::<E, N>(parameters, t)?;
        Ok(Self::elsewhere(parameters, &rest, t))
    }

    /// The motion at the start as it is given, at time `t` \[s], of which the effects hear; the parameters were checked.
    pub(crate) fn at_start<E: Effects>(parameters: &mut Parameters<E>, t: f64) -> Self {
        let (bodies, mut state) = Self::placed(parameters, t);
        let motion = bodies.under(&parameters.effects).motion(t, &state);
        let mut own_nominal = [0.0; N];
        let own = E::layout::<N>().own();
        parameters.effects.begin(&motion, &mut state[own.clone()], &mut own_nominal[own]);
        let events = Events::begin(&mut parameters.effects, &motion, &state);
        Self { bodies, state, own_nominal, events }
    }

    /// [`Motion::at_start`], but for rotor and effects to go on elsewhere: what effects measure from the start they measure from there.
    pub(super) fn elsewhere<E: Effects>(parameters: &mut Parameters<E>, start: &Start, t: f64) -> Self {
        let heard = Self::at_start(parameters, t);
        parameters.setup.start = start.clone();
        let (bodies, mut state) = Self::placed(parameters, t);
        let own = E::layout::<N>().own();
        state[own.clone()].copy_from_slice(&heard.state[own]);
        let motion = bodies.under(&parameters.effects).motion(t, &state);
        let events = Events::begin(&mut parameters.effects, &motion, &state);
        Self { bodies, state, events, ..heard }
    }

    /// Where the start places the rotor.
    fn placed<E: Effects>(parameters: &Parameters<E>, t: f64) -> (Bodies, [f64; N]) {
        let (shape, start) = (parameters.shape(), &parameters.setup.start);
        let body = shape.inertia();
        let (frame, gamma, phi) = Frame::begin(body, start.gamma, start.phi);
        let tilt = Tilt::new(frame.chart, gamma);
        let omega = start.omega;
        let mut coordinates =
            Coordinates { r: start.r_c, v: start.v_c, k: shape.rotor.angular_momentum(&omega, &tilt.axis), gamma, phi };
        if let Some(asymmetric) = &body.asymmetric {
            let attitude = tilt.attitude(phi);
            let to_centre = attitude * asymmetric.centre;
            // eq. 71: r_G = r_c + L b, v_G = v_c + ω×L b, K_G = L J_G Lᵀ ω
            coordinates.r += to_centre;
            coordinates.v += omega.cross(&to_centre);
            coordinates.k = attitude * (shape.tensor() * attitude.tr_mul(&omega));
        }
        let mut state = [0.0; N];
        E::layout::<N>().write(&mut state, ROTOR, &coordinates);
        let bodies = Bodies { frames: [frame], active: Active::of(&parameters.effects) };
        // An imposed speed strikes along n, as at every jump, and λ counts from there (eq. 75).
        coordinates.k = bodies.under(&parameters.effects).motion(t, &state).momentum();
        E::layout::<N>().write(&mut state, ROTOR, &coordinates);
        (bodies, state)
    }

    /// What it shows at time `t` \[s], under the effects that heard of it.
    pub(super) fn shows<E: Effects>(&self, effects: &E, t: f64) -> Instant<N> {
        let motion = self.bodies.under(effects).motion(t, &self.state);
        let shows = |total| Instant::new(motion, self.state, effects, total, Cost::default());
        shows(shows(0.0).reading.ledger.total())
    }

    /// φ with all its turns in the state, as a host integrates it.
    pub(super) fn unwrap_turns<E: Effects>(&mut self) {
        let ([frame], phi) = (&mut self.bodies.frames, &mut self.state[E::layout::<N>().phi(ROTOR)]);
        *phi = frame.unwrap(*phi);
    }
}

/// Errors count beside this part of the nominals \[1] until a method has seen a motion that is larger: what a spring gives way to a
/// weight may be far more than what the rotor then does.
pub(super) const BESIDE: f64 = 1e-4;

/// How small the error of a step must be in a run that lasts for `span` \[s], infinite where nobody knows.
pub(super) fn tolerance<E: Effects, const N: usize>(
    setup: &Setup,
    effects: &E,
    motion: &Motion<N>,
    t: f64,
    span: f64,
) -> Tolerance {
    let Solver { relative_tolerance: relative, absolute_tolerance, .. } = setup.solver;
    let part =
        |of: f64, span: f64| Nominals::of(effects, motion, t, span).squares::<E>().map(|square| of * of * square);
    Tolerance { relative, absolute: part(absolute_tolerance, f64::INFINITY), nominal: part(BESIDE, span) }
}
