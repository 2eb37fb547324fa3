//! `cargo xtask`: the commands of split-rotor. One file a command; `cargo xtask --help` lists them.

mod accuracy;
mod bench;
mod c;
mod c_host;
mod demo;
mod fmu;
mod fuzz;
mod licences;
mod memcheck;
mod package;
mod page;
mod paths;
mod python;
mod run;
mod sanitize;
mod scenes;
mod sheet;
mod templates;
mod terminals;
mod test;
mod unpacked;

use anyhow::Result;
use clap::{Parser, Subcommand};
use std::path::PathBuf;
use std::process::ExitCode;

/// The commands of split-rotor. SCENE is a name in scenes/ or a path to a TOML file of your own.
#[derive(Parser)]
#[command(name = "cargo xtask", bin_name = "cargo xtask")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Package a scene, simulate the FMU with fmpy, check its energy and write a report with pictures
    Demo {
        /// The scene
        #[arg(default_value = "paper")]
        scene: String,
    },
    /// Run the tests: Rust, equal bits in every build, and the packaged FMUs under fmpy
    Test {
        /// The long ones too: third-party clients
        #[arg(long)]
        long: bool,
    },
    /// Package scenes as target/fmu/<scene>.fmu
    Package {
        /// The scenes
        #[arg(default_value = "paper")]
        scenes: Vec<String>,
        /// Where the FMUs go
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
    },
    /// Measure error against time for every method: table, SVG, CSV and JSON in target/accuracy/<scene>
    Accuracy {
        /// The scene
        #[arg(default_value = "paper")]
        scene: String,
        /// Also what a user would pick instead: heyoka, SciPy, CVODE, Exudyn, MuJoCo, and two Rust crates
        #[arg(long)]
        peers: bool,
    },
    /// Measure what calls of the FMU, the right-hand side and the methods' steps take: times, and instructions where
    /// valgrind is installed
    Bench,
    /// List the scenes and the effects that each calls for
    Scenes,
    /// Print a scene's modelDescription.xml
    Describe {
        /// The scene
        #[arg(default_value = "paper")]
        scene: String,
    },
}

fn main() -> ExitCode {
    match dispatch(Arguments::parse().command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            eprintln!("error: {error:#}");
            ExitCode::FAILURE
        }
    }
}

fn dispatch(command: Command) -> Result<()> {
    match command {
        Command::Demo { scene } => demo::demo(&scene),
        Command::Test { long } => test::test(long),
        Command::Package { scenes, out } => package::package(&scenes, out.as_deref()).map(drop),
        Command::Accuracy { scene, peers } => accuracy::accuracy(&scene, peers).map(drop),
        Command::Bench => bench::bench(),
        Command::Scenes => scenes::list(),
        Command::Describe { scene } => scenes::describe(&scene),
    }
}
