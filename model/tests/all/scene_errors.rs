//! Scenes that cannot be: what is said of each stands in `model/tests/golden/scene_errors`, to be read aloud. It names the place and
//! what would be right.

use split_rotor_model::scene::{Problem, Scene, SceneError};
use split_rotor_model::simulation::General;
use std::collections::BTreeSet;
use std::path::{Path, PathBuf};

/// A name, and what is replaced by what in the scene of the paper.
type Case = (&'static str, &'static [(&'static str, &'static str)]);

/// An effect more.
const MORE: &str = "[solver]";

const CASES: &[Case] = &[
    // No TOML.
    ("comma", &[("m = 5.0", "m = 5,0")]),
    ("comma_in_a_table", &[("{ x = 0.75 }", "{ x = 0,75 }")]),
    ("comma_in_quotes", &[("m = 5.0", "m = \"5,0 kg\"")]),
    ("thousands", &[("m = 5.0", "m = 5,000.0"), ("l = 0.75", "l = \"1.000,75 mm\"")]),
    ("unit_without_quotes", &[("m = 5.0", "m = 5 kg"), ("l = 0.75", "l = 750mm")]),
    ("text_without_quotes", &[("\"dop853\"", "dop853")]),
    ("no_value", &[("m = 5.0", "m =")]),
    ("no_equals", &[("m = 5.0", "m: 5.0")]),
    ("two_equals", &[("m = 5.0", "m = = 5.0")]),
    ("open_quotes", &[("\"dop853\"", "\"dop853")]),
    ("open_bracket", &[("[rotor]", "[rotor")]),
    ("no_digits", &[("m = 5.0", "m = 5."), ("Ja = 0.15625", "Ja = .15625")]),
    ("no_text_but_a_formula", &[("m = 5.0", "m = 2*2.5")]),
    // Twice.
    ("key_twice", &[("l = 0.75", "l = 0.75\nl = 0.5")]),
    ("section_twice", &[(MORE, "[rotor]\nm = 3.0\n[solver]")]),
    ("bearing_twice", &[(MORE, "[effects.bearing]\nposition = 0.0\n\n[effects.bearing]\nposition = 0.1\n[solver]")]),
    ("one_bearing", &[(MORE, "[effects.bearing]\npostion = 0.0\n[solver]")]),
    (
        "both_kinds_of_bearing",
        &[(MORE, "[[effects.bearing]]\nposition = 0.0\n[effects.bearing]\nposition = 0.1\n[solver]")],
    ),
    ("two_supports", &[("[effects.support]", "[[effects.support]]")]),
    (
        "five_probes",
        &[(
            MORE,
            "[[effects.probe]]\nposition = 0.0\n[[effects.probe]]\nposition = 0.0\n[[effects.probe]]\nposition = 0.0\n[[effects.probe]]\nposition = 0.0\n[[effects.probe]]\nposition = 0.0\n[solver]",
        )],
    ),
    // Names.
    ("unknown_section", &[("[rotor]", "[rotr]")]),
    ("effect_as_section", &[("[effects.gravity]", "[gravity]")]),
    ("unknown_effect", &[("effects.gravity", "effects.gravty")]),
    ("no_effect", &[("effects.gravity", "effects.levity")]),
    ("former_effect", &[(MORE, "[effects.shaft]\n[solver]")]),
    ("misspelt_keys", &[("m = 5.0", "M = 5.0"), ("omega =", "omgea ="), ("relative_tolerance", "relative_tolernace")]),
    ("key_of_nobody", &[("m = 5.0", "colour = 5.0")]),
    ("keys_by_other_names", &[("m = 5.0", "mass = 5.0"), ("Ja =", "Jp ="), ("omega = {", "speed = {")]),
    ("method_of_the_experiment", &[("[experiment]", "[experiment]\nmethod = \"dop853\"")]),
    ("text_for_a_table", &[("omega = { x = 50.0 }", "omega = \"3000 rpm\"")]),
    ("key_of_another_section", &[("c2 =", "gamma = { y = 0.1 }\nstop = 2.0\ntitle = \"x\"\nc2 =")]),
    ("key_of_an_output", &[("c2 =", "F = { x = 1.0 }\nc2 =")]),
    (
        "key_of_a_bearing",
        &[(MORE, "[[effects.bearing]]\nposition = 0.0\n[[effects.bearing]]\nposition = 0.0\nk_yy = 1.0\n[solver]")],
    ),
    (
        "key_of_what_has_none",
        &[("[effects.gravity]", "[[effects.port]]\nposition = 0.0\nf = { a = 1.0 }\n[effects.gravity]")],
    ),
    ("key_of_a_component", &[("r_c = { x", "r_c = { w")]),
    ("key_of_the_experiment", &[("step =", "stpe =")]),
    ("unknown_method", &[("\"dop853\"", "\"dop835\"")]),
    ("no_method", &[("\"dop853\"", "\"rk4\"")]),
    // What is missing.
    ("missing_mass", &[("m = 5.0\n", "")]),
    ("missing_rotor", &[("[rotor]\nm = 5.0\nJa = 0.15625\nJt = 0.078125\nl = 0.75\n", "")]),
    ("missing_support_point", &[("l = 0.75\n", "")]),
    ("missing_position", &[(MORE, "[[effects.bearing]]\nposition = 0.0\n[[effects.bearing]]\nkyy = 1.0\n[solver]")]),
    // Types.
    ("text_for_a_number", &[("m = 5.0", "m = \"five\""), ("stop = 10.0", "stop = \"ten\"")]),
    ("number_in_quotes", &[("m = 5.0", "m = \"5\""), ("relative_tolerance = 1e-10", "relative_tolerance = \"1e-10\"")]),
    (
        "number_for_a_table",
        &[("r_c = { x = 0.75 }", "r_c = 0.75"), ("[experiment]", "[effects]\nbearing = [5]\ndrag = 3\n[experiment]")],
    ),
    ("number_for_several", &[("[experiment]", "[effects]\nbearing = 5\n[experiment]")]),
    (
        "number_for_a_text",
        &[("method = \"dop853\"", "method = 3"), ("title = ", "title = 5 #"), ("[rotor]", "general = 1\n[rotor]")],
    ),
    ("list_for_a_number", &[("m = 5.0", "m = [5.0,\n  6.0]")]),
    ("control_characters", &[("title = \"", "title = \"\\u0001")]),
    // Units.
    ("mass_for_a_length", &[("l = 0.75", "l = \"20 kg\""), ("stop = 10.0", "stop = \"10 rpm\"")]),
    ("unit_for_a_pure_number", &[("relative_tolerance = 1e-10", "relative_tolerance = \"1e-10 m\"")]),
    (
        "unknown_units",
        &[
            ("m = 5.0", "m = \"5 kkg\""),
            ("omega = { x = 50.0 }", "omega = { x = \"3000 rmp\" }"),
            ("c1 = 2000.0", "c1 = \"2 N/mm.s\""),
        ],
    ),
    (
        "two_unbalances_in_one",
        &[(
            MORE,
            "[[effects.unbalance]]\nmoment = \"40 g mm\"\nradius = 0.1\nposition = 0.0\n[[effects.unbalance]]\nmoment = \"-3 kg\"\nposition = 0.0\n[solver]",
        )],
    ),
    // Bounds.
    ("out_of_bounds", &[("m = 5.0", "m = -5.0"), ("c1 = 2000.0", "c1 = \"-1 N/mm\""), ("1e-10", "1.0")]),
    (
        "no_numbers",
        &[
            ("m = 5.0", "m = 1e400"),
            ("l = 0.75", "l = nan"),
            ("c2 = 500.0", "c2 = inf"),
            ("z = -9.81", "z = -99999999999999999999"),
        ],
    ),
    (
        "impossible_experiment",
        &[("stop = 10.0", "start = 20.0\nstop = 10.0\ntolerance = 2.0"), ("step = 0.01", "step = 0.0")],
    ),
    ("impossible_inertia", &[("Jt = 0.078125", "Jt = 0.05")]),
    ("too_large_a_tilt", &[("[start]", "[start]\ngamma = { y = 3.0, z = 4.0 }")]),
    (
        "two_impossible_effects",
        &[(
            MORE,
            "[[effects.rub]]\nposition = 0.0\ngap = 1e-300\nv0 = 0.01\nradius = 0.1\n[[effects.bearing]]\nposition = 0.0\ncyy = 1.0\nczz = 4.0\ncyz = 2.0\nczy = 2.5\n[solver]",
        )],
    ),
    ("what_excludes_each_other", &[(MORE, "[effects.drive]\n[effects.imposed_speed]\n[solver]")]),
    // What joins several keys is told beside what is wrong with one, unless that is one of them.
    (
        "rules_beside_slips",
        &[
            ("m = 5.0", "m = -5.0"),
            ("Jt = 0.078125", "Jt = 0.05"),
            ("[start]", "[start]\nat_rest = true\nv_c = { y = 1.0 }\ngamma = { y = 3.0, z = 4.0 }"),
            ("c1 = 2000.0", "c1 = \"2 kg\""),
            ("step =", "stpe ="),
            (
                MORE,
                "[effects.drive]\n[effects.imposed_speed]\n[[effects.unbalance]]\nmoment = \"40 g mm\"\nmass = 1.0\nposition = 0.0\n[solver]",
            ),
        ],
    ),
    ("no_rule_on_a_slip", &[("Ja = 0.15625", "Ja = \"1 kg\""), ("Jt = 0.078125", "Jt = -1.0")]),
    (
        "slips_in_one_table",
        &[(
            MORE,
            "[[effects.bearing]]\nposition = 0.0\nspeed = [0, 2, 2]\nkyy = [1, 2]\nkzz = [1, 2, 3]\nkxx = [1, nan, 2]\n\
             [[effects.bearing]]\nposition = 0.0\nspeed = [0, 2, 2]\nkyy = [1, 2]\n[solver]",
        )],
    ),
    // Brackets.
    ("open_list", &[("[start]", "[start]\ngamma = [1.0, 2.0\nphi = 0.0\n")]),
    ("list_without_a_comma", &[("m = 5.0", "m = [1.0, 2.0\n  3.0]"), ("step =", "stpe =")]),
    ("round_brackets", &[("m = 5.0", "m = (5.0, 0.0)")]),
    ("no_brackets", &[("m = 5.0", "m = 5.0, 0.0 # kg")]),
    ("comma_in_a_list", &[("m = 5.0", "m = [0,001, 2]")]),
    ("minus_of_a_word_processor", &[("m = 5.0", "m = \"−5 kg\"")]),
    // Inputs.
    (
        "misspelt_name_of_an_input",
        &[(MORE, "[effects.drive]\n[[input]]\nnam = \"drive.tau\"\ntime = [0]\nvalue = [1]\n[solver]")],
    ),
    ("inputs_of_nobody", &[("[experiment]", "[[input]]\nname = \"drive.tau\"\ntime = [0]\nvalue = [1]\n[experiment]")]),
    (
        "inputs",
        &[(
            MORE,
            "[effects.drive]\n[[input]]\nname = \"drive.tua\"\ntime = [0]\nvalue = [1]\n[[input]]\ntime = [0]\nvalue = [1]\n[[input]]\nname = \"drive.tau\"\ntimes = [0]\nvalue = [1]\n[[input]]\nname = \"drive.tau\"\ntime = [0, \"1 m\", \"1 min\"]\nvalue = [1, nan, \"2 N/m\"]\n[solver]",
        )],
    ),
    (
        "points_of_inputs",
        &[(
            MORE,
            "[effects.drive]\n[[input]]\nname = \"drive.tau\"\ntime = [0, 1]\nvalue = [1]\n[[input]]\nname = \"drive.tau\"\ntime = [0, 2, 1]\nvalue = [1, 2, 3]\n[[input]]\nname = \"drive.tau\"\nfile = \"nosuch.csv\"\n[solver]",
        )],
    ),
    (
        "input_twice",
        &[(
            MORE,
            "[effects.drive]\n[[input]]\nname = \"drive.tau\"\ntime = [0]\nvalue = [1]\n[[input]]\nname = \"drive.tau\"\ntime = [0]\nvalue = [1]\n[solver]",
        )],
    ),
    ("one_input", &[(MORE, "[effects.drive]\n[input]\nname = \"drive.tau\"\n[solver]")]),
    // Tables.
    ("table_without_speeds", &[(MORE, "[[effects.bearing]]\nposition = 0.0\nkyy = [1.0, 2.0]\n[solver]")]),
    (
        "columns_of_two_lengths",
        &[(
            MORE,
            "[[effects.bearing]]\nposition = 0.0\nspeed = [\"0 rpm\", \"1000 rpm\"]\nkyy = [1.0, 2.0, 3.0]\nkzz = [1.0]\n[solver]",
        )],
    ),
    (
        "tables_of_no_length",
        &[(
            MORE,
            "[[effects.bearing]]\nposition = 0.0\nspeed = []\nkyy = [1,2,3,4,5,6,7,8,9,10,11,12,13,14,15,16,17]\n[solver]",
        )],
    ),
    ("number_for_a_column", &[(MORE, "[[effects.bearing]]\nposition = [0.0]\nspeed = 3.0\nkxx = [1.0]\n[solver]")]),
    ("node_that_is_none", &[(MORE, "[[effects.bearing]]\nposition = 0.0\nspeed = [0.0, inf, \"3 m\"]\n[solver]")]),
    (
        "speeds_that_do_not_ascend",
        &[(MORE, "[[effects.bearing]]\nposition = 0.0\nspeed = [0, 2, 2]\nkyy = [1, 2, 3]\n[solver]")],
    ),
];

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/golden/scene_errors")
}

