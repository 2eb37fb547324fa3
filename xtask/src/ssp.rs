//! `package --ssp`: a scene and the models at its terminals as a system of SSP 1.0, one zip.

mod join;
mod model;
mod system;

use crate::{paths, scenes, ssv};
use anyhow::{Context, Result, bail, ensure};
use model::Model;
use split_rotor_model::scene::Scene;
use split_rotor_model::xml;
use split_rotor_tools::archive::archive;
use split_rotor_tools::terminals;
use std::fs;
use std::path::{Path, PathBuf};
use std::str::FromStr;
use system::{Component, System};

/// A model that a user connects to a terminal.
#[derive(Clone, Debug)]
pub struct Partner {
    terminal: String,
    fmu: PathBuf,
}

impl FromStr for Partner {
    type Err = String;

    fn from_str(given: &str) -> Result<Self, String> {
        match given.split_once('=') {
            Some((terminal, fmu)) if !terminal.is_empty() && !fmu.is_empty() => {
                Ok(Self { terminal: terminal.into(), fmu: fmu.into() })
            }
            _ => Err("write a terminal of the scene, = and an FMU, as in port[1]=bearing.fmu".into()),
        }
    }
}

/// A package that waits for the FMU of its scene.
pub struct Package {
    scene: String,
    /// The texts in it: path and contents.
    texts: Vec<(String, String)>,
    /// FMUs of partners: path there and here.
    fmus: Vec<(String, PathBuf)>,
}

/// The packages of these scenes, the partners connected, with a boundary or not.
pub fn plan(names: &[String], partners: &[Partner], has_boundary: bool) -> Result<Vec<Package>> {
    ensure!(partners.is_empty() || names.len() == 1, "--partner: give one scene, not several");
    names.iter().map(|name| Package::of(&scenes::find(name)?, partners, has_boundary)).collect()
}

/// Writes packages into the folder of the FMUs.
pub fn write(packages: &[Package], out: Option<&Path>) -> Result<()> {
    let out = out.map_or_else(paths::fmus, Path::to_owned);
    packages.iter().try_for_each(|package| {
        let file = out.join(format!("{}.ssp", package.scene));
        let own = (in_package(&package.scene, "fmu"), paths::fmu_in(&out, &package.scene));
        archive(&file, |add| {
            package.texts.iter().try_for_each(|(path, text)| add(path, text.as_bytes()))?;
            package
                .fmus
                .iter()
                .chain([&own])
                .try_for_each(|(path, fmu)| add(path, &fs::read(fmu).with_context(|| fmu.display().to_string())?))
        })?;
        println!("{}", file.display());
        Ok(())
    })
}

/// Where a file lies in a package.
fn in_package(name: &str, ending: &str) -> String {
    format!("resources/{name}.{ending}")
}

impl Package {
    fn of(scene: &Scene, partners: &[Partner], has_boundary: bool) -> Result<Self> {
        let rotor = Component {
            name: scene.identifier(),
            source: in_package(&scene.name, "fmu"),
            parameters: in_package(&scene.name, "ssv"),
            model: Model::read(&xml::model_description(scene))?,
        };
        let mut system = System { components: vec![rotor], connections: Vec::new() };
        let (mut on, mut fmus) = (Vec::new(), Vec::<(String, PathBuf)>::new());
        for (n, (partner, name)) in partners.iter().zip(component_names(partners)).enumerate() {
            let Partner { terminal, fmu } = partner;
            let in_words = || format!("--partner {terminal}={}", fmu.display());
            on.extend(switches(scene, terminal).with_context(in_words)?);
            ensure!(
                partners[..n].iter().all(|other| other.terminal != *terminal),
                "{}: {terminal} already has a partner; each terminal takes one",
                in_words()
            );
            let rotor = &system.components[0];
            let model = Model::of_fmu(fmu).with_context(in_words)?;
            ensure!(
                name != rotor.name,
                "{}: the component of the rotor has the name {name} too: rename the partner's file",
                in_words()
            );
            let joined = join::join(terminal, &rotor.model, &model).with_context(in_words)?;
            let here = rotor.name.clone();
            let connect = |[own, other]: [String; 2]| [[here.clone(), own], [name.clone(), other]];
            system.connections.extend(joined.shown.into_iter().map(connect));
            let reversed = joined.answered.into_iter().map(connect).map(|[own, other]| [other, own]);
            system.connections.extend(reversed);
            let packed = fmus.iter().find(|(_, other)| other == fmu).map(|(path, _)| path.clone());
            let source = packed.unwrap_or_else(|| {
                let path = in_package(&name, "fmu");
                fmus.push((path.clone(), fmu.clone()));
                path
            });
            let parameters = in_package(&name, "ssv");
            system.components.push(Component { name, source, parameters, model });
        }
        system.components.iter().skip(1).for_each(|partner| eprintln!("  {}", summary(&system, partner)));
        if !on.is_empty() {
            eprintln!("  fmpy 0.3.32 ignores parameter sets: give it {} = true as start values", on.join(", "));
        }
        let mut texts = vec![
            ("SystemStructure.ssd".into(), system.structure(scene, has_boundary)?),
            (system.components[0].parameters.clone(), ssv::own(scene, &on)?),
        ];
        for partner in &system.components[1..] {
            // One name for all sets: ecos applies those of the name that it is given.
            texts.push((partner.parameters.clone(), partner.parameter_set(&scene.name)?));
        }
        Ok(Self { scene: scene.name.clone(), texts, fmus })
    }
}

