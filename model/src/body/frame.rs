//! How the motion of a body is written: the chart of its tilt, the whole turns of φ beside it, and how far one step may take both.

use super::Inertia;
use crate::integrate::Refusal;
use crate::rotation::chart::{azimuth_change, crossed_exactly};
use crate::rotation::{Angle, Chart};
use crate::stored::{Damaged, Stored, Walk, whole};
use nalgebra::Vector2;
use std::f64::consts::TAU;

/// A body, and how its motion is written.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Frame {
    /// The body.
    pub body: Inertia,
    /// The active chart.
    pub chart: Chart,
    /// Whole turns of φ, stored separately.
    pub turns: f64,
}

impl Stored for Frame {
    fn walk(&mut self, walk: &mut impl Walk) -> Result<(), Damaged> {
        let Self { body, chart, turns } = self;
        body.walk(walk)?;
        chart.walk(walk)?;
        whole(turns, walk)
    }
}

/// φ \[rad] advances by at most so much in a step: further, a double near 0 and one so large differ too much in their
/// last place for the remainder of φ to stay exact.
const LONGEST_TURN: f64 = 16.0 * TAU;

/// γ \[rad] advances by about so much at most in a step: through −e it goes nearly straight, and no error estimate would
/// keep the step from growing beyond what its dense output can follow. A power series can be read wherever it is right.
const LONGEST_TILT: f64 = 1.0;

/// The azimuth of γ from −e \[rad] advances by about so much at most in a step, so that its turns can be counted.
const LONGEST_WHIRL: f64 = 1.0;

/// Where the azimuth of γ turns by more than this in a step \[rad], the way past the origin is looked at closely: on a
/// curved path it may have turned by more than π. Steady whirl turns by less ([`LONGEST_WHIRL`]).
const MUCH: f64 = 1.2;

const BEYOND_REACH: Refusal = Refusal("the axis turns too far for one chart, however short the step");

const BEYOND_CHART: Refusal = Refusal(
    "|gamma| of the continuous states exceeds 3.1 rad, too far for their chart: complete a step earlier, so that an event \
     can change it",
);

impl Frame {
    /// How many indicators of events it has.
    pub const INDICATORS: usize = 4;

    /// The frame in which a motion begins, and γ and φ \[rad] in it, from γ and φ \[rad] from e.
    pub fn begin(body: Inertia, gamma: Vector2<f64>, phi: f64) -> (Self, Vector2<f64>, f64) {
        let (chart, gamma) = Chart::best(gamma);
        let phi = chart.own_angle(Angle { turns: 0.0, remainder: phi }.wrapped(), gamma);
        (Self { body, chart, turns: phi.turns }, gamma, phi.remainder)
    }

    /// Goes on in the other chart if γ \[rad] leaves this one; returns γ and φ \[rad] there.
    #[inline(always)]
    pub fn leave(&mut self, gamma: Vector2<f64>, phi: f64) -> Option<(Vector2<f64>, f64)> {
        self.chart.is_left_at(gamma).then(|| self.cross(gamma, phi))
    }

    /// [`Frame::leave`] where it does: seldom, so it is called.
    #[cold]
    #[inline(never)]
    fn cross(&mut self, gamma: Vector2<f64>, phi: f64) -> (Vector2<f64>, f64) {
        let phi = self.chart.axial_angle(self.turns, phi, gamma);
        let crossed = crossed_exactly(gamma);
        self.chart = self.chart.other();
        let phi = self.chart.own_angle(phi, crossed);
        self.turns = phi.turns;
        (crossed, phi.remainder)
    }

    /// φ \[rad] in [0, 2π); its whole turns are counted here.
    pub fn wrap(&mut self, phi: f64) -> f64 {
        let phi = Angle { turns: self.turns, remainder: phi }.wrapped();
        self.turns = phi.turns;
        phi.remainder
    }

    /// φ \[rad] with all its turns, which no longer count here.
    pub fn unwrap(&mut self, phi: f64) -> f64 {
        Angle { turns: std::mem::take(&mut self.turns), remainder: phi }.radians()
    }

    /// The indicators of events at this γ \[rad]: of the chart, of γ about −e, and, under a law that is undefined at π, of its limit.
    pub fn indicators(&self, gamma: Vector2<f64>, needs_gamma: bool) -> [f64; Self::INDICATORS] {
        let about = if self.chart == Chart::FromMinusE { [gamma.x, gamma.y] } else { [1.0; 2] };
        let limit = if needs_gamma { self.chart.before_limit(gamma) } else { 1.0 };
        [self.chart.before_border(gamma), about[0], about[1], limit]
    }

    /// Refuses γ \[rad] beyond this reach \[rad] of the chart.
    pub fn reaches(&self, gamma: Vector2<f64>, reach: f64) -> Result<(), Refusal> {
        if gamma.norm_squared() > reach * reach {
            return Err(if reach < Chart::LIMIT { BEYOND_REACH } else { BEYOND_CHART });
        }
        Ok(())
    }

