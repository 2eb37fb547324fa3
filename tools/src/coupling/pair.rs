//! A machine without its bearings, which are partners at ports, and the same machine with them inside.

use super::partner::{NAMES, Partner};
use crate::scenes;
use anyhow::{Result, bail, ensure};
use split_rotor_model::effects::{All, Info, named};
use split_rotor_model::scene::Scene;
use split_rotor_model::variable::Place;
use split_rotor_model::variables::{self, Parameters};

/// What is solved more accurately than this is no better known \[1]: else the solver's error would hide that of the exchange.
const TOLERANCE: f64 = 1e-10;

/// What the FMU is set to.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Setting {
    /// As tables call it.
    pub name: &'static str,
    /// `extrapolation.order`.
    pub order: usize,
    /// `port[i].learn`.
    pub learns: bool,
    /// `extrapolation.redo`.
    pub redoes: bool,
    /// Whether the ports have the coefficients of their partners.
    pub is_given: bool,
}

/// All as the FMU is with nothing set.
const NOTHING_SET: Setting = Setting { name: "nothing set", order: 0, learns: true, redoes: false, is_given: false };

/// The settings that are compared.
pub const SETTINGS: [Setting; 6] = [
    Setting { name: "held", learns: false, ..NOTHING_SET },
    Setting { name: "order 1", order: 1, ..NOTHING_SET },
    Setting { name: "order 2", order: 2, ..NOTHING_SET },
    Setting { name: "order 2, redone", order: 2, redoes: true, ..NOTHING_SET },
    NOTHING_SET,
    Setting { name: "coefficients given", is_given: true, ..NOTHING_SET },
];

/// The machine, its springs and dampers inside or at ports.
pub struct Pair {
    /// What becomes a partner.
    pub partners: Vec<Partner>,
    /// The number of the port of each.
    pub ports: Vec<u32>,
    /// The speed at which it starts [rad/s].
    pub speed: f64,
    /// With the bearings inside; the ports are there, and nobody feeds them.
    pub whole: Parameters<All>,
    /// Without them.
    open: Parameters<All>,
    /// How many ports the scene has of its own.
    own_ports: u32,
}

impl Pair {
    /// The bearings of a scene as partners, or its support where it has no bearing; the machine starts at this speed [rad/s], with its
    /// inputs as they are at the start.
    pub fn of(scene: &Scene, speed: f64) -> Result<Self> {
        let file = scene.file.display();
        let value = scenes::values(scene);
        let is_on = |name: &str| value(&format!("effects.{name}")) != Some(0.0);
        let numbers_of = |kind: &str| {
            let of_kind = scene.effects.iter().filter(|(info, _)| info.name == kind);
            let on = of_kind.filter(|(info, number)| is_on(&info.block_name(*number)));
            on.map(|(_, number)| *number).collect::<Vec<_>>()
        };
        let (bearings, supports) = (numbers_of("bearing"), numbers_of("support"));
        let mut partners: Vec<_> = bearings.iter().map(|number| Partner::bearing(scene, *number)).collect();
        if partners.is_empty() {
            partners.extend(supports.first().map(|_| Partner::support(scene)));
        }
        if partners.is_empty() {
            bail!(
                "{file}: the scene has no bearing and no support, so nothing of it can become a partner at a port: add [[effects.bearing]] \
                 with position and the stiffness and damping of the model that you will couple (kyy, kzz, cyy, czz ...)"
            );
        }
        for partner in &partners {
            ensure!(
                partner.at(speed).iter().any(|coefficient| *coefficient != 0.0),
                "{file}: all coefficients of {} are 0, so it answers nothing: give it stiffness or damping",
                partner.name
            );
        }
        let own_ports = numbers_of("port");
        let free: Vec<_> = (1..=Place::OF_A_KIND).filter(|number| !own_ports.contains(number)).collect();
        ensure!(
            partners.len() <= free.len(),
            "{file}: {} bearings and {} ports: the bearings become ports, and a scene has at most {}: remove ports",
            partners.len(),
            own_ports.len(),
            Place::OF_A_KIND
        );
        let ports: Vec<_> = free[..partners.len()].to_vec();
        let mut whole = scene.parameters();
        let solver = &mut whole.setup.solver;
        solver.relative_tolerance = solver.relative_tolerance.min(TOLERANCE);
        // Out of equilibrium, so that the machine moves.
        let start = &mut whole.setup.start;
        (start.at_rest, start.omega.x) = (false, speed);
        let mut pair = Self { partners, ports, speed, open: whole.clone(), whole, own_ports: own_ports.len() as u32 };
        if numbers_of("imposed_speed") == [1] {
            for parameters in [&mut pair.whole, &mut pair.open] {
                set(parameters, "imposed_speed", 1, "w", speed);
                set(parameters, "imposed_speed", 1, "a", 0.0);
            }
        }
        for (partner, port) in pair.partners.iter().zip(&pair.ports) {
            let (kind, number) = match partner.name.split_once('[') {
                Some((kind, number)) => (kind, number.trim_end_matches(']').parse().expect("a number of a bearing")),
                None => (&*partner.name, 1),
            };
            switch_off(&mut pair.open, kind, number);
            for parameters in [&mut pair.whole, &mut pair.open] {
                parameters.begin_with(Place::switch(block("port", *port)), 1.0);
                set(parameters, "port", *port, "position", partner.position);
            }
        }
        Ok(pair)
    }

