//! `cargo xtask`: the commands of split-rotor. One file a command; `cargo xtask --help` lists them.

mod abroad;
mod accuracy;
mod alone;
mod bench;
mod c;
mod c_host;
mod campbell;
mod chart;
mod copies;
mod coupling;
mod debug;
mod demo;
mod describe;
mod docs;
#[cfg(test)]
mod documents;
mod frequency;
mod fuzz;
mod hard_cases;
mod known;
mod library;
mod licences;
mod linear_fmu;
mod memcheck;
mod osp;
mod package;
mod paths;
mod platforms;
mod progress;
mod python;
mod report;
mod response;
mod ross;
mod run;
mod sanitize;
mod scenes;
mod sheet;
mod sheets;
mod simulate;
mod ssp;
mod ssv;
mod stability;
mod state_space;
mod test;
mod unpacked;
mod wheel;

use accuracy::Peers;
use anyhow::{Result, anyhow, ensure};
use clap::{Parser, Subcommand};
use hard_cases::Extent;
use split_rotor_model::scene::{Given, SceneError};
use split_rotor_model::variable::units::RADIAN_PER_SECOND;
use split_rotor_tools::{fmu, numbers, peaks, speeds};
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
    /// Package a scene, simulate the FMU with fmpy, check its energy and write an interactive report, one HTML file
    Demo {
        /// The scene
        #[arg(default_value = "paper")]
        scene: String,
    },
    /// Run the tests: Rust, equal bits in every build, and the packaged FMUs under fmpy
    Test {
        /// Only jobs whose names hold this
        #[arg(default_value = "")]
        part: String,
        /// The long ones too: third-party clients
        #[arg(long)]
        long: bool,
        /// Of the long ones also those that have not changed since they last ran
        #[arg(long, requires = "long")]
        all: bool,
    },
    /// Package scenes as target/fmu/SCENE.fmu
    Package {
        /// The scenes
        #[arg(default_value = "paper")]
        scenes: Vec<String>,
        /// Where the FMUs go
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
        /// For which platforms, with commas between: `here` is this machine and its like, which is the quickest. Without it, for all
        /// for which nothing must be fetched
        #[arg(long, value_delimiter = ',', value_name = "PLATFORM", value_parser = platforms::NAMES)]
        platforms: Vec<String>,
        /// Beside each FMU also SCENE_OspModelDescription.xml: its ports and drives as groups that tools of the Open Simulation Platform
        /// connect
        #[arg(long)]
        osp: bool,
        /// Beside each FMU also SCENE.ssp, a system of SSP 1.0: the FMU, its parameter set, its inputs and outputs with units, its partners
        #[arg(long)]
        ssp: bool,
        #[arg(
            long = "partner",
            help = "With --ssp, connect an FMU to a port or drive of the scene, by the names of their variables: --partner \"port[1]=bearing.fmu\". \
                    Repeat it for each partner",
            value_name = "TERMINAL=FMU",
            requires = "ssp"
        )]
        partners: Vec<ssp::Partner>,
        /// With --ssp, also connectors at the boundary of the system for what is free. libcosim 0.0.6 and ecos 0.7.2 open no such system;
        /// without it free inputs keep their start values
        #[arg(long, requires = "ssp")]
        boundary: bool,
    },
    /// Simulate a scene without packaging it, in a moment: a summary, a report with pictures, and every output as CSV in target/run/SCENE
    Run {
        /// The scene
        #[arg(default_value = "paper")]
        scene: String,
        /// Only the summary and the CSV
        #[arg(long)]
        no_report: bool,
        /// Into this folder
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
    },
    /// Measure error against time for every method: table, SVG, CSV and JSON in target/accuracy/SCENE
    Accuracy {
        /// The scene
        #[arg(default_value = "paper")]
        scene: String,
        /// Also what a user would pick instead: heyoka, SciPy, CVODE, Exudyn, MuJoCo, and two Rust crates
        #[arg(long)]
        peers: bool,
        /// Instead the error over the tolerance of all scenes, into docs/accuracy.md and docs/accuracy/tolerances.csv
        #[arg(long, conflicts_with_all = ["scene", "peers", "out"])]
        tolerances: bool,
        /// With the FMUs in target/fmu, as they were packaged last
        #[arg(long, requires = "tolerances")]
        packaged: bool,
        /// Into this folder
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
    },
    /// Run the gallery of hard cases, each against an exact or independent answer: table, CSV and JSON in target/hard-cases
    HardCases {
        /// Only cases whose names hold this
        part: Option<String>,
        /// Long cases shortened
        #[arg(long)]
        short: bool,
        /// Each row once more with a wrong constant or sign, which must make it fail
        #[arg(long)]
        mutants: bool,
        /// With the FMUs in target/fmu, as they were packaged last
        #[arg(long)]
        packaged: bool,
    },
    /// Measure what calls of the FMU, the right-hand side and the methods' steps take: times, and instructions where
    /// valgrind is installed
    Bench {
        /// Only tables whose names hold this: calls, scenes, effects, general, off, counts, times
        #[arg(default_value = "")]
        part: String,
        /// Draws the sets of effects of `general`
        #[arg(long)]
        seed: Option<u64>,
    },
    /// Draw whirl frequencies and damping against the spin, find critical speeds and the threshold of stability: table, SVG, CSV and
    /// JSON in target/campbell/SCENE
    Campbell {
        /// The scene
        #[arg(default_value = "paper")]
        scene: String,
        /// The first and the last speed, in rad/s or with a unit: 0 "3000 rpm"; else from 0 to half as much again as the scene reaches
        #[arg(long, num_args = 2, value_names = ["FROM", "TO"], allow_hyphen_values = true)]
        speeds: Option<Vec<String>>,
        /// How many speeds
        #[arg(long, default_value_t = campbell::STEPS)]
        steps: u32,
        /// Lines of the speed's multiples, whose crossings are critical speeds
        #[arg(long, num_args = 1.., value_name = "X", default_values_t = campbell::ORDERS)]
        orders: Vec<f64>,
        /// Into this folder
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
    },
    /// Find how an unbalance makes the machine whirl against the spin: half axes and phases of the orbits at its probes or bearings, by the
    /// linear equations and by the laws as they stand; with --from and --to how an output answers an input: table, SVG, CSV and JSON in
    /// target/response/SCENE
    Response {
        /// The scene
        #[arg(default_value = "jeffcott")]
        scene: String,
        /// The first and the last speed, in rad/s or with a unit: 0 "3000 rpm"; else from 0 to half as much again as the scene reaches
        #[arg(long, num_args = 2, value_names = ["FROM", "TO"], allow_hyphen_values = true)]
        speeds: Option<Vec<String>>,
        /// How many speeds, or frequencies
        #[arg(long, default_value_t = 401)]
        steps: u32,
        /// Only by the linear equations, which takes no time
        #[arg(long)]
        linear: bool,
        #[arg(
            long,
            help = "Instead the frequency response to this input, such as port[1].f.y: Bode's and Nyquist's pictures",
            value_name = "INPUT",
            requires = "to",
            conflicts_with_all = ["speeds", "linear"]
        )]
        from: Option<String>,
        #[arg(long, help = "of this output, such as probe[1].r.y", value_name = "OUTPUT", requires = "from")]
        to: Option<String>,
        /// at this spin, in rad/s or with a unit; else at the one with which the scene starts
        #[arg(long, value_name = "W", requires = "from", allow_hyphen_values = true)]
        speed: Option<String>,
        /// from the first to the second frequency, in rad/s or with a unit; else from a tenth of the lowest to ten times the highest of its
        /// modes
        #[arg(long, num_args = 2, value_names = ["FROM", "TO"], requires = "from", allow_hyphen_values = true)]
        frequencies: Option<Vec<String>>,
        /// Into this folder
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
    },
    /// Measure the error versus the communication step where the bearings of a machine are other models, for each setting of its ports, and end
    /// with a recipe of what to set in which master: table, SVG, CSV and JSON in target/coupling/SCENE
    Coupling {
        /// The scene; its bearings, or its support where it has none, become partners at ports
        #[arg(default_value = "turbo")]
        scene: String,
        /// The spin at the start, in rad/s or with a unit: "3000 rpm"; else that of the scene, or the fastest that it comes to from rest
        #[arg(long, value_name = "W", allow_hyphen_values = true)]
        speed: Option<String>,
        /// The communication steps, in s or with a unit: 1e-4 "0.2 ms"; else some that suit the fastest mode
        #[arg(long, num_args = 1.., value_name = "H", allow_negative_numbers = true)]
        steps: Vec<String>,
        /// Into this folder
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
    },
    /// Write a scene about its steady state as matrices A, B, C and D with names and units, drives off, the spin held: JSON, MATLAB's .mat
    /// and an FMU, SCENE_linear.fmu, in target/state-space/SCENE
    StateSpace {
        /// The scene
        #[arg(default_value = "coupled")]
        scene: String,
        /// The spin, in rad/s or with a unit: "3000 rpm"; else the one with which the scene starts
        #[arg(long, value_name = "W", allow_hyphen_values = true)]
        speed: Option<String>,
        /// Into this folder
        #[arg(long)]
        out: Option<PathBuf>,
    },
    /// Find where the machine begins to whirl by itself, against one parameter and the spin, or the lowest such speed against two: table,
    /// SVG, CSV and JSON in target/stability/SCENE
    Stability {
        /// The scene
        #[arg(default_value = "unstable_whirl")]
        scene: String,
        #[arg(
            long,
            help = "The parameter, such as bearing[1].cyy; twice, each with its --values, for a map over two",
            required = true,
            value_name = "PARAMETER"
        )]
        against: Vec<String>,
        /// Its first and its last value, in the parameter's unit or with another one: "1 N/mm" "5 N/mm"
        #[arg(long, required = true, num_args = 2, value_names = ["FROM", "TO"], allow_hyphen_values = true)]
        values: Vec<String>,
        /// How many values of each
        #[arg(long, default_value_t = 61)]
        count: u32,
        /// The first and the last speed, in rad/s or with a unit: 0 "3000 rpm"; else from 0 to half as much again as the scene reaches
        #[arg(long, num_args = 2, value_names = ["FROM", "TO"], allow_hyphen_values = true)]
        speeds: Option<Vec<String>>,
        /// At how many speeds modes are looked for; thresholds between them are found exactly
        #[arg(long, default_value_t = 61)]
        steps: u32,
        /// Into this folder
        #[arg(long, value_name = "DIR")]
        out: Option<PathBuf>,
    },
    /// Write a scene as a parameter set of SSP 1.0, with which the general FMU, `rotor`, is that scene: target/ssv/SCENE.ssv
    Ssv {
        /// The scene
        #[arg(default_value = "paper")]
        scene: String,
        /// Into this folder
        #[arg(long)]
        out: Option<PathBuf>,
    },
    /// Build the Python package `split_rotor` into target/wheel, install it into a new environment without Rust, and test it there
    Wheel,
    /// Make a site of the documents, with search and equations, that asks nothing of a network: target/book
    Docs,
    /// List the scenes and the effects that each calls for
    Scenes,
    /// Print every key that a scene knows, with its value, unit and meaning, as a scene
    Describe {
        /// The scene
        #[arg(default_value = "paper")]
        scene: String,
        /// Instead its modelDescription.xml
        #[arg(long)]
        xml: bool,
    },
}

