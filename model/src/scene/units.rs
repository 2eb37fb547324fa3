//! A number with its unit, as a scene may have it in quotes: `"30000 rpm"`, `"20 mm"`, `"5 N.m.s/rad"`.
//!
//! A power of ten shifts the point of the number that is written, so that 20 mm have the bits of 0.02; libraries that read units
//! multiply by rounded factors.

use super::similar::did_you_mean;
use crate::variable::units::Unit;
use std::f64::consts::PI;

/// A unit as people write it.
pub(super) struct Written {
    /// How it is written.
    pub name: &'static str,
    /// Whether it may have a prefix.
    pub prefixed: bool,
    /// It is 10 to this power,
    pub ten: i32,
    /// times the first whole number over the second,
    pub ratio: [f64; 2],
    /// times π to this power,
    pub pi: i8,
    /// of the product of kg, m, s and rad to these powers.
    pub exponents: [i8; 4],
}

const fn si(name: &'static str, exponents: [i8; 4]) -> Written {
    Written { name, prefixed: true, ten: 0, ratio: [1.0, 1.0], pi: 0, exponents }
}

const fn other(name: &'static str, ratio: [f64; 2], exponents: [i8; 4]) -> Written {
    Written { ratio, prefixed: false, ..si(name, exponents) }
}

/// An angle of this part of a half turn, or a speed.
const fn turn(name: &'static str, ratio: [f64; 2], exponents: [i8; 4]) -> Written {
    Written { pi: 1, ..other(name, ratio, exponents) }
}

/// The units that a scene may write.
pub(super) const UNITS: &[Written] = &[
    si("m", [0, 1, 0, 0]),
    Written { ten: -3, ..si("g", [1, 0, 0, 0]) },
    si("s", [0, 0, 1, 0]),
    si("rad", [0, 0, 0, 1]),
    si("N", [1, 1, -2, 0]),
    si("J", [1, 2, -2, 0]),
    si("Nm", [1, 2, -2, 0]),
    si("W", [1, 2, -3, 0]),
    si("Pa", [1, -1, -2, 0]),
    Written { ten: -1, ..si("P", [1, -1, -1, 0]) },
    // Speeds are meant: one revolution in a second.
    Written { prefixed: true, ..turn("Hz", [2.0, 1.0], [0, 0, -1, 1]) },
    Written { ten: 5, ..si("bar", [1, -1, -2, 0]) },
    other("t", [1e3, 1.0], [1, 0, 0, 0]),
    other("min", [60.0, 1.0], [0, 0, 1, 0]),
    other("h", [3600.0, 1.0], [0, 0, 1, 0]),
    turn("deg", [1.0, 180.0], [0, 0, 0, 1]),
    turn("°", [1.0, 180.0], [0, 0, 0, 1]),
    turn("rev", [2.0, 1.0], [0, 0, 0, 1]),
    turn("rpm", [2.0, 60.0], [0, 0, -1, 1]),
    turn("RPM", [2.0, 60.0], [0, 0, -1, 1]),
    other("in", [254.0, 1e4], [0, 1, 0, 0]),
    other("ft", [3048.0, 1e4], [0, 1, 0, 0]),
    other("oz", [28_349_523_125.0, 1e12], [1, 0, 0, 0]),
    other("lb", [45_359_237.0, 1e8], [1, 0, 0, 0]),
    other("lbf", [44_482_216_152_605.0, 1e13], [1, 1, -2, 0]),
];

/// What people write for some of them, which no likeness of letters finds.
const ALSO: &[(&str, &str)] = &[
    ("sec", "s"),
    ("r", "rev"),
    ("U", "rev"),
    ("turns", "rev"),
    ("rps", "rev/s"),
    ("degrees", "deg"),
    ("inch", "in"),
    ("lbs", "lb"),
];