    /// The machine without its bearings under a setting, where answers are late by so many steps.
    pub fn open(&self, setting: &Setting, lag: u32) -> Parameters<All> {
        let mut parameters = self.open.clone();
        parameters.begin_with(Place::switch(block("extrapolation", 1)), 1.0);
        let is_told = setting.order > 0 || setting.is_given;
        set(&mut parameters, "extrapolation", 1, "order", setting.order as f64);
        set(&mut parameters, "extrapolation", 1, "redo", f64::from(u8::from(setting.redoes)));
        set(&mut parameters, "extrapolation", 1, "lag", if is_told { f64::from(lag) } else { 0.0 });
        for (partner, port) in self.partners.iter().zip(&self.ports) {
            set(&mut parameters, "port", *port, "learn", f64::from(u8::from(setting.learns)));
            let given = if setting.is_given { partner.at(self.speed) } else { [0.0; NAMES.len()] };
            NAMES.into_iter().zip(given).for_each(|(name, value)| set(&mut parameters, "port", *port, name, value));
        }
        parameters
    }

    /// Whether the machine can be coupled with this setting.
    pub fn allows(&self, setting: &Setting) -> bool {
        !setting.redoes || self.open(setting, 0).check().is_ok()
    }

    /// How many ports the scene has of its own, which nobody feeds here.
    pub fn own_ports(&self) -> u32 {
        self.own_ports
    }

    /// √(Jt/m) \[m].
    pub fn length(&self) -> f64 {
        libm::sqrt(self.whole.setup.rotor.Jt / self.whole.setup.rotor.m)
    }
}

fn info(kind: &str) -> &'static Info {
    named(kind).expect("the catalogue has this effect")
}

fn block(kind: &str, number: u32) -> u32 {
    Place::effect_block(info(kind).number, number)
}

/// Where a variable of an effect stands.
pub fn place(kind: &str, number: u32, name: &str) -> Place {
    let list = variables::of_scene(&[(info(kind), number)]);
    let full = format!("{}.{name}", info(kind).block_name(number));
    list.iter().find(|variable| variable.name == full).expect("the effect has this variable").place
}

fn set(parameters: &mut Parameters<All>, kind: &str, number: u32, name: &str, value: f64) {
    assert!(parameters.begin_with(place(kind, number, name), value), "{kind}.{name} can be set");
}

/// Switches an effect off.
pub fn switch_off(parameters: &mut Parameters<All>, kind: &str, number: u32) {
    parameters.begin_with(Place::switch(block(kind, number)), 0.0);
}
