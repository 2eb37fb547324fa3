//! The section of a library that holds a scene's values: they come back to the bit, and nothing else passes for them.

use split_rotor_model::scene::Scene;
use split_rotor_model::section::{blank, check, fill, find, guid, starts};
use split_rotor_model::xml;
use std::collections::BTreeMap;
use std::path::Path;

const GUID: &str = "{01234567-89ab-cdef-0123-456789abcdef}";
const LIST: &str = "(Gravity, ())";

fn values() -> BTreeMap<u32, f64> {
    [(0, 1.5), (7, -0.0), (256, f64::MIN_POSITIVE / 3.0), (u32::MAX, f64::MAX)].into()
}

fn filled(room: usize) -> Vec<u8> {
    let mut section = blank(LIST, room);
    fill(&mut section, GUID, &values());
    section
}

#[test]
fn exact_values_come_back_to_the_bit() {
    let bits = |starts: &mut dyn Iterator<Item = (u32, f64)>| starts.map(|(n, x)| (n, x.to_bits())).collect::<Vec<_>>();
    for room in [4, 9] {
        let section = filled(room);
        assert_eq!(section.len(), blank(LIST, room).len());
        assert_eq!(check(&section), Ok(()));
        assert_eq!(guid(&section), GUID);
        assert_eq!(bits(&mut starts(&section)), bits(&mut values().into_iter()));
    }
}

#[test]
fn exact_what_was_written_before_is_gone() {
    let mut section = filled(9);
    let fewer = [(3, 4.0)].into();
    fill(&mut section, GUID, &fewer);
    let mut new = blank(LIST, 9);
    fill(&mut new, GUID, &fewer);
    assert_eq!(section, new);
}

#[test]
fn no_flipped_bit_and_no_empty_section_passes() {
    assert!(check(&blank(LIST, 4)).unwrap_err().contains("no values of a scene"));
    let section = filled(9);
    // Behind the mark, by which it is found.
    for place in 16..section.len() {
        for bit in 0..8 {
            let mut other = section.clone();
            other[place] ^= 1 << bit;
            assert!(check(&other).unwrap_err().contains("checksum"), "byte {place}, bit {bit}");
        }
    }
}

#[test]
fn only_a_library_with_one_section_of_the_same_list_and_room_is_filled() {
    let library = |parts: &[&[u8]]| parts.concat();
    let (section, code) = (blank(LIST, 4), [0x90; 100]);
    assert_eq!(find(&mut library(&[&code, &section, &code]), LIST, 4), Ok(&mut *section.clone()));
    let refused = |mut library: Vec<u8>, list, room| find(&mut library, list, room).unwrap_err();
    assert!(refused(library(&[&code]), LIST, 4).contains("0 sections"));
    assert!(refused(library(&[&section, &section]), LIST, 4).contains("2 sections"));
    assert!(refused(library(&[&code, &section[..90]]), LIST, 4).contains("cut"));
    assert!(refused(library(&[&code, &section]), "()", 4).contains("another list"));
    assert!(refused(library(&[&section, &code, &code]), LIST, 5).contains("another"));
}

#[test]
#[should_panic(expected = "there is room for 3 start values")]
fn a_section_without_room_is_not_filled() {
    filled(3);
}

#[test]
fn exact_each_scene_has_room_in_the_library_of_its_list() {
    for name in ["paper", "film_bearings", "rotor", "tumbling"] {
        let scenes = Path::new(env!("CARGO_MANIFEST_DIR")).join("../scenes");
        let scene = Scene::find(name, &scenes).unwrap();
        let mut section = blank(&scene.list(), scene.room());
        fill(&mut section, &xml::guid(&scene), &scene.starts);
        assert_eq!(guid(&section), xml::guid(&scene));
        assert_eq!(starts(&section).collect::<BTreeMap<_, _>>(), scene.starts);
    }
}
