//! From parameters to the motion at the start and the tolerance of its integration.

use super::nominals::Nominals;
use crate::effects::Effects;
use crate::integrate::Tolerance;
use crate::rotation::{Angle, Chart, Tilt};
use crate::rotor::Rotor;
use crate::state::{Coordinates, PHI, WITH_WORK, Whole};
use crate::variables::{Parameters, Setup, Solver};

/// A rotor and where it is.
pub(super) struct Motion<E> {
    /// With the chart of the state and the whole turns of φ.
    pub rotor: Rotor<E>,
    /// φ wrapped, no work done yet.
    pub state: Whole<f64>,
}

impl<E: Effects> Motion<E> {
    /// The motion at the start, at time `t` \[s]; the parameters were checked.
    pub(super) fn at_start(parameters: &Parameters<E>, t: f64) -> Self {
        let (shape, start) = (parameters.shape(), &parameters.setup.start);
        let body = shape.inertia();
        let (chart, gamma) = Chart::best(start.gamma);
        let phi = chart.own_angle(Angle { turns: 0.0, remainder: start.phi }.wrapped(), gamma);
        let tilt = Tilt::new(chart, gamma);
        let omega = start.omega;
        let mut coordinates = Coordinates {
            r: start.r_c,
            v: start.v_c,
            k: shape.rotor.angular_momentum(&omega, &tilt.axis),
            gamma,
            phi: phi.remainder,
        };
        if let Some(asymmetric) = &body.asymmetric {
            let attitude = tilt.attitude(phi.remainder);
            let to_centre = attitude * asymmetric.centre;
            // eq. 71: r_G = r_c + L b, v_G = v_c + ω×L b, K_G = L J_G Lᵀ ω
            coordinates.r += to_centre;
            coordinates.v += omega.cross(&to_centre);
            coordinates.k = attitude * (shape.tensor() * attitude.tr_mul(&omega));
        }
        let mut state = [0.0; WITH_WORK];
        coordinates.write(&mut state);
        let mut rotor = Rotor::new(body, parameters.effects.clone(), chart, phi.turns);
        // An imposed speed strikes along n, as at every jump, and λ counts from there (eq. 75).
        coordinates.k = rotor.motion(t, &state).momentum();
        coordinates.write(&mut state);
        let motion = rotor.motion(t, &state);
        rotor.effects.begin(&motion);
        Self { rotor, state }
    }

    /// φ with all its turns in the state, as a host integrates it.
    pub(super) fn unwrap_turns(&mut self) {
        let turns = std::mem::take(&mut self.rotor.turns);
        self.state[PHI] = Angle { turns, remainder: self.state[PHI] }.radians();
    }
}

/// Errors count beside this part of the nominals \[1] until a method has seen a motion that is larger: what a spring gives way to a
/// weight may be far more than what the rotor then does.
pub(super) const BESIDE: f64 = 1e-4;

/// How small the error of a step must be (INTERFACE.md).
pub(super) fn tolerance<E: Effects>(setup: &Setup, motion: &Motion<E>, t: f64) -> Tolerance {
    let Solver { relative_tolerance: relative, absolute_tolerance, .. } = setup.solver;
    let squares = Nominals::of(motion, t).squares();
    let part = |of: f64| squares.map(|square| of * of * square);
    Tolerance { relative, absolute: part(absolute_tolerance), nominal: part(BESIDE) }
}
