"""What an FMU of PythonFMU (0.6.3, 0.7.0) should declare, and declares only where its author writes it: units, and the inputs on which each
output depends.

A partner calls `parameter`, `state`, `shown` and `answer` for its variables, and returns `complete(...)` from `to_xml`.
"""

from xml.etree.ElementTree import Element, SubElement

from pythonfmu import Fmi2Causality, Fmi2Initial, Fmi2Variability, Real

UNITS = {
    "1": {},
    "A": {"A": 1},
    "A.s/m": {"A": 1, "s": 1, "m": -1},
    "A/m": {"A": 1, "m": -1},
    "N": {"kg": 1, "m": 1, "s": -2},
    "N.m": {"kg": 1, "m": 2, "s": -2},
    "N.m.s/rad": {"kg": 1, "m": 2, "s": -1, "rad": -1},
    "N.m/rad": {"kg": 1, "m": 2, "s": -2, "rad": -1},
    "N.s/m": {"kg": 1, "s": -1},
    "N/A": {"kg": 1, "m": 1, "s": -2, "A": -1},
    "N/m": {"kg": 1, "s": -2},
    "Pa.s": {"kg": 1, "m": -1, "s": -1},
    "kg": {"kg": 1},
    "kg.m2": {"kg": 1, "m": 2},
    "m": {"m": 1},
    "m/s": {"m": 1, "s": -1},
    "rad": {"rad": 1},
    "rad/s": {"rad": 1, "s": -1},
    "s": {"s": 1},
}
"""By the name of a unit: exponents of the base units."""


def _variable(model, name, unit, description, start=0.0, depends=(), **kind):
    if not hasattr(model, "declared"):
        model.declared = {}
    model.declared[name] = (unit, depends)
    if "getter" not in kind:
        setattr(model, name, start)
    model.register_variable(Real(name, description=description, **kind))


def parameter(model, name, unit, start, description):
    """A constant of the partner."""
    kind = {"causality": Fmi2Causality.parameter, "variability": Fmi2Variability.tunable}
    _variable(model, name, unit, description, start, **kind)


def state(model, name, unit, description):
    """A state. PythonFMU restores registered variables, and no others, where a master goes back."""
    kind = {"causality": Fmi2Causality.output, "variability": Fmi2Variability.continuous, "initial": Fmi2Initial.exact}
    _variable(model, name, unit, description, **kind)


def shown(model, name, unit, description):
    """An input: motion of the rotor."""
    kind = {"causality": Fmi2Causality.input, "variability": Fmi2Variability.continuous}
    _variable(model, name, unit, description, **kind)


def answer(model, name, unit, description, value, depends):
    """An output: a load on the rotor, returned by `value`, which depends on these inputs directly."""
    kind = {"causality": Fmi2Causality.output, "variability": Fmi2Variability.continuous}
    _variable(
        model, name, unit, description, depends=depends, getter=value, initial=Fmi2Initial.calculated, **kind
    )


def complete(xml, model):
    """The model description with units and dependencies."""
    units = Element("UnitDefinitions")
    for unit in sorted({unit for unit, _ in model.declared.values()}):
        SubElement(SubElement(units, "Unit", name=unit), "BaseUnit", {of: str(power) for of, power in UNITS[unit].items()})
    xml.insert([child.tag for child in xml].index("CoSimulation") + 1, units)
    index = {}
    for number, variable in enumerate(xml.find("ModelVariables"), 1):
        index[variable.get("name")] = number
        variable.find("Real").set("unit", model.declared[variable.get("name")][0])
    structure = xml.find("ModelStructure")
    structure.clear()
    causality = {variable.get("name"): variable for variable in xml.find("ModelVariables")}
    outputs = [name for name, variable in causality.items() if variable.get("causality") == "output"]
    calculated = [name for name in outputs if causality[name].get("initial") == "calculated"]
    for element, names in (("Outputs", outputs), ("InitialUnknowns", calculated)):
        if not names:
            continue
        unknowns = SubElement(structure, element)
        for name in names:
            depends = " ".join(str(index[other]) for other in model.declared[name][1])
            SubElement(unknowns, "Unknown", index=str(index[name]), dependencies=depends)
    return xml
