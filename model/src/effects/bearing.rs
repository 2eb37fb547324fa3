//! `bearing`: linear springs and dampers at a station, with cross coupling; against the speed where a table is given.

use super::housing::{self, Fixed, Housed, Housing, Moving};
use super::table::Table;
use super::{Act, Change, Doubt, Effect, Facts, MOST_DOUBTS, MOST_LOADS, Motion, Pose, Row, Wrench};
use crate::error::Invalid;
use crate::scalar::Scalar;
use crate::variable::units::{
    METRE, NEWTON, NEWTON_METRE_PER_RADIAN, NEWTON_METRE_SECOND_PER_RADIAN, NEWTON_PER_METRE, NEWTON_SECOND_PER_METRE,
    RADIAN_PER_SECOND,
};
use crate::variable::{Access, Bound, Meta, output, parameter};
use nalgebra::Vector3;

/// A bearing on the stator line, the x axis, in a housing, with a table of so many nodes.
#[derive(Clone, Debug, Default)]
pub struct Bearing<H: Housing = Fixed, const NODES: usize = 0> {
    /// Where it is, along t from c \[m].
    pub position: f64,
    /// Stiffness K [N/m]; a seal or a magnet may have a negative one.
    pub kyy: f64,
    /// Force along −y by a displacement along z [N/m].
    pub kyz: f64,
    /// Force along −z by a displacement along y [N/m].
    pub kzy: f64,
    /// As `kyy` [N/m].
    pub kzz: f64,
    /// Damping C [N·s/m].
    pub cyy: f64,
    /// As `kyz` [N·s/m].
    pub cyz: f64,
    /// As `kzy` [N·s/m].
    pub czy: f64,
    /// As `cyy` [N·s/m].
    pub czz: f64,
    /// Axial stiffness [N/m].
    pub kxx: f64,
    /// Axial damping [N·s/m].
    pub cxx: f64,
    /// Stiffness against tilt [N·m/rad].
    pub kt: f64,
    /// Damping of the tilt [N·m·s/rad].
    pub ct: f64,
    /// What K and C have besides against ω_φ: kyy, kyz, kzy, kzz, cyy, cyz, czy, czz of each node.
    table: Coefficients<NODES>,
    /// What it is fixed to.
    pub housing: H,
    /// Where [`Bearing::axial`] counts from \[m]; the number of the table's stretch; when the communication step began \[s].
    memory: [f64; FROM + 1],
}

/// Where in the memory the start of a communication step is.
const FROM: usize = 2;

/// The columns of the table after that of the speeds.
const COLUMNS: [&str; 8] = ["kyy", "kyz", "kzy", "kzz", "cyy", "cyz", "czy", "czz"];

/// Those that couple y and z, which change their sign with the speed: a rotor that turns backwards moves as the mirror image of one that
/// turns forwards.
const CROSS: u32 = 0b0110_0110;

/// The table of a bearing: K [N/m] and C [N·s/m] of each node, row by row.
pub type Coefficients<const NODES: usize> = Table<8, NODES, CROSS>;

/// A symmetric damping that is within this of its bound \[1] is rounded.
const ROUNDING: f64 = 1e-12;

/// A rotor at rest that its springs shake may turn back and forth by this [rad/s].
const TREMBLES: f64 = 0.1;

/// Between two nodes, the damping is checked at so many speeds.
const CHECKED_BETWEEN: u32 = 32;

/// So many variables stand before those of the nodes.
const UNTABLED: usize = 16;

/// Each node has so many.
const OF_NODE: usize = 9;

/// Rows of a matrix that acts on (y, z).
type Matrix<S> = [[S; 2]; 2];

/// [a, b, c, d] as a matrix.
#[inline(always)]
fn matrix<S: Copy>(a: &[S]) -> Matrix<S> {
    [[a[0], a[1]], [a[2], a[3]]]
}

impl<const NODES: usize> Bearing<Fixed, NODES> {
    /// A bearing at `position` along t from c \[m] with K [N/m] and C [N·s/m], each as rows that act on (y, z). What else it has is
    /// zero, and its table empty.
    pub fn new(position: f64, [[kyy, kyz], [kzy, kzz]]: Matrix<f64>, [[cyy, cyz], [czy, czz]]: Matrix<f64>) -> Self {
        Self { position, kyy, kyz, kzy, kzz, cyy, cyz, czy, czz, ..Self::default() }
    }