/// Prefixes and their powers of ten.
pub(super) const PREFIXES: &[(&str, i32)] =
    &[("n", -9), ("u", -6), ("µ", -6), ("μ", -6), ("m", -3), ("c", -2), ("d", -1), ("k", 3), ("M", 6), ("G", 9)];

/// What quantities are called, by the powers of kg, m, s and rad.
const QUANTITIES: &[([i8; 4], &str)] = &[
    ([0, 0, 0, 0], "a pure number"),
    ([1, 0, 0, 0], "a mass"),
    ([0, 1, 0, 0], "a length"),
    ([0, 0, 1, 0], "a time"),
    ([0, 0, 0, 1], "an angle"),
    ([0, 1, -1, 0], "a speed"),
    ([0, 1, -2, 0], "an acceleration"),
    ([0, 0, -1, 1], "an angular speed"),
    ([0, 0, -2, 1], "an angular acceleration"),
    ([1, 1, -2, 0], "a force"),
    ([1, 2, -2, 0], "a torque"),
    ([1, 2, -3, 0], "a power"),
    ([1, 0, -2, 0], "a stiffness"),
    ([1, 0, -1, 0], "a damping"),
    ([1, 2, -2, -1], "a torsional stiffness"),
    ([1, 2, -1, -1], "a torsional damping"),
    ([1, 2, 0, -2], "a quadratic drag"),
    ([1, 2, 0, 0], "a moment of inertia"),
    ([1, 1, 0, 0], "a moment of unbalance"),
    ([1, -1, -2, 0], "a pressure"),
    ([1, -1, -1, 0], "a viscosity"),
];

/// What a quantity of these powers is called; a radian is a pure number where no name has it.
pub(super) fn quantity(exponents: [i8; 4]) -> Option<&'static str> {
    let named = |same: &dyn Fn([i8; 4]) -> bool| QUANTITIES.iter().find(|(of, _)| same(*of)).map(|(_, name)| *name);
    named(&|of| of == exponents).or_else(|| named(&|of| of[..3] == exponents[..3]))
}

/// A number with its unit.
#[derive(Debug, PartialEq)]
pub(super) struct Quantity<'t> {
    /// The number, in kg, m, s and rad.
    pub value: f64,
    /// Their powers.
    pub exponents: [i8; 4],
    /// How the unit is written.
    pub unit: &'t str,
}

/// What is said of a speed in 1/min.
pub const RPM: &str = "turns a minute are rpm, radians rad/min";

impl Quantity<'_> {
    /// Whether it can be given for this unit: radians are pure numbers.
    pub fn fits(&self, unit: &Unit) -> bool {
        self.exponents[..3] == unit.exponents[..3]
    }

    /// Whether it fits a unit with radians, but by minutes, which rotor people count turns by: a speed in 1/min.
    pub fn may_count_turns(&self, unit: &Unit) -> bool {
        self.fits(unit) && unit.exponents[3] != 0 && self.exponents[3] == 0 && self.unit.contains("min")
    }
}