fn scenes() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes")
}

fn read(file: &Path) -> String {
    std::fs::read_to_string(file).unwrap_or_else(|error| panic!("{}: {error}", file.display()))
}

#[test]
fn golden_what_is_said_of_scenes_that_cannot_be() {
    let (paper, renews) = (read(&scenes().join("paper.toml")), std::env::var_os("UPDATE_GOLDEN").is_some());
    if renews {
        std::fs::remove_dir_all(folder()).ok();
        std::fs::create_dir_all(folder()).expect("a folder beside the tests");
    }
    for (name, edits) in CASES {
        let text = edits.iter().fold(paper.clone(), |text, (old, new)| {
            assert_eq!(text.matches(old).count(), 1, "{name}: {old:?} in the scene");
            text.replace(old, new)
        });
        let error = Scene::parse(Path::new("bad.toml"), &text).expect_err(name).to_string();
        let golden = folder().join(format!("{name}.txt"));
        if renews {
            std::fs::write(&golden, format!("{error}\n")).expect("the folder can be written");
        }
        assert_eq!(format!("{error}\n"), read(&golden), "{name}: UPDATE_GOLDEN=1 renews it");
    }
    let files = std::fs::read_dir(folder()).expect("the folder").map(|entry| entry.expect("a file").path());
    let files: BTreeSet<_> =
        files.map(|file| file.file_stem().expect("a name").to_string_lossy().into_owned()).collect();
    assert_eq!(files, CASES.iter().map(|(name, _)| (*name).to_owned()).collect());
}

