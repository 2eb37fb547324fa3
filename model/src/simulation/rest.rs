//! Where a rotor stands while it spins steadily: what acts on it balances, but for what drives its spin.

use super::start::Motion;
use crate::dual::Dual;
use crate::effects::{Effects, MOST_INDICATORS};
use crate::error::Invalid;
use crate::integrate::System;
use crate::integrate::stiff::Differentiable;
use crate::rotation::Tilt;
use crate::rotor::Rotor;
use crate::state::{Coordinates, GAMMA, own, rigid, rigid_mut};
use crate::variables::{Parameters, Start};
use nalgebra::{Matrix3, Matrix3x2, SMatrix, SVector, Vector2, Vector3};

/// Place (3) and tilt (2), which are sought.
const UNKNOWNS: usize = 5;

/// Rates of v (3) and K (3), which must vanish.
const BALANCES: usize = 6;

/// Newton's method takes so many steps at most, each with a turn of the axis of at most so much \[rad].
const MOST_STEPS: u32 = 60;
const LONGEST: f64 = 0.3;

/// Singular values below this part of the largest are those of directions in which nothing holds the rotor \[1].
const UNHELD: f64 = 1e-12;

/// What is left of the loads where they balance, over what they were \[1].
const BALANCED: f64 = 1e-9;

/// From one side of a contact to another one goes so often at most.
const MOST_SIDES: u32 = 8;

/// What is out of balance goes onto the axis.
const UNBALANCE: (&str, &str) = ("unbalance", "radius");

/// A balanced rotor that spins about an axis at rest.
pub(crate) struct Spinning<'r, E> {
    pub rotor: &'r Rotor<'r, E>,
    /// Moment of inertia about the axis [kg·m²].
    pub about_axis: f64,
    /// ω_φ [rad/s].
    pub speed: f64,
}

/// Where it stands.
pub(crate) struct Rest<const N: usize> {
    /// Place of the mass centre G \[m].
    pub r: Vector3<f64>,
    /// γ \[rad].
    pub gamma: Vector2<f64>,
    /// Whether springs hold it in all directions.
    pub is_held: bool,
    /// The equations there.
    pub balance: Balance<N>,
}

/// The equations at a state of rest but for the spin.
pub(crate) struct Balance<const N: usize> {
    /// Rates of v over the radius of gyration, and of K over Jt but for its part along the axis [1/s²].
    left: SVector<f64, BALANCES>,
    /// Their derivatives by place over that radius and by tilt.
    slopes: SMatrix<f64, BALANCES, UNKNOWNS>,
    /// ∂f/∂y of all numbers of the state.
    pub jacobian: [[f64; N]; N],
    /// The axis t \[1].
    pub axis: Vector3<f64>,
    /// ∂t/∂γ.
    pub turning: Matrix3x2<f64>,
    /// Moment about the axis [N·m].
    pub moment: f64,
}

impl<E: Effects> Spinning<'_, E> {
    /// The state with the mass centre at `r` \[m] and this γ \[rad].
    pub fn state<const N: usize>(&self, r: Vector3<f64>, gamma: Vector2<f64>) -> [f64; N] {
        let mut state = [0.0; N];
        let axis = Tilt::new(self.rotor.frame.chart, gamma).axis;
        let k = axis * (self.about_axis * self.speed);
        Coordinates { r, v: Vector3::zeros(), k, gamma, phi: 0.0 }.write(rigid_mut(&mut state));
        state
    }

    /// Transverse inertia [kg·m²], and the radius of gyration that goes with it \[m].
    fn across(&self) -> (f64, f64) {
        let (across, per_m) = (1.0 / self.rotor.frame.body.per_jt, self.rotor.frame.body.per_m);
        (across, (across * per_m).sqrt())
    }

    fn balance<const N: usize>(&self, r: Vector3<f64>, gamma: Vector2<f64>) -> Balance<N> {
        let (rotor, (inertia, length)) = (self.rotor, self.across());
        let state: [f64; N] = self.state(r, gamma);
        let rates = Coordinates::from_slice(rigid(&rotor.rates_of_all(0.0, &state)));
        let jacobian = rotor.jacobian(0.0, &state);
        let moving = Vector2::new(Dual::<2>::variable(gamma.x, 0), Dual::variable(gamma.y, 1));
        let tilted = Tilt::new(rotor.frame.chart, moving).axis;
        let (axis, turning) = (tilted.map(|t| t.re), Matrix3x2::from_fn(|row, column| tilted[row].eps[column]));
        let moment = rates.k.dot(&axis);
        let across = rates.k - axis * moment;
        let [by_place, by_tilt, by_k] = [0..3, GAMMA, 6..9].map(|of| Block { jacobian: &jacobian, of });
        // K = Ja ω_φ t
        let v_by_tilt = by_tilt.rates_of::<2>(3) + by_k.rates_of::<3>(3) * turning * (self.about_axis * self.speed);
        let k_by_tilt = by_tilt.rates_of::<2>(6) + by_k.rates_of::<3>(6) * turning * (self.about_axis * self.speed);
        let project = Matrix3::identity() - axis * axis.transpose();
        // eq. 115: d(M − (M·t) t)
        let turned = project * k_by_tilt - axis * (rates.k.transpose() * turning) - turning * moment;
        let mut slopes = SMatrix::<f64, BALANCES, UNKNOWNS>::zeros();
        slopes.fixed_view_mut::<3, 3>(0, 0).copy_from(&by_place.rates_of::<3>(3));
        slopes.fixed_view_mut::<3, 2>(0, 3).copy_from(&(v_by_tilt / length));
        slopes.fixed_view_mut::<3, 3>(3, 0).copy_from(&(project * by_place.rates_of::<3>(6) * (length / inertia)));
        slopes.fixed_view_mut::<3, 2>(3, 3).copy_from(&(turned / inertia));
        let (v, k) = (rates.v / length, across / inertia);
        let left = SVector::from([v.x, v.y, v.z, k.x, k.y, k.z]);
        Balance { left, slopes, jacobian, axis, turning, moment }
    }

    /// Where it stands, sought from `r` \[m] and `gamma` \[rad] by Newton's method; None where it does not get there. Where nothing holds it
    /// in some direction, it stays where it is in that.
    pub fn rest<const N: usize>(&self, mut r: Vector3<f64>, mut gamma: Vector2<f64>) -> Option<Rest<N>> {
        let (_, length) = self.across();
        let (mut before, mut at_first) = (f64::INFINITY, None);
        for _ in 0..MOST_STEPS {
            let balance = self.balance::<N>(r, gamma);
            let all = balance.slopes.svd(true, true);
            let largest = all.singular_values[0];
            let first = *at_first.get_or_insert(balance.left.norm());
            let step = all.solve(&balance.left, UNHELD * largest).ok()?;
            let size = step.norm();
            // What rounding leaves shrinks no more.
            if size == 0.0 || (size < 1e-9 && size >= 0.5 * before) || size < 1e-15 {
                let rounded = 1e-13 * largest * (1.0 + r.norm() / length);
                let is_held = all.singular_values[UNKNOWNS - 1] > UNHELD * largest;
                let balances = balance.left.norm() <= BALANCED * first + rounded;
                return balances.then_some(Rest { r, gamma, is_held, balance });
            }
            let share = if size > LONGEST { LONGEST / size } else { 1.0 };
            r -= step.fixed_rows::<3>(0) * (share * length);
            gamma -= step.fixed_rows::<2>(3) * share;
            before = size;
        }
        None
    }
}

