//! SI units with their exponents, as modelDescription.xml declares them.

/// A unit: its name, the exponents of its SI base units, and the unit in which people like to see it.
#[derive(Debug, PartialEq)]
pub struct Unit {
    /// Its name; empty for a pure number.
    pub name: &'static str,
    /// Exponents of kg, m, s, rad.
    pub exponents: [i8; 4],
    /// Name and factor: shown value = factor · value.
    pub display: Option<(&'static str, f64)>,
}

const fn unit(name: &'static str, exponents: [i8; 4]) -> Unit {
    Unit { name, exponents, display: None }
}

/// A pure number.
pub static ONE: Unit = unit("", [0, 0, 0, 0]);
/// m
pub static METRE: Unit = unit("m", [0, 1, 0, 0]);
/// m/s
pub static METRE_PER_SECOND: Unit = unit("m/s", [0, 1, -1, 0]);
/// m/s2
pub static METRE_PER_SECOND_SQUARED: Unit = unit("m/s2", [0, 1, -2, 0]);
/// s
pub static SECOND: Unit = unit("s", [0, 0, 1, 0]);
/// kg
pub static KILOGRAM: Unit = unit("kg", [1, 0, 0, 0]);
/// kg.m2
pub static KILOGRAM_METRE_SQUARED: Unit = unit("kg.m2", [1, 2, 0, 0]);
/// kg.m2/s, of angular momentum
pub static ANGULAR_MOMENTUM: Unit = unit("kg.m2/s", [1, 2, -1, 0]);
/// rad
pub static RADIAN: Unit = Unit { name: "rad", exponents: [0, 0, 0, 1], display: Some(("deg", 57.295_779_513_082_32)) };
/// rad/s
pub static RADIAN_PER_SECOND: Unit =
    Unit { name: "rad/s", exponents: [0, 0, -1, 1], display: Some(("rpm", 9.549_296_585_513_72)) };
/// rad/s2
pub static RADIAN_PER_SECOND_SQUARED: Unit = unit("rad/s2", [0, 0, -2, 1]);
/// N
pub static NEWTON: Unit = unit("N", [1, 1, -2, 0]);
/// N.m
pub static NEWTON_METRE: Unit = unit("N.m", [1, 2, -2, 0]);
/// N.m/s
pub static NEWTON_METRE_PER_SECOND: Unit = unit("N.m/s", [1, 2, -3, 0]);
/// N/m
pub static NEWTON_PER_METRE: Unit = unit("N/m", [1, 0, -2, 0]);
/// N.m/rad
pub static NEWTON_METRE_PER_RADIAN: Unit = unit("N.m/rad", [1, 2, -2, -1]);
/// N.s/m
pub static NEWTON_SECOND_PER_METRE: Unit = unit("N.s/m", [1, 0, -1, 0]);
/// N.m.s/rad
pub static NEWTON_METRE_SECOND_PER_RADIAN: Unit = unit("N.m.s/rad", [1, 2, -1, -1]);
/// N.m.s2/rad2
pub static NEWTON_METRE_SECOND_SQUARED_PER_RADIAN_SQUARED: Unit = unit("N.m.s2/rad2", [1, 2, 0, -2]);
/// J
pub static JOULE: Unit = unit("J", [1, 2, -2, 0]);
/// W
pub static WATT: Unit = unit("W", [1, 2, -3, 0]);
