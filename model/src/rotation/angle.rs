//! An angle of any size without loss: whole turns and the remainder apart.

use super::exact;
use std::f64::consts::TAU;

/// What the double nearest 2π lacks \[rad].
const TAU_LOW: f64 = 2.449_293_598_294_706_4e-16;

/// 2π·turns + remainder.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Angle {
    /// Whole turns, a whole number \[1].
    pub turns: f64,
    /// What is left \[rad], in [0, 2π) once wrapped.
    pub remainder: f64,
}

impl Angle {
    /// The same angle with its remainder in [0, 2π); where rounding gives 2π itself: 0 and one turn more.
    pub fn wrapped(self) -> Self {
        // eq. 20: φ = 2π·turns + angle, 2π·turns with its rounding error and with what the double of 2π lacks
        if (0.0..TAU).contains(&self.remainder) {
            return self;
        }
        let whole = (self.remainder / TAU).floor();
        let (high, low) = exact::product(whole, TAU);
        let remainder = ((self.remainder - high) - low) - whole * TAU_LOW;
        let turns = self.turns + whole;
        // `whole` may be one off where the remainder is within rounding of a whole turn.
        if remainder < 0.0 {
            Self { turns: turns - 1.0, remainder: remainder + TAU }.below_a_turn()
        } else {
            Self { turns, remainder }.below_a_turn()
        }
    }

    fn below_a_turn(self) -> Self {
        if self.remainder >= TAU { Self { turns: self.turns + 1.0, remainder: 0.0 } } else { self }
    }

    /// The angle as one number \[rad].
    pub fn radians(self) -> f64 {
        // eq. 20
        let (high, low) = exact::product(self.turns, TAU);
        high + (self.remainder + (low + self.turns * TAU_LOW))
    }
}
