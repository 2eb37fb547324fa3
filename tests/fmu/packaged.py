"""A packaged FMU, as the tests take it."""

from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

from fmpy import extract, read_model_description, simulate_fmu
from fmpy.model_description import ModelDescription
from host import Host


def _silent(*_message):
    """Logs nothing."""


@dataclass(frozen=True)
class Fmu:
    """An FMU, packed and unpacked."""

    scene: str
    path: Path
    directory: Path
    description: ModelDescription
    xml: ElementTree.Element

    @property
    def variables(self):
        """fmpy's variables by name."""
        return {variable.name: variable for variable in self.description.modelVariables}

    def host(self, **options):
        """A new instance."""
        return Host(self, **options)

    def simulate(self, **options):
        """fmpy's result: a structured array, a row a communication point."""
        # A logger each time: without one fmpy logs through that of an earlier call, which is gone.
        options.setdefault("logger", _silent)
        return simulate_fmu(str(self.directory), model_description=self.description, **options)


def unpack(path, directory):
    """The FMU in this file."""
    extract(str(path), str(directory))
    description = read_model_description(str(path), validate=False)
    return Fmu(path.stem, path, directory, description, ElementTree.parse(directory / "modelDescription.xml").getroot())