    /// The same with K and C against ω_φ besides: kyy, kyz, kzy, kzz [N/m] and cyy, cyz, czy, czz [N·s/m] of each node, whose cross terms
    /// change their sign with ω_φ.
    pub fn with_table(self, table: Coefficients<NODES>) -> Self {
        Self { table, ..self }
    }

    /// The same in a housing that moves.
    pub fn in_housing(self, housing: Moving) -> Bearing<Moving, NODES> {
        let Self { position, kyy, kyz, kzy, kzz, cyy, cyz, czy, czz, kxx, cxx, kt, ct, table, housing: _, memory } =
            self;
        Bearing { position, kyy, kyz, kzy, kzz, cyy, cyz, czy, czz, kxx, cxx, kt, ct, table, housing, memory }
    }
}

impl<H: Housing, const NODES: usize> Bearing<H, NODES> {
    fn stiffness(&self) -> [f64; 4] {
        [self.kyy, self.kyz, self.kzy, self.kzz]
    }

    fn damping(&self) -> [f64; 4] {
        [self.cyy, self.cyz, self.czy, self.czz]
    }

    /// Force by the displacement \[m] and force by the velocity [m/s] across, as the table has them at a speed [rad/s] \[N].
    #[inline(always)]
    fn tabled<S: Scalar>(&self, speed: S, q: Vector3<S>, rate: Vector3<S>) -> Option<[Vector3<S>; 2]> {
        if NODES == 0 {
            return None;
        }
        let table = self.table.at(speed)?;
        let across = |coefficients, v| -times(S::zero(), matrix(coefficients), v);
        // eq. 101: F = −K(ω_φ) q − C(ω_φ) dq/dt
        Some([across(&table[..4], q), across(&table[4..], rate)])
    }

    /// What couples y and z in a circle, half of kyz − kzy [N/m].
    fn circulation(&self) -> f64 {
        0.5 * (self.kyz - self.kzy)
    }

    /// x of its station, from where it is when c is at the origin and t along e \[m]. By how much a small tilt draws the station back
    /// would be lost beside its distance from c.
    #[inline(always)]
    fn axial<S: Scalar>(&self, motion: &Motion<S>) -> S {
        // x = e·r_c − p (1 − e·t)
        motion.r_c().x - motion.foreshortening() * S::constant(self.position)
    }

    /// (x, q) of its station relative to the housing, x from its place at the start \[m].
    #[inline(always)]
    fn displacement<S: Scalar>(&self, motion: &Motion<S>) -> Vector3<S> {
        let station = motion.station(self.position);
        let from_start = Vector3::new(self.axial(motion) - S::constant(self.memory[0]), station.y, station.z);
        self.housing.relative(motion, from_start)
    }

    /// Velocity of its station relative to the housing [m/s].
    #[inline(always)]
    fn velocity<S: Scalar>(&self, motion: &Motion<S>) -> Vector3<S> {
        self.housing.relative_velocity(motion, motion.station_velocity(self.position))
    }

    /// Force on the rotor at the station \[N], which is so far from the housing \[m].
    #[inline(always)]
    fn force_at<S: Scalar>(&self, motion: &Motion<S>, q: Vector3<S>) -> Vector3<S> {
        let rate = self.velocity(motion);
        // eq. 61: F = −(kxx x, K q) − (cxx dx/dt, C dq/dt)
        let force = -self.springs(q) + -self.dampers(rate);
        self.tabled(motion.omega_phi(), q, rate).map_or(force, |[pull, drag]| force + pull + drag)
    }

    /// Force on the rotor at the station \[N].
    fn force<S: Scalar>(&self, motion: &Motion<S>) -> Vector3<S> {
        self.force_at(motion, self.displacement(motion))
    }

    /// (kxx x, K q).
    #[inline(always)]
    fn springs<S: Scalar>(&self, v: Vector3<S>) -> Vector3<S> {
        times(S::constant(self.kxx), matrix(&self.stiffness().map(S::constant)), v)
    }

    /// (cxx dx/dt, C dq/dt).
    #[inline(always)]
    fn dampers<S: Scalar>(&self, v: Vector3<S>) -> Vector3<S> {
        times(S::constant(self.cxx), matrix(&self.damping().map(S::constant)), v)
    }
}