/// The derivatives along some coordinates.
struct Block<'a, const N: usize> {
    jacobian: &'a [[f64; N]; N],
    of: std::ops::Range<usize>,
}

impl<const N: usize> Block<'_, N> {
    /// Of three rates from the coordinate `first` on.
    fn rates_of<const D: usize>(&self, first: usize) -> SMatrix<f64, 3, D> {
        SMatrix::from_fn(|row, column| self.jacobian[own(N) + first + row][own(N) + self.of.start + column])
    }
}

/// On which side each indicator of an effect is in this state.
pub(crate) fn sides<E: Effects, const N: usize>(rotor: &Rotor<'_, E>, state: &[f64; N]) -> [bool; MOST_INDICATORS] {
    let mut all = [1.0; MOST_INDICATORS];
    rotor.effects.indicators(&rotor.motion(0.0, state), &state[..own(N)], &mut all);
    all.map(|indicator| indicator > 0.0)
}

/// Puts what is out of balance onto the axis.
pub(crate) fn balance<E: Effects>(effects: &mut E) {
    effects.for_each(|block| {
        let kind = block.kind();
        if kind.name == UNBALANCE.0 {
            let is_radius = |row: &usize| (kind.meta)(*row).is_some_and(|meta| meta.name == UNBALANCE.1);
            block.set_parameter((0..).find(is_radius).expect("it has one"), 0.0);
        }
    });
}

/// Where a machine with `start.at_rest` begins at time `t` \[s]: at the spin of its start, which is along the axis then, where the balanced
/// machine stands, sought from its start.
pub(super) fn start<E: Effects, const N: usize>(parameters: &Parameters<E>, t: f64) -> Result<Start, Invalid> {
    let given = &parameters.setup.start;
    let refused = |reason: String| Invalid { variable: "start.at_rest".into(), reason };
    if given.v_c != Vector3::zeros() || given.omega.yz() != Vector2::zeros() {
        return Err(refused(
            "= true: start.v_c, start.omega.y and start.omega.z must be 0, for only the spin is left".into(),
        ));
    }
    let mut balanced = parameters.clone();
    balance(&mut balanced.effects);
    let speed = balanced.effects.imposed(t).map_or(given.omega.x, |[speed, _]| speed);
    let nothing = || {
        refused(format!(
            "= true: nothing balances what acts on the rotor at {speed} rad/s (a support or bearings must hold it where a load acts)"
        ))
    };
    let mut begun = Motion::<N>::at_start(&mut balanced, t);
    let start = Coordinates::from_slice(rigid(&begun.state));
    let (mut r, mut gamma) = (start.r, start.gamma);
    for _ in 0..MOST_SIDES {
        let rotor = begun.frame.under(&balanced.effects);
        let spinning =
            Spinning { rotor: &rotor, about_axis: 1.0 / (rotor.frame.body.spin + rotor.frame.body.per_jt), speed };
        let rest: Rest<N> = spinning.rest(r, gamma).ok_or_else(nothing)?;
        let (axis, tilt) = (rest.balance.axis, Tilt::new(rotor.frame.chart, rest.gamma));
        let centre = rotor.frame.body.asymmetric.map_or(0.0, |asymmetric| asymmetric.centre.x);
        let stays = sides(&rotor, &spinning.state::<N>(rest.r, rest.gamma)) == sides(&rotor, &begun.state);
        let found = Start { r_c: rest.r - axis * centre, gamma: tilt.gamma(), omega: axis * speed, ..given.clone() };
        if stays {
            return Ok(found);
        }
        // What touches there is asked for again.
        balanced.setup.start = given.clone();
        begun = Motion::elsewhere(&mut balanced, &found, t);
        (r, gamma) = (rest.r, rest.gamma);
    }
    Err(nothing())
}
