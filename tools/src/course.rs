//! Inputs over time: a run stops wherever one of them bends or jumps, and is told how it goes on.

use split_rotor_model::scene::{Input, Scene};
use split_rotor_model::variable::Place;

/// What inputs drive.
pub trait Driven {
    /// Why it does not go on.
    type Error;

    /// Goes from one time to another \[s].
    fn go(&mut self, from: f64, to: f64) -> Result<(), Self::Error>;

    /// Gives the input at this place a value and a rate, each in its unit.
    fn steer(&mut self, input: Place, course: [f64; 2]) -> Result<(), Self::Error>;
}

/// The inputs over time of a scene.
pub struct Course<'s> {
    inputs: Vec<(&'s Input, Place)>,
    /// When any of them bends or jumps \[s], ascending.
    bends: Vec<f64>,
}

impl<'s> Course<'s> {
    /// Of this scene.
    pub fn of(scene: &'s Scene) -> Self {
        let place = |name: &str| scene.variables.iter().find(|variable| variable.name == name).map(|it| it.place);
        let inputs = scene.inputs.iter().filter_map(|input| Some((input, place(&input.name)?))).collect();
        let mut bends: Vec<_> = scene.inputs.iter().flat_map(|input| &input.time).copied().collect();
        bends.sort_by(f64::total_cmp);
        bends.dedup();
        Self { inputs, bends }
    }

    /// The inputs, each with its value from time `t` \[s] on.
    pub fn values(&self, t: f64) -> impl Iterator<Item = (Place, f64)> {
        self.inputs.iter().map(move |(input, place)| (*place, input.from(t)[0]))
    }

    /// Gives all inputs their course from time `t` \[s] on.
    pub fn begin<D: Driven>(&self, driven: &mut D, t: f64) -> Result<(), D::Error> {
        self.steer(driven, t, |_| true)
    }

    /// Goes from one time to another \[s], with a stop wherever an input bends or jumps.
    pub fn go<D: Driven>(&self, driven: &mut D, from: f64, to: f64) -> Result<(), D::Error> {
        let [first, after] = [from, to].map(|t| self.bends.partition_point(|bend| *bend < t));
        let mut at = from;
        for &bend in &self.bends[first..after] {
            if bend > at {
                driven.go(at, bend)?;
                at = bend;
            }
            self.steer(driven, bend, |input| input.time.contains(&bend))?;
        }
        driven.go(at, to)
    }

    fn steer<D: Driven>(&self, driven: &mut D, t: f64, which: impl Fn(&Input) -> bool) -> Result<(), D::Error> {
        let those = self.inputs.iter().filter(|(input, _)| which(input));
        those.into_iter().try_for_each(|(input, place)| driven.steer(*place, input.from(t)))
    }
}
