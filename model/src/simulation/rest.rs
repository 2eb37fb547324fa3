//! Where a rotor stands while it spins steadily: what acts on it balances, but for what drives its spin.

use super::growth::Watch;
use super::start::Motion;
use crate::body::ROTOR;
use crate::decompositions::{eigenvalues, singular_values};
use crate::dual::Dual;
use crate::effects::{Effects, MOST_INDICATORS};
use crate::error::Invalid;
use crate::integrate::System;
use crate::integrate::stiff::Differentiable;
use crate::rotation::Tilt;
use crate::rotor::Rotor;
use crate::state::{Coordinates, GAMMA};
use crate::variables::{Parameters, Start};
use nalgebra::{Matrix2, Matrix3, Matrix3x2, SMatrix, SVector, Vector2, Vector3};

/// Place (3) and tilt (2), which are sought.
pub(super) const UNKNOWNS: usize = 5;

/// Rates of v (3) and K (3), which must vanish.
const BALANCES: usize = 6;

/// Newton's method takes so many steps at most, each with a turn of the axis of at most so much \[rad].
const MOST_STEPS: u32 = 60;
const LONGEST: f64 = 0.3;

/// Singular values below this part of the largest are those of directions in which nothing holds the rotor \[1].
const UNHELD: f64 = 1e-12;

/// Springs hold nothing whose period is beyond all times: the square of a rate [1/s²].
const NOTHING: f64 = 1e-100;

/// What rounding leaves of loads, over how they change with a place of one radius of gyration, or a tilt of one radian \[1].
const ROUNDED: f64 = 1e-13;

/// What is left of the loads where they balance, over what they were \[1].
const BALANCED: f64 = 1e-9;

/// Without inertia a rotor comes to rest in so many steps at most, each of at most so much \[1, rad]; they grow by this factor.
const MOST_CREEPING: u32 = 1000;
const FARTHEST: f64 = 0.05;
const GROWS: f64 = 4.0;

/// Where it creeps by less than this it is handed to Newton's method, which moves it by no more than that much \[1, rad].
const NEAR: f64 = 1e-7;
const BEYOND: f64 = 1e-3;

/// Forces balance after so many steps at most, where the last is no longer than this part of the radius of gyration \[1].
const MOST_SETTLING: u32 = 20;
const SETTLED: f64 = 1e-9;

/// A direction is held where the square of its stiffness is more than this part of that of all \[1].
const HARDLY_HELD: f64 = 1e-14;
/// From a place that is not stable it is moved by this along what leaves there \[1, rad]; it then creeps in steps of at most this part of the
/// time in which that grows by e: the implicit rule would lead longer ones back.
const BESIDE: f64 = 1e-2;
const LEAVES: f64 = 0.5;

/// What leaves does so by more than this part of the largest rate \[1].
const UNSTABLE: f64 = 1e-9;

/// The chart of γ is asked for again beyond this \[rad].
const FAR: f64 = 2.0;

/// A contact on the way is found by so many bisections.
const BISECTIONS: u32 = 40;

/// What is out of balance goes onto the axis.
const UNBALANCE: (&str, &str) = ("unbalance", "radius");

/// A balanced rotor that spins about an axis at rest.
pub(crate) struct Spinning<'r, E, const N: usize> {
    pub rotor: &'r Rotor<'r, E>,
    /// A state with the own states of its effects.
    pub own: [f64; N],
    /// Moment of inertia about the axis [kg·m²].
    pub about_axis: f64,
    /// ω_φ [rad/s].
    pub speed: f64,
    /// When \[s]: inputs may change with time.
    pub t: f64,
}

/// Where it stands.
#[cfg_attr(not(feature = "general"), allow(dead_code, reason = "what only the linear view asks for"))]
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
#[cfg_attr(not(feature = "general"), allow(dead_code, reason = "what only the linear view asks for"))]
pub(crate) struct Balance<const N: usize> {
    /// Rates of v over the radius of gyration, and of K over Jt but for its part along the axis [1/s²].
    pub(super) left: SVector<f64, BALANCES>,
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

impl<E: Effects, const N: usize> Spinning<'_, E, N> {
    /// The state with the mass centre at `r` \[m] and this γ \[rad].
    pub fn state(&self, r: Vector3<f64>, gamma: Vector2<f64>) -> [f64; N] {
        let mut state = self.own;
        let axis = Tilt::new(self.rotor.frame.chart, gamma).axis;
        let k = axis * (self.about_axis * self.speed);
        let at = Coordinates { r, v: Vector3::zeros(), k, gamma, phi: 0.0 };
        E::layout::<N>().write(&mut state, ROTOR, &at);
        state
    }

