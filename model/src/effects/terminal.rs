//! What an effect offers to other models.

/// A terminal: the inputs and outputs of an effect under one name, so that a tool connects them all at once (FMI 3.0,
/// 2.4.9, which FMI 2.0.4 takes over). The name is that of the effect's block.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Terminal {
    /// What may be connected to it.
    pub kind: &'static str,
    /// Those of its members that add up to zero where terminals meet, counted into the rotor; the others are equal there.
    pub flows: &'static [&'static str],
}
