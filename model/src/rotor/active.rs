//! What the active effects do, asked once and not in each evaluation.

use crate::effects::Effects;
use crate::stored::stored;

/// Of effects that stay switched as they are.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Active {
    /// Whether one of them can lose energy or be supplied with it.
    pub works: bool,
    /// Which indicators are those of effects that have events, a bit each.
    events: u32,
    /// Whether one of them follows φ.
    pub follows_phi: bool,
    /// Whether one of them has loads whose errors count.
    pub has_loads: bool,
    /// How many own states the effects have that are switched off.
    pub idle: u32,
}

stored!(Active { works, events, follows_phi, has_loads, idle });

impl Active {
    /// Asks these effects.
    pub fn of<E: Effects>(effects: &E) -> Self {
        let active: usize = effects.active().map(|block| block.kind().facts.own).sum();
        let (mut events, mut first) = (0, 0);
        for block in effects.blocks() {
            let count = block.kind().facts.indicators;
            if block.is_active() && block.has_events() {
                events |= ((1 << count) - 1) << first;
            }
            first += count;
        }
        Self {
            works: effects.works(),
            events,
            follows_phi: effects.follows_phi(),
            has_loads: effects.active().any(|block| block.kind().facts.loads > 0),
            idle: (E::FACTS.own - active) as u32,
        }
    }

    /// Whether one of them has events.
    pub fn has_events(&self) -> bool {
        self.events != 0
    }

    /// Whether the indicator with this index is that of an effect that has events.
    pub(crate) fn watches(&self, number: usize) -> bool {
        self.events >> number & 1 == 1
    }
}
