//! Loads that are outputs, as groups of their own: the error of each counts beside how far it goes.

use super::{Rotor, is_apart};
use crate::effects::{Change, Effects, Pose};
use crate::integrate::sizes::{MOST_GROUPS, Squares};
use crate::rotation::{Chart, Tilt};
use crate::rotor::groups::RIGID;
use crate::state::Coordinates;
use nalgebra::{Vector2, Vector3};

impl<E: Effects> Rotor<'_, E> {
    /// Where the loads stand among the groups.
    const fn load_groups() -> std::ops::Range<usize> {
        let first = E::FACTS.own + RIGID;
        assert!(first + E::FACTS.loads <= MOST_GROUPS, "a system has at most MOST_GROUPS groups");
        first..first + E::FACTS.loads
    }

    /// Whether errors of loads count.
    #[inline(always)]
    pub(super) fn has_loads(&self) -> bool {
        E::FACTS.loads > 0 && (!E::FACTS.switched || self.active.has_loads)
    }

    /// Writes how large each load is beside what it was at `origin`, of a motion whose c went by `way` \[m] and moves at `velocity` [m/s].
    #[inline(always)]
    pub(super) fn size_loads<const N: usize>(
        &self,
        [at, rate, origin]: [&Coordinates<f64>; 3],
        [way, velocity]: [Vector3<f64>; 2],
        squares: &mut Squares,
    ) {
        if !self.has_loads() {
            return;
        }
        let chart = self.frame.chart;
        let tilt = Tilt::new(chart, at.gamma);
        let (r_c, axis) = match chart {
            // Most motions begin upright.
            Chart::FromE if origin.gamma == Vector2::zeros() => (way, tilt.axis - Vector3::x()),
            Chart::FromE => (way, tilt.axis - Tilt::new(chart, origin.gamma).axis),
            // Where it has turned over, the axis of the start is not known any more: loads count by themselves.
            Chart::FromMinusE => (at.r, tilt.axis),
        };
        let axis_rate = tilt.axis_change(&rate.gamma);
        let excursion = Change { r_c, axis, v_c: velocity, axis_rate, speed: rate.phi };
        let pose = self.pose(at, tilt, axis_rate, rate.phi);
        self.load_squares::<N, true>(&pose, &excursion, squares);
    }

    /// Writes by how much each load changes with a small change `by` of the coordinates.
    #[inline(always)]
    pub(crate) fn part_loads<const N: usize>(
        &self,
        t: f64,
        y: &[f64; N],
        by: &Coordinates<f64>,
        squares: &mut Squares,
    ) {
        if !self.has_loads() {
            return;
        }
        let at = self.at(y);
        let tilt = Tilt::new(self.frame.chart, at.gamma);
        let (axis, momentum, body) = (tilt.axis_change(&by.gamma), self.momentum(t, y), &self.frame.body);
        // eq. 121: d(dt/dt) = (dK×t + K×dt)/Jt
        let axis_rate = (by.k.cross(&tilt.axis) + momentum.cross(&axis)) * body.per_jt;
        let speed = (by.k.dot(&tilt.axis) + momentum.dot(&axis)) * (body.per_jt + body.spin);
        let change = Change { r_c: by.r, axis, v_c: by.v, axis_rate, speed };
        self.change_loads::<N>(&at, &tilt, &momentum, &change, squares);
    }

    /// The same of a change of the motion at these coordinates, with this tilt and angular momentum [kg·m²/s].
    #[inline(always)]
    pub(super) fn change_loads<const N: usize>(
        &self,
        at: &Coordinates<f64>,
        tilt: &Tilt<f64>,
        momentum: &Vector3<f64>,
        change: &Change,
        squares: &mut Squares,
    ) {
        let body = &self.frame.body;
        // ω_φ without the precession of the axis, which is slow beside the spin.
        let speed = momentum.dot(&tilt.axis) * (body.per_jt + body.spin);
        let pose = self.pose(at, *tilt, momentum.cross(&tilt.axis) * body.per_jt, speed);
        self.load_squares::<N, false>(&pose, change, squares);
    }

    /// Writes what loads change by where place and tilt change as numbers that are rounded, which have these sizes: r_c \[m], v_c [m/s],
    /// γ \[rad], dt/dt [1/s].
    #[inline(always)]
    pub(crate) fn round_loads<const N: usize>(
        &self,
        at: &Coordinates<f64>,
        [place, velocity, tilt, tilt_rate]: [f64; 4],
        squares: &mut Squares,
    ) {
        if !self.has_loads() {
            return;
        }
        // Along e a small tilt is of second order.
        let change = Change {
            r_c: Vector3::repeat(place),
            axis: Vector3::new(tilt * tilt, tilt, tilt),
            v_c: Vector3::repeat(velocity),
            axis_rate: Vector3::repeat(tilt_rate),
            speed: tilt_rate,
        };
        let pose = self.pose(at, Tilt::new(self.frame.chart, at.gamma), Vector3::zeros(), 0.0);
        self.load_squares::<N, false>(&pose, &change, squares);
    }

    /// Writes how large each load is, or by how much it changes.
    #[inline(always)]
    fn load_squares<const N: usize, const SIZES: bool>(&self, pose: &Pose, change: &Change, squares: &mut Squares) {
        if const { is_apart::<E>() } {
            self.load_squares_called::<N, SIZES>(pose, change, squares);
        } else {
            self.effects.loads::<SIZES>(pose, change, &mut squares[Self::load_groups()]);
        }
    }

    /// The same, called.
    #[inline(never)]
    fn load_squares_called<const N: usize, const SIZES: bool>(
        &self,
        pose: &Pose,
        change: &Change,
        squares: &mut Squares,
    ) {
        self.effects.loads::<SIZES>(pose, change, &mut squares[Self::load_groups()]);
    }

    /// How the rotor lies at these coordinates, where its axis has this tilt and rate [1/s] and φ this rate [rad/s].
    #[inline(always)]
    fn pose(&self, at: &Coordinates<f64>, tilt: Tilt<f64>, axis_rate: Vector3<f64>, speed: f64) -> Pose {
        let to_centre = self.inertia().asymmetric.map(|asymmetric| asymmetric.centre);
        let (l, phi) = (self.frame.body.l, at.phi);
        Pose { centre: at.r, to_centre, tilt, phi, velocity: at.v, axis_rate, l, speed }
    }

    /// Angular momentum about G [kg·m²/s].
    #[inline(always)]
    fn momentum<const N: usize>(&self, t: f64, y: &[f64; N]) -> Vector3<f64> {
        if E::FACTS.imposes && self.effects.imposed(t).is_some() {
            return self.motion(t, y).momentum();
        }
        self.at(y).k
    }
}
