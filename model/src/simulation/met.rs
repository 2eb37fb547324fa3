//! The speeds that a motion came to, where the law of an effect may not be known at all of them.

use crate::effects::Effects;
use crate::rotor::Rotor;
use crate::stored::stored;

/// The lowest and the highest ω_φ so far [rad/s]; None where every law is known at each, so that nobody need look.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Met {
    speeds: Option<[f64; 2]>,
}

stored!(Met { speeds });

impl Met {
    /// The lowest and the highest [rad/s].
    pub fn speeds(&self) -> Option<[f64; 2]> {
        self.speeds
    }

    /// Looks at the rotor at time `t` \[s] and state `y`.
    pub fn look<E: Effects, const N: usize>(&mut self, rotor: &Rotor<'_, E>, t: f64, y: &[f64; N]) {
        if rotor.effects.is_doubtful() {
            *self = self.with(rotor.motion(t, y).axial_rate());
        }
    }

    /// The same and this ω_φ [rad/s].
    pub fn with(self, speed: f64) -> Self {
        let [low, high] = self.speeds.unwrap_or([speed; 2]);
        Self { speeds: Some([low.min(speed), high.max(speed)]) }
    }
}
