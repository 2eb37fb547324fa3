//! A rotor with all effects at once, in variables that the library does not know.
//!
//! The attitude is P·S: a unit quaternion P that carries e to the axis without spinning about it, and S, a turn by ψ about e.
//! So a small tilt keeps its digits beside a great spin, no attitude is singular, and a rotor that is even about its axis does
//! not feel ψ at all. The rest of the state is r and v of the mass centre G of the whole, its angular momentum K about G, and
//! φ as a quadrature of ω·(e + t)/(1 + e·t), and the torque of a motor that lags. Vectors in O, SI units, radians.
//! Checks: `tests/exact/paper.rs`, `tests/exact/machine.rs`.

mod inputs;
pub mod known;
mod laws;
mod outputs;
mod rub;
mod run;
mod settings;
mod switches;
mod tabled;

pub use inputs::Input;
pub use outputs::Beside;
pub use run::{Pace, Run, Shown};

use nalgebra::{Vector2, Vector3};

/// A point mass on the rotor.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Unbalance {
    /// \[kg].
    pub mass: f64,
    /// From the axis \[m].
    pub radius: f64,
    /// From y towards z, at φ = 0 and γ = 0 \[rad].
    pub angle: f64,
    /// Along t from c \[m].
    pub position: f64,
}

/// A linear bearing.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Bearing {
    /// Along t from c \[m].
    pub position: f64,
    /// Rows of K [N/m].
    pub k: [[f64; 2]; 2],
    /// Rows of C [N·s/m].
    pub c: [[f64; 2]; 2],
    /// Axial stiffness [N/m] and damping [N·s/m].
    pub axial: [f64; 2],
    /// Stiffness against tilt [N·m/rad] and its damping [N·m·s/rad].
    pub tilt: [f64; 2],
    /// What K and C have besides against |ω_φ|.
    pub table: Vec<Node>,
}

/// A node of a bearing's table.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Node {
    /// |ω_φ| [rad/s].
    pub speed: f64,
    /// Rows of what K has besides [N/m].
    pub k: [[f64; 2]; 2],
    /// Rows of what C has besides [N·s/m].
    pub c: [[f64; 2]; 2],
}

impl Node {
    /// What it has: kyy, kyz, kzy, kzz, cyy, cyz, czy, czz.
    pub fn values(&self) -> [f64; 8] {
        let Self { k: [[kyy, kyz], [kzy, kzz]], c: [[cyy, cyz], [czy, czz]], .. } = *self;
        [kyy, kyz, kzy, kzz, cyy, cyz, czy, czz]
    }
}

/// A motor on a straight characteristic.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Motor {
    /// At rest [N·m].
    pub stall_torque: f64,
    /// Without torque [rad/s].
    pub synchronous_speed: f64,
    /// In which its torque follows \[s]; 0: at once.
    pub time_constant: f64,
}

/// A ring around a station.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Rub {
    /// Along t from c \[m].
    pub position: f64,
    /// Between shaft and ring \[m].
    pub gap: f64,
    /// Of the ring, above 0 [N/m].
    pub stiffness: f64,
    /// Of the ring [N·s/m].
    pub damping: f64,
    /// Coefficient of friction \[1].
    pub friction: f64,
    /// Of the shaft \[m].
    pub radius: f64,
    /// Speed of sliding at which friction has tanh 1 of its strength [m/s].
    pub v0: f64,
}

/// The paper's support, at −l.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Support {
    /// Stiffness [N/m], [N·m/rad].
    pub c: [f64; 2],
    /// Damping [N·s/m], [N·m·s/rad].
    pub d: [f64; 2],
}

/// The motion at the start.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Start {
    /// Position of c \[m].
    pub r_c: Vector3<f64>,
    /// Velocity of c [m/s].
    pub v_c: Vector3<f64>,
    /// φ \[rad].
    pub phi: f64,
    /// γ, y and z \[rad].
    pub gamma: Vector2<f64>,
    /// Angular velocity [rad/s].
    pub omega: Vector3<f64>,
}

/// A rotor, what acts on it, and where it starts; None, or an empty list, where an effect is absent.
#[derive(Clone, Debug, Default, PartialEq)]
#[allow(non_snake_case, reason = "the paper's symbols")]
pub struct Machine {
    /// Mass \[kg].
    pub m: f64,
    /// Moments of inertia about the axis and about y [kg·m²].
    pub Ja: f64,
    /// About y [kg·m²].
    pub Jt: f64,
    /// About z, where it is another [kg·m²].
    pub Jt2: Option<f64>,
    /// From the support to c \[m].
    pub l: f64,
    /// At the start.
    pub start: Start,
    /// Acceleration of gravity [m/s²].
    pub gravity: Option<Vector3<f64>>,
    /// The paper's support.
    pub support: Option<Support>,
    /// Point masses.
    pub unbalances: Vec<Unbalance>,
    /// Bearings.
    pub bearings: Vec<Bearing>,
    /// Damping in turning axes [N·s/m] and where \[m].
    pub rotating_damping: Option<[f64; 2]>,
    /// Windage, linear [N·m·s/rad] and quadratic [N·m·s²/rad²].
    pub drag: Option<[f64; 2]>,
    /// Whether there is a drive with a torque from outside.
    pub drive: bool,
    /// A motor.
    pub motor: Option<Motor>,
    /// Whether its speed is imposed.
    pub imposed_speed: bool,
    /// Rings.
    pub rubs: Vec<Rub>,
    /// Where ports are \[m].
    pub ports: Vec<f64>,
    /// Degree of the polynomials through the last inputs, and how many steps these are late.
    pub extrapolation: Option<[usize; 2]>,
    /// The inputs at the start; what is not named is 0, the motor's command 1.
    pub inputs: Vec<(Input, f64)>,
}