    /// The longest step \[s] that chart and turns allow, if the next one takes `h` \[s]; γ \[rad] and φ \[rad] have these rates [rad/s].
    #[inline(always)]
    pub fn longest_step(&self, h: f64, gamma: Vector2<f64>, rate: Vector2<f64>, phi_rate: f64, is_series: bool) -> f64 {
        // Mostly nothing limits the step, and products show that: divisions and roots would hold up the next step.
        let (mut longest, turning) = (h, phi_rate.abs());
        if h * turning > LONGEST_TURN {
            longest = LONGEST_TURN / turning;
        }
        // At its present rate γ stays within reach of its chart.
        let tilt = if is_series { Chart::REACH } else { LONGEST_TILT };
        let far = gamma.norm_squared() < (Chart::REACH - tilt) * (Chart::REACH - tilt);
        if !far || rate.norm_squared() * h * h >= tilt * tilt {
            longest = longest.min((Chart::REACH - gamma.norm()).min(tilt) / rate.norm());
        }
        if self.chart == Chart::FromMinusE {
            // dβ/dt = e·(γ×dγ/dt)/|γ|²
            longest = longest.min(LONGEST_WHIRL * gamma.norm_squared() / gamma.perp(&rate).abs());
        }
        longest
    }
}

/// What must be known of a step of a body to read it.
#[derive(Clone, Copy, Default)]
pub struct Step {
    /// Its chart; the body may go on in the other one.
    pub chart: Chart,
    /// Whole turns of φ at its start.
    pub turns: f64,
    /// γ \[rad] at its start.
    pub gamma: Vector2<f64>,
    /// When \[s] and where \[rad] γ came closest to the origin, if its azimuth turned much.
    pub closest: Option<(f64, Vector2<f64>)>,
}

impl Stored for Step {
    fn walk(&mut self, walk: &mut impl Walk) -> Result<(), Damaged> {
        let Self { chart, turns, gamma, closest } = self;
        chart.walk(walk)?;
        whole(turns, walk)?;
        gamma.walk(walk)?;
        closest.walk(walk)
    }
}

impl Step {
    /// A step that begins in this frame at γ \[rad].
    pub fn from(frame: &Frame, gamma: Vector2<f64>) -> Self {
        Self { chart: frame.chart, turns: frame.turns, gamma, closest: None }
    }

    /// Whether the azimuth turned so far on the way to this γ \[rad] that counting turns needs the point closest to the origin.
    pub fn turns_much(&self, to: Vector2<f64>) -> bool {
        azimuth_change(self.gamma, to).abs() > MUCH
    }

    /// The whole turns of φ that go with γ \[rad] at a time `t` \[s] of the step.
    pub fn turns_at(&self, t: f64, gamma: Vector2<f64>) -> f64 {
        let past = self.closest.filter(|(when, _)| *when < t).map(|(_, closest)| closest);
        self.turns + self.chart.turns_gained(self.gamma, past.into_iter().chain([gamma]))
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::PI;

    #[test]
    fn exact_a_chart_is_left_and_entered_again_without_a_trace() {
        /// Of |γ| and φ \[rad]; measured 4.4e-16 each, allow 2e-15.
        const APART: f64 = 2e-15;
        /// Of φ beside a million turns \[rad]; measured 3.6e-10, allow the last place of all of it.
        const UNWRAPPED: f64 = 1e-9;
        for azimuth in [-3.0, -1.2, 0.0, 0.4, 3.1] {
            let (tilt, phi) = (Vector2::new(libm::cos(azimuth), libm::sin(azimuth)), 1.7);
            let mut frame = Frame { turns: 1e6, ..Frame::default() };
            assert!(frame.leave(tilt * 1.9, phi).is_none(), "it stays where it is");
            let (crossed, own) = frame.leave(tilt * 2.1, phi).expect("beyond the border");
            assert!(frame.chart == Chart::FromMinusE && (crossed.norm() - (PI - 2.1)).abs() < APART);
            let angle = frame.chart.axial_angle(frame.turns, own, crossed);
            assert!(angle.turns == 1e6 && (angle.remainder - phi).abs() < APART, "{azimuth}: {angle:?}");
            // As a host integrates it, and back.
            let turns = frame.turns;
            let all = frame.unwrap(own);
            assert_eq!(frame.turns, 0.0);
            let again = frame.wrap(all);
            assert!(frame.turns == turns && (again - own).abs() < UNWRAPPED, "{azimuth}: {again:?}, not {own:?}");
        }
    }

    #[test]
    fn exact_turns_on_both_sides_of_the_closest_place() {
        let frame = Frame { chart: Chart::FromMinusE, turns: 3.0, ..Frame::default() };
        let step = Step::from(&frame, Vector2::new(-1.0, 0.1));
        // Past the origin on the side where the azimuth passes its cut at ±π, and on the other.
        for (closest, turns) in [(Vector2::new(-0.1, -0.1), 5.0), (Vector2::new(0.1, 0.1), 3.0)] {
            let step = Step { closest: Some((0.5, closest)), ..step };
            assert_eq!(step.turns_at(0.4, Vector2::new(-0.8, 0.1)), 3.0);
            assert_eq!(step.turns_at(1.0, Vector2::new(0.6, -0.9)), turns, "by {closest:?}");
        }
    }
}
