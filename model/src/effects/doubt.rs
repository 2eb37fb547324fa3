//! Where a law is asked for what nobody gave it: it answers, and its user must know.

use crate::log::shown;
use std::f64::consts::PI;

/// What makes a law doubtful at speeds that a motion came to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Doubt {
    /// The size of the speed is below the first node of a table.
    Below {
        /// The speeds of its first and last node [rad/s].
        known: [f64; 2],
        /// The lowest that was met [rad/s].
        speed: f64,
    },
    /// It is beyond the last one.
    Beyond {
        /// The speeds of its first and last node [rad/s].
        known: [f64; 2],
        /// The highest that was met [rad/s].
        speed: f64,
    },
    /// The rotor turns backwards, and constants that drive forward whirl at positive spin drive backward whirl there.
    Backward {
        /// The speed that was met, of the largest size [rad/s].
        speed: f64,
    },
}

/// A speed that is beyond a node by less than this part of it is at the node but for rounding \[1].
const EDGE: f64 = 1e-9;

impl Doubt {
    /// What a table that is known between these speeds leaves open of ω_φ between those [rad/s].
    pub fn of_table(known: [f64; 2], [low, high]: [f64; 2]) -> [Option<Self>; 2] {
        let largest = high.max(-low);
        let smallest = if low <= 0.0 && high >= 0.0 { 0.0 } else { low.abs().min(high.abs()) };
        let below = (smallest < known[0] * (1.0 - EDGE)).then_some(Self::Below { known, speed: smallest });
        let beyond = (largest > known[1] * (1.0 + EDGE)).then_some(Self::Beyond { known, speed: largest });
        [below, beyond]
    }

    /// Whether both are of one kind.
    pub fn is_like(&self, other: &Self) -> bool {
        std::mem::discriminant(self) == std::mem::discriminant(other)
    }

    /// What to warn of, about the effect of this name.
    pub fn words(&self, block: &str) -> String {
        match self {
            Self::Below { known, speed } => format!(
                "{block}: speeds down to {} are below its table, which is known from {} to {}: there the coefficients of its \
                 first node are held, and cross terms go to 0 with the speed",
                in_both(*speed),
                in_both(known[0]),
                in_both(known[1])
            ),
            Self::Beyond { known, speed } => format!(
                "{block}: speeds up to {} are beyond its table, which is known from {} to {}: there the coefficients of its \
                 last node are held",
                in_both(*speed),
                in_both(known[0]),
                in_both(known[1])
            ),
            Self::Backward { speed } => format!(
                "{block}: the rotor turns backwards, at {}, and the constants kyz and kzy keep their sign: a whirl that they \
                 drive with the spin forwards goes against it here; a table (speed = [...]) changes their signs with the speed",
                in_both(*speed)
            ),
        }
    }
}

/// A speed [rad/s], in rpm too.
fn in_both(speed: f64) -> String {
    let [own, rpm] = [speed, speed * 30.0 / PI].map(shown);
    format!("{own:?} rad/s ({rpm:?} rpm)")
}