/// Where a reader has seen enough, as `head` has, nothing is wrong.
fn end_quietly_without_a_reader() {
    let usual = std::panic::take_hook();
    std::panic::set_hook(Box::new(move |panic| match panic.payload().downcast_ref::<String>() {
        Some(words) if words.starts_with("failed printing to stdout") => std::process::exit(0),
        _ => usual(panic),
    }));
}

fn main() -> ExitCode {
    end_quietly_without_a_reader();
    match dispatch(Arguments::parse().command) {
        Ok(()) => ExitCode::SUCCESS,
        Err(error) => {
            // A scene's errors say so themselves.
            match error.downcast_ref::<SceneError>() {
                Some(error) => eprintln!("{error}"),
                None => eprintln!("error: {error:#}"),
            }
            ExitCode::FAILURE
        }
    }
}

/// A speed that a user gives an option [rad/s].
fn one(option: &str, given: Option<String>) -> Result<Option<f64>> {
    let value = |text: String| Given::new(text).value(&RADIAN_PER_SECOND);
    given.map(value).transpose().map_err(|wrong| anyhow!("{option} {wrong}"))
}

/// The first and the last speed that a user gives an option [rad/s].
fn pair(option: &str, given: Option<&[String]>) -> Result<Option<[f64; 2]>> {
    let Some([from, to]) = given else { return Ok(None) };
    let both = Given::pair([&Given::new(from), &Given::new(to)], &RADIAN_PER_SECOND);
    both.map(Some).map_err(|wrong| anyhow!("{option} {wrong}"))
}

