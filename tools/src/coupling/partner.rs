//! The model of a bearing or a support as a partner at a port: it has no states, and answers with the law of the effect.

use nalgebra::{Matrix3, Vector2, Vector3};
use split_rotor_model::effects::bearing::Coefficients;
use split_rotor_model::effects::table::MOST_NODES;
use split_rotor_model::scene::Scene;

use crate::scenes;

/// What a port shows to its partner.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Shown {
    /// Position of the station \[m].
    pub r: Vector3<f64>,
    /// Velocity of the station [m/s].
    pub v: Vector3<f64>,
    /// Transverse Euler vector γ, y and z \[rad].
    pub theta: Vector2<f64>,
    /// Angular velocity [rad/s].
    pub omega: Vector3<f64>,
}

impl Shown {
    /// The axis t of the rotor \[1].
    pub fn axis(&self) -> Vector3<f64> {
        let [y, z] = [self.theta.x, self.theta.y];
        let angle = libm::hypot(y, z);
        let part = if angle < 1e-8 { 1.0 } else { libm::sin(angle) / angle };
        // t = e cos θ + (sin θ/θ) γ×e
        Vector3::new(libm::cos(angle), part * z, -part * y)
    }

    /// t×dt/dt, the angular velocity across the axis [rad/s].
    pub fn turn(&self) -> Vector3<f64> {
        let t = self.axis();
        self.omega - t * self.omega.dot(&t)
    }

    /// ω_φ [rad/s].
    fn speed(&self) -> f64 {
        let t = self.axis();
        // ω_φ = ω·(e + t)/(1 + e·t)
        (self.omega.x + self.omega.dot(&t)) / (1.0 + t.x)
    }
}

/// The names of the coefficients of a bearing and of a port: those of K along x, across in rows, and against tilt; those of C alike.
pub const NAMES: [&str; 12] = ["kxx", "kyy", "kyz", "kzy", "kzz", "kt", "cxx", "cyy", "cyz", "czy", "czz", "ct"];

/// Springs and dampers at a station.
#[derive(Clone, Debug)]
pub struct Partner {
    /// The effect whose law this is.
    pub name: String,
    /// Where it is, along t from c \[m].
    pub position: f64,
    /// Where its axial spring is without a load \[m].
    pub rest: f64,
    /// Values in the order of [`NAMES`].
    coefficients: [f64; NAMES.len()],
    /// What K and C across have besides against ω_φ.
    table: Option<Coefficients<MOST_NODES>>,
}

impl Partner {
    /// Springs and dampers of these coefficients.
    pub fn of(name: &str, position: f64, coefficients: [f64; NAMES.len()]) -> Self {
        Self { name: name.into(), position, rest: position, coefficients, table: None }
    }

    /// The bearing with this index in a scene. At the start its axial spring carries no load.
    pub fn bearing(scene: &Scene, number: u32) -> Self {
        let (name, value) = (format!("bearing[{number}]"), scenes::values(scene));
        let named = |end: &str| value(&format!("{name}.{end}"));
        let coefficients = NAMES.map(|coefficient| named(coefficient).unwrap_or_default());
        let partner = Self::of(&name, named("position").unwrap_or_default(), coefficients);
        const COLUMNS: [&str; 9] = ["speed", "kyy", "kyz", "kzy", "kzz", "cyy", "cyz", "czy", "czz"];
        let mut table = Coefficients::default();
        for node in (1..=MOST_NODES).take_while(|node| named(&format!("speed[{node}]")).is_some()) {
            for (column, of) in COLUMNS.into_iter().enumerate() {
                table.set(node, column, named(&format!("{of}[{node}]")).unwrap_or_default());
            }
        }
        let start = scene.parameters().setup.start;
        let rest = start.r_c.x + partner.position * libm::cos(start.gamma.norm());
        Self { rest, table: table.is_given().then_some(table), ..partner }
    }

    /// The support of a scene.
    pub fn support(scene: &Scene) -> Self {
        let value = scenes::values(scene);
        let [c1, c2, d1, d2, l] = ["support.c1", "support.c2", "support.d1", "support.d2", "rotor.l"]
            .map(|name| value(name).unwrap_or_default());
        let coefficients = [c1, c1, 0.0, 0.0, c1, c2, d1, d1, 0.0, 0.0, d1, d2];
        Self { rest: 0.0, ..Self::of("support", 0.0 - l, coefficients) }
    }

    /// Its coefficients at a speed [rad/s], in the order of [`NAMES`].
    pub fn at(&self, speed: f64) -> [f64; NAMES.len()] {
        let mut all = self.coefficients;
        let Some(table) = &self.table else { return all };
        let mut table = table.clone();
        table.follow(speed, None);
        let besides = table.at(speed).expect("the table is given and its stretch entered");
        for n in 0..4 {
            all[1 + n] += besides[n];
            all[7 + n] += besides[4 + n];
        }
        all
    }

    /// Whether its coefficients depend on the speed.
    pub fn has_table(&self) -> bool {
        self.table.is_some()
    }

    /// Whether it acts along the axis.
    pub fn is_axial(&self) -> bool {
        self.coefficients[0] != 0.0 || self.coefficients[6] != 0.0
    }

    /// Whether it acts against tilt.
    pub fn is_tilted(&self) -> bool {
        self.coefficients[5] != 0.0 || self.coefficients[11] != 0.0
    }

    /// The displacement of its station \[m].
    fn displacement(&self, shown: &Shown) -> Vector3<f64> {
        shown.r - Vector3::x() * self.rest
    }

    /// Force and moment on the rotor \[N], [N·m].
    pub fn answer(&self, shown: &Shown) -> [Vector3<f64>; 2] {
        let all = self.at(shown.speed());
        let [k, c] = [matrix(&all[..5]), matrix(&all[6..11])];
        // eq. 61: F = −(kxx x, K q) − (cxx dx/dt, C dq/dt), M = −kt γ − ct t×dt/dt
        let force = -k * self.displacement(shown) - c * shown.v;
        let moment = -Vector3::new(0.0, shown.theta.x, shown.theta.y) * all[5] - shown.turn() * all[11];
        [force, moment]
    }

    /// The energy in its springs \[J].
    pub fn stored(&self, shown: &Shown) -> f64 {
        let all = self.at(shown.speed());
        let r = self.displacement(shown);
        0.5 * (r.dot(&(matrix(&all[..5]) * r)) + all[5] * shown.theta.norm_squared())
    }
}

/// xx, yy, yz, zy and zz as a matrix.
fn matrix(of: &[f64]) -> Matrix3<f64> {
    let [xx, yy, yz, zy, zz] = [of[0], of[1], of[2], of[3], of[4]];
    Matrix3::new(xx, 0.0, 0.0, 0.0, yy, yz, 0.0, zy, zz)
}