/// Why a text is no number with a unit.
#[derive(Debug, PartialEq)]
pub(super) enum Unreadable<'t> {
    /// It does not begin with a number.
    NoNumber,
    /// It is nothing but a number.
    NoUnit,
    /// It has a comma: what that does, and how it is right.
    Comma(&'static str, String),
    /// Its unit cannot be read: what of it, and what would be right.
    Unit(&'t str, String),
}

/// Reads a number with its unit. What is a power of ten of SI's unit has the bits that the number has with its point shifted: 20 mm are
/// 0.02.
pub(super) fn read(text: &str) -> Result<Quantity<'_>, Unreadable<'_>> {
    let text = text.trim();
    let (mantissa, exponent, rest) = number(text).ok_or(Unreadable::NoNumber)?;
    if rest.strip_prefix(',').is_some_and(|rest| rest.starts_with(|c: char| c.is_ascii_digit())) {
        let (comma, right) = with_a_point(text);
        return Err(Unreadable::Comma(comma, right));
    }
    let unit = rest.trim_start();
    if unit.is_empty() {
        return Err(Unreadable::NoUnit);
    }
    let mut scale = Scale { ten: exponent, over: 1.0, under: 1.0, pi: 0, exponents: [0; 4] };
    let rest = scale.product(unit, 1)?;
    if !rest.is_empty() {
        return Err(Unreadable::Unit(rest, "a unit is a product of powers, as in N.m.s2/rad2".into()));
    }
    let shifted = format!("{mantissa}e{}", scale.ten).parse::<f64>().map_err(|_| Unreadable::NoNumber)?;
    // π last: 180 deg are π, 30 rpm are π in a second.
    let ratio = shifted * scale.over / scale.under;
    let value = (0..scale.pi.abs()).fold(ratio, |value, _| if scale.pi > 0 { value * PI } else { value / PI });
    Ok(Quantity { value, exponents: scale.exponents, unit })
}

/// The number at the beginning of a text without its power of ten, that power, and what follows.
fn number(text: &str) -> Option<(&str, i32, &str)> {
    let digits = |text: &str| text.len() - text.trim_start_matches(|c: char| c.is_ascii_digit()).len();
    let sign = usize::from(text.starts_with(['+', '-']));
    let whole = sign + digits(&text[sign..]);
    let end = match text[whole..].strip_prefix('.').map(digits) {
        None => whole,
        Some(decimals) => whole + 1 + decimals,
    };
    let (mantissa, rest) = text.split_at(end);
    if !mantissa.contains(|c: char| c.is_ascii_digit()) {
        return None;
    }
    let power = rest.strip_prefix(['e', 'E']).and_then(|after| {
        let sign = usize::from(after.starts_with(['+', '-']));
        let end = sign + digits(&after[sign..]);
        let power = after[..end].parse().ok().filter(|power: &i32| power.abs() < 10_000)?;
        Some((power, &after[end..]))
    });
    let (exponent, rest) = power.unwrap_or((0, rest));
    Some((mantissa, exponent, rest))
}

/// 10^ten · over / under · π^pi, of the product of kg, m, s and rad to the exponents.
struct Scale {
    ten: i32,
    over: f64,
    under: f64,
    pi: i8,
    exponents: [i8; 4],
}

impl Scale {
    /// Takes the factors at the beginning of a text to the power `sign`, 1 or -1; what is left.
    fn product<'t>(&mut self, text: &'t str, sign: i8) -> Result<&'t str, Unreadable<'t>> {
        let mut rest = self.factor(text, sign)?;
        let mut divided = false;
        loop {
            let next = rest.trim_start();
            if let Some(after) = next.strip_prefix('/') {
                divided = true;
                rest = self.factor(after.trim_start(), -sign)?;
                continue;
            }
            let after = next.strip_prefix(['.', '*', '·', '-']).map_or(next, str::trim_start);
            if after.is_empty() || after.starts_with(')') {
                return Ok(next);
            }
            if divided {
                let right = "what follows a `/` needs brackets where it is a product: N/(m.s)";
                return Err(Unreadable::Unit(after, right.into()));
            }
            rest = self.factor(after, sign)?;
        }
    }

    /// Takes one factor: a unit with its power, 1, or a product in brackets.
    fn factor<'t>(&mut self, text: &'t str, sign: i8) -> Result<&'t str, Unreadable<'t>> {
        if let Some(inside) = text.strip_prefix('(') {
            let rest = self.product(inside, sign)?;
            return rest.strip_prefix(')').ok_or(Unreadable::Unit(text, "the bracket is not closed".into()));
        }
        if let Some(rest) = text.strip_prefix('1') {
            return Ok(rest);
        }
        let end = text.find(|c: char| !is_letter(c)).unwrap_or(text.len());
        let (name, rest) = text.split_at(end);
        if name.is_empty() {
            return Err(Unreadable::Unit(text, "a unit is expected here".into()));
        }
        let (prefix, unit) = named(name).ok_or_else(|| Unreadable::Unit(name, unknown(name)))?;
        let (power, rest) = power(rest).ok_or_else(|| Unreadable::Unit(text, "a power is from -9 to 9".into()))?;
        let power = power * sign;
        for _ in 0..power.abs() {
            let [over, under] = unit.ratio;
            let (up, down) = if power > 0 { (over, under) } else { (under, over) };
            (self.over, self.under) = (self.over * up, self.under * down);
        }
        self.ten += i32::from(power) * (prefix + unit.ten);
        self.pi = self.pi.saturating_add(power.saturating_mul(unit.pi));
        for (exponent, of_unit) in self.exponents.iter_mut().zip(unit.exponents) {
            *exponent = exponent.saturating_add(power.saturating_mul(of_unit));
        }
        Ok(rest)
    }
}

