//! What an instance says, and which of it the host hears.

use split_rotor_model::log::{ALL, Category};

/// What a message means for the call in which it is sent.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Severity {
    /// All well.
    Ok,
    /// All well, but look at it.
    Warning,
    /// Not done; the instance stands where it stood, or at the last successful time.
    Discard,
    /// Refused; nothing changed.
    Error,
    /// The instance is lost.
    Fatal,
}

/// Hands a message on to the host.
pub type Callback = Box<dyn Fn(Severity, Category, &str)>;

/// Where messages go, and which.
pub struct Logger {
    callback: Option<Callback>,
    /// A set of [`Category`] bits.
    enabled: u8,
}

/// What a host hears unasked: errors, warnings and why a step could not be done.
const UNASKED: u8 = Category::Error.bit() | Category::Warning.bit() | Category::Discard.bit();
const EVERYTHING: u8 = u8::MAX;

impl Logger {
    /// A logger to a host that wants messages, or to one that does not; with `logging_on`, of everything.
    pub fn new(callback: Option<Callback>, logging_on: bool) -> Self {
        Self { callback, enabled: if logging_on { EVERYTHING } else { UNASKED } }
    }

    /// Enables these categories by name and disables the others; without names, all or none of them. An unknown name is
    /// returned, and nothing changed.
    pub fn choose<'n>(&mut self, on: bool, names: &[&'n str]) -> Result<(), &'n str> {
        let mut chosen = if names.is_empty() { EVERYTHING } else { 0 };
        for name in names {
            let category = Category::EACH.into_iter().find(|category| category.words().0 == *name);
            chosen |= match category {
                Some(category) => category.bit(),
                None if *name == ALL => EVERYTHING,
                None => return Err(name),
            };
        }
        self.enabled = if on { chosen } else { self.enabled & !chosen };
        Ok(())
    }

    /// Whether somebody listens to this category: what nobody hears need not be written.
    pub fn hears(&self, category: Category) -> bool {
        self.callback.is_some() && self.enabled & category.bit() != 0
    }

    /// Sends a message, if its category is enabled.
    pub fn log(&self, severity: Severity, category: Category, message: &str) {
        if let Some(callback) = self.callback.as_ref().filter(|_| self.hears(category)) {
            callback(severity, category, message);
        }
    }
}
