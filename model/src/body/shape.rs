//! What effects make of the body: its mass, its mass centre and its inertia tensor.

use super::principal::principal;
use super::{Body, Inertia};
use crate::error::Invalid;
use crate::stored::stored;
use nalgebra::{Matrix3, Vector2, Vector3};

/// The rotor with all that effects add to it. Body axes: x along t, y and z where φ = 0 and γ = 0.
#[derive(Clone, Copy, Debug)]
#[allow(non_snake_case, reason = "the paper's symbols")]
pub struct Shape {
    /// The rotor, balanced, with Jt about y.
    pub rotor: Body,
    /// Its moment of inertia about z, where it is not Jt as well [kg·m²].
    pub Jt2: Option<f64>,
    /// Σ m_i of what is added \[kg].
    mass: f64,
    /// Σ m_i s_i from c [kg·m].
    moment: Vector3<f64>,
    /// Σ m_i (|s_i|² − s_i s_iᵀ) about c [kg·m²].
    inertia: Matrix3<f64>,
}

/// What is asymmetric of a body: its mass centre is not on its axis, or it is not symmetric about it.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Asymmetric {
    /// From c to the mass centre G of the whole, in body axes \[m].
    pub centre: Vector3<f64>,
    /// Its first two principal axes, in body axes \[1].
    pub axes: [Vector3<f64>; 2],
    /// 1/J about the second less that about the third [1/(kg·m²)].
    pub excess: f64,
}

stored!(Asymmetric { centre, axes, excess });

impl Asymmetric {
    /// Its principal axes, as columns, the third making them right-handed \[1].
    pub fn principal(&self) -> Matrix3<f64> {
        let [first, second] = self.axes;
        Matrix3::from_columns(&[first, second, first.cross(&second)])
    }
}

/// A moment of inertia beyond its bound by no more than this is that of a thin disk \[1].
const ROUNDING: f64 = 1e-12;

impl Shape {
    /// The rotor alone.
    pub fn of(rotor: Body) -> Self {
        Self { rotor, Jt2: None, mass: 0.0, moment: Vector3::zeros(), inertia: Matrix3::zeros() }
    }

    /// Adds a point mass \[kg] at `place` from c, in body axes \[m].
    pub fn add(&mut self, mass: f64, place: &Vector3<f64>) {
        self.mass += mass;
        self.moment += place * mass;
        self.inertia += spread(place) * mass;
    }

    /// Whether a body of this shape can exist: Ja ≤ 2 Jt (equal for the thin disk), or each of Ja, Jt and Jt2 at most the sum
    /// of the others.
    ///
    /// Ja is the integral of y² + z², Jt that of x² + z², Jt2 that of x² + y².
    #[allow(non_snake_case, reason = "the paper's symbols")]
    pub fn check(&self) -> Result<(), Invalid> {
        let Body { Ja, Jt, .. } = self.rotor;
        let Some(Jt2) = self.Jt2 else {
            if Ja <= 2.0 * Jt * (1.0 + ROUNDING) {
                return Ok(());
            }
            let bound = format!("at most 2 rotor.Jt = {:?} (a thin disk has Ja = 2 Jt)", 2.0 * Jt);
            return Err(Invalid::new("rotor.Ja", Ja, bound));
        };
        let (least, most) = ((Ja - Jt).abs(), Ja + Jt);
        let slack = ROUNDING * most;
        // The principal moments are rounded beside the largest.
        if Jt2 <= f64::EPSILON * most {
            let bound = format!("more than what is lost in the rounding of rotor.Ja + rotor.Jt = {most:?}");
            return Err(Invalid::new("asymmetry.Jt2", Jt2, bound));
        }
        if (least - slack..=most + slack).contains(&Jt2) {
            return Ok(());
        }
        let bound = format!("from |rotor.Ja - rotor.Jt| = {least:?} to rotor.Ja + rotor.Jt = {most:?}");
        Err(Invalid::new("asymmetry.Jt2", Jt2, bound))
    }

    /// From c to the mass centre G of the whole, in body axes \[m].
    pub fn centre(&self) -> Vector3<f64> {
        self.moment / (self.rotor.m + self.mass)
    }

    /// Of what is added, U = Σ m_i s_i [kg·m] and W = Σ m_i (x_i − x_G) s_i [kg·m²] across the axis, along y and z of the body: what the
    /// field calls static and couple unbalance.
    pub fn unbalance(&self) -> [Vector2<f64>; 2] {
        let first = self.moment.yz();
        // −Σ m_i x_i s_i stands in the inertia tensor.
        let about_c = -Vector2::new(self.inertia[(1, 0)], self.inertia[(2, 0)]);
        [first, about_c - first * self.centre().x]
    }

    /// The inertia tensor about G, in body axes, 3×3 [kg·m²].
    pub fn tensor(&self) -> Matrix3<f64> {
        let balanced = Vector3::new(self.rotor.Ja, self.rotor.Jt, self.Jt2.unwrap_or(self.rotor.Jt));
        // eq. 71: J_G = diag(Ja, Jt, Jt2) + Σ m_i (|s_i|² − s_i s_iᵀ) − M (|b|² − b bᵀ)
        Matrix3::from_diagonal(&balanced) + self.inertia - spread(&self.centre()) * (self.rotor.m + self.mass)
    }

    /// What the motion needs of it.
    pub fn inertia(&self) -> Inertia {
        let symmetric = Inertia::from(self.rotor);
        if self.Jt2.is_none() && self.mass == 0.0 {
            return symmetric;
        }
        let m = self.rotor.m + self.mass;
        let (moments, axes) = principal(self.tensor());
        let [first, second, third] = moments.map(|moment| 1.0 / moment).into();
        let axes = [axes.column(0).into_owned(), axes.column(1).into_owned()];
        let asymmetric = Asymmetric { centre: self.centre(), axes, excess: second - third };
        Inertia { m, per_m: 1.0 / m, per_jt: third, spin: first - third, asymmetric: Some(asymmetric), ..symmetric }
    }
}

/// |s|² − s sᵀ [m²].
fn spread(s: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::from_diagonal_element(s.norm_squared()) - s * s.transpose()
}
