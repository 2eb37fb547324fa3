"""libcosim with a system of the Open Simulation Platform (libcosimpy 0.0.6): one connection joins all variables of two groups.

`cargo xtask package rotor --osp` writes the groups of the rotor beside its FMU; those of the partners are written here. The order of
steps is that of by_libcosim.
"""

import shutil
from pathlib import Path
from tempfile import TemporaryDirectory
from xml.etree.ElementTree import Element, ElementTree, SubElement, parse

from fmpy import read_model_description
from libcosimpy.CosimExecution import CosimExecution
from libcosimpy.CosimLogging import CosimLogLevel, log_output_level

from masters.by_libcosim import stepped

GROUPS = "https://open-simulation-platform.com/OspModelDescription/1.0.1"
SYSTEM = "http://opensimulationplatform.com/MSMI/OSPSystemStructure"
TYPES = {bool: "Boolean", int: "Integer"}


def osp(models, links, watched, step, count):
    log_output_level(CosimLogLevel.WARNING)
    with TemporaryDirectory() as folder:
        write(Path(folder), models, links, step)
        execution = CosimExecution.from_osp_config_file(folder)
        slaves = {name: execution.slave_index_from_instance_name(name) for name in models}
        return stepped(execution, slaves, watched, count)


def write(folder, models, links, step):
    """Writes the system, as a tool of the platform opens it, into the folder."""
    root = Element("OspSystemStructure", xmlns=SYSTEM, version="0.1")
    SubElement(root, "BaseStepSize").text = str(step)
    # Without it libcosim refuses the system, though its schema names this one as the usual one.
    SubElement(root, "Algorithm").text = "fixedStep"
    simulators, groups = SubElement(root, "Simulators"), {}
    for name, (path, values) in models.items():
        shutil.copy(path, folder)
        simulator = SubElement(simulators, "Simulator", name=name, source=Path(path).name)
        start = SubElement(simulator, "InitialValues")
        for variable, value in values.items():
            of = SubElement(start, "InitialValue", variable=variable)
            SubElement(of, TYPES.get(type(value), "Real"), value=str(value).lower())
        groups |= {f"{name}.{group}": names for group, names in groups_of(path, folder).items()}
    connections, partners = SubElement(root, "Connections"), {}
    other = {end: far for link in links for end, far in (link, link[::-1])}
    for group, names in groups.items():
        model = group.split(".", 1)[0]
        ends = [f"{model}.{name}" for name in names]
        if all(end in other for end in ends):
            far = [other[end].split(".", 1) for end in ends]
            partner, own = far[0][0], "+".join(name for _, name in far)
            partners.setdefault(models[partner][0], {})[own] = [name for _, name in far]
            join(connections, "VariableGroup", (model, group.split(".", 1)[1]), (partner, own))
            for end in ends:
                del other[end]
    for source, sink in links:
        if source in other and sink in other:
            join(connections, "Variable", source.split(".", 1), sink.split(".", 1))
    for path, own in partners.items():
        describe(folder / described(path), own)
    ElementTree(root).write(folder / "OspSystemStructure.xml", "utf-8", xml_declaration=True)


def described(path):
    """Where libcosim looks for the groups of an FMU."""
    return read_model_description(path).modelName + "_OspModelDescription.xml"


def groups_of(path, folder):
    """By the name of each vector of an FMU with a file of groups, the names of its variables; the file goes into the folder."""
    file = Path(path).with_name(described(path))
    if not file.is_file():
        return {}
    shutil.copy(file, folder)
    nests = parse(file).getroot().iterfind(f"{{{GROUPS}}}VariableGroups/{{{GROUPS}}}Generic/*")
    return {group.get("name"): [variable.get("ref") for variable in group] for group in nests}


def describe(file, groups):
    """Writes the groups of a partner."""
    root = Element("OspModelDescription", xmlns=GROUPS, version="1.0")
    all_groups = SubElement(root, "VariableGroups")
    for name, variables in groups.items():
        group = SubElement(all_groups, "Generic", name=name)
        for variable in variables:
            SubElement(group, "Variable", ref=variable)
    ElementTree(root).write(file, "utf-8", xml_declaration=True)


def join(connections, kind, *ends):
    """Adds a connection."""
    connection = SubElement(connections, f"{kind}Connection")
    for simulator, name in ends:
        SubElement(connection, kind, simulator=simulator, name=name)