    /// Transverse inertia [kg·m²], and the radius of gyration that goes with it \[m].
    pub(super) fn across(&self) -> (f64, f64) {
        let (across, per_m) = (1.0 / self.rotor.frame.body.per_jt, self.rotor.frame.body.per_m);
        (across, (across * per_m).sqrt())
    }

    pub(super) fn balance(&self, r: Vector3<f64>, gamma: Vector2<f64>) -> Balance<N> {
        let (rotor, (inertia, length)) = (self.rotor, self.across());
        let state = self.state(r, gamma);
        let mut rates = rotor.at(&rotor.rates_of_all(self.t, &state));
        let jacobian = rotor.jacobian(self.t, &state);
        let moving = Vector2::new(Dual::<2>::variable(gamma.x, 0), Dual::variable(gamma.y, 1));
        let tilted = Tilt::new(rotor.frame.chart, moving).axis;
        let (axis, turning) = (tilted.map(|t| t.re), Matrix3x2::from_fn(|row, column| tilted[row].eps[column]));
        if let Some([_, rate]) = rotor.effects.imposed(self.t) {
            // eq. 75: what imposes the speed turns the rotor about n = (e + t)/(1 + e·t), n·t = 1
            let n = (Vector3::x() + axis) / (1.0 + axis.x);
            rates.k += n * (self.about_axis * rate - rates.k.dot(&axis));
        }
        let moment = rates.k.dot(&axis);
        let across = rates.k - axis * moment;
        let [by_place, by_tilt, by_k] = [0..3, GAMMA, 6..9].map(|of| Block { jacobian: &jacobian, of });
        // K = Ja ω_φ t
        let v_by_tilt =
            by_tilt.rates_of::<E, 2>(3) + by_k.rates_of::<E, 3>(3) * turning * (self.about_axis * self.speed);
        let k_by_tilt =
            by_tilt.rates_of::<E, 2>(6) + by_k.rates_of::<E, 3>(6) * turning * (self.about_axis * self.speed);
        let project = Matrix3::identity() - axis * axis.transpose();
        // eq. 115: d(M − (M·t) t)
        let turned = project * k_by_tilt - axis * (rates.k.transpose() * turning) - turning * moment;
        let mut slopes = SMatrix::<f64, BALANCES, UNKNOWNS>::zeros();
        slopes.fixed_view_mut::<3, 3>(0, 0).copy_from(&by_place.rates_of::<E, 3>(3));
        slopes.fixed_view_mut::<3, 2>(0, 3).copy_from(&(v_by_tilt / length));
        slopes.fixed_view_mut::<3, 3>(3, 0).copy_from(&(project * by_place.rates_of::<E, 3>(6) * (length / inertia)));
        slopes.fixed_view_mut::<3, 2>(3, 3).copy_from(&(turned / inertia));
        let (v, k) = (rates.v / length, across / inertia);
        let left = SVector::from([v.x, v.y, v.z, k.x, k.y, k.z]);
        Balance { left, slopes, jacobian, axis, turning, moment }
    }

    /// The largest of the loads that do not balance: which of three forces [N] and three moments [N·m], and its size.
    fn largest_load(&self, balance: &Balance<N>) -> (usize, f64) {
        let (inertia, length) = self.across();
        let largest = balance.left.iamax();
        let size = if largest < 3 { length / self.rotor.frame.body.per_m } else { inertia };
        (largest, balance.left[largest] * size)
    }

    /// Where it stands, sought from `r` \[m] and `gamma` \[rad] by Newton's method; None where it does not get there. Where nothing holds it
    /// in some direction, it stays where it is in that.
    pub fn rest(&self, mut r: Vector3<f64>, mut gamma: Vector2<f64>) -> Option<Rest<N>> {
        let (_, length) = self.across();
        let (mut before, mut at_first) = (f64::INFINITY, None);
        for _ in 0..MOST_STEPS {
            let balance = self.balance(r, gamma);
            let all = singular_values(&balance.slopes)?;
            let largest = all.singular_values[0];
            let first = *at_first.get_or_insert(balance.left.norm());
            let step = all.solve(&balance.left, UNHELD * largest).ok()?;
            let size = step.norm();
            // What rounding leaves shrinks no more.
            if size == 0.0 || (size < 1e-9 && size >= 0.5 * before) || size < 1e-15 {
                let is_held = all.singular_values[UNKNOWNS - 1] > UNHELD * largest;
                let balances = balance.left.norm() <= BALANCED * first + rounding(largest, r, length);
                return balances.then_some(Rest { r, gamma, is_held, balance });
            }
            let share = if size > LONGEST { LONGEST / size } else { 1.0 };
            r -= step.fixed_rows::<3>(0) * (share * length);
            gamma -= step.fixed_rows::<2>(3) * share;
            before = size;
        }
        None
    }