fn is_letter(c: char) -> bool {
    c.is_alphabetic() || c == '°'
}

/// What is said where pounds are meant as a force; None where this would not fit either.
pub(super) fn pounds(unit: &str, own: &Unit) -> Option<&'static str> {
    let as_force = format!("1 {}", unit.replace("lb", "lbf"));
    let is_meant = unit.contains("lb") && read(&as_force).is_ok_and(|quantity| quantity.fits(own));
    is_meant.then_some("; lb is a mass: a force is lbf, as in ft lbf")
}

/// The power of ten of a unit's prefix, and the unit.
fn named(name: &str) -> Option<(i32, &'static Written)> {
    let find = |name: &str| UNITS.iter().find(|unit| unit.name == name);
    let prefixed = |(prefix, ten): &(&str, i32)| {
        find(name.strip_prefix(prefix)?).filter(|unit| unit.prefixed).map(|unit| (*ten, unit))
    };
    find(name).map(|unit| (0, unit)).or_else(|| PREFIXES.iter().find_map(prefixed))
}

/// What a comma does in a number, and the number as TOML writes it: of several marks the last is the decimal one, unless it stands twice.
fn with_a_point(text: &str) -> (&'static str, String) {
    const MARKS: [char; 2] = [',', '.'];
    let is_of_number = |c: char| c.is_ascii_digit() || "+-,.".contains(c);
    let number = text.find(|c| !is_of_number(c)).unwrap_or(text.len());
    let (number, rest) = text.split_at(number);
    let mark = number.rfind(MARKS).unwrap_or(number.len());
    let (whole, decimals) = number.split_at(mark);
    let separates = whole.contains(&decimals[..decimals.len().min(1)]);
    let point = if separates { "" } else { "." };
    let comma = if whole.contains(MARKS) { "has a mark between thousands" } else { "has a decimal comma" };
    (comma, format!("{}{point}{}{rest}", whole.replace(MARKS, ""), decimals.replace(MARKS, "")))
}

/// Whether a text may be meant as a unit, though it is none: `hz`, `U/min`, `krpm`, `min-1`.
pub(super) fn may_be_meant(text: &str) -> bool {
    let mut parts = text.split(['/', '*', '.', '-']).map(|part| part.trim_end_matches(|c: char| c.is_ascii_digit()));
    let is_known = |name: &str| {
        let is_it = |known: &str| known.chars().count() > 1 && known.eq_ignore_ascii_case(name);
        UNITS.iter().any(|unit| is_it(unit.name)) || ALSO.iter().any(|(also, _)| *also == name)
    };
    let without_prefix =
        |name: &str| PREFIXES.iter().any(|(prefix, _)| name.strip_prefix(prefix).is_some_and(is_known));
    parts.clone().any(|part| !part.is_empty())
        && parts.all(|part| part.is_empty() || named(part).is_some() || is_known(part) || without_prefix(part))
}

