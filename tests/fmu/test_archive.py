"""The FMU as a zip archive: what is in it, and that it is packed as FMI 2.0.4 (2.3) asks, alike every time."""

import json
import re
import shutil
from zipfile import ZIP_DEFLATED, ZIP_STORED, ZipFile

import project
import pytest
from fmpy import platform, sharedLibraryExtension

DATA_DESCRIPTOR, UTF_8 = 1 << 3, 1 << 11
"""Bits of a zip entry's flags that an FMU may have; bit 0 would be encryption."""


@pytest.fixture
def entries(fmu):
    """The archive's directory."""
    with ZipFile(fmu.path) as archive:
        assert archive.testzip() is None
        return archive.infolist()


def test_exact_what_is_in_it(fmu, entries):
    assert [entry.filename for entry in entries] == [
        "modelDescription.xml",
        "model.png",
        f"binaries/{platform}/{fmu.scene}{sharedLibraryExtension}",
        "documentation/index.html",
        "documentation/licenses/license.txt",
        "documentation/licenses/third-party.txt",
        "documentation/licenses/bill-of-materials.cdx.json",
        "terminalsAndIcons/terminalsAndIcons.xml",
        "terminalsAndIcons/icon.png",
    ]


def test_exact_entries_are_stored_or_deflated(entries):
    for entry in entries:
        allowed = DATA_DESCRIPTOR | UTF_8 if entry.compress_type == ZIP_DEFLATED else UTF_8
        assert entry.compress_type in (ZIP_STORED, ZIP_DEFLATED), entry.filename
        assert entry.flag_bits & ~allowed == 0, entry.filename
        assert entry.extract_version <= 20, entry.filename


def test_exact_entries_tell_nothing_of_their_making(entries):
    for entry in entries:
        assert entry.date_time == (1980, 1, 1, 0, 0, 0), entry.filename
        assert (entry.comment, entry.extra) == (b"", b""), entry.filename


@pytest.mark.long
def test_exact_packaging_again_gives_the_same_bytes(paper, xtask, tmp_path):
    """The library is built anew: what was kept of it is forgotten, and what cargo knows of it."""
    fcntl = pytest.importorskip("fcntl", reason="a builder's lock is taken")
    with paper.kept.with_suffix(".lock").open("wb") as of_list:
        fcntl.flock(of_list, fcntl.LOCK_EX)
        paper.kept.with_suffix(".stamp").unlink(missing_ok=True)
        for builder in project.BUILDERS.glob("[0-9]"):  # not those of other platforms, nor one at work
            with (builder / "lock").open("wb") as lock:
                fcntl.flock(lock, fcntl.LOCK_EX)
                for known in builder.glob("fmu/.fingerprint/split-rotor-*"):
                    shutil.rmtree(known)
    done = xtask("package", "paper", "--platforms", "here", "--out", tmp_path)
    assert done.returncode == 0, done.stderr
    again = (tmp_path / "paper.fmu").read_bytes()
    assert again == paper.path.read_bytes(), f"or {paper.path} is out of date"


def test_exact_the_licence_of_each_linked_crate_is_there(fmu):
    with ZipFile(fmu.path) as archive:
        text = archive.read("documentation/licenses/third-party.txt").decode("utf-8")
    crates = re.findall(r"^=+\n(\S+) \d+\.\d+\.\d+: ([^\n]+)\n=+\n(.*?)(?=^=+\n|\Z)", text, re.MULTILINE | re.DOTALL)
    assert {"nalgebra", "libm", "libc"} <= {name for name, _, _ in crates}
    assert [name for name, _, licence in crates if "Copyright" not in licence and "Apache License" not in licence] == []


def test_exact_the_bill_of_materials_names_the_same_crates(fmu):
    with ZipFile(fmu.path) as archive:
        bill = json.loads(archive.read("documentation/licenses/bill-of-materials.cdx.json"))
        text = archive.read("documentation/licenses/third-party.txt").decode("utf-8")
    assert (bill["bomFormat"], bill["specVersion"], bill["metadata"]["component"]["name"]) == ("CycloneDX", "1.6", "split-rotor")
    listed = [f"pkg:cargo/{name}@{version}" for name, version in re.findall(r"^=+\n(\S+) (\S+): ", text, re.MULTILINE)]
    assert [component["purl"] for component in bill["components"] if "purl" in component] == listed
    assert [component["name"] for component in bill["components"] if "purl" not in component] == ["Rust standard library"]
    assert all(component["licenses"][0]["expression"] for component in bill["components"])
