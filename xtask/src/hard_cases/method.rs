//! The methods that cases are run with.

use anyhow::{Context, Result};
use split_rotor_model::variables::METHODS;

/// A method and what chooses its accuracy.
#[derive(Clone, Debug)]
pub struct Method {
    /// Its name.
    pub name: &'static str,
    /// What is set beside it.
    pub settings: Vec<(&'static str, f64)>,
}

impl Method {
    /// Its number.
    pub fn number(&self) -> Result<i32> {
        let found = METHODS.items.iter().find(|item| item.1 == self.name);
        Ok(found.with_context(|| format!("there is no method {}", self.name))?.0)
    }

    /// As a table shows it: `dop853 at 1e-12`, `symplectic 6, 0.01 s`.
    pub fn label(&self) -> String {
        let of = |name: &str| self.settings.iter().find(|setting| setting.0 == name).map(|setting| setting.1);
        match (of("solver.order"), of("solver.step_size"), of("solver.relative_tolerance")) {
            (Some(order), Some(h), _) => format!("{} {order}, {h:?} s", self.name),
            (.., Some(tolerance)) => format!("{} at {tolerance:e}", self.name),
            _ => self.name.into(),
        }
    }
}

/// An adaptive method, or `auto`, at this relative tolerance.
pub fn at(name: &'static str, tolerance: f64) -> Method {
    Method { name, settings: vec![("solver.relative_tolerance", tolerance)] }
}

/// The composition of this order in steps of `h` \[s].
pub fn symplectic(order: u32, h: f64) -> Method {
    Method { name: "symplectic", settings: vec![("solver.order", f64::from(order)), ("solver.step_size", h)] }
}

/// The methods that most cases are run with, each with the bound of its error: dop853 and dopri5 at 1e-12, stiff at 1e-10, and
/// others.
pub fn usual(bounds: [f64; 3], others: impl IntoIterator<Item = (Method, f64)>) -> Vec<(Method, f64)> {
    let methods = [at("dop853", 1e-12), at("dopri5", 1e-12), at("stiff", 1e-10)];
    methods.into_iter().zip(bounds).chain(others).collect()
}