/// What is said of a name that is no unit.
fn unknown(name: &str) -> String {
    if let Some((_, unit)) = ALSO.iter().find(|(also, _)| *also == name) {
        return format!("did you mean `{unit}`?");
    }
    let mut names: Vec<_> = UNITS.iter().map(|unit| unit.name.to_owned()).collect();
    for unit in UNITS.iter().filter(|unit| unit.prefixed) {
        names.extend(PREFIXES.iter().map(|(prefix, _)| format!("{prefix}{}", unit.name)));
    }
    // Two units without a space between, such as Nm, are no third one.
    let parts = name.char_indices().skip(1).map(|(at, _)| name.split_at(at));
    let both = parts.filter(|(one, other)| named(one).is_some() && named(other).is_some());
    // One letter with an s is a product, as in Ns; more may be a plural, as in kgs, and a letter twice a slip, as in rpmm.
    let is_twice = |shorter: &&str| shorter.chars().last() == name.chars().last();
    let doubled = || name.char_indices().last().map(|(at, _)| &name[..at]).filter(is_twice);
    let singular = name.strip_suffix('s').or_else(doubled);
    let singular = singular.filter(|singular| singular.chars().count() > 1 && named(singular).is_some());
    let singular = singular.map_or_else(String::new, |singular| format!("`{singular}` or "));
    let both = both.last().map(|(one, other)| format!("did you mean {singular}`{one} {other}`?"));
    both.or_else(|| did_you_mean(name, names.iter().map(String::as_str))).unwrap_or_else(|| {
        let names: Vec<_> = UNITS.iter().map(|unit| unit.name).collect();
        format!("the units are {}", names.join(", "))
    })
}