/// A bearing with this damping drives nothing; `at` tells where it has it.
fn check_damping([cyy, cyz, czy, czz]: [f64; 4], at: &str) -> Result<(), Invalid> {
    // Halves and roots do not overflow.
    let most = cyy.sqrt() * czz.sqrt();
    if (0.5 * cyz + 0.5 * czy).abs() <= most * (1.0 + ROUNDING) {
        return Ok(());
    }
    let bound = format!(
        "such that (cyz + czy)/2 is at most sqrt(cyy czz) = {most:?} in size{at}, or the bearing would drive what it damps"
    );
    let (name, value) = if cyz == 0.0 { ("czy", czy) } else { ("cyz", cyz) };
    let with_table = if at.is_empty() { "" } else { " with its table" };
    Err(Invalid::new(format!("{name}{with_table}"), value, bound))
}

/// What damps and what a table adds to it do not overflow together.
fn check_sums(sums: [f64; 4], at: &str) -> Result<(), Invalid> {
    match (0..4).find(|n| !sums[*n].is_finite()) {
        None => Ok(()),
        Some(n) => Err(Invalid::new(format!("{} with its table", COLUMNS[4 + n]), sums[n], format!("finite{at}"))),
    }
}

/// (axial x, A q).
#[inline(always)]
fn times<S: Scalar>(axial: S, across: Matrix<S>, v: Vector3<S>) -> Vector3<S> {
    let [y, z] = across.map(|[a, b]| v.y * a + v.z * b);
    Vector3::new(v.x * axial, y, z)
}

/// The variables without a table, then those of each of these nodes, column by column.
macro_rules! rows {
    ([$($untabled:expr),* $(,)?], $($node:literal)*) => {
        &[
            $($untabled,)*
            $(
                rows!($node 0 "speed", &RADIAN_PER_SECOND, Bound::NotNegative, "size of omega_phi"),
                rows!($node 1 "kyy", &NEWTON_PER_METRE, Bound::Finite, "stiffness, force along y by displacement along y,"),
                rows!($node 2 "kyz", &NEWTON_PER_METRE, Bound::Finite, "stiffness, force along y by displacement along z,"),
                rows!($node 3 "kzy", &NEWTON_PER_METRE, Bound::Finite, "stiffness, force along z by displacement along y,"),
                rows!($node 4 "kzz", &NEWTON_PER_METRE, Bound::Finite, "stiffness, force along z by displacement along z,"),
                rows!($node 5 "cyy", &NEWTON_SECOND_PER_METRE, Bound::NotNegative, "damping, force along y by speed along y,"),
                rows!($node 6 "cyz", &NEWTON_SECOND_PER_METRE, Bound::Finite, "damping, force along y by speed along z,"),
                rows!($node 7 "czy", &NEWTON_SECOND_PER_METRE, Bound::Finite, "damping, force along z by speed along y,"),
                rows!($node 8 "czz", &NEWTON_SECOND_PER_METRE, Bound::NotNegative, "damping, force along z by speed along z,"),
            )*
        ]
    };
    ($node:literal $column:literal $name:literal, $unit:expr, $bound:expr, $what:literal) => {
        Row {
            meta: Meta::parameter(concat!($name, "[", $node, "]"), $unit, Some(0.0), $bound, concat!($what, " at node ", $node)),
            access: Access::Parameter {
                get: |bearing: &Self| bearing.table.number($node, $column),
                set: |bearing: &mut Self, value| bearing.table.set($node, $column, value),
            },
        }
    };
}

