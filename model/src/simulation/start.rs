//! From parameters to the motion at the start and the tolerance of its integration.

use crate::body::Body;
use crate::effects::Effects;
use crate::integrate::Tolerance;
use crate::rotation::{Angle, Chart, Tilt};
use crate::rotor::Rotor;
use crate::state::{Coordinates, PHI, WITH_WORK, Whole};
use crate::variables::{Parameters, Setup};

/// A rotor and where it is.
pub(super) struct Motion<E> {
    /// With the chart of the state and the whole turns of φ.
    pub rotor: Rotor<E>,
    /// φ wrapped, no work done yet.
    pub state: Whole<f64>,
}

impl<E: Effects> Motion<E> {
    /// The motion at the start, at time `t` [s]; the parameters were checked.
    pub(super) fn at_start(parameters: &Parameters<E>, t: f64) -> Self {
        let (shape, start) = (parameters.shape(), &parameters.setup.start);
        let body = shape.inertia();
        let (chart, gamma) = Chart::best(start.gamma);
        let phi = chart.own_angle(Angle { turns: 0.0, remainder: start.phi }.wrapped(), gamma);
        let tilt = Tilt::new(chart, gamma);
        let mut omega = start.omega;
        if let Some([speed, _]) = parameters.effects.imposed::<f64>(t) {
            // eq. 75: ω ← ω + (w − n·ω) t
            omega += tilt.axis * (speed - tilt.axial_rate(&omega));
        }
        let mut coordinates = Coordinates {
            r: start.r_c,
            v: start.v_c,
            k: shape.rotor.angular_momentum(&omega, &tilt.axis),
            gamma,
            phi: phi.remainder,
        };
        if let Some(uneven) = &body.uneven {
            let attitude = tilt.attitude(phi.remainder);
            let to_centre = attitude * uneven.centre;
            // eq. 71: r_G = r_c + L b, v_G = v_c + ω×L b, K_G = L J_G Lᵀ ω
            coordinates.r += to_centre;
            coordinates.v += omega.cross(&to_centre);
            coordinates.k = attitude * (shape.tensor() * attitude.tr_mul(&omega));
        }
        let mut state = [0.0; WITH_WORK];
        coordinates.write(&mut state);
        let mut rotor = Rotor::new(body, parameters.effects.clone(), chart, phi.turns);
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

/// What a place counts with, of a mass centre at `l` [m] from the support point [m].
pub(super) fn length(l: f64) -> f64 {
    if l == 0.0 { 1.0 } else { l.abs() }
}

/// What each number of the state counts with, in its unit (INTERFACE.md); equal for all components of a vector.
pub(super) fn nominals(rotor: &Body) -> Whole<f64> {
    let mut nominal = [1.0; WITH_WORK];
    nominal[0..3].fill(length(rotor.l));
    nominal[6..9].fill(rotor.Ja.max(rotor.Jt));
    nominal
}

/// The tolerance of each component: relative to its size, plus absolute in nominals (INTERFACE.md); of φ where the
/// motion follows it.
pub(super) fn tolerance<const N: usize>(setup: &Setup, follows_phi: bool) -> Tolerance<N> {
    let solver = &setup.solver;
    let in_nominals =
        if solver.absolute_tolerance > 0.0 { solver.absolute_tolerance } else { solver.relative_tolerance };
    let nominal = nominals(&setup.rotor);
    let absolute = std::array::from_fn(|n| in_nominals * nominal[n]);
    let mut tolerance = Tolerance { absolute, relative: [solver.relative_tolerance; N] };
    // Where nothing follows φ it is a quadrature. Else it counts with 1 rad, however many turns it has.
    tolerance.relative[PHI] = 0.0;
    if !follows_phi {
        tolerance.absolute[PHI] = f64::INFINITY;
    }
    tolerance
}
