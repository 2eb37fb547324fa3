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
    /// The motion at the start; the parameters were checked.
    pub(super) fn at_start(parameters: &Parameters<E>) -> Self {
        let (body, start) = (parameters.setup.rotor, &parameters.setup.start);
        let (chart, gamma) = Chart::best(start.gamma);
        let phi = chart.own_angle(Angle { turns: 0.0, remainder: start.phi }.wrapped(), gamma);
        let coordinates = Coordinates {
            r_c: start.r_c,
            v_c: start.v_c,
            k_c: body.angular_momentum(&start.omega, &Tilt::new(chart, gamma).axis),
            gamma,
            phi: phi.remainder,
        };
        let mut state = [0.0; WITH_WORK];
        coordinates.write(&mut state);
        Self { rotor: Rotor { body: body.into(), effects: parameters.effects.clone(), chart, turns: phi.turns }, state }
    }

    /// φ with all its turns in the state, as a host integrates it.
    pub(super) fn unwrap_turns(&mut self) {
        let turns = std::mem::take(&mut self.rotor.turns);
        self.state[PHI] = Angle { turns, remainder: self.state[PHI] }.radians();
    }
}

/// What each number of the state counts with, in its unit (INTERFACE.md); equal for all components of a vector.
pub(super) fn nominals(rotor: &Body) -> Whole<f64> {
    let mut nominal = [1.0; WITH_WORK];
    nominal[0..3].fill(if rotor.l == 0.0 { 1.0 } else { rotor.l.abs() });
    nominal[6..9].fill(rotor.Ja.max(rotor.Jt));
    nominal
}

/// The tolerance of each component: relative to its size, plus absolute in nominals (INTERFACE.md).
pub(super) fn tolerance<const N: usize>(setup: &Setup) -> Tolerance<N> {
    let solver = &setup.solver;
    let in_nominals =
        if solver.absolute_tolerance > 0.0 { solver.absolute_tolerance } else { solver.relative_tolerance };
    let nominal = nominals(&setup.rotor);
    let absolute = std::array::from_fn(|n| in_nominals * nominal[n]);
    let mut tolerance = Tolerance { absolute, relative: [solver.relative_tolerance; N] };
    // φ is a quadrature.
    tolerance.absolute[PHI] = f64::INFINITY;
    tolerance.relative[PHI] = 0.0;
    tolerance
}
