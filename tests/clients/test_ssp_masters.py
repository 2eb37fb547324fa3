"""`cargo xtask package --ssp` in masters of other tools: rotors and partners of examples/cosim are connected, and move, as there."""

import json
import os
import subprocess
import sys
from pathlib import Path

import pytest
from fmpy.ssp.ssd import read_ssd

import project

pytestmark = pytest.mark.long

COSIM = project.ROOT / "examples" / "cosim"
STEP, COUNT = 1e-4, 200
# Pair and partner of the example, and where it takes hold.
PARTNERS = [
    ("linear", "bearing", ["port[1]", "port[2]"]),
    ("journal", "journal", ["port[1]", "port[2]"]),
    ("pedestal", "pedestal", ["port[1]", "port[2]"]),
    ("magnetic", "magnetic", ["port[1]", "port[2]"]),
    ("motor", "motor", ["drive"]),
]


@pytest.fixture(scope="module")
def package(python_of, tmp_path_factory):
    """Packages `rotor` with a partner at these terminals and these options: the path."""
    folder = tmp_path_factory.mktemp("ssp")

    def make(kind, terminals, *options):
        fmu = folder / f"{kind.capitalize()}.fmu"
        if not fmu.is_file():
            build = [python_of("libcosimpy"), "-m", "pythonfmu", "build", "--handle-state", "-d", folder, "-f"]
            subprocess.run([*build, COSIM / "partners" / f"{kind}.py", COSIM / "partners" / "described.py"], check=True)
        command = [project.build_xtask(), "package", "rotor", "--platforms", "here", "--ssp", "--out", folder, *options]
        command += [word for terminal in terminals for word in ("--partner", f"{terminal}={fmu}")]
        subprocess.run(command, check=True, cwd=project.ROOT)
        return folder / "rotor.ssp"

    return make


@pytest.fixture
def bearings(package):
    """Packages the rotor with two bearings and these options."""
    return lambda *options: package("bearing", ["port[1]", "port[2]"], *options)


@pytest.fixture
def both(python_of, tmp_path):
    """Runs a package with two bearings in a master: what is printed, and the motion, by the package and by the example."""

    def run(master, package):
        program = Path(__file__).with_name("run_ssp.py")
        command = [python_of("libcosimpy"), program, master, package, str(STEP), str(COUNT)]
        environment = os.environ | {"TMPDIR": str(tmp_path)}
        return subprocess.run(command, capture_output=True, encoding="utf-8", env=environment, cwd=tmp_path)

    return run


@pytest.mark.parametrize("pair,kind,terminals", PARTNERS, ids=[pair for pair, *_ in PARTNERS])
def test_exact_names_connect_what_the_example_connects(package, pair, kind, terminals, monkeypatch):
    monkeypatch.setattr(sys, "path", [str(COSIM), *sys.path])
    from pairs import PAIRS

    name = kind.capitalize()
    names = {"rotor": "rotor", "first": f"{name}_1", "second": f"{name}_2", "motor": name}

    def named(end):
        model, variable = end.split(".", 1)
        return names[model], variable

    system = read_ssd(package(kind, terminals)).system
    found = {(of.startElement, of.startConnector, of.endElement, of.endConnector) for of in system.connections}
    assert found == {(*named(source), *named(sink)) for source, sink in PAIRS[pair].links}


@pytest.mark.parametrize("master", ["ssp", "libcosim", "ecos"])
def test_exact_a_package_moves_as_the_example(bearings, both, master):
    done = both(master, bearings())
    assert done.returncode == 0, done.stdout + done.stderr
    found = json.loads(done.stdout.splitlines()[-1])
    assert max(abs(value) for row in found["example"] for value in row) > 1e-6  # [m]
    assert found["package"] == found["example"]


def test_exact_a_package_with_a_boundary_moves_as_the_example_in_fmpy(bearings, both):
    """fmpy sets the inputs at the boundary to 0, as they are, and the solver stops there: 1.1e-15."""
    done = both("ssp", bearings("--boundary"))
    assert done.returncode == 0, done.stdout + done.stderr
    found = json.loads(done.stdout.splitlines()[-1])
    pairs = [pair for rows in zip(found["package"], found["example"], strict=True) for pair in zip(*rows, strict=True)]
    assert max(abs(a - b) for a, b in pairs) <= 1e-12 * max(abs(b) for _, b in pairs)


@pytest.mark.parametrize("master", ["libcosim", "ecos"])
def test_regress_libcosim_and_ecos_open_no_boundary(bearings, both, master):
    """So a boundary must be asked for: findings/libcosim_and_ecos_open_no_ssp_with_a_boundary.sh."""
    assert both(master, bearings("--boundary")).returncode != 0
