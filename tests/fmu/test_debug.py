"""The debug information of a library: kept apart, and of that library."""

import re
import subprocess
import zlib

import project
import pytest
from fmpy import platform, sharedLibraryExtension

pytestmark = pytest.mark.skipif(sharedLibraryExtension != ".so", reason="elsewhere the linker keeps it in files of its own")


def tool(*command):
    """What a program of binutils prints, a checksum as if it were text too."""
    return subprocess.run(command, check=True, stdout=subprocess.PIPE, encoding="utf-8", errors="replace").stdout


def test_exact_the_library_holds_none(fmu):
    sections = re.findall(r"^ *\[ *\d+\] (\S+) ", tool("readelf", "-SW", fmu.library), re.MULTILINE)
    assert ".text" in sections
    assert [name for name in sections if re.match(r"\.(debug|z?symtab|strtab)", name)] == []
    exported = re.findall(r" T (\S+)", tool("nm", "-D", "--defined-only", fmu.library))
    assert len(exported) == 44
    assert [name for name in exported if not name.startswith("fmi2")] == []


def test_exact_an_address_in_the_library_is_a_line_of_a_source(fmu):
    """By the file whose name and checksum the library holds, and that which has its build id."""
    folder = fmu.path.with_suffix(".debug")
    link = re.search(r"\S+\.debug", tool("readelf", "--string-dump=.gnu_debuglink", fmu.library))[0]
    build_id = re.search(r"Build ID: (\w+)", tool("readelf", "-n", fmu.library))[1]
    address = re.search(r"(\w+) T fmi2DoStep", tool("nm", "-D", fmu.library))[1]
    for file in folder / platform / link, folder / ".build-id" / build_id[:2] / f"{build_id[2:]}.debug":
        function, line = tool("addr2line", "-Cfe", file, address).splitlines()
        assert function == "fmi2DoStep"
        checksum = zlib.crc32(file.read_bytes()).to_bytes(4, "little")
        assert link.encode() + b"\0" * (4 - len(link) % 4) + checksum in fmu.library.read_bytes()
        assert re.fullmatch(r"split-rotor/src/fmi2/exports.*\.rs:\d+", line), line


def test_exact_no_path_of_this_machine_is_in_it(fmu):
    folder = fmu.path.with_suffix(".debug") / platform
    (file,) = folder.iterdir()
    text = file.read_bytes()
    assert b"split-rotor" in text
    home = str(fmu.path.home()).encode()
    for path in str(project.ROOT).encode(), home + b"/":
        assert path not in text
