//! Files that users take for a scene or for the points of an input: what each is, and what to do with it.

use std::path::Path;

/// What a user gives a file for.
#[derive(Clone, Copy)]
pub(super) enum Purpose {
    /// As a scene.
    Scene,
    /// As the points of an input.
    Input,
}

/// A kind of file that can be neither.
struct Kind {
    /// What it is.
    is: &'static str,
    /// Whether a file with this extension, in small letters, and these bytes is one.
    matches: fn(&str, &[u8]) -> bool,
    /// What to do with it in place of a scene.
    for_scene: &'static str,
    /// What to do with it in place of points.
    for_input: &'static str,
}

/// What is said of files that hold measurements, given as a scene.
const NAME_IN_SCENE: &str = "a scene is a TOML file; it names a CSV of points with `file = ...` in its [[input]]";
/// What is said of files that describe a rotor, given as points.
const NO_POINTS: &str = "it has no points over time: give a CSV with a time and a value in each line";
/// What is said of binary tables, given as points.
const EXPORT: &str = "save its columns as a CSV: a time and values in each line, commas between them";

const KINDS: &[Kind] = &[
    Kind {
        is: "a workbook of Excel or LibreOffice",
        matches: |extension, bytes| {
            ["xlsx", "xlsm", "xlsb", "xls", "ods"].contains(&extension) || bytes.starts_with(b"\xd0\xcf\x11\xe0")
        },
        for_scene: "a scene is a TOML file; columns of a sheet go into it as arrays, such as `speed = [...]`",
        for_input: "save the sheet as a CSV: commas between columns, decimals behind a point",
    },
    Kind {
        is: "a zip archive, as an FMU and an SSP are",
        matches: |extension, bytes| ["fmu", "ssp"].contains(&extension) || bytes.starts_with(b"PK\x03\x04"),
        for_scene: "give the TOML file of the scene",
        for_input: NO_POINTS,
    },
    Kind {
        is: "a universal file (UFF)",
        matches: |extension, bytes| {
            let lines = || text(bytes).lines().map(str::trim).filter(|line| !line.is_empty());
            let is_number = |line: &str| line.len() <= 6 && line.bytes().all(|byte| byte.is_ascii_digit());
            let begins = lines().next() == Some("-1") && lines().nth(1).is_some_and(is_number);
            ["uff", "unv"].contains(&extension) || begins
        },
        for_scene: NAME_IN_SCENE,
        for_input: "write the record as a CSV: pyuff reads it in Python",
    },
    Kind {
        is: "a parameter set of SSP (.ssv) for the general FMU, `rotor`",
        matches: |extension, bytes| extension == "ssv" || text(bytes).contains("SystemStructureParameterValues"),
        for_scene: "apply it to rotor.fmu in an SSP tool, or give the TOML file that `cargo xtask ssv` made it from",
        for_input: NO_POINTS,
    },
    Kind {
        is: "a rotor or element of ROSS",
        matches: |_, bytes| {
            let elements = ["ShaftElement", "DiskElement", "BearingElement", "SealElement"];
            // Headers of TOML, or keys of JSON.
            let heads = |element: &&str| {
                ["[", "[\"", "\""].iter().any(|mark| text(bytes).contains(&format!("{mark}{element}")))
            };
            elements.iter().any(heads)
        },
        for_scene: "write its mass, inertias and bearings into a scene: [rotor], [[effects.bearing]]",
        for_input: NO_POINTS,
    },
    Kind {
        is: "a file of MATLAB",
        matches: |extension, bytes| extension == "mat" || bytes.starts_with(b"MATLAB 5.0"),
        for_scene: NAME_IN_SCENE,
        for_input: EXPORT,
    },
    Kind {
        is: "a binary table (Parquet, HDF5, TDMS or NumPy)",
        matches: |extension, bytes| {
            let magic: [&[u8]; 4] = [b"PAR1", b"\x89HDF", b"TDSm", b"\x93NUMPY"];
            ["parquet", "h5", "hdf5", "tdms", "npy"].contains(&extension)
                || magic.iter().any(|it| bytes.starts_with(it))
        },
        for_scene: NAME_IN_SCENE,
        for_input: EXPORT,
    },
    Kind {
        is: "XML",
        matches: |_, bytes| text(bytes).trim_start().starts_with("<?xml"),
        for_scene: "a scene is a TOML file",
        for_input: NO_POINTS,
    },
    Kind {
        is: "text in UTF-16",
        matches: |_, bytes| bytes.starts_with(b"\xff\xfe") || bytes.starts_with(b"\xfe\xff"),
        for_scene: "save it as UTF-8",
        for_input: "save it as UTF-8, with commas between columns",
    },
    Kind {
        is: "JSON",
        matches: |_, bytes| text(bytes).trim_start().starts_with('{'),
        for_scene: "a scene is a TOML file",
        for_input: EXPORT,
    },
];

/// So much of a file is looked at \[bytes].
const HEAD: usize = 8192;

/// The text at the beginning of a file; nothing where that is no text.
fn text(bytes: &[u8]) -> &str {
    let head = &bytes[..bytes.len().min(HEAD)];
    let head = head.utf8_chunks().next().map_or("", |chunk| chunk.valid());
    head.strip_prefix('\u{feff}').unwrap_or(head)
}

/// What a file of these bytes is, and what to do with it; None where it may be what it is given for.
pub(super) fn recognised(file: &Path, bytes: &[u8], purpose: Purpose) -> Option<[&'static str; 2]> {
    let extension = file.extension().unwrap_or_default().to_string_lossy().to_lowercase();
    match (purpose, &*extension) {
        (Purpose::Scene, "csv") => return Some(["a CSV", NAME_IN_SCENE]),
        (Purpose::Input, "toml") if text(bytes).contains("[rotor]") => return Some(["a scene", NO_POINTS]),
        _ => {}
    }
    let kind = KINDS.iter().find(|kind| (kind.matches)(&extension, bytes))?;
    Some(match purpose {
        Purpose::Scene => [kind.is, kind.for_scene],
        Purpose::Input => [kind.is, kind.for_input],
    })
}