fn dispatch(command: Command) -> Result<()> {
    match command {
        Command::Demo { scene } => demo::demo(&scene),
        Command::Test { part, long, all } => {
            let length = if all {
                test::Length::All
            } else if long {
                test::Length::Long
            } else {
                test::Length::Short
            };
            test::test(&part, length)
        }
        Command::Package { scenes, out, platforms, osp, ssp, partners, boundary } => {
            let platforms: Vec<_> = platforms.iter().map(String::as_str).collect();
            // A wrong partner should not cost the time of building.
            let packages = if ssp { ssp::plan(&scenes, &partners, boundary)? } else { Vec::new() };
            package::package_for(&scenes, &platforms, out.as_deref())?;
            if osp {
                osp::write(&scenes, out.as_deref())?;
            }
            ssp::write(&packages, out.as_deref())
        }
        Command::Run { scene, no_report, out } => simulate::simulate(&scene, !no_report, out.as_deref()),
        Command::Accuracy { tolerances: true, packaged, .. } => accuracy::tolerances(packaged),
        Command::Accuracy { scene, peers, out, .. } => {
            let peers = if peers { Peers::Measured } else { Peers::Absent };
            accuracy::accuracy(&scene, peers, out.as_deref()).map(drop)
        }
        Command::HardCases { part, short, mutants, packaged } => {
            let extent = Extent { part, whole: !short, mutants, ..Extent::default() };
            if packaged { hard_cases::run(&extent, &paths::fmus()) } else { hard_cases::hard_cases(&extent) }
        }
        Command::Bench { part, seed } => bench::bench(&part, seed),
        Command::Campbell { scene, speeds, steps, orders, out } => {
            let speeds = pair("--speeds", speeds.as_deref())?;
            campbell::campbell(&scene, speeds, steps, &orders, out.as_deref()).map(|left| left.show())
        }
        Command::Response { scene, from: Some(from), to: Some(to), speed, frequencies, steps, out, .. } => {
            let (speed, ends) = (one("--speed", speed)?, pair("--frequencies", frequencies.as_deref())?);
            frequency::frequency(&scene, speed, [&from, &to], ends, steps, out.as_deref())
        }
        Command::Response { scene, speeds, steps, linear, out, .. } => {
            let speeds = pair("--speeds", speeds.as_deref())?;
            response::response(&scene, speeds, steps, !linear, out.as_deref())
        }
        Command::Stability { scene, against, values, count, speeds, steps, out } => {
            ensure!(against.len() == values.len() / 2, "--against: each parameter needs its own --values FROM TO");
            let ends = |ends: &[String]| [&ends[0], &ends[1]].map(Given::new);
            let pairs = against.iter().zip(values.chunks(2)).map(|(name, values)| (name, ends(values)));
            let against: Vec<_> = pairs.map(|(name, values)| stability::Against { name, values, count }).collect();
            let speeds = pair("--speeds", speeds.as_deref())?;
            stability::stability(&scene, &against, speeds, steps, out.as_deref())
        }
        Command::Coupling { scene, speed, steps, out } => {
            coupling::coupling(&scene, one("--speed", speed)?, &steps, out.as_deref())
        }
        Command::StateSpace { scene, speed, out } => {
            state_space::state_space(&scene, one("--speed", speed)?, out.as_deref())
        }
        Command::Ssv { scene, out } => ssv::ssv(&scene, out.as_deref()),
        Command::Wheel => wheel::wheel().map(drop),
        Command::Docs => docs::docs(),
        Command::Scenes => scenes::list(),
        Command::Describe { scene, xml } => describe::describe(&scene, xml),
    }
}