/// The keys of a scene: where each begins, and where its value begins and ends.
fn keys(text: &str) -> Vec<[usize; 3]> {
    let mut keys = Vec::new();
    let mut start = 0;
    for line in text.split_inclusive('\n') {
        let code = if line.trim_start().starts_with('#') { "" } else { line.trim_end() };
        for (at, _) in code.match_indices(" = ") {
            let key = code[..at].rfind([' ', '{', ',']).map_or(0, |before| before + 1);
            let value = &code[at + 3..];
            let ends = match value.chars().next() {
                Some('{' | '[') => value.len(),
                Some('"') => 2 + value[1..].find('"').expect("an end of quotes"),
                _ => value.find([',', ' ']).unwrap_or(value.len()),
            };
            keys.push([start + key, start + at + 3, start + at + 3 + ends]);
        }
        start += line.len();
    }
    keys
}

/// What a slip makes of a key and its value: deleted, misspelt in two ways, doubled, of other types, and no numbers.
fn slips(text: &str, [key, value, end]: [usize; 3]) -> Vec<String> {
    let (name, given) = (&text[key..value - 3], &text[value..end]);
    let replaced = |new: &str| format!("{}{new}{}", &text[..key], &text[end..]);
    let rest = text[end..].trim_start_matches([',', ' ']);
    let mut slips = vec![
        format!("{}{rest}", &text[..key]),
        replaced(&format!("{name}x = {given}")),
        replaced(&format!("{} = {given}", &name[1..])),
        replaced(&format!("{name} = {given}\n{name} = {given}")),
    ];
    let values = ["\"text\"", "[1.0, 2.0]", "[]", "{}", "-1", "nan", "1e400", "true", "\"1 kg\"", "1979-05-27"];
    slips.extend(values.map(|value| replaced(&format!("{name} = {value}"))));
    slips
}

