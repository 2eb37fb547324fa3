//! Names that a user may give, and what is said of those that are none.

use split_rotor_model::scene::did_you_mean;

/// ` (did you mean …?)` for a name that is none of these and no word of them, or nothing.
pub fn meant<'n>(name: &str, known: impl IntoIterator<Item = &'n str>) -> String {
    let words = |known: &'n str| known.split(' ').map(|word| word.trim_matches(|c: char| !c.is_alphanumeric()));
    let mut candidates: Vec<_> = known.into_iter().flat_map(|known| words(known).chain([known])).collect();
    candidates.sort_unstable();
    candidates.dedup();
    // One that is known may still not be there to choose.
    candidates.retain(|known| *known != name);
    did_you_mean(name, candidates).map_or_else(String::new, |meant| format!(" ({meant})"))
}

#[cfg(test)]
mod tests {
    #[test]
    fn a_word_of_a_name_may_be_meant() {
        let known = ["Rust's tests", "hard cases, with mutants", "bearing[1].kyy"];
        for (name, meant) in [
            ("mutnats", " (did you mean `mutants`?)"),
            ("bearing[1].kyyy", " (did you mean `bearing[1].kyy`?)"),
            ("nosuch", ""),
        ] {
            assert_eq!(super::meant(name, known), meant);
        }
    }
}
