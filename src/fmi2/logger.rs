//! Messages to the host: ready-made, with `%` doubled because some hosts format them and others cannot pass arguments.
#![allow(unsafe_code)]

use super::abi::{CallbackFunctions, Status};
use crate::instance::{Logger, Severity};
use split_rotor_model::log::Category;
use std::ffi::{CStr, CString};

impl From<Severity> for Status {
    fn from(severity: Severity) -> Self {
        match severity {
            Severity::Ok => Status::Ok,
            Severity::Warning => Status::Warning,
            Severity::Discard => Status::Discard,
            Severity::Error => Status::Error,
            Severity::Fatal => Status::Fatal,
        }
    }
}

/// The logger of an instance of this name. The host's struct of callbacks may be gone after fmi2Instantiate, so its
/// members are copied.
pub fn logger(callbacks: &CallbackFunctions, instance: &CStr, logging_on: bool) -> Logger {
    let (environment, instance) = (callbacks.environment, instance.to_owned());
    let send = callbacks.logger.map(|callback| {
        let send = move |severity: Severity, category: Category, message: &str| {
            let c_string = |text: &str| CString::new(text.replace('\0', " ")).unwrap_or_default();
            let (message, name) = (c_string(&message.replace('%', "%%")), c_string(category.words().0));
            // SAFETY: the host promised a callback of this type that is valid as long as the instance is, and the strings
            // live until it returns. The message is a format without conversions, so no arguments follow.
            unsafe { callback(environment, instance.as_ptr(), severity.into(), name.as_ptr(), message.as_ptr()) };
        };
        Box::new(send) as _
    });
    Logger::new(send, logging_on)
}
