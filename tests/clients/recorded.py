"""FMUs that record: recorder.c takes the place of the library, which stays beside it."""

import os
import shlex
import shutil
import subprocess
import zipfile
from pathlib import Path, PurePosixPath

import project

SOURCE = Path(__file__).with_name("recorder.c")
VARIABLE = "SPLIT_ROTOR_RECORD"
"""The environment variable that names the recording."""


def build_recorder():
    """Compiles recorder.c; the path of the library."""
    compiler = shlex.split(os.environ.get("CC", "cc"))
    if shutil.which(compiler[0]) is None:
        raise FileNotFoundError(f"a C compiler is needed: {compiler[0]} (Debian: apt-get install gcc)")
    library = project.ROOT / "target" / "clients" / "recorder.so"
    library.parent.mkdir(parents=True, exist_ok=True)
    options = ["-std=c11", "-O1", "-Wall", "-Wextra", "-fPIC", "-shared"]
    subprocess.run([*compiler, *options, SOURCE, "-o", library, "-ldl"], check=True)
    return library


def is_library(name):
    """Whether this file of an FMU is its library."""
    return PurePosixPath(name).match("binaries/*/*")


def neighbour(library):
    """Where recorder.c looks for what it stands in for."""
    return library.with_suffix(f".real{library.suffix}")


def record_fmu(fmu, recorder, copy):
    """Writes `copy`, an FMU like `fmu` that records."""
    with zipfile.ZipFile(fmu) as old, zipfile.ZipFile(copy, "w", zipfile.ZIP_DEFLATED) as new:
        for name in old.namelist():
            if is_library(name):
                new.write(recorder, name)
                new.writestr(str(neighbour(PurePosixPath(name))), old.read(name))
            else:
                new.writestr(name, old.read(name))


def unpack_library(fmu, folder):
    """Unpacks the library of an FMU; its path."""
    with zipfile.ZipFile(fmu) as archive:
        (name,) = filter(is_library, archive.namelist())
        return Path(archive.extract(name, folder))