/// Each of its problems says where it is, unless a whole section is missing.
fn is_told(error: &SceneError, name: &str) -> bool {
    let is_placed = |problem: &Problem| problem.place.is_some() || problem.wrong.ends_with("] is missing");
    let text = error.to_string();
    error.problems.iter().all(is_placed) && (text.contains(name) || text.contains("no TOML"))
}

#[test]
fn a_slip_in_any_key_of_any_scene_is_told_or_leaves_a_scene() {
    let (mut refused, mut sound) = (0, 0);
    for scene in Scene::names(&scenes()) {
        let text = read(&scenes().join(format!("{scene}.toml")));
        let keys = keys(&text);
        assert!(keys.len() > 10, "{scene}");
        for key in keys {
            let name = text[key[0]..key[1] - 3].trim();
            for slip in slips(&text, key) {
                match Scene::parse(Path::new("bad.toml"), &slip) {
                    Err(error) => {
                        assert!(is_told(&error, &name[1..]), "{name} in {slip}\n{error}");
                        refused += 1;
                    }
                    Ok(scene) => {
                        // Its start may still be refused, by the same rules as in the FMU.
                        _ = General::from(scene.parameters()).start(scene.experiment.start, None);
                        sound += 1;
                    }
                }
            }
        }
    }
    println!("{refused} refused, {sound} sound");
    assert!(refused > sound && sound > 400, "{refused} refused, {sound} sound");
}
