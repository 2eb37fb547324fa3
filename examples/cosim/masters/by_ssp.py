"""fmpy's master of SSP packages (fmpy 0.3.32): partners answer a step late, and all inputs are 0 in the first step.

What else it does stands in findings/fmpy_ssp_feeds_inputs_that_nothing_feeds.sh.
"""

import zipfile
from pathlib import Path
from tempfile import TemporaryDirectory
from types import SimpleNamespace
from xml.etree.ElementTree import Element, SubElement, tostring

import numpy as np
from fmpy.ssp.simulation import simulate_ssp

SSD = "http://ssp-standard.org/SSP1/SystemStructureDescription"
SSC = "http://ssp-standard.org/SSP1/SystemStructureCommon"


def ssp(models, links, watched, step, count):
    parameters = [
        SimpleNamespace(name=f"{name}.{variable}", value=value)
        for name, (_, values) in models.items()
        for variable, value in values.items()
    ]
    with TemporaryDirectory() as folder:
        package = Path(folder) / "pair.ssp"
        with zipfile.ZipFile(package, "w") as archive:
            archive.writestr("SystemStructure.ssd", tostring(described(models, links, watched), "utf-8", xml_declaration=True))
            for path in {path for path, _ in models.values()}:
                archive.write(path, f"resources/{Path(path).name}")
        rows = simulate_ssp(
            package,
            # It goes on as long as the sum of the steps is less.
            stop_time=(count - 0.5) * step,
            step_size=step,
            parameter_set=SimpleNamespace(parameters=parameters),
        )
    return np.array([[row[name] for name in watched] for row in rows])


def described(models, links, watched):
    """The XML of a system."""
    root = Element(f"{{{SSD}}}SystemStructureDescription", version="1.0", name="pair")
    system = SubElement(root, f"{{{SSD}}}System", name="pair")
    elements = SubElement(system, f"{{{SSD}}}Elements")
    outputs = sorted({source for source, _ in links} | set(watched))
    inputs = sorted(sink for _, sink in links)
    for name, (path, _) in models.items():
        source = f"resources/{Path(path).name}"
        component = SubElement(
            elements, f"{{{SSD}}}Component", name=name, type="application/x-fmu-sharedlibrary", source=source
        )
        connectors = SubElement(component, f"{{{SSD}}}Connectors")
        for kind, ends in (("output", outputs), ("input", inputs)):
            for model, variable in (end.split(".", 1) for end in ends):
                if model == name:
                    connector = SubElement(connectors, f"{{{SSD}}}Connector", name=variable, kind=kind)
                    SubElement(connector, f"{{{SSC}}}Real")
    connections = SubElement(system, f"{{{SSD}}}Connections")
    for source, sink in links:
        ends = [end.split(".", 1) for end in (source, sink)]
        names = ("startElement", "startConnector", "endElement", "endConnector")
        SubElement(connections, f"{{{SSD}}}Connection", dict(zip(names, ends[0] + ends[1])))
    return root