    /// How it goes on from there in a step over `span` \[s²] without inertia, by the implicit rule of Euler: loads move it, until they
    /// balance where it is stable.
    fn creep(&self, balance: &Balance<N>, span: f64) -> Option<SVector<f64, UNKNOWNS>> {
        let mut matrix = -balance.slopes;
        for n in 0..3 {
            matrix[(n, n)] += 1.0 / span;
        }
        // A change of t turns by t × δt.
        for column in 0..2 {
            let turned = balance.axis.cross(&balance.turning.column(column).into_owned()) / span;
            let mut rows = matrix.fixed_view_mut::<3, 1>(3, 3 + column);
            rows += turned;
        }
        let all = singular_values(&matrix)?;
        let step = all.solve(&balance.left, UNHELD * all.singular_values[0]).ok()?;
        step.iter().all(|part| part.is_finite()).then_some(step)
    }

    /// What leaves a place fastest without inertia: by which rate [1/s²], and where to, of length 1; None where it is stable, or where that is not
    /// known.
    fn leaving(&self, balance: &Balance<N>) -> Option<(f64, SVector<f64, UNKNOWNS>)> {
        // A tilt's rate is the part of the moment along its turn of the axis.
        let turned = [0, 1].map(|column| balance.axis.cross(&balance.turning.column(column).into_owned()));
        let mut rates = SMatrix::<f64, UNKNOWNS, UNKNOWNS>::zeros();
        rates.fixed_rows_mut::<3>(0).copy_from(&balance.slopes.fixed_rows::<3>(0));
        let [a, b] = turned;
        let inner = Matrix2::new(a.dot(&a), a.dot(&b), b.dot(&a), b.dot(&b)).try_inverse()?;
        let moments = balance.slopes.fixed_rows::<3>(3).into_owned();
        let parts = Matrix3x2::from_columns(&turned).transpose() * moments;
        rates.fixed_rows_mut::<2>(3).copy_from(&(inner * parts));
        let rate = eigenvalues(&rates)?.iter().map(|value| value.re).fold(f64::NEG_INFINITY, f64::max);
        if rate <= UNSTABLE * rates.amax() {
            return None;
        }
        let rows = singular_values(&(rates - SMatrix::identity() * rate))?.v_t?;
        Some((rate, rows.row(UNKNOWNS - 1).transpose()))
    }

    /// Where a step ends, or all but where a contact on the way begins or ends, and whether one does.
    fn moved(
        &self,
        r: Vector3<f64>,
        gamma: Vector2<f64>,
        step: &SVector<f64, UNKNOWNS>,
    ) -> (Vector3<f64>, Vector2<f64>, bool) {
        let (_, length) = self.across();
        let at = |share: f64| (r + step.fixed_rows::<3>(0) * (share * length), gamma + step.fixed_rows::<2>(3) * share);
        let side = |share: f64| sides(self.rotor, &self.state(at(share).0, at(share).1));
        let (before, [mut low, mut high]) = (side(0.0), [0.0, 1.0]);
        let switches = side(1.0) != before;
        for _ in 0..if switches { BISECTIONS } else { 0 } {
            let middle = 0.5 * (low + high);
            *(if side(middle) == before { &mut low } else { &mut high }) = middle;
        }
        let (r, gamma) = at(high);
        (r, gamma, switches)
    }
}

impl<const N: usize> Balance<N> {
    /// Whether a force follows the velocity.
    pub(super) fn damps<E: Effects>(&self) -> bool {
        Block { jacobian: &self.jacobian, of: 3..6 }.rates_of::<E, 3>(3).iter().any(|slope| *slope != 0.0)
    }