/// The power at the beginning of a text, 1 where there is none, and what follows: `2`, `^2`, `-1`, `²`.
fn power(text: &str) -> Option<(i8, &str)> {
    const RAISED: [char; 10] = ['⁰', '¹', '²', '³', '⁴', '⁵', '⁶', '⁷', '⁸', '⁹'];
    let told = text.strip_prefix('^').unwrap_or(text);
    let (sign, digits) = match told.strip_prefix(['-', '⁻']) {
        Some(digits) => (-1, digits),
        None => (1, told),
    };
    let is_product = text.starts_with('-') && digits.starts_with(is_letter);
    let mut digits = digits.chars();
    let digit = digits.next().and_then(|c| {
        let raised = RAISED.iter().position(|raised| *raised == c).map(|digit| digit as u32);
        c.to_digit(10).or(raised)
    });
    match digit {
        Some(digit) if !digits.as_str().starts_with(|c: char| c.is_ascii_digit()) => {
            Some((sign * digit as i8, digits.as_str()))
        }
        // N-m is a product.
        None if told.len() == text.len() && (sign == 1 || is_product) => Some((1, text)),
        _ => None,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn value(text: &str) -> f64 {
        read(text).unwrap_or_else(|wrong| panic!("{text}: {wrong:?}")).value
    }

    #[test]
    fn exact_powers_of_ten_have_the_bits_of_the_number_in_si() {
        for (text, si) in [
            ("20 mm", 0.02),
            ("0.1 mm", 1e-4),
            ("8 µm", 8e-6),
            ("8um", 8e-6),
            ("1e7 N/m", 1e7),
            ("0.3 kN/mm", 3e5),
            ("5 kg", 5.0),
            ("78.1 kg cm2", 78.1e-4),
            ("40 g mm", 4e-5),
            ("12.3 g·mm", 12.3e-6),
            ("20 cP", 0.02),
            ("0.7 MPa", 7e5),
            ("2 mbar", 200.0),
            ("7 N.m.s/rad", 7.0),
            ("5 Nm", 5.0),
            ("2 mNm", 2e-3),
            ("7 Nm s/rad", 7.0),
            ("7 N m s rad^-1", 7.0),
            ("7 N·m·s²/rad²", 7.0),
            ("7 N-m", 7.0),
            ("7 kN-mm/rad", 7.0),
            ("7 kg-m2-s-1", 7.0),
            ("7 kg/(m.s)", 7.0),
            ("3 kg/m/s", 3.0),
            ("-1.5e-3 t", -1.5),
            ("2 1/s", 2.0),
            ("3 s⁻¹", 3.0),
        ] {
            assert_eq!(value(text), si, "{text}");
        }
    }

    #[test]
    fn exact_other_units() {
        for (text, si) in [
            ("2 min", 120.0),
            ("0.5 h", 1800.0),
            ("180 deg", PI),
            ("90°", PI / 2.0),
            ("60 rpm", 2.0 * PI),
            ("60 RPM", 2.0 * PI),
            ("50 Hz", 100.0 * PI),
            ("60 rev/min", 2.0 * PI),
            ("1 in", 0.0254),
            ("2 ft", 0.6096),
            ("1 lb", 0.453_592_37),
            ("1 lbf", 4.448_221_615_260_5),
            ("16 oz", 0.453_592_37),
            ("180 N.m/deg", 32400.0 / PI),
        ] {
            assert_eq!(value(text), si, "{text}");
        }
    }

    #[test]
    fn powers_of_a_unit() {
        assert_eq!(read("1 N.m.s2/rad2").unwrap().exponents, [1, 2, 0, -2]);
        assert_eq!(read("1 kg^2").unwrap().exponents, [2, 0, 0, 0]);
        assert_eq!(quantity([1, 2, 0, -2]), Some("a quadratic drag"));
        assert_eq!(quantity([0, 1, 0, -1]), Some("a length"));
        assert_eq!(quantity([2, 0, 0, 0]), None);
    }

    #[test]
    fn what_cannot_be_read() {
        for text in ["", "ten", "m", "-", ".", "+ m", "nan m"] {
            assert_eq!(read(text), Err(Unreadable::NoNumber), "{text}");
        }
        assert_eq!(read(" 5 "), Err(Unreadable::NoUnit));
        for (written, comma, right) in [
            ("5,25 kg", "has a decimal comma", "5.25 kg"),
            ("-0,5", "has a decimal comma", "-0.5"),
            ("2,000.5 N/m", "has a mark between thousands", "2000.5 N/m"),
            ("2.000,5 N/m", "has a mark between thousands", "2000.5 N/m"),
            ("2,000,000", "has a mark between thousands", "2000000"),
        ] {
            assert_eq!(read(written), Err(Unreadable::Comma(comma, right.into())));
        }
        let unit = |text| match read(text) {
            Err(Unreadable::Unit(what, right)) => (what, right),
            other => panic!("{text}: {other:?}"),
        };
        assert_eq!(unit("5 rmp"), ("rmp", "did you mean `rpm`?".into()));
        assert_eq!(unit("40 gmm").1, "did you mean `g mm`?");
        assert_eq!(unit("0.04 kgm2").1, "did you mean `kg m`?");
        assert_eq!(unit("5 sec").1, "did you mean `s`?");
        assert_eq!(unit("12 kgs").1, "did you mean `kg` or `kg s`?");
        assert_eq!(unit("1000 rpmm").1, "did you mean `rpm` or `rpm m`?");
        assert_eq!(unit("2000 Ns/m").1, "did you mean `N s`?");
        assert_eq!(unit("3000 U/min"), ("U", "did you mean `rev`?".into()));
        assert_eq!(unit("5 N/m.s").0, "s");
        assert_eq!(unit("5 N/(m.s").1, "the bracket is not closed");
        assert_eq!(unit("5 m)").0, ")");
        assert_eq!(unit("5 m^").1, "a power is from -9 to 9");
        assert_eq!(unit("5 m22").1, "a power is from -9 to 9");
        assert_eq!(unit("5 m-").1, "a power is from -9 to 9");
        assert_eq!(unit("5 %").1, "a unit is expected here");
        assert!(unit("5 parsec").1.starts_with("the units are m, g, s"));
        // Nothing with a prefix that has none, nor two of them.
        assert!(read("5 krpm").is_err() && read("5 mmm").is_err());
    }
}