impl<H: Housing, const NODES: usize> Bearing<H, NODES> {
    /// Its variables, and those of nodes that it may not have.
    const ALL: &'static [Row<Self>] = rows!([
        parameter!(position, &METRE, None, Bound::Finite, "axial position from the mass centre"),
        parameter!(
            kyy,
            &NEWTON_PER_METRE,
            Some(0.0),
            Bound::Finite,
            "stiffness, force along y by displacement along y"
        ),
        parameter!(
            kyz,
            &NEWTON_PER_METRE,
            Some(0.0),
            Bound::Finite,
            "stiffness, force along y by displacement along z"
        ),
        parameter!(
            kzy,
            &NEWTON_PER_METRE,
            Some(0.0),
            Bound::Finite,
            "stiffness, force along z by displacement along y"
        ),
        parameter!(
            kzz,
            &NEWTON_PER_METRE,
            Some(0.0),
            Bound::Finite,
            "stiffness, force along z by displacement along z"
        ),
        parameter!(
            cyy,
            &NEWTON_SECOND_PER_METRE,
            Some(0.0),
            Bound::NotNegative,
            "damping, force along y by speed along y"
        ),
        parameter!(cyz, &NEWTON_SECOND_PER_METRE, Some(0.0), Bound::Finite, "damping, force along y by speed along z"),
        parameter!(czy, &NEWTON_SECOND_PER_METRE, Some(0.0), Bound::Finite, "damping, force along z by speed along y"),
        parameter!(
            czz,
            &NEWTON_SECOND_PER_METRE,
            Some(0.0),
            Bound::NotNegative,
            "damping, force along z by speed along z"
        ),
        parameter!(kxx, &NEWTON_PER_METRE, Some(0.0), Bound::Finite, "axial stiffness"),
        parameter!(cxx, &NEWTON_SECOND_PER_METRE, Some(0.0), Bound::NotNegative, "axial damping"),
        parameter!(kt, &NEWTON_METRE_PER_RADIAN, Some(0.0), Bound::Finite, "stiffness against tilt"),
        parameter!(ct, &NEWTON_METRE_SECOND_PER_RADIAN, Some(0.0), Bound::NotNegative, "damping of the tilt"),
        output!("F.x", &NEWTON, "force of the bearing on the rotor at its station, along x", |b, m| b.force(m).x),
        output!("F.y", &NEWTON, "force of the bearing on the rotor at its station, along y", |b, m| b.force(m).y),
        output!("F.z", &NEWTON, "force of the bearing on the rotor at its station, along z", |b, m| b.force(m).z),
    ], 1 2 3 4 5 6 7 8 9 10 11 12 13 14 15 16);
}

impl<H: Housing, const NODES: usize> Housed for Bearing<H, NODES> {
    type Housing = H;

    fn housing(&self) -> &H {
        &self.housing
    }

    fn housing_mut(&mut self) -> &mut H {
        &mut self.housing
    }

    fn force_on_housing<S: Scalar>(&self, motion: &Motion<S>) -> Vector3<S> {
        let ahead = self.housing.ahead(motion, self.memory[FROM]);
        -self.force_at(motion, self.displacement(motion) + self.velocity(motion) * ahead)
    }
}

impl<H: Housing, const NODES: usize> Effect for Bearing<H, NODES> {
    const LAW: &'static str =
        "at the station, q = (y, z): F = −K q − C dq/dt, F_x = −kxx x − cxx dx/dt, M = −kt γ − ct t×dt/dt";

    const ROWS: &'static [Row<Self>] = Self::ALL.split_at(UNTABLED + OF_NODE * NODES).0;

    const HOUSING: &'static [Row<Self>] = housing::rows::<Self>();

    const FACTS: Facts = Facts {
        loads: 1,
        tells_rates: H::CAN_MOVE,
        // A node is passed.
        indicators: (NODES > 0) as usize,
        analytic: NODES == 0,
        may_be_doubted: true,
        ..Facts::USUAL
    };

    #[inline(always)]
    fn load_changes(&self, at: &Pose, change: &Change) -> [f64; MOST_LOADS] {
        let (q, rate) = (change.station(self.position), change.station_velocity(self.position));
        let force = -(self.springs(q) + self.dampers(rate));
        let force = self.tabled(at.speed, q, rate).map_or(force, |[pull, drag]| force + pull + drag);
        [force.norm_squared(), 0.0]
    }