    /// Directions in which nothing holds it, or so little that these loads would take it farther than `lost` radii of gyration or \[rad]; None
    /// where they were not found.
    pub(super) fn unheld(&self, loads: &SVector<f64, BALANCES>, lost: f64) -> Option<Free> {
        let all = singular_values(&self.slopes)?;
        let largest = all.singular_values[0];
        let least = if largest > NOTHING { UNHELD * largest } else { largest };
        let (rows, loads) = (all.v_t?, all.u?.tr_mul(loads));
        let is_free = |n: &usize| all.singular_values[*n] <= least;
        let is_lost = |n: &usize| !is_free(n) && loads[*n].abs() > lost * all.singular_values[*n];
        let unheld = (0..UNKNOWNS).filter(|n| is_free(n) || is_lost(n));
        let directions: Vec<_> = unheld.map(|n| rows.row(n).transpose()).collect();
        Some(Free {
            held: UNKNOWNS - directions.len(),
            is_weak: (0..UNKNOWNS).any(|n| is_lost(&n)),
            largest,
            directions,
        })
    }
}

/// What rounding leaves of the loads, at most, in the units of [`Balance::left`]: with this largest stiffness, the mass centre at `r` \[m], and
/// this radius of gyration \[m].
pub(super) fn rounding(largest: f64, r: Vector3<f64>, length: f64) -> f64 {
    ROUNDED * largest * (1.0 + r.norm() / length)
}

/// Directions in which nothing holds a rotor.
pub(super) struct Free {
    /// Orthonormal in place over the radius of gyration and tilt.
    pub directions: Vec<SVector<f64, UNKNOWNS>>,
    /// The largest stiffness, as in [`Balance::left`] \[1/s²].
    pub largest: f64,
    /// In how many directions something holds it.
    pub held: usize,
    /// Whether something does in these too, if hardly.
    pub is_weak: bool,
}

/// The derivatives along some coordinates.
struct Block<'a, const N: usize> {
    jacobian: &'a [[f64; N]; N],
    of: std::ops::Range<usize>,
}

impl<const N: usize> Block<'_, N> {
    /// Of three rates from this coordinate on.
    fn rates_of<E: Effects, const D: usize>(&self, rate: usize) -> SMatrix<f64, 3, D> {
        let first = E::layout::<N>().body(ROTOR).start;
        SMatrix::from_fn(|row, column| self.jacobian[first + rate + row][first + self.of.start + column])
    }
}

/// The state with the mass centre where the forces balance, so far as stiffness holds it; all else is as it is. A load on a spring turns
/// the rotor: a top stands on its own weight, and before its spring has taken that up, nothing turns it over. The state itself where it
/// lies on another side of an event, or is not found: the laws are then far from linear.
pub(super) fn settled<E: Effects, const N: usize>(rotor: &Rotor<'_, E>, t: f64, y: &[f64; N]) -> [f64; N] {
    let (mut state, length, layout) = (*y, rotor.frame.body.radius(), E::layout::<N>());
    for _ in 0..MOST_SETTLING {
        let acceleration = rotor.at(&rotor.rates_of_all(t, &state)).v;
        let slopes = Block { jacobian: &rotor.jacobian(t, &state), of: 0..3 }.rates_of::<E, 3>(3);
        // Least squares: where nothing holds the rotor, it stays.
        let squares = slopes.tr_mul(&slopes);
        let inverse = (squares + Matrix3::identity() * (HARDLY_HELD * squares.trace())).try_inverse();
        let Some(step) = inverse.map(|inverse| inverse * slopes.tr_mul(&acceleration)) else { return *y };
        let mut coordinates = rotor.at(&state);
        coordinates.r -= step;
        layout.write(&mut state, ROTOR, &coordinates);
        if step.norm() <= SETTLED * length {
            return if sides(rotor, &state) == sides(rotor, y) { state } else { *y };
        }
    }
    *y
}

/// On which side each indicator of an effect is in this state.
pub(crate) fn sides<E: Effects, const N: usize>(rotor: &Rotor<'_, E>, state: &[f64; N]) -> [bool; MOST_INDICATORS] {
    let mut all = [1.0; MOST_INDICATORS];
    rotor.effects.indicators(&rotor.motion(0.0, state), &state[E::layout::<N>().own()], &mut all);
    all.map(|indicator| indicator > 0.0)
}

/// Puts what is out of balance onto the axis.
pub(crate) fn put_on_axis<E: Effects>(effects: &mut E) {
    effects.for_each(|block| {
        let kind = block.kind();
        if kind.name == UNBALANCE.0 {
            let is_radius = |row: &usize| (kind.meta)(*row).is_some_and(|meta| meta.name == UNBALANCE.1);
            block.set_parameter((0..).find(is_radius).expect("it has one"), 0.0);
        }
    });
}

