//! What is known of an effect, or of the effects of a list together, while it is compiled.

use crate::state::Layout;

/// What an effect can do, with any parameters and inputs, and how much room it needs.
#[derive(Clone, Copy, Debug)]
pub struct Facts {
    /// How many effects there are.
    pub count: usize,
    /// Whether any can be switched off; set by the entry of a list.
    pub switched: bool,
    /// How many inputs may be extrapolated; set by the entry of a list.
    pub extrapolated: usize,
    /// How many states of its own it has, at most [`MOST_OWN`](super::MOST_OWN): numbers that are integrated with the motion.
    pub own: usize,
    /// How many of its outputs are loads whose errors count, each a vector, at most [`MOST_LOADS`](super::MOST_LOADS).
    pub loads: usize,
    /// How many [indicators](super::Effect::indicator) it has; one that has any keeps its branch in its [memory](super::Effect::memory).
    pub indicators: usize,
    /// How many effects may have a [partner](super::Effect::exchange), whose law it goes on with.
    pub partners: usize,
    /// Whether its outputs are the velocity of a station.
    pub shows_velocity: bool,
    /// Whether it can lose energy or be supplied with it. To forget to deny it costs time, not energy.
    pub could_work: bool,
    /// Whether it can apply a load or impose a speed, other than a force at the mass centre that nothing changes.
    pub pushes: bool,
    /// Whether it can [shape](super::Effect::shape) the body. A scene without such effects is compiled for a symmetric rotor.
    pub shapes: bool,
    /// Whether what it does follows φ, so that φ is no quadrature where it is at work; what shapes the body always does.
    pub follows_phi: bool,
    /// Whether its law is analytic in everything that it depends on, so that its motion has power series in time.
    pub analytic: bool,
    /// Whether its law may be [doubtful](super::Effect::doubts) at some speeds.
    pub may_be_doubted: bool,
    /// Whether it can [impose](super::Effect::imposed) a speed.
    pub imposes: bool,
    /// Whether it [extrapolates](super::Effect::extrapolate) inputs.
    pub extrapolates: bool,
    /// How many inputs it can extrapolate at most.
    pub most_extrapolated: usize,
    /// Whether its own inputs tell one another's rates, so that nobody need extrapolate them.
    pub tells_rates: bool,
}

impl Facts {
    /// Of nothing.
    pub(super) const NONE: Self = Self {
        count: 0,
        switched: false,
        extrapolated: 0,
        own: 0,
        loads: 0,
        indicators: 0,
        partners: 0,
        shows_velocity: false,
        could_work: false,
        pushes: false,
        shapes: false,
        follows_phi: false,
        analytic: true,
        may_be_doubted: false,
        imposes: false,
        extrapolates: false,
        most_extrapolated: usize::MAX,
        tells_rates: false,
    };

    /// Of an effect that says nothing else.
    pub const USUAL: Self = Self { count: 1, could_work: true, pushes: true, ..Self::NONE };

    /// Of both together.
    pub const fn and(self, other: Self) -> Self {
        let most = [self.most_extrapolated, other.most_extrapolated];
        Self {
            count: self.count + other.count,
            switched: self.switched || other.switched,
            extrapolated: self.extrapolated + other.extrapolated,
            own: self.own + other.own,
            loads: self.loads + other.loads,
            indicators: self.indicators + other.indicators,
            partners: self.partners + other.partners,
            shows_velocity: self.shows_velocity || other.shows_velocity,
            could_work: self.could_work || other.could_work,
            pushes: self.pushes || other.pushes,
            shapes: self.shapes || other.shapes,
            follows_phi: self.follows_phi || other.follows_phi,
            analytic: self.analytic && other.analytic,
            may_be_doubted: self.may_be_doubted || other.may_be_doubted,
            imposes: self.imposes || other.imposes,
            extrapolates: self.extrapolates || other.extrapolates,
            most_extrapolated: if most[0] < most[1] { most[0] } else { most[1] },
            tells_rates: self.tells_rates || other.tells_rates,
        }
    }

    /// Where everything stands in a state of `n` numbers of a rotor under these effects.
    #[inline(always)]
    pub const fn layout(&self, n: usize) -> Layout {
        let layout = Layout::new(self.own, n != Layout::new(self.own, false).count());
        assert!(layout.count() == n, "a state has coordinates and own states, and room for both works or none");
        layout
    }
}
