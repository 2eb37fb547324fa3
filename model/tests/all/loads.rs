//! Loads as groups of the error: what they are made of.

use crate::harness::{properties, within};
use nalgebra::Vector2;
use proptest::prelude::*;
use split_rotor_model::dual::Dual;
use split_rotor_model::rotation::{Chart, Tilt};

/// The change of the axis relative to that of dual numbers [1]: measured 2.4e-9, of the series near the joint with the closed form.
const CHANGE: f64 = 1e-8;

proptest! {
    #![proptest_config(properties(2000))]

    #[test]
    fn exact_axis_change_is_the_derivative(
        theta in prop_oneof![0.0..1e-3, 0.05..0.15, 0.0..3.1], azimuth in -3.2..3.2, way in -3.2..3.2, from_e: bool
    ) {
        let chart = if from_e { Chart::FromE } else { Chart::FromMinusE };
        let at = |size: f64, angle: f64| Vector2::new(libm::cos(angle), libm::sin(angle)) * size;
        let (gamma, change) = (at(theta, azimuth), at(1.0, way));
        let moving = gamma.zip_map(&change, Dual::along);
        let exact = Tilt::<Dual<1>>::new(chart, moving).axis.map(|t| t.eps[0]);
        let found = Tilt::new(chart, gamma).axis_change(&change);
        within("change of the axis", (found - exact).norm(), CHANGE);
    }
}
