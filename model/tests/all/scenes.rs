//! What scenes mean: several effects of a kind, numbers with units, what is left out.

use crate::harness::named::{Named, ROTOR, refusal};
use crate::harness::{at, within};
use split_rotor_model::scene::Scene;
use std::path::Path;

#[test]
fn several_of_a_kind_are_numbered_as_the_file_has_them() {
    let bearing = |position: f64, kyy: f64| format!("[[effects.bearing]]\nposition = {position:?}\nkyy = {kyy:?}\n");
    let mut scene =
        Named::written(&[ROTOR.to_owned(), bearing(0.5, 1e3), bearing(-0.25, 2e3), bearing(0.0, 3e3)].concat());
    for (index, position, kyy) in [(1, 0.5, 1e3), (2, -0.25, 2e3), (3, 0.0, 3e3)] {
        assert_eq!(scene.get(&format!("bearing[{index}].position")), position);
        assert_eq!(scene.get(&format!("bearing[{index}].kyy")), kyy);
        // Its own block of value references.
        assert_eq!(scene.place(&format!("bearing[{index}].position")).block, 16 + 4 * 5 + index - 1);
    }
    assert!(!scene.scene.variables.iter().any(|variable| variable.name.starts_with("bearing[4]")));
}

#[test]
fn exact_each_of_a_kind_acts_with_its_own_values() {
    // Two bearings at the ends of the rotor, off centre by 1 mm along y.
    let mut scene = Named::written(&format!(
        "{ROTOR}[start]\nr_c = {{ y = 0.001 }}\n[[effects.bearing]]\nposition = 0.5\nkyy = 1e3\n\
         [[effects.bearing]]\nposition = -0.25\nkyy = 2e3\nkzy = 4e3\n"
    ));
    for (name, force) in [
        ("bearing[1].F.y", -1.0),
        ("bearing[1].F.z", 0.0),
        ("bearing[2].F.y", -2.0),
        ("bearing[2].F.z", -4.0),
        ("der(state.v.y)", -3.0 / 5.0),
        ("der(state.v.z)", -4.0 / 5.0),
        ("der(state.K.y)", -0.25 * 4.0),
        ("der(state.K.z)", -0.5 + 0.5),
    ] {
        assert!((scene.get(name) - force).abs() < 1e-12, "{name} = {}", scene.get(name));
    }
}

#[test]
fn the_support_point_need_not_be_told_where_there_is_no_support() {
    let without =
        ROTOR.lines().filter(|line| !line.starts_with("l ")).map(|line| format!("{line}\n")).collect::<String>();
    let parse = |rest: &str| Scene::parse(Path::new("bad.toml"), &format!("{without}{rest}"));
    let held = parse("[[effects.bearing]]\nposition = 0.0\n").expect("it has no support");
    assert_eq!(held.parameters().setup.rotor.l, 0.0);
    assert_eq!(
        refusal(&format!("{without}[effects.support]\nc1 = 1.0\n")),
        "line 1: `rotor.l` is missing: give `l = ...`, the distance from the support point a to the mass centre c [m]"
    );
}

