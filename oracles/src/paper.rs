//! The reference motion of the paper's example, from `tests/fmu/data/paper_reference.csv`: two formulations in
//! quadruple precision and a third code agree to 24 digits (the README beside it). Check: its energy and K_c·t are
//! constant, in `tests/exact/paper.rs`.

use nalgebra::{Vector2, Vector3};

const TABLE: &str = include_str!("../../tests/fmu/data/paper_reference.csv");

/// One instant of the reference.
#[derive(Clone, Debug)]
pub struct Instant {
    /// Time \[s].
    pub t: f64,
    /// Position of the mass centre \[m].
    pub r_c: Vector3<f64>,
    /// Axial angle, whole turns included \[rad].
    pub phi: f64,
    /// γ_y and γ_z \[rad].
    pub gamma: Vector2<f64>,
    /// Velocity of the mass centre [m/s].
    pub v_c: Vector3<f64>,
    /// Angular momentum about the mass centre [kg·m²/s].
    pub k_c: Vector3<f64>,
    /// Axial rate [rad/s].
    pub omega_phi: f64,
    /// Total energy \[J].
    pub energy: f64,
}

/// 0 … 10 s every 0.1 s.
pub fn instants() -> Vec<Instant> {
    let mut lines = TABLE.lines();
    assert_eq!(lines.next(), Some("t,rx,ry,rz,phi,gx,gy,gz,vx,vy,vz,Kx,Ky,Kz,omega_phi,E"));
    let instants: Vec<_> = lines
        .map(|line| {
            let x: Vec<f64> = line.split(',').map(|number| number.parse().expect("a number")).collect();
            assert!(x.len() == 16 && x[5] == 0.0, "a line of the reference: {line}");
            Instant {
                t: x[0],
                r_c: Vector3::new(x[1], x[2], x[3]),
                phi: x[4],
                gamma: Vector2::new(x[6], x[7]),
                v_c: Vector3::new(x[8], x[9], x[10]),
                k_c: Vector3::new(x[11], x[12], x[13]),
                omega_phi: x[14],
                energy: x[15],
            }
        })
        .collect();
    assert_eq!(instants.len(), 101);
    instants
}
