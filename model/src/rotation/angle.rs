//! An angle of any size without loss: whole turns and the remainder apart.

use std::f64::consts::TAU;

/// 2π in three parts whose products with a whole number below 2²⁰ are exact but for the last (Cody and Waite).
const TAU_HIGH: f64 = f64::from_bits(TAU.to_bits() & (u64::MAX << 27));
const TAU_MIDDLE: f64 = TAU - TAU_HIGH;
const TAU_LOW: f64 = 2.449_293_598_294_706_4e-16;

/// 2π·turns + remainder.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Angle {
    /// Whole turns, a whole number [1].
    pub turns: f64,
    /// What is left [rad], in [0, 2π) once wrapped.
    pub remainder: f64,
}

impl Angle {
    /// The same angle with its remainder in [0, 2π); where rounding gives 2π itself: 0 and one turn more.
    pub fn wrapped(self) -> Self {
        // eq. 20: φ = 2π·turns + angle
        let whole = (self.remainder / TAU).floor();
        if whole == 0.0 {
            return self;
        }
        let remainder = ((self.remainder - whole * TAU_HIGH) - whole * TAU_MIDDLE) - whole * TAU_LOW;
        let turns = self.turns + whole;
        // `whole` may be one off where the remainder is within rounding of a whole turn.
        if remainder < 0.0 {
            Self { turns: turns - 1.0, remainder: remainder + TAU }.below_a_turn()
        } else {
            Self { turns, remainder }.below_a_turn()
        }
    }

    fn below_a_turn(self) -> Self {
        if self.remainder < TAU { self } else { Self { turns: self.turns + 1.0, remainder: 0.0 } }
    }

    /// The angle as one number [rad].
    pub fn radians(self) -> f64 {
        // eq. 20
        TAU * self.turns + self.remainder
    }
}
