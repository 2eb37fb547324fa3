//! From parameters to the motion at the start and the tolerance of its integration.

use crate::effects::Effects;
use crate::integrate::Tolerance;
use crate::rotation::{Angle, Chart, Tilt};
use crate::rotor::Rotor;
use crate::state::{Coordinates, PHI};
use crate::variables::{Parameters, Setup};

/// A rotor and where it is.
pub(super) struct Motion<E> {
    pub rotor: Rotor<E>,
    /// In the rotor's chart, φ wrapped.
    pub coordinates: Coordinates<f64>,
    /// Whole turns of φ.
    pub turns: f64,
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
        Self { rotor: Rotor { body, effects: parameters.effects.clone(), chart }, coordinates, turns: phi.turns }
    }
}

/// The tolerance of each component: relative to its size, plus absolute in nominals (INTERFACE.md).
pub(super) fn tolerance<const N: usize>(setup: &Setup) -> Tolerance<N> {
    let (rotor, solver) = (&setup.rotor, &setup.solver);
    let in_nominals =
        if solver.absolute_tolerance > 0.0 { solver.absolute_tolerance } else { solver.relative_tolerance };
    let mut nominal = [1.0; N];
    nominal[0..3].fill(if rotor.l == 0.0 { 1.0 } else { rotor.l.abs() });
    nominal[6..9].fill(rotor.Ja.max(rotor.Jt));
    let mut tolerance =
        Tolerance { absolute: nominal.map(|nominal| in_nominals * nominal), relative: [solver.relative_tolerance; N] };
    // φ counts with 1 rad, not with its size, which the whole turns would make arbitrary.
    tolerance.absolute[PHI] += solver.relative_tolerance;
    tolerance.relative[PHI] = 0.0;
    tolerance
}
