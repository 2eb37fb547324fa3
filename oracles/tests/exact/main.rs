//! Every exact answer against something that it was not made from.

mod elliptic;
mod fixed;
mod limited_power;
mod machine;
mod monotone;
mod motion;
mod numerics;
mod paper;
mod rigid_body;
mod top;
mod whirl;
