"""A packaged FMU, as the tests take it."""

from dataclasses import dataclass
from pathlib import Path
from xml.etree import ElementTree

import project
from fmpy import extract, platform, read_model_description, sharedLibraryExtension, simulate_fmu
from fmpy.model_description import ModelDescription
from host import Host

MARK = b"\0rotor's values\0"
"""With it the values of the scene begin in a library."""


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

    @property
    def library(self):
        """The library for this machine."""
        return self.directory / "binaries" / platform / (self.scene + sharedLibraryExtension)

    @property
    def kept(self):
        """The library for this machine as it was linked, without values."""
        linked = self.library.read_bytes()
        code = linked[: linked.index(MARK)]
        return next(file for file in project.KEPT.glob("*" + sharedLibraryExtension) if file.read_bytes().startswith(code))

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
