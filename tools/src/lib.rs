//! What the commands of split-rotor and its Python package share: a run, the linear and the nonlinear view of a scene, the files of its
//! FMU. It knows no folder of the project and prints nothing.

pub mod accuracy;
pub mod archive;
pub mod campbell;
pub mod coupling;
pub mod course;
pub mod doubts;
pub mod fmu;
pub mod general;
pub mod numbers;
pub mod osp;
pub mod page;
pub mod peaks;
pub mod platform;
pub mod response;
pub mod rows;
pub mod run;
pub mod scenes;
pub mod speeds;
pub mod templates;
pub mod terminals;
