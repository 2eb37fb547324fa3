//! The house rules that no compiler holds: floors, where `unsafe` may stand, equation labels, the committed XML.

use split_rotor_model::scene::Scene;
use split_rotor_model::xml;
use std::collections::BTreeSet;
use std::fs;
use std::path::{Path, PathBuf};

/// The rooms of `model` from the ground up; each may import only from rooms below it (docs/architecture.md).
const ROOMS: [&str; 26] = [
    "scalar",
    "coefficient",
    "decompositions",
    "dual",
    "traced",
    "stored",
    "error",
    "log",
    "section",
    "signal",
    "rotation",
    "integrate",
    "body",
    "state",
    "variable",
    "effects",
    "energy",
    "rotor",
    "splitting",
    "variables",
    "simulation",
    "linear",
    "periodic",
    "scene",
    "dependencies",
    "xml",
];

/// Where `unsafe` may stand: the FMI shell, and what calls an FMU as a host does.
const UNSAFE: [&str; 4] = ["src/arguments.rs", "src/fmi2", "tests/", "tools/src/fmu.rs"];

/// No file is longer than this, in lines.
const LONGEST: usize = 800;

fn root() -> &'static Path {
    Path::new(env!("CARGO_MANIFEST_DIR"))
}

/// All files below `folder` that end with `suffix`, relative to the root, sorted.
fn files(folder: &str, suffix: &str) -> Vec<PathBuf> {
    let mut found = Vec::new();
    let mut folders = vec![root().join(folder)];
    while let Some(folder) = folders.pop() {
        for entry in fs::read_dir(&folder).unwrap_or_else(|error| panic!("{}: {error}", folder.display())) {
            let path = entry.unwrap().path();
            if path.is_dir() {
                folders.push(path);
            } else if path.to_string_lossy().ends_with(suffix) {
                found.push(path.strip_prefix(root()).unwrap().to_owned());
            }
        }
    }
    found.sort();
    found
}

fn rust_files() -> Vec<PathBuf> {
    ["src", "model", "oracles", "tests", "benches", "tools", "xtask", "fuzz/src", "python/src"]
        .iter()
        .flat_map(|folder| files(folder, ".rs"))
        .collect()
}

fn read(file: &Path) -> String {
    fs::read_to_string(root().join(file)).unwrap()
}

/// The names that follow `marker` in a text.
fn names_after<'t>(text: &'t str, marker: &str) -> Vec<&'t str> {
    let name = |rest: &'t str| rest.split(|c: char| !c.is_alphanumeric() && c != '_').next().unwrap_or("");
    text.split(marker).skip(1).map(name).collect()
}

fn imports_from_above(room: &str, text: &str) -> Vec<String> {
    let floor = |name: &str| ROOMS.iter().position(|room| *room == name);
    let above = |name: &&str| *name != room && floor(name) >= floor(room);
    let code: String = text.lines().filter(|line| !line.trim_start().starts_with("//")).collect();
    let grouped = code.split("crate::{").skip(1).flat_map(first_names);
    names_after(&code, "crate::").into_iter().chain(grouped).filter(above).map(str::to_owned).collect()
}

/// The first name of each path in `a::{b, c}, d}…`, up to the brace that closes the group.
fn first_names(group: &str) -> Vec<&str> {
    let (mut depth, mut start, mut paths) = (0, 0, Vec::new());
    for (i, c) in group.char_indices() {
        match c {
            '{' => depth += 1,
            '}' | ',' if depth == 0 => {
                paths.push(&group[start..i]);
                start = i + 1;
                if c == '}' {
                    break;
                }
            }
            '}' => depth -= 1,
            _ => {}
        }
    }
    paths.into_iter().filter_map(|path| path.trim().split("::").next()).collect()
}

#[test]
fn each_room_of_the_model_imports_only_from_below() {
    let mut seen = BTreeSet::new();
    for file in files("model/src", ".rs") {
        let room = file.iter().nth(2).unwrap().to_str().unwrap().trim_end_matches(".rs");
        if room == "lib" {
            continue;
        }
        assert!(ROOMS.contains(&room), "{}: which floor is this room on? Add it to ROOMS", file.display());
        // From a room's own file or from one in its folder, the way up to the crate is `super::`.
        let up = if file.components().count() == 3 { "super::" } else { "super::super::" };
        let wrong = imports_from_above(room, &read(&file).replace("$crate::", "crate::").replace(up, "crate::"));
        assert!(wrong.is_empty(), "{} imports from its own floor or above: {wrong:?}", file.display());
        seen.insert(room.to_owned());
    }
    assert_eq!(seen.len(), ROOMS.len(), "a room in ROOMS has no file");
}

