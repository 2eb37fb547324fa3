//! Why a call was refused.

use split_rotor_model::error::Invalid;
use split_rotor_model::integrate::Refusal;

/// Why a call was refused: what is wrong, and what would be right.
#[derive(Debug)]
pub enum Failure {
    /// Bad arguments or a bad sequence; nothing changed.
    Error(String),
    /// What cannot be done or calculated here, though the call is right.
    Discard(String),
}

impl From<Invalid> for Failure {
    fn from(invalid: Invalid) -> Self {
        Self::Error(invalid.to_string())
    }
}

impl From<Refusal> for Failure {
    fn from(refusal: Refusal) -> Self {
        Self::Discard(refusal.0.into())
    }
}

/// Nothing, or why a call was refused.
pub type Reply = Result<(), Failure>;
