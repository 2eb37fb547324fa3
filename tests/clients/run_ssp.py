"""The pair `linear` of examples/cosim as a package of `cargo xtask package --ssp`, in fmpy, libcosim or ecos: MASTER PACKAGE STEP COUNT.

Printed, as JSON: what is watched after each step by the package, and by the master of the example, which connects the same FMUs itself.
"""

import json
import sys
import zipfile
from pathlib import Path
from tempfile import TemporaryDirectory
from types import SimpleNamespace
from xml.etree import ElementTree

sys.path.insert(0, str(Path(__file__).resolve().parents[2] / "examples" / "cosim"))
from masters import by_ssp  # noqa: E402
from pairs import PAIRS, with_paths  # noqa: E402

NAMES = {"rotor": "rotor", "first": "Bearing_1", "second": "Bearing_2"}
SSV = "{http://ssp-standard.org/SSP1/SystemStructureParameterValues}"


def with_values(package, changed, values):
    """Writes the package with these values of each component in its parameter sets, as a user would."""
    with zipfile.ZipFile(package) as old, zipfile.ZipFile(changed, "w") as new:
        for path in old.namelist():
            data, of = old.read(path), values.get(Path(path).stem, {})
            if path.endswith(".ssv"):
                root = ElementTree.fromstring(data)
                places = {parameter.get("name"): parameter[0] for parameter in root.iter(f"{SSV}Parameter")}
                for name, value in of.items():
                    places[name].set("value", str(value).lower())
                data = ElementTree.tostring(root)
                # libcosim goes by the usual prefixes.
                data = data.replace(b"ns0:", b"ssv:").replace(b"xmlns:ns0", b"xmlns:ssv")
            new.writestr(path, data)


def by_fmpy(package, values, watched, step, count):
    from fmpy.ssp.simulation import simulate_ssp

    parameters = [
        SimpleNamespace(name=f"{component}.{name}", value=value) for component, of in values.items() for name, value in of.items()
    ]
    stop = (count - 0.5) * step
    rows = simulate_ssp(package, stop_time=stop, step_size=step, parameter_set=SimpleNamespace(parameters=parameters))
    return [[float(row[name]) for name in watched] for row in rows]


def by_libcosim(package, watched, step, count):
    from libcosimpy.CosimExecution import CosimExecution
    from libcosimpy.CosimLogging import CosimLogLevel, log_output_level
    from masters.by_libcosim import NANOSECONDS, stepped

    log_output_level(CosimLogLevel.WARNING)
    execution = CosimExecution.from_ssp_file(str(package), round(step * NANOSECONDS))
    slaves = {name: execution.slave_index_from_instance_name(name) for name in NAMES.values()}
    return stepped(execution, slaves, watched, count).tolist()


def by_ecos(package, watched, step, count):
    from ecospy import EcosSimulation

    with EcosSimulation(ssp_path=str(package), step_size=step) as simulation:
        if not simulation.init(parameter_set="rotor"):
            sys.exit("ecos did not start")
        seen = []
        for _ in range(count):
            simulation.step(1)
            seen.append([simulation.get_real(name.replace(".", "::", 1)) for name in watched])
        simulation.terminate()
    return seen


def main():
    master, package, step, count = sys.argv[1], Path(sys.argv[2]), float(sys.argv[3]), int(sys.argv[4])
    pair = PAIRS["linear"]
    values = {NAMES[name]: own for name, (_, own) in pair.models.items()}
    with TemporaryDirectory() as folder:
        with zipfile.ZipFile(package) as archive:
            archive.extractall(folder)
        resources = Path(folder) / "resources"
        models = with_paths(pair, {"rotor": resources / "rotor.fmu", "bearing": resources / "Bearing_1.fmu"}, {})
        changed = Path(folder) / "changed.ssp"
        with_values(package, changed, values)
        if master == "ssp":
            found = by_fmpy(package, values, pair.watched, step, count)
            expected = by_ssp.ssp(models, pair.links, pair.watched, step, count)
        elif master == "libcosim":
            from masters.by_libcosim import libcosim

            found = by_libcosim(changed, pair.watched, step, count)
            expected = libcosim(models, pair.links, pair.watched, step, count)
        else:
            from masters.by_ecos import ecos

            found = by_ecos(changed, pair.watched, step, count)
            expected = ecos(models, pair.links, pair.watched, step, count)
        print(json.dumps({"package": found, "example": expected.tolist()}))


if __name__ == "__main__":
    main()
