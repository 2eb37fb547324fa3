//! What somebody may have meant.

/// A name is like another one where so much of both is the same \[1], from 0 to 1.
const ALIKE: f64 = 0.5;

/// "did you mean `kyy`?", or None where no name is like this one.
pub fn did_you_mean<'n>(name: &str, known: impl IntoIterator<Item = &'n str>) -> Option<String> {
    let best = similar(name, known);
    let names: Vec<_> = best.iter().map(|name| format!("`{name}`")).collect();
    (!names.is_empty()).then(|| format!("did you mean {}?", names.join(" or ")))
}

/// The names that are most like this one, at most three: with capitals and small letters alike, or else by the letters that must be
/// changed, left out, added or swapped.
pub(super) fn similar<'n>(name: &str, known: impl IntoIterator<Item = &'n str>) -> Vec<&'n str> {
    let likeness = |other: &str| {
        let same = strsim::normalized_damerau_levenshtein(name, other);
        if other.eq_ignore_ascii_case(name) { 1.0 } else { same }
    };
    let mut known: Vec<_> = known.into_iter().map(|other| (likeness(other), other)).collect();
    let most = known.iter().map(|(same, _)| *same).fold(ALIKE, f64::max);
    known.retain(|(same, _)| *same == most && *same > ALIKE);
    if known.len() > 3 { Vec::new() } else { known.into_iter().map(|(_, other)| other).collect() }
}

#[cfg(test)]
mod tests {
    use super::did_you_mean;

    #[test]
    fn a_slip_finds_its_name() {
        let known = ["position", "kyy", "kyz", "kzy", "kxx", "relative_tolerance", "omega"];
        for (name, meant) in [
            ("kyyy", Some("did you mean `kyy`?")),
            ("k_yy", Some("did you mean `kyy`?")),
            ("KYY", Some("did you mean `kyy`?")),
            ("postion", Some("did you mean `position`?")),
            ("relative_tolernace", Some("did you mean `relative_tolerance`?")),
            ("kyx", Some("did you mean `kyy` or `kyz` or `kxx`?")),
            ("stiffness", None),
            ("", None),
        ] {
            assert_eq!(did_you_mean(name, known).as_deref(), meant, "{name}");
        }
    }
}