/// Where a machine with `start.at_rest` begins at time `t` \[s]: at the spin of its start, which is along the axis then, where the balanced
/// machine stands. From its start it creeps there without inertia, so to where it is stable, and through contacts one after another. A place
/// that it leaves at this spin by itself, such as that of an upright top, it gets only where it creeps to none that is stable.
pub(super) fn start<E: Effects, const N: usize>(parameters: &Parameters<E>, t: f64) -> Result<Start, Invalid> {
    let given = &parameters.setup.start;
    let mut balanced = parameters.clone();
    put_on_axis(&mut balanced.effects);
    let speed = balanced.effects.imposed(t).map_or(given.omega.x, |[speed, _]| speed);
    let lost = |(largest, size): (usize, f64)| {
        let (what, unit) = if largest < 3 { ("force", "N") } else { ("moment", "N.m") };
        let axis = ["x", "y", "z"][largest % 3];
        let reason = format!(
            "= true: no place where loads balance at {speed:.3} rad/s was found from start.r_c and start.gamma, a {what} of {size:.3} {unit} \
             along {axis} remains: a support or bearings must hold the rotor where a load acts; give it a start nearer to its rest"
        );
        Invalid { variable: "start.at_rest".into(), reason }
    };
    let mut remains = (0, 0.0);
    let mut begun = Motion::<N>::at_start(&mut balanced, t);
    let mut span = None;
    let mut unstable = None;
    for _ in 0..MOST_CREEPING {
        let rotor = begun.bodies.under(&balanced.effects);
        let at = rotor.at(&begun.state);
        let about_axis = 1.0 / (rotor.frame.body.spin + rotor.frame.body.per_jt);
        let spinning = Spinning { rotor: &rotor, own: begun.state, about_axis, speed, t };
        let centre = rotor.frame.body.asymmetric.map_or(0.0, |asymmetric| asymmetric.centre.x);
        let start_at = |r: Vector3<f64>, gamma: Vector2<f64>| {
            let tilt = Tilt::new(rotor.frame.chart, gamma);
            Start { r_c: r - tilt.axis * centre, gamma: tilt.gamma(), omega: tilt.axis * speed, ..given.clone() }
        };
        let here = spinning.balance(at.r, at.gamma);
        remains = spinning.largest_load(&here);
        let size = here.left.norm();
        let mut over = *span.get_or_insert(if size > 0.0 { FARTHEST / size } else { f64::MAX });
        if unstable.is_some()
            && let Some((rate, _)) = spinning.leaving(&here)
        {
            over = over.min(LEAVES / rate);
        }
        let Some(step) = spinning.creep(&here, over) else { break };
        if step.norm() > FARTHEST {
            span = Some(over / GROWS);
            continue;
        }
        let (r, gamma, switches) = spinning.moved(at.r, at.gamma, &step);
        if step.norm() < NEAR && !switches {
            let Some(rest) = spinning.rest(r, gamma) else { break };
            let (_, length) = spinning.across();
            let moved = (rest.r - r).norm() / length + (rest.gamma - gamma).norm();
            let stays = sides(&rotor, &spinning.state(rest.r, rest.gamma)) == sides(&rotor, &spinning.state(r, gamma));
            if stays && moved < BEYOND {
                let found = start_at(rest.r, rest.gamma);
                let leaving = spinning.leaving(&rest.balance).filter(|_| {
                    let mut watch = Watch::default();
                    watch.look(&rotor, t, &spinning.state(rest.r, rest.gamma));
                    watch.found().is_some()
                });
                let Some((rate, along)) = leaving.filter(|_| unstable.is_none()) else { return Ok(found) };
                unstable = Some(found);
                // Where the start lies, if it lies on one side.
                let given = rotor.at(&spinning.own);
                let side = along.fixed_rows::<2>(3).dot(&(given.gamma - rest.gamma))
                    + along.fixed_rows::<3>(0).dot(&(given.r - rest.r)) / length;
                let (r, gamma, _) = spinning.moved(rest.r, rest.gamma, &(along * BESIDE.copysign(side)));
                (begun.state, span) = (spinning.state(r, gamma), Some(LEAVES / rate));
                continue;
            }
        }
        span = Some((over * GROWS).min(f64::MAX));
        if switches || gamma.norm() > FAR {
            // What touches there is asked for again, and which chart; effects measure from the start that was given.
            let found = start_at(r, gamma);
            balanced.setup.start = given.clone();
            begun = Motion::elsewhere(&mut balanced, &found, t);
        } else {
            begun.state = spinning.state(r, gamma);
        }
    }
    unstable.ok_or_else(|| lost(remains))
}