#[test]
fn what_no_xml_can_hold_is_refused() {
    let titled = |title: &str, file: &str| Scene::parse(Path::new(file), &format!("title = {title}\n{ROTOR}"));
    let says = "is not possible: it must be one line without control characters";
    for title in [r#""\u0001""#, r#""two\nlines""#, r#""\u007f""#, r#""\ufffe""#] {
        assert_eq!(refusal(&format!("title = {title}\n{ROTOR}")), format!("line 1: title = {title} {says}"));
    }
    let refused = titled(r#""A rotor""#, "a\u{1}.toml").expect_err("no name in XML").to_string();
    assert!(refused.ends_with("the file of a scene has no control characters in its name"), "{refused}");
    // Any other letter is welcome.
    assert_eq!(titled(r#""Läufer φ <&> 转子""#, "läufer.toml").expect("a scene").title, "Läufer φ <&> 转子");
}

#[test]
fn a_folder_is_no_scene() {
    let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
    let given = scenes.display().to_string();
    let refused = Scene::find(&given, &scenes).expect_err("a folder").to_string();
    assert_eq!(refused, format!("error: this is a folder\n--> {given}\n = help: a scene is a TOML file"));
}

/// The value of a variable in the rotor with this below it.
fn value(rest: &str, name: &str) -> f64 {
    let scene =
        Scene::parse(Path::new("good.toml"), &format!("{ROTOR}{rest}")).unwrap_or_else(|error| panic!("{error}"));
    let variable = scene.variables.iter().find(|variable| variable.name == name);
    scene.starts[&variable.unwrap_or_else(|| panic!("{name}")).place.value_reference()]
}

#[test]
fn exact_numbers_with_units_have_the_bits_of_those_in_si() {
    let bearing = "[[effects.bearing]]\nposition = \"20 mm\"\nkyy = \"1e4 N/mm\"\nct = \"7 N m s/rad\"\n\
                   speed = [0, \"60 rpm\"]\nkzz = [\"1 kN/mm\", 2e6]\n";
    for (rest, name, si) in [
        ("[start]\nomega = { x = \"30000 rpm\" }\n", "start.omega.x", 500.0 * std::f64::consts::TAU),
        ("[start]\nphi = \"180 deg\"\n", "start.phi", std::f64::consts::PI),
        ("[solver]\nstep_size = \"1 ms\"\n", "solver.step_size", 1e-3),
        (bearing, "bearing[1].position", 0.02),
        (bearing, "bearing[1].kyy", 1e7),
        (bearing, "bearing[1].ct", 7.0),
        (bearing, "bearing[1].speed[2]", std::f64::consts::TAU),
        (bearing, "bearing[1].kzz[1]", 1e6),
    ] {
        assert_eq!(value(rest, name), si, "{name}");
    }
    let timed = format!("{ROTOR}[experiment]\nstop = \"2 min\"\nstep = \"10 ms\"\n");
    let experiment = Scene::parse(Path::new("good.toml"), &timed).expect("a scene").experiment;
    assert_eq!((experiment.stop, experiment.step), (120.0, 0.01));
}

#[test]
fn each_quantity_of_a_variable_has_a_name() {
    // What it is told by where a unit does not fit.
    let text = std::fs::read_to_string(Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes/rotor.toml"))
        .expect("it is there");
    let scene = Scene::parse(Path::new("rotor.toml"), &text).expect("a scene");
    let mut units = std::collections::BTreeSet::new();
    for variable in scene.variables.iter().filter(|variable| variable.meta.has_start()) {
        units.insert(variable.meta.unit.name);
    }
    assert!(units.len() > 10);
    for unit in units.into_iter().filter(|unit| !unit.is_empty()) {
        let found = refusal(&format!("{ROTOR}[start]\nphi = \"1 {unit}\"\nr_c = {{ x = \"1 {unit}\" }}\n"));
        assert!(found.contains(" is a") && !found.contains(" is in "), "{unit}: {found}");
    }
}

#[test]
fn a_speed_in_1_per_minute_is_refused_for_it_may_count_turns() {
    let speed = |text: &str| format!("{ROTOR}[start]\nomega = {{ x = \"{text}\" }}\n");
    for unit in ["1/min", "min^-1", "min⁻¹"] {
        let said = format!(
            "line 7: start.omega.x = \"3000 {unit}\" may count turns or radians: turns a minute are rpm, radians rad/min"
        );
        assert_eq!(refusal(&speed(&format!("3000 {unit}"))), said);
    }
    for sound in ["3000 rpm", "3000 rev/min", "3000 rad/min", "50 1/s", "50 Hz"] {
        Scene::parse(Path::new("good.toml"), &speed(sound)).expect(sound);
    }
    // Nor in the columns of a CSV.
    let folder = std::env::temp_dir().join(format!("split_rotor_speeds_{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder for what is tried");
    let told = ["rpm", "1/min"].map(|unit| {
        let csv = format!("time [s],imposed_speed.w [{unit}]\n0,0\n1,60\n");
        std::fs::write(folder.join("x.csv"), csv).expect("the folder can be written");
        let input = "[effects.imposed_speed]\n[[input]]\nname = \"imposed_speed.w\"\nfile = \"x.csv\"\n";
        let scene = Scene::parse(&folder.join("any.toml"), &format!("{ROTOR}{input}"));
        scene.map(|scene| scene.inputs[0].value.clone()).map_err(|error| error.problems[0].wrong.clone())
    });
    let refused = "line 1 of x.csv has a unit that does not fit, [1/min]".to_owned();
    assert_eq!(told, [Ok(vec![0.0, 2.0 * std::f64::consts::PI]), Err(refused)]);
    std::fs::remove_dir_all(&folder).expect("it is there");
}

#[test]
fn exact_gravity_that_is_empty_is_that_of_the_earth() {
    let along = |rest: &str| ["x", "y", "z"].map(|axis| value(rest, &format!("gravity.g.{axis}")));
    assert_eq!(along("[effects.gravity]\n"), [0.0, 0.0, -9.81]);
    assert_eq!(along("[effects.gravity]\ng = { x = -9.81 }\n"), [-9.81, 0.0, 0.0]);
    assert_eq!(along("[effects.gravity]\ng = {}\n"), [0.0; 3]);
    // In the general scene too, and only where it is called for.
    let general = |rest: &str| {
        let text = format!("general = true\n{ROTOR}{rest}");
        Named::written(&text).get("gravity.g.z")
    };
    assert_eq!([general("[effects.gravity]\n"), general("")], [-9.81, 0.0]);
}

/// What a moment makes of the whole, relative \[1]: rounding.
const OF_A_MOMENT: f64 = 1e-15;

#[test]
fn exact_moment_of_an_unbalance() {
    let [moment, m, axial, across] = [4e-5, 5.0, 0.15625, 0.078125];
    let rest = "[[effects.unbalance]]\nmoment = \"40 g mm\"\nangle = \"90 deg\"\nposition = \"5 cm\"\n";
    // A disk that is no thin one: a point mass beside it is part of it.
    let (thick, across) = (ROTOR.replace("Jt = 0.078125", "Jt = 0.09"), across + 0.011875);
    let values = |rest: &str| {
        let mut scene = Named::written(&format!("{thick}{rest}"));
        let names = ["unbalance[1].mass", "unbalance[1].radius", "rotor.m", "rotor.Ja", "rotor.Jt"];
        names.map(|name| scene.get(name))
    };
    let [mass, radius, balanced, balanced_axial, balanced_across] = values(rest);
    within("moment", (mass * radius / moment - 1.0).abs(), OF_A_MOMENT);
    // The scene's mass and inertias are those of the whole, about c and in the mean of both directions across.
    within("mass", ((balanced + mass) / m - 1.0).abs(), OF_A_MOMENT);
    within("axial", ((balanced_axial + mass * radius * radius) / axial - 1.0).abs(), OF_A_MOMENT);
    let of_point = mass * (0.05 * 0.05 + 0.5 * radius * radius);
    within("across", ((balanced_across + of_point) / across - 1.0).abs(), OF_A_MOMENT);
    // Not at all in the limit.
    assert_eq!(values(&rest.replace("40", "0"))[0], 0.0);
    assert_eq!(
        refusal(&format!("{ROTOR}{}mass = 0.1\n", rest)),
        "line 10: `mass` beside a moment: a moment is mass times radius: give either the moment or both of these"
    );
    let negative = refusal(&format!("{ROTOR}{}", rest.replace("40", "-40")));
    assert!(negative.starts_with("line 7: effects.unbalance[1].moment = \"-40 g mm\" is not possible"), "{negative}");
    // Nothing is left of a rotor lighter than what the moment stands for, nor of a thin disk with a mass beside it.
    for (rotor, moment) in [(&thick, "40 kg m"), (&ROTOR.to_owned(), "40 g mm")] {
        let nothing = refusal(&format!("{rotor}{}", rest.replace("40 g mm", moment)));
        assert!(
            nothing.starts_with("line 7: [rotor] has m, Ja and Jt of the whole: no rotor is left without"),
            "{nothing}"
        );
        assert_eq!(nothing.lines().count(), 1, "{nothing}");
    }
}

/// The largest difference of two whirls, over the larger of them \[1]: measured 1e-11.
const SAME_WHIRL: f64 = 1e-9;

#[test]
fn regress_a_moment_adds_no_mass() {
    let run = |rotor: &str, unbalance: &str| {
        let mut rotor = Named::started(&format!(
            "[rotor]\n{rotor}\n[start]\nat_rest = true\n[effects.gravity]\n[[effects.bearing]]\nposition = 0.0\nkyy = 10000.0\n\
             kzz = 10000.0\nkxx = 1e4\nkt = 100.0\n[[effects.unbalance]]\n{unbalance}\nposition = 0.0\n[effects.imposed_speed]\nw = 0.0\n\
             a = 237.17082451262849\n[solver]\nrelative_tolerance = 1e-12\n"
        ));
        let places = (1..=200).map(|n| {
            at(&mut rotor.simulation, 0.01 * f64::from(n));
            [rotor.get("r_c.y"), rotor.get("r_c.z")]
        });
        places.collect::<Vec<_>>()
    };
    // The same mass and axial inertia of the whole, by another point mass. It was 4.4 % away.
    let given = run("m = 0.1\nJa = 1e-5\nJt = 1e-4", "moment = 5e-7");
    let other = run("m = 0.09999\nJa = 9.975e-6\nJt = 9.99875e-5", "mass = 1e-5\nradius = 0.05");
    let largest = given.iter().flatten().fold(0.0, |most: f64, place| most.max(place.abs()));
    let off = given.iter().flatten().zip(other.iter().flatten()).map(|(one, other)| (one - other).abs());
    within("whirl", off.fold(0.0, f64::max) / largest, SAME_WHIRL);
}

#[test]
fn inputs_over_time_from_the_scene_or_a_csv() {
    let folder = std::env::temp_dir().join(format!("split_rotor_inputs_{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder for what is tried");
    let parse = |points: &str| {
        let text = format!("{ROTOR}[effects.drive]\n[[input]]\nname = \"drive.tau\"\n{points}\n");
        Scene::parse(&folder.join("good.toml"), &text).map(|scene| scene.inputs)
    };
    let told = parse("time = [0, \"100 ms\", 0.1]\nvalue = [0, \"1 kN mm\", 2.5]").expect("a scene");
    assert_eq!(
        (&*told[0].name, &*told[0].time, &*told[0].value),
        ("drive.tau", &[0.0, 0.1, 0.1][..], &[0.0, 1.0, 2.5][..])
    );
    for csv in [
        "time,tau\n0,0\n0.1,1.0\n0.1,2.5\n",
        "0, 0\r\n0.1, 1\r\n\r\n0.1, 2.5\r\n",
        "\u{feff}\"Time (s)\",\"torque [N.m]\"\n0,0\n0.1,1\n0.1,2.5\n",
        "# time,tau\n0,0\n0.1,1\n0.1,2.5\n",
        // Bits of the shifted point, as in a scene.
        "t [ms],drive.tau [kN.mm]\n0,0\n100,1\n100,2.5\n",
        "t [ms],Torque [mNm]\n0,0\n100,1000\n100,2500\n",
        "\"time\",\"drive.tau\"\n\"0\",\"0\"\n\"0.1\",\"1\"\n\"0.1\",\"2.5\"\n",
        "# bench 3\ntime,tau\n# warm\n0,0\n0.1,1\n  # a jump\n0.1,2.5\n# end\n",
        "# Measured on site, at the bench\n0,0\n0.1,1\n0.1,2.5\n",
        "# test on site, third run\n0,0\n0.1,1\n0.1,2.5\n",
        "# Measured in May, at 20 degrees, by us\n# Time [s],Torque [Nm]\n0,0\n0.1,1\n0.1,2.5\n",
        // Of several columns that with the input's name, or the only one with a unit that fits.
        "time,drive.w,drive.tau,phi\n0,7,0,1\n0.1,8,1,2\n0.1,9,2.5,3\n",
        "Time [s],Speed [rpm],\"Torque, left [Nm]\"\n0,1500,0\n0.1,1502,1\n0.1,1504,2.5\n",
        "Zeit [ms],n [rpm],M (Nm),Name\n0,0,0,a\n100,0,1,b\n100,0,2.5,\"c,d\"\n",
        "time,motor.tau,tau\n0,7,0\n0.1,8,1\n0.1,9,2.5\n",
    ] {
        std::fs::write(folder.join("x.csv"), csv).expect("the folder can be written");
        assert_eq!(parse("file = \"x.csv\"").expect("a scene"), told);
    }
    let columns = "line 1 of x.csv does not name the columns";
    for (csv, wrong) in [
        ("t,tau\n0,1\n1\n", "line 3 of x.csv is no point"),
        ("0,1\n1,nan\n", "line 2 of x.csv is no point"),
        ("0,1\n2,1\n1,1\n", "line 3 of x.csv comes after 2.0 s"),
        ("", "x.csv has no points"),
        ("time,tau\n", "x.csv has no points"),
        // What is no point is not taken for the names of columns, and names must be those that are meant.
        ("0;30\n1;2,5\n", "x.csv has semicolons between its columns"),
        ("0 30\n1 2\n", "x.csv has blanks between its columns"),
        ("time\ttau\n0\t30\n", "x.csv has tabs between its columns"),
        ("0.0 s,30 N\n1,2\n", "line 1 of x.csv is no point"),
        ("-,-\n1,2\n", "line 1 of x.csv is no point"),
        ("O.0,3O.0\n1,2\n", columns),
        ("# zero,thirty\n1,2\n", columns),
        ("# run, Drehzahl in rpm\n1,2\n", columns),
        ("zero,thirty\n1,2\n", columns),
        ("tau,time\n1,2\n", columns),
        ("time,time\n1,2\n", columns),
        ("time,turns\n1,2\n", columns),
        ("time,tau,speed\n1,2\n", "line 2 of x.csv is no point"),
        ("0,1,2\n1,2,3\n", "line 1 of x.csv is no point"),
        ("t,x\n0,1\n1,2\n", columns),
        (",tau\n0,1\n1,2\n", columns),
        ("time_ms,tau\n0,1\n1,2\n", columns),
        ("time,port[1].m.x [N.m]\n0,1\n1,2\n", columns),
        ("time,tau,tau\n0,1,2\n", "line 1 of x.csv names tau more than once"),
        ("time,a [Nm],b [kN.mm]\n0,1,2\n", "line 1 of x.csv has several columns that may be drive.tau"),
        ("time,torque_Nm\n0,1\n", "line 1 of x.csv has a unit without brackets, torque_Nm"),
        ("time,speed_rpm\n0,1\n", "line 1 of x.csv has a unit without brackets, speed_rpm"),
        ("time,n,torque Nm\n0,1,2\n", "line 1 of x.csv has a unit without brackets, torque Nm"),
        ("# t_s;tau\n0;30\n", "x.csv has semicolons between its columns"),
        ("time [m],tau\n1,2\n", "line 1 of x.csv has a unit that does not fit, [m]"),
        ("time,tau [N]\n1,2\n", "line 1 of x.csv has a unit that does not fit, [N]"),
        ("time,tau [ ]\n1,2\n", "line 1 of x.csv has a unit that does not fit, []"),
    ] {
        std::fs::write(folder.join("x.csv"), csv).expect("the folder can be written");
        let error = parse("file = \"x.csv\"").expect_err(csv);
        assert_eq!(error.problems[0].wrong, wrong, "{csv}");
        // Its excerpt is that of the CSV.
        let line = error.problems[0].line.as_ref().map(|line| csv.lines().nth(line.number - 1));
        assert!(line.flatten().is_none_or(|line| error.to_string().contains(&format!("| {line}\n"))), "{error}");
    }
    // All lines at once, unless they are many.
    std::fs::write(folder.join("x.csv"), "0/1\n1,1\n2/1\n3/1\n4/1\n5,a\n").expect("the folder can be written");
    let error = parse("file = \"x.csv\"").expect_err("no points").to_string();
    for told in ["x.csv:1:1", "x.csv:3:1", "x.csv:4:1", "2 more lines of x.csv are wrong"] {
        assert!(error.contains(told), "{told}: {error}");
    }
    // Another encoding than UTF-8.
    let file = folder.join("latin.toml");
    std::fs::write(&file, [b"title = \"".as_slice(), b"Kr\xfcmmung\"\n"].concat()).expect("the folder can be written");
    let error = Scene::read(&file).expect_err("no UTF-8").to_string();
    assert!(error.contains("latin.toml:1:12") && error.contains("save the file as UTF-8"), "{error}");
    std::fs::remove_dir_all(&folder).expect("it is there");
}

/// The torque that a CSV has in its column, or what is wrong with it and what would be right.
fn torque_of(csv: &str, input: &str, rest: &str) -> Result<Vec<f64>, [String; 2]> {
    static NEXT: std::sync::atomic::AtomicU32 = std::sync::atomic::AtomicU32::new(0);
    let number = NEXT.fetch_add(1, std::sync::atomic::Ordering::Relaxed);
    let folder = std::env::temp_dir().join(format!("split_rotor_columns_{}_{number}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder for what is tried");
    std::fs::write(folder.join("x.csv"), csv).expect("the folder can be written");
    let text = format!("{ROTOR}[[input]]\nname = \"{input}\"\nfile = \"x.csv\"\n{rest}\n");
    let block = input.split(['.', '[']).next().unwrap_or_default();
    let keys = if block == "motor" { "synchronous_speed = 100.0" } else { "" };
    let scene = Scene::parse(&folder.join("any.toml"), &format!("{text}[effects.{block}]\n{keys}\n"));
    std::fs::remove_dir_all(&folder).expect("it is there");
    scene.map(|mut scene| scene.inputs.remove(0).value).map_err(|error| {
        let problem = &error.problems[0];
        [problem.wrong.clone(), problem.right.clone()]
    })
}

#[test]
fn regress_a_column_is_never_read_as_another_quantity() {
    let rpm = |n: f64| n * 2.0 / 60.0 * std::f64::consts::PI;
    let wrong = |is: &str, right: &str| Err([format!("line 1 of x.csv {is}"), right.to_owned()]);
    // It ran at 3000 rad/s.
    let bare = "time,speed_rpm\n0,0\n1,3000\n2,3000\n";
    assert_eq!(
        torque_of(bare, "imposed_speed.w", ""),
        wrong(
            "has a unit without brackets, speed_rpm",
            "write speed [rpm], or column = \"speed_rpm [rpm]\" in the scene"
        )
    );
    assert_eq!(
        torque_of(bare, "imposed_speed.w", "column = \"speed_rpm\"").map_err(|wrong| wrong[0].clone()),
        Err("line 1 of x.csv has a unit without brackets, speed_rpm".into())
    );
    // Without anything between them.
    for (head, name, unit) in [("speedHz", "speed", "Hz"), ("speedRPM", "speed", "RPM")] {
        let right = format!("write {name} [{unit}], or column = \"{head} [{unit}]\" in the scene");
        let bare = bare.replace("speed_rpm", head);
        for column in [String::new(), format!("column = \"{head}\"")] {
            let is = format!("has a unit without brackets, {head}");
            assert_eq!(torque_of(&bare, "imposed_speed.w", &column), wrong(&is, &right));
        }
    }
    // What is hardly a unit here is none to be guessed: advice that gives a wrong speed is no advice.
    for (head, hint) in
        [("speed_hz", "`Hz`"), ("Drehzahl U/min", "`rev`"), ("speed_rps", "`rev/s`"), ("n_1/min", "[rpm]")]
    {
        for column in [String::new(), format!("column = \"{head}\"")] {
            let [is, right] = torque_of(&bare.replace("speed_rpm", head), "imposed_speed.w", &column).expect_err(head);
            assert_eq!(is, format!("line 1 of x.csv has a unit without brackets, {head}"));
            assert!(right.contains(hint) && !right.contains("[rad/s]"), "{head}: {right}");
        }
    }
    let [_, right] = torque_of(&bare.replace("speed_rpm", "Torque"), "imposed_speed.w", "").expect_err("a torque");
    assert!(right.ends_with("or say column = \"Torque [...]\" in the scene, with its unit"), "{right}");
    let hertz = bare.replace("speed_rpm", "speed [Hz]");
    assert_eq!(
        torque_of(&hertz, "imposed_speed.w", "column = \"speed [rpm]\""),
        Err(["x.csv has no column `speed [rpm]`".into(), "its unit is [Hz]: write column = \"speed\"".into()])
    );
    let speeds = [0.0, rpm(3000.0), rpm(3000.0)].to_vec();
    assert_eq!(torque_of(bare, "imposed_speed.w", "column = \"speed_rpm [rpm]\""), Ok(speeds.clone()));
    assert_eq!(torque_of(&bare.replace("speed_rpm", "speed [RPM]"), "imposed_speed.w", ""), Ok(speeds));
    // A test bench's.
    let bench = "Time [s],Speed [rpm],Torque [Nm]\n0.00,1500,210\n0.01,1502,211\n0.02,1504,212\n";
    let torques = Ok(vec![210.0, 211.0, 212.0]);
    assert_eq!(torque_of(bench, "drive.tau", ""), torques);
    assert_eq!(torque_of(bench, "drive.tau", "column = \"Torque\""), torques);
    assert_eq!(torque_of(bench, "drive.tau", "column = \"Torque [Nm]\""), torques);
    assert_eq!(torque_of(bench, "imposed_speed.w", ""), Ok([1500.0, 1502.0, 1504.0].map(rpm).to_vec()));
    assert_eq!(
        torque_of(bench, "drive.tau", "column = \"Speed\""),
        wrong("has a unit that does not fit, [rpm]", "the column must hold a torque, in [N.m] or another unit of it")
    );
    assert_eq!(
        torque_of(bench, "drive.tau", "column = \"Torqe\""),
        Err(["x.csv has no column `Torqe`".into(), "did you mean `Torque`?".into()])
    );
    // The product's own table: units are those of the variables.
    let result = "time,phi,omega_phi,energy.total\n0,0,1,7\n1,1,2,7\n";
    assert_eq!(torque_of(result, "imposed_speed.w", "column = \"omega_phi\""), Ok(vec![1.0, 2.0]));
    assert_eq!(
        torque_of(result, "imposed_speed.w", "column = \"energy.total\""),
        wrong(
            "has a unit that does not fit, [J]",
            "the column must hold an angular speed, in [rad/s] or another unit of it"
        )
    );
    assert_eq!(
        torque_of(result, "imposed_speed.w", ""),
        wrong(
            "does not name the columns",
            "name the column imposed_speed.w [rad/s], or say column = \"...\" in the scene"
        )
    );
    // Another input's name.
    let other = "time,imposed_speed.a [rad/s2],imposed_speed.w [rpm]\n0,1,30\n1,1,60\n";
    assert_eq!(torque_of(other, "imposed_speed.w", ""), Ok(vec![rpm(30.0), rpm(60.0)]));
    // That of an effect which the scene lacks, by its whole name or its own, and with a unit that fits.
    for (csv, column, unit) in [
        ("time,drive.tau,v\n0,1,2\n", "drive.tau", "[N.m]"),
        ("time,bearing[1].F.y,v\n0,1,2\n", "bearing[1].F.y", "[N]"),
        ("time,port[3].f.y,v\n0,1,2\n", "port[3].f.y", "[N]"),
    ] {
        let found = torque_of(csv, "imposed_speed.w", &format!("column = \"{column}\""));
        let is = format!("has a unit that does not fit, {unit}");
        assert_eq!(found, wrong(&is, "the column must hold an angular speed, in [rad/s] or another unit of it"));
    }
    assert_eq!(
        torque_of("time,drive.tau [rpm],v\n0,30,2\n", "imposed_speed.w", "column = \"drive.tau\""),
        Ok(vec![rpm(30.0)])
    );
    assert_eq!(torque_of("time,drive.w,v\n0,1,2\n", "imposed_speed.w", "column = \"drive.w\""), Ok(vec![1.0]));
    // Units with a hyphen.
    for unit in ["N-m", "kN-mm"] {
        assert_eq!(torque_of(&format!("time,M [{unit}]\n0,5\n"), "drive.tau", ""), Ok(vec![5.0]));
    }
    let [is, right] = torque_of("time,M [ft-lb]\n0,5\n", "drive.tau", "").expect_err("a mass times a length");
    assert_eq!(is, "line 1 of x.csv has a unit that does not fit, [ft-lb]");
    assert!(right.ends_with("lb is a mass: a force is lbf, as in ft lbf"), "{right}");
    assert_eq!(
        torque_of("0,1\n1,2\n", "drive.tau", "column = \"tau\""),
        Err(["x.csv does not name its columns".into(), "its first line must name them, or leave `column` out".into()])
    );
    // A pure number.
    assert_eq!(torque_of("t,motor.command [-]\n0,0.5\n1,1\n", "motor.command", ""), Ok(vec![0.5, 1.0]));
}

#[test]
fn other_files_are_named_for_what_they_are() {
    let folder = std::env::temp_dir().join(format!("split_rotor_other_{}", std::process::id()));
    std::fs::create_dir_all(&folder).expect("a folder for what is tried");
    let ssv = "<?xml version=\"1.0\"?>\n<ssv:ParameterSet xmlns:ssv=\"http://ssp-standard.org/SSP1/SystemStructureParameterValues\"/>";
    for (name, bytes, is) in [
        ("x.xlsx", &b"PK\x03\x04rest"[..], "a workbook of Excel or LibreOffice"),
        ("x.xls", b"\xd0\xcf\x11\xe0", "a workbook of Excel or LibreOffice"),
        ("x.fmu", b"PK\x03\x04rest", "a zip archive, as an FMU and an SSP are"),
        ("x.dat", b"    -1\n    58\nA response\n", "a universal file (UFF)"),
        ("x.ssv", ssv.as_bytes(), "a parameter set of SSP (.ssv) for the general FMU, `rotor`"),
        ("x.xml", ssv.as_bytes(), "a parameter set of SSP (.ssv) for the general FMU, `rotor`"),
        ("ross.toml", b"[\"ShaftElement_0\"]\nL = 0.25\n", "a rotor or element of ROSS"),
        ("ross.json", b"{\"DiskElement_0\": {}}", "a rotor or element of ROSS"),
        ("x.mat", b"MATLAB 5.0 MAT-file", "a file of MATLAB"),
        ("x.parquet", b"PAR1\x15", "a binary table (Parquet, HDF5, TDMS or NumPy)"),
        ("x.txt", b"\xff\xfet\0,\0", "text in UTF-16"),
        ("x.json", b"{\"time\": [0]}", "JSON"),
        ("modelDescription.xml", b"<?xml version=\"1.0\"?><fmiModelDescription/>", "XML"),
    ] {
        let file = folder.join(name);
        std::fs::write(&file, bytes).expect("the folder can be written");
        let as_scene = Scene::read(&file).expect_err(name);
        assert_eq!(as_scene.problems[0].wrong, format!("this is {is}, not a scene"));
        let text = format!("{ROTOR}[effects.drive]\n[[input]]\nname = \"drive.tau\"\nfile = \"{name}\"\n");
        let as_input = Scene::parse(&folder.join("good.toml"), &text).expect_err(name);
        assert_eq!(as_input.problems[0].wrong, format!("{name} is {is}"));
        assert!(!as_scene.problems[0].right.is_empty() && !as_input.problems[0].right.is_empty(), "{name}");
    }
    std::fs::remove_dir_all(&folder).expect("it is there");
}

#[test]
fn what_is_hardly_meant_is_warned_of() {
    let warnings = |text: &str| {
        let text = format!("{ROTOR}[effects.drive]\n{text}\n[experiment]\nstart = 1.0\nstop = 3.0\n");
        Scene::parse(Path::new("odd.toml"), &text).expect("a scene").warnings()
    };
    let input = |times: &str| format!("[[input]]\nname = \"drive.tau\"\ntime = [{times}]\nvalue = [1, 2]\n");
    let unbalance = |mass: &str| format!("[[effects.unbalance]]\nmass = \"{mass}\"\nradius = 0.01\nposition = 0.1\n");
    let place = |x: &str| format!("[[effects.probe]]\nposition = {x}\n");
    let bearing = |rest: &str| format!("[[effects.bearing]]\nposition = 0.1\n{rest}\n");
    for odd in [
        (place("-120"), "probe[1].position = -120.0 m is 960 radii of gyration, 0.125 m, from c: are these mm?"),
        (unbalance("40 kg"), "unbalance[1].mass = 40.0 kg is more than rotor.m = 5.0 kg: are these g?"),
        (unbalance("40 g") + "angle = 90\n", "unbalance[1].angle = 90.0 rad is more than a turn: are these degrees?"),
        (unbalance("0 kg"), "unbalance[1] does nothing: mass is 0"),
        ("[effects.drag]".into(), "drag does nothing: linear, quadratic are 0"),
        (
            "[[effects.bearing]]\nposition = 0.1".into(),
            "bearing[1] does nothing: kyy, kyz, kzy, kzz, cyy, cyz, czy, czz, kxx, cxx, kt, ct are 0",
        ),
        (
            bearing("kxx = 1e6\nkyy = 1e6\ncxx = 1e3\ncyy = 1e3\nczz = 1e3"),
            "bearing[1] has kxx, kyy and no kzz: here x is the axis of the rotor, and y and z lie across it; where the lateral directions \
             are x and y (ROSS, API data sheets, DyRoBeS), write kyy, kzz for them",
        ),
        (
            bearing("kxx = 1e6\ncxx = 1e3\nspeed = [0, 100]\nkyy = [0, 1e6]\ncyy = [1e3, 1e3]"),
            "bearing[1] has kxx, kyy, cxx, cyy and no kzz, czz: here x is the axis of the rotor, and y and z lie across it; where the \
             lateral directions are x and y (ROSS, API data sheets, DyRoBeS), write kyy, kzz, cyy, czz for them",
        ),
        (input("3, 4"), "the input drive.tau begins at 3.0 s, and the run ends at 3.0 s"),
        (input("0, 1"), "the input drive.tau ends at 1.0 s, and the run begins at 1.0 s"),
    ] {
        assert_eq!(warnings(&odd.0), [odd.1], "{}", odd.0);
    }
    for ordinary in [
        bearing("kxx = 1e6\nkyy = 1e6\nkzz = 1e5"),
        bearing("kyy = 1e6"),
        bearing("kxx = 1e6"),
        place("3.7"),
        unbalance("40 g") + "angle = 3\n",
        input("0, 2"),
        input("2.9, 9"),
    ] {
        assert_eq!(warnings(&ordinary), [""; 0], "{ordinary}");
    }
    let imposed = |speed: &str| {
        let input = format!("[[input]]\nname = \"imposed_speed.w\"\ntime = [0, 1]\nvalue = [{speed}, 90]\n");
        let text = format!("{ROTOR}[start]\nomega = {{ x = 50 }}\n[effects.imposed_speed]\n{input}");
        Scene::parse(Path::new("odd.toml"), &text).expect("a scene").warnings()
    };
    assert_eq!(imposed("90"), ["start.omega.x = 50.0 rad/s does not count: imposed_speed.w begins with 90.0 rad/s"]);
    assert_eq!(imposed("50"), [""; 0]);
    for name in crate::harness::named::names() {
        let scene = Named::new(&name, split_rotor_model::simulation::Integrator::Method).scene;
        assert_eq!(scene.warnings(), [""; 0], "{name}");
    }
}

/// A host reads a run at so many points at most, if it takes the scene's own step: more than one a turn of what spins fast.
const POINTS: f64 = 3.001e4;

#[test]
fn regress_no_scene_asks_a_host_for_too_many_points() {
    for name in crate::harness::named::names() {
        let experiment = Named::new(&name, split_rotor_model::simulation::Integrator::Method).scene.experiment;
        let points = (experiment.stop - experiment.start) / experiment.step;
        assert!(points <= POINTS, "{name} asks for {points} points");
    }
}

/// What turns over by any method at the end of the scene [rad] and what is exact: measured 3e-7.
const TURNED_OVER: f64 = 1e-6;

#[test]
fn regress_what_turns_over_does_so_alike_by_every_method() {
    let turned = |method: f64| {
        let mut named = Named::new("dzhanibekov", split_rotor_model::simulation::Integrator::Method);
        named.set("solver.method", method);
        named.start();
        named.simulation.advance(named.scene.experiment.stop).expect("a possible motion");
        named.get("phi")
    };
    // Nothing acts on it, so auto takes one exact drift.
    let exact = turned(1.0);
    for method in [2.0, 3.0, 5.0, 6.0] {
        within(&format!("method {method}"), (turned(method) - exact).abs(), TURNED_OVER);
    }
}
