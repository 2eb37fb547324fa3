//! Messages to the host: ready-made, with `%` doubled because some hosts format them and others cannot pass arguments.
#![allow(unsafe_code)]

use crate::abi::{CallbackFunctions, Environment, LoggerCallback, Status};
use split_rotor_model::log::{ALL, Category};
use std::ffi::{CStr, CString};

/// Where messages go, and which. The host's struct of callbacks may be gone after fmi2Instantiate: this is a copy.
pub struct Logger {
    callback: Option<LoggerCallback>,
    environment: Environment,
    instance: CString,
    /// A set of [`Category`] bits.
    enabled: u8,
}

/// What a host hears unasked: errors, warnings and why a step could not be done.
const UNASKED: u8 = Category::Error.bit() | Category::Warning.bit() | Category::Discard.bit();
const EVERYTHING: u8 = u8::MAX;

impl Logger {
    /// A logger for an instance of this name; with `logging_on`, of everything.
    pub fn new(callbacks: &CallbackFunctions, instance: &CStr, logging_on: bool) -> Self {
        Self {
            callback: callbacks.logger,
            environment: callbacks.environment,
            instance: instance.to_owned(),
            enabled: if logging_on { EVERYTHING } else { UNASKED },
        }
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
    pub fn log(&self, status: Status, category: Category, message: &str) {
        let Some(callback) = self.callback.filter(|_| self.hears(category)) else { return };
        let c_string = |text: &str| CString::new(text.replace('\0', " ")).unwrap_or_default();
        let (message, name) = (c_string(&message.replace('%', "%%")), c_string(category.words().0));
        // SAFETY: the host promised a callback of this type that is valid as long as the instance is, and the strings
        // live until it returns. The message is a format without conversions, so no arguments follow.
        unsafe { callback(self.environment, self.instance.as_ptr(), status, name.as_ptr(), message.as_ptr()) };
    }
}