/// What makes this terminal act, where the scene leaves that to its user.
fn switches(scene: &Scene, terminal: &str) -> Result<Vec<String>> {
    let mut terminals: Vec<_> = terminals::of_scene(scene).collect();
    match terminals.iter().position(|of| of.name == terminal) {
        Some(n) if scene.general => Ok(terminals.swap_remove(n).switches),
        Some(_) => Ok(Vec::new()),
        None if terminals.is_empty() => {
            bail!("{} has no terminal: add [[effects.port]] or [effects.drive] to the scene", scene.name)
        }
        None => {
            let names: Vec<_> = terminals.into_iter().map(|of| of.name).collect();
            bail!("{} has no terminal {terminal}, only {}", scene.name, names.join(", "))
        }
    }
}

/// A name for the component of each partner: that of its file, and a number if several files have that name.
fn component_names(partners: &[Partner]) -> Vec<String> {
    let stem = |partner: &Partner| -> String {
        let stem = partner.fmu.file_stem().unwrap_or_default().to_string_lossy();
        // A point would separate a component from its connector.
        stem.chars().map(|c| if c.is_alphanumeric() { c } else { '_' }).collect()
    };
    let stems: Vec<_> = partners.iter().map(stem).collect();
    let count = |until: usize, stem: &String| stems[..until].iter().filter(|other| *other == stem).count();
    let name = |(n, stem): (usize, &String)| match count(stems.len(), stem) {
        1 => stem.clone(),
        _ => format!("{stem}_{}", count(n, stem) + 1),
    };
    stems.iter().enumerate().map(name).collect()
}

/// What of a partner is connected, and what is not.
fn summary(system: &System, partner: &Component) -> String {
    let names = |is_input: bool, is_free: bool| {
        let free: Vec<_> = system.free(partner).map(|variable| &variable.name).collect();
        let of = partner.model.variables.iter().filter(|of| of.is_input == is_input);
        let found: Vec<_> = of.map(|of| &of.name).filter(|name| free.contains(name) == is_free).collect();
        if found.is_empty() { "none".into() } else { found.into_iter().cloned().collect::<Vec<_>>().join(", ") }
    };
    format!(
        "{}: connected inputs {}; connected outputs {}; free inputs {}",
        partner.name,
        names(true, false),
        names(false, false),
        names(true, true)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    fn partners(given: &[&str]) -> Vec<Partner> {
        given.iter().map(|given| given.parse().unwrap()).collect()
    }

    #[test]
    fn a_partner_is_a_terminal_and_a_file() {
        let partner: Partner = "port[1]=a=b.fmu".parse().unwrap();
        assert_eq!((partner.terminal.as_str(), partner.fmu), ("port[1]", PathBuf::from("a=b.fmu")));
        for wrong in ["port[1]", "=a.fmu", "drive=", ""] {
            assert!(wrong.parse::<Partner>().is_err(), "{wrong}");
        }
    }

    #[test]
    fn components_have_the_names_of_files_and_none_begins_another() {
        // fmpy gives each component the parameters whose names begin with its own.
        let partners = partners(&["port[1]=a/film.fmu", "port[2]=b/film.fmu", "drive=my.motor.fmu"]);
        assert_eq!(component_names(&partners), ["film_1", "film_2", "my_motor"]);
    }

    #[test]
    fn a_general_scene_has_switches_and_others_have_none() {
        let find = |name: &str| {
            let file = paths::root().join(name);
            scenes::find(if file.is_file() { file.to_str().unwrap() } else { name }).unwrap()
        };
        assert_eq!(switches(&find("rotor"), "port[2]").unwrap(), ["effects.port[2]"]);
        let housing = ["effects.bearing[2]", "bearing[2].housing.moves"];
        assert_eq!(switches(&find("examples/cosim/housed.toml"), "bearing[2].housing").unwrap(), housing);
        assert!(switches(&find("coupled"), "port[2]").unwrap().is_empty());
        let refused = |scene: &str, terminal: &str| switches(&find(scene), terminal).unwrap_err().to_string();
        assert_eq!(refused("coupled", "drive"), "coupled has no terminal drive, only port[1], port[2]");
        let expected = "paper has no terminal: add [[effects.port]] or [effects.drive] to the scene";
        assert_eq!(refused("paper", "drive"), expected);
    }

    #[test]
    fn parameters_are_those_of_the_scene_with_the_method_by_its_number() {
        let scene = scenes::find("rotor").unwrap();
        let set = ssv::own(&scene, &["effects.drive".into()]).unwrap();
        let has = |name: &str, value: &str| set.contains(&format!("\"{name}\"><ssv:{value}/>"));
        assert!(has("effects.drive", "Boolean value=\"true\"") && has("effects.port[1]", "Boolean value=\"false\""));
        assert!(has("solver.method_number", "Integer value=\"1\""), "{set}");
        assert!(!set.contains("Enumeration"));
    }
}
