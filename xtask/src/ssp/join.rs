//! A partner at a terminal: the variables of both that are connected, found by their names.

use super::model::{Model, Variable};
use anyhow::{Result, bail};

/// What the rotor shows a partner besides the members of the terminal: the name there, and here.
const SHOWN_BESIDES: [(&str, &str); 2] = [("w", "omega_phi"), ("phi", "phi")];

/// Pairs of names, the rotor's and the partner's.
#[derive(Debug, PartialEq)]
pub struct Joined {
    /// Outputs of the rotor, inputs of the partner.
    pub shown: Vec<[String; 2]>,
    /// Inputs of the rotor, outputs of the partner.
    pub answered: Vec<[String; 2]>,
}

/// Connects the rotor's terminal of this name to a partner: `r.x` there is `r.x`, `rx` or `r_x` here. Names that the partner lacks stay free.
pub fn join(terminal: &str, rotor: &Model, partner: &Model) -> Result<Joined> {
    let member = |variable: &Variable| Some(variable.name.strip_prefix(terminal)?.strip_prefix('.')?.to_owned());
    let of = |is_input: bool| rotor.variables.iter().filter(move |variable| variable.is_input == is_input);
    let mut besides: Vec<_> = of(false).filter_map(|variable| Some((member(variable)?, variable))).collect();
    let named = |name: &str| of(false).find(|variable| variable.name == name);
    besides.extend(SHOWN_BESIDES.iter().filter_map(|(there, here)| Some((there.to_string(), named(here)?))));
    let members: Vec<_> = of(true).filter_map(|variable| Some((member(variable)?, variable))).collect();
    let reals =
        |is_input: bool| partner.variables.iter().filter(move |of| of.is_input == is_input && of.kind == "Real");
    let (mut shown, mut answered, mut wrong) = (Vec::new(), Vec::new(), Vec::new());
    let mut add = |pairs: &mut Vec<_>, own: &Variable, other: &Variable| {
        match (&own.unit, &other.unit) {
            (Some(of_own), Some(of_other)) if !of_own.is(of_other) => {
                wrong.push(format!("its {} is in {}, and {} in {}", other.name, of_other.name, own.name, of_own.name));
            }
            _ => {}
        }
        pairs.push([own.name.clone(), other.name.clone()]);
    };
    for input in reals(true) {
        if let Some((_, output)) = besides.iter().find(|(name, _)| spelt(name).contains(&input.name)) {
            add(&mut shown, output, input);
        }
    }
    for (name, input) in &members {
        if let Some(output) = spelt(name).iter().find_map(|name| reals(false).find(|of| of.name == *name)) {
            add(&mut answered, input, output);
        }
    }
    if answered.is_empty() {
        let outputs: Vec<_> = reals(false).map(|of| of.name.as_str()).collect();
        let outputs = if outputs.is_empty() { "no outputs".into() } else { outputs.join(", ") };
        let wanted: Vec<_> = members.iter().map(|(name, _)| name.as_str()).collect();
        let dotted = wanted.iter().find(|name| name.contains('.')).map(|name| spelt(name));
        let also = dotted.map_or_else(String::new, |[name, one, other]| format!("; {name} may be {one} or {other}"));
        bail!(
            "none of its outputs has the name of an input of {terminal}. Found: {outputs}. Right: one or more of {}{also}",
            wanted.join(", ")
        );
    }
    if !wrong.is_empty() {
        bail!("units differ, and masters convert none: {}", wrong.join("; "));
    }
    Ok(Joined { shown, answered })
}

/// How a partner may spell the name of a member.
fn spelt(member: &str) -> [String; 3] {
    [member.to_owned(), member.replace('.', ""), member.replace('.', "_")]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A model of such variables, each with a unit.
    fn model(inputs: &[(&str, &str)], outputs: &[(&str, &str)]) -> Model {
        let variable = |(name, unit): &(&str, &str), causality: &str| {
            let unit = if unit.is_empty() { String::new() } else { format!(" unit=\"{unit}\"") };
            format!("<ScalarVariable name=\"{name}\" causality=\"{causality}\"><Real{unit}/></ScalarVariable>")
        };
        let inputs = inputs.iter().map(|of| variable(of, "input"));
        let variables: String = inputs.chain(outputs.iter().map(|of| variable(of, "output"))).collect();
        Model::read(&format!(
            "<fmiModelDescription fmiVersion=\"2.0\"><CoSimulation/>{variables}</fmiModelDescription>"
        ))
        .unwrap()
    }

    fn rotor() -> Model {
        let outputs =
            [("port[1].r.x", "m"), ("port[1].r.y", "m"), ("port[10].r.x", "m"), ("phi", "rad"), ("omega_phi", "rad/s")];
        model(&[("port[1].f.x", "N"), ("port[1].f.y", "N"), ("port[10].f.x", "N")], &outputs)
    }

    fn pairs(joined: &[[String; 2]]) -> String {
        joined.iter().map(|[own, other]| format!("{own}={other} ")).collect()
    }

    #[test]
    fn names_are_found_however_they_are_spelt() {
        for [x, y, f] in [["r.x", "r.y", "f.y"], ["rx", "ry", "fy"], ["r_x", "r_y", "f_y"]] {
            let partner = model(&[(x, "m"), (y, ""), ("w", "rad/s"), ("T", "K")], &[(f, "N"), ("loss", "W")]);
            let joined = join("port[1]", &rotor(), &partner).unwrap();
            assert_eq!(pairs(&joined.shown), format!("port[1].r.x={x} port[1].r.y={y} omega_phi=w "));
            assert_eq!(pairs(&joined.answered), format!("port[1].f.y={f} "));
        }
    }

    #[test]
    fn a_member_of_the_terminal_comes_before_what_is_shown_besides() {
        let rotor = model(&[("drive.tau", "N.m")], &[("phi", "rad"), ("drive.phi", "rad")]);
        let joined = join("drive", &rotor, &model(&[("phi", "rad")], &[("tau", "N.m")])).unwrap();
        assert_eq!(pairs(&joined.shown), "drive.phi=phi ");
    }

    #[test]
    fn a_partner_that_answers_nothing_is_told_what_is_right() {
        let partner = model(&[("phi1", "rad"), ("f.x", "N")], &[("tau1", "N.m"), ("tau2", "N.m")]);
        let refused = join("port[1]", &rotor(), &partner).unwrap_err().to_string();
        let expected = "none of its outputs has the name of an input of port[1]. Found: tau1, tau2. Right: one or more of f.x, f.y; \
                        f.x may be fx or f_x";
        assert_eq!(refused, expected);
    }

    #[test]
    fn all_other_units_are_told() {
        let partner = model(&[("rx", "mm")], &[("fx", "kN"), ("fy", "N")]);
        let refused = join("port[1]", &rotor(), &partner).unwrap_err().to_string();
        let expected = "units differ, and masters convert none: its rx is in mm, and port[1].r.x in m; its fx is in kN, and port[1].f.x in N";
        assert_eq!(refused, expected);
    }
}