    #[inline(always)]
    fn act<S: Scalar>(&self, motion: &Motion<S>) -> Act<S> {
        let (r, v) = (self.displacement(motion), self.velocity(motion));
        let (lean, t_rate) = (motion.lean(), motion.axis_rate());
        let at_station = |force| Wrench::at_station(motion, self.position, force);
        let springs = r.dot(&self.springs(r));
        let linear = Act {
            // eq. 61: F = −(kxx x, K q), M = −kt γ
            load: at_station(-self.springs(r)) + Wrench::against_lean(motion, self.kt),
            // eq. 61: F = −(cxx dx/dt, C dq/dt), M = −ct t×(dt/dt)
            damping: at_station(-self.dampers(v)) + Wrench::against_turn(motion, self.ct),
            // eq. 62: V = ½ (kxx x² + qᵀK q + kt |γ|²); of K only the symmetric part counts
            stored: (springs + lean.dot(&lean) * S::constant(self.kt)) * S::constant(0.5),
            // eq. 63: −dqᵀ/dt K_skew q = ½ (kyz − kzy) e·(q×dq/dt)
            supply: motion.power_along(self.circulation(), r.y, v.z) - motion.power_along(self.circulation(), r.z, v.y),
            // eq. 62: P = cxx (dx/dt)² + dqᵀ/dt C dq/dt + ct |dt/dt|²; of C only the symmetric part counts
            loss: motion.power(1.0, &v, &self.dampers(v)) + motion.power(self.ct, &t_rate, &t_rate),
            ..Act::none()
        };
        let Some([pull, drag]) = self.tabled(motion.omega_phi(), r, v) else {
            return self.housing.supplying(motion, linear, || self.force(motion));
        };
        let tabled = Act {
            load: linear.load + at_station(pull),
            damping: linear.damping + at_station(drag),
            // eq. 101: −dqᵀ/dt K q is supplied, dqᵀ/dt C dq/dt is lost
            supply: linear.supply + v.dot(&pull),
            loss: linear.loss - v.dot(&drag),
            ..linear
        };
        self.housing.supplying(motion, tabled, || self.force(motion))
    }

    fn follows_speed(&self) -> bool {
        let Self { cyy, cyz, czy, czz, cxx, ct, .. } = *self;
        self.table.is_given() || [cyy, cyz, czy, czz, cxx, ct].iter().any(|c| *c != 0.0)
    }

    fn no_limit(&self) -> Option<&'static str> {
        let spring = (self.kt != 0.0).then_some(no_limit!("the spring kt of a bearing, which follows gamma,"));
        let table = self.table.is_given().then_some(no_limit!("omega_phi, which the table of a bearing follows,"));
        spring.or(table)
    }

    fn is_analytic(&self) -> bool {
        !self.table.is_given()
    }

    fn works(&self) -> bool {
        // What damps across gives no work, but is asked for only where something works.
        self.circulation() != 0.0 || self.follows_speed() || self.housing.moves()
    }

    fn check(&self) -> Result<(), Invalid> {
        if !self.table.is_given() {
            return check_damping(self.damping(), "");
        }
        self.table.check(&COLUMNS)?;
        let damping = self.damping();
        // Constants keep their sign where the rotor turns backwards.
        let samples = self.table.samples(CHECKED_BETWEEN);
        let both =
            samples.flat_map(|(speed, table)| [(speed, table), (-speed, Coefficients::<NODES>::mirrored(table))]);
        both.into_iter().try_for_each(|(speed, table)| {
            let (sums, at) = (std::array::from_fn(|n| damping[n] + table[4 + n]), format!(" at {speed:?} rad/s"));
            check_sums(sums, &at)?;
            check_damping(sums, &at)
        })
    }

    fn is_doubtful(&self) -> bool {
        self.table.is_followed() || self.circulation() != 0.0
    }

    fn doubts(&self, [low, high]: [f64; 2]) -> [Option<Doubt>; MOST_DOUBTS] {
        let [below, beyond] = self.table.known().map_or([None; 2], |known| Doubt::of_table(known, [low, high]));
        let backward = low < -TREMBLES && self.circulation() != 0.0;
        [below, beyond, backward.then_some(Doubt::Backward { speed: low })]
    }

    #[inline(always)]
    fn step_from(&mut self, t: f64) {
        self.housing.step_from(t);
        self.memory[FROM] = t;
    }

    fn begin(&mut self, start: &Motion<f64>) {
        self.memory = [self.axial(start), 0.0, housing::NO_STEP];
        if NODES > 0 {
            self.memory[1] = self.table.follow(start.omega_phi(), None);
        }
    }

    fn has_events(&self) -> bool {
        self.table.is_given()
    }

    fn indicator(&self, _n: usize, motion: &Motion<f64>) -> f64 {
        if self.table.is_given() { self.table.within(self.memory[1], motion.omega_phi()) } else { 1.0 }
    }

    fn switch(&mut self, positive: &[bool], motion: &Motion<f64>) {
        if let [positive] = positive {
            self.memory[1] = self.table.follow(motion.omega_phi(), Some(*positive));
        }
    }

    fn memory(&mut self) -> &mut [f64] {
        &mut self.memory[..if H::CAN_MOVE { FROM + 1 } else { 1 + Self::FACTS.indicators }]
    }

    fn restored(&mut self) -> bool {
        NODES == 0 || self.table.restore(self.memory[1])
    }
}