#[test]
fn the_floor_check_sees_an_import_from_above() {
    assert_eq!(
        imports_from_above("body", "/// crate::energy\nuse crate::rotor::Rotor; use crate::scalar::Scalar;"),
        ["rotor"]
    );
}

#[test]
fn unsafe_stands_only_in_the_shell() {
    for file in rust_files() {
        let allowed = UNSAFE.iter().any(|place| file.starts_with(place));
        let opens = read(&file).contains(concat!("allow(unsafe", "_code"));
        assert!(allowed || !opens, "{} opens the door to unsafe code", file.display());
    }
}

#[test]
fn the_instance_names_no_version_of_fmi() {
    for file in rust_files().iter().filter(|file| file.starts_with("src/instance") || file.ends_with("src/instance.rs"))
    {
        assert!(!read(file).contains("fmi2"), "{} is for any version of FMI", file.display());
    }
}

#[test]
fn files_are_short_and_finished() {
    for file in rust_files() {
        let text = read(&file);
        assert!(text.lines().count() <= LONGEST, "{} has more than {LONGEST} lines", file.display());
        for unfinished in [concat!("TO", "DO"), concat!("FIX", "ME"), concat!("todo", "!("), concat!("dbg", "!(")] {
            assert!(!text.contains(unfinished), "{} holds {unfinished}", file.display());
        }
    }
}

/// The tests of a file that can end before they tested anything: with a bare `return` of their own.
fn tests_that_return(text: &str) -> Vec<&str> {
    let bodies = text.split("\n#[test]\n").skip(1).map(|rest| rest.split("\n}\n").next().unwrap_or(rest));
    let returns = |body: &&str| body.contains("else { return };") || body.lines().any(|line| line.trim() == "return;");
    bodies.filter(returns).flat_map(|body| names_after(body, "fn ").into_iter().next()).collect()
}

#[test]
fn no_test_passes_without_having_run() {
    // What a scene or machine does not suit is ignored (build.rs says which scenes do) or panics.
    for file in rust_files().iter().filter(|file| file.iter().any(|part| part == "tests")) {
        assert_eq!(tests_that_return(&read(file)), [""; 0], "{}", file.display());
    }
    let early = concat!("\n#[test]\n#[ignore]\nfn early() {\n    let Some(it) = it() else { ", "return };\n}\n");
    assert_eq!(tests_that_return(early), ["early"]);
}

#[test]
fn no_code_takes_the_larger_of_two_zeros() {
    // Of 0 and −0 `max` gives either, each build its own; behind a division the bits then differ.
    for file in rust_files().iter().filter(|file| file.starts_with("model/src")) {
        let compares = [".max(0.0)", ".min(0.0)", ".max(-0.0)", ".min(-0.0)"];
        assert!(!compares.iter().any(|call| read(file).contains(call)), "{}", file.display());
    }
}

#[test]
fn equation_labels_of_code_and_theory_match() {
    let theory = read(Path::new("docs/theory.md"));
    let numbers = |text: &str, marker: &str| -> Vec<u32> {
        names_after(text, marker).into_iter().filter_map(|name| name.parse().ok()).collect()
    };
    let defined = numbers(&theory, "\\tag{");
    let distinct: BTreeSet<_> = defined.iter().copied().collect();
    assert_eq!(distinct.len(), defined.len(), "an equation number stands twice in docs/theory.md");
    assert!(!distinct.is_empty());
    let mut used = BTreeSet::new();
    for file in files("model", ".rs").into_iter().chain(files("oracles", ".rs")) {
        for number in numbers(&read(&file), "eq. ") {
            assert!(distinct.contains(&number), "{} cites eq. {number}, which docs/theory.md lacks", file.display());
            used.insert(number);
        }
    }
    let unused: Vec<_> = distinct.difference(&used).collect();
    assert!(unused.is_empty(), "no code and no test cites the equations {unused:?} of docs/theory.md");
}

#[test]
fn the_committed_xml_is_what_the_list_renders() {
    let scene = Scene::find("paper", &root().join("scenes")).unwrap();
    let committed = read(Path::new("modelDescription/modelDescription.xml"));
    let remedy = "run `cargo xtask describe --xml > modelDescription/modelDescription.xml`";
    assert!(
        committed == xml::model_description(&scene),
        "modelDescription/modelDescription.xml is out of date: {remedy}"
    );
}

#[test]
fn every_scene_can_be_simulated() {
    let folder = root().join("scenes");
    let names = Scene::names(&folder);
    assert!(!names.is_empty());
    for name in names {
        Scene::find(&name, &folder).unwrap_or_else(|error| panic!("{error}"));
    }
}
