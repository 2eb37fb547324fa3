"""Seven pairs of a rotor and models of another tool, and what is right of each: by the FMU's own bearings, by equations, or by a master of our
own with much shorter steps."""

import sys
from dataclasses import dataclass, field
from pathlib import Path

from masters import by_fmpy

sys.path.insert(0, str(Path(__file__).resolve().parents[1]))
from coupled import PLACES, ROTOR, coefficients  # noqa: E402

TOLERANCE = 1e-9
PROBE = ("rotor.probe[1].r.y", "rotor.probe[1].r.z")
TURBO = {"effects.support": False, "effects.unbalance[1]": True, "effects.probe[1]": True} | ROTOR
# Axial positions are counted from the first bearing: a master that sends 0 to a bearing before it has read anything stretches no spring.
PORTS = {"start.r_c.x": -PLACES[0]} | {
    name: value
    for n, place in enumerate(PLACES, 1)
    for name, value in ((f"effects.port[{n}]", True), (f"port[{n}].position", place))
}
BEARINGS = [
    {name.split(".")[1]: value for name, value in coefficients("bearing").items() if name.startswith(f"bearing[{n}]")}
    for n in (1, 2)
]
LATE = {"effects.extrapolation": True, "extrapolation.lag": 1.0}
ORDER_1 = {"effects.extrapolation": True, "extrapolation.order": 1}


@dataclass(frozen=True)
class Pair:
    """Models that are coupled."""

    models: dict
    """By name: "rotor" or the file of a partner, and its start values."""
    links: tuple
    """Of outputs to inputs, as "model.variable"."""
    watched: tuple
    """Outputs that are compared."""
    span: float
    """[s]"""
    exact: object
    """Called with the paths of the FMUs, a step, and a much shorter one [s]: the watched outputs after each step."""
    held: dict = field(default_factory=dict)
    """Values of the rotor with which its inputs are held."""
    advised: dict = field(default_factory=dict)
    """Values of the rotors that docs/cosimulation.md advises."""
    means: bool = True
    """Whether a partner that holds its inputs takes the mean of a step, in a master that iterates; else what is there at its start."""


def turbo(partner, values, axes, motions="rv", others=(), of_rotor=(), **more):
    """The turbo rotor on two partners of this kind. They are shown these motions, position and velocity, along these axes, and answer along
    these; `others` are links to both, such as the speed."""
    names = ("first", "second")
    links = [
        (f"rotor.port[{n}].{of}.{axis}", f"{name}.{of}{axis}")
        for n, name in enumerate(names, 1)
        for of in motions
        for axis in axes
    ]
    links += [(source, f"{name}.{sink}") for name in names for source, sink in others]
    links += [
        (f"{name}.f{axis}", f"rotor.port[{n}].f.{axis}") for n, name in enumerate(names, 1) for axis in axes
    ]
    models = {"rotor": ("rotor", TURBO | PORTS | dict(of_rotor))}
    models |= {name: (partner, of_one) for name, of_one in zip(names, values)}
    held = {f"port[{n}].learn": False for n in (1, 2)}
    return Pair(models, tuple(links), PROBE, 0.05, held=held, **more)


def own_bearings(paths, step, _):
    """The turbo rotor in bearings of its own."""
    values = TURBO | {
        name: value
        for n, place in enumerate(PLACES, 1)
        for name, value in ((f"effects.bearing[{n}]", True), (f"bearing[{n}].position", place))
    }
    values |= coefficients("bearing")
    return by_fmpy.plain({"rotor": (paths["rotor"], values)}, (), PROBE, step, round(0.05 / step))


def housed():
    """The turbo rotor in bearings of its own, in housings that two pedestals move."""
    names, axes = ("first", "second"), "yz"
    own = {"kyy": 1e7, "kzz": 1e7, "cyy": 1e3, "czz": 1e3, "housing.moves": True}
    of_rotor = {
        name: value
        for n, place in enumerate(PLACES, 1)
        for name, value in ((f"effects.bearing[{n}]", True), (f"bearing[{n}].position", place))
    }
    of_rotor |= {f"bearing[{n}].{name}": value for n in (1, 2) for name, value in own.items()}
    ends = [(f"rotor.bearing[{n}].housing", name, axis) for n, name in enumerate(names, 1) for axis in axes]
    links = [(f"{housing}.F.{axis}", f"{name}.F{axis}") for housing, name, axis in ends]
    links += [(f"{name}.{of}{axis}", f"{housing}.{of}.{axis}") for housing, name, axis in ends for of in "rv"]
    models = {"rotor": ("rotor", TURBO | of_rotor)} | {name: ("housing", {}) for name in names}
    advised = {f"bearing[{n}].housing.ahead": 0.5 for n in (1, 2)}
    return Pair(models, tuple(links), PROBE, 0.05, finely("housing", advised), advised=advised)


def finely(name, values=None):
    """A pair with short steps, each partner answering at once; loads are held unless other values are given."""

    def exact(paths, step, fine):
        pair = PAIRS[name]
        every, models = round(step / fine), with_paths(pair, paths, values or pair.held)
        return by_fmpy.fresh(models, pair.links, pair.watched, fine, round(pair.span / fine))[every - 1 :: every]

    return exact


def with_paths(pair, paths, values):
    """The models of a pair: path and start values, those of rotors with these too."""
    return {
        name: (paths[kind], own | (values if kind == "rotor" else {})) for name, (kind, own) in pair.models.items()
    }


def integrated(rates, start, watched, span):
    """Runge-Kutta steps of these equations, as a reference: `watched` are numbers of states."""

    def exact(_, step, fine):
        inner = max(1, round(step / fine))
        h, state, found = step / inner, list(start), []
        add = lambda a, k, b: [x + k * y for x, y in zip(a, b)]  # noqa: E731
        for _ in range(round(span / step)):
            for _ in range(inner):
                k1 = rates(state)
                k2 = rates(add(state, h / 2, k1))
                k3 = rates(add(state, h / 2, k2))
                k4 = rates(add(state, h, k3))
                state = [x + h / 6 * (a + 2 * b + 2 * c + d) for x, a, b, c, d in zip(state, k1, k2, k3, k4)]
            found.append([state[n] for n in watched])
        return found

    return exact


def motor_rates(state):
    """Of angle and speed of the rotor (Ja = 0.08 kg m²) and of the motor, as partners/motor.py has them."""
    phi, w, phi_m, w_m = state
    torque = 2e4 * (phi_m - phi) + 2.0 * (w_m - w)
    drive = max(-200.0, min(200.0, 5.0 * (300.0 - w_m)))
    return [w, torque / 0.08, w_m, (drive - torque) / 0.05]


def two_rates(state):
    """Of angle and speed of two rotors (0.08 and 0.05 kg m²) with a torsion spring between."""
    phi1, w1, phi2, w2 = state
    torque = 2e4 * (phi1 - phi2) + 1.0 * (w1 - w2)
    return [w1, -torque / 0.08, w2, torque / 0.05]


def in_line(axial, **start):
    """A rotor with a drive, without weight and support."""
    values = {"effects.support": False, "effects.gravity": False, "effects.drive": True, "rotor.l": 0.0, "rotor.m": 10.0}
    values |= {"rotor.Ja": axial, "rotor.Jt": 0.15, "start.r_c.x": 0.0, "solver.relative_tolerance": TOLERANCE}
    return values | {f"start.{name}": value for name, value in start.items()}


PAIRS = {
    "linear": turbo(
        "bearing",
        BEARINGS,
        "xyz",
        exact=own_bearings,
        advised=coefficients("port"),
    ),
    "journal": turbo(
        "journal",
        ({}, {}),
        "yz",
        others=(("rotor.omega_phi", "w"),),
        of_rotor={"start.omega.x": 600.0, "start.r_c.y": 5e-6, "start.r_c.z": -10e-6},
        exact=finely("journal"),
        # Of the film at the centre: c = pi viscosity R L^3 / (2 clearance^3), and c times half the speed across.
        advised={
            f"port[{n}].{name}": value
            for n in (1, 2)
            for name, value in {"cyy": 5e4, "czz": 5e4, "kyz": 1.5e7, "kzy": -1.5e7}.items()
        },
    ),
    "pedestal": turbo(
        "pedestal",
        ({}, {}),
        "yz",
        exact=finely("pedestal"),
        # Of the bearing between rotor and pedestal.
        advised=ORDER_1 | {
            f"port[{n}].{name}": value
            for n in (1, 2)
            for name, value in {"kyy": 1e7, "kzz": 1e7, "cyy": 1e3, "czz": 1e3, "ahead": 0.5}.items()
        },
    ),
    "housing": housed(),
    "magnetic": turbo(
        "magnetic",
        ({}, {}),
        "yz",
        motions="r",
        of_rotor={"start.omega.x": 600.0, "start.r_c.z": -50e-6},
        exact=finely("magnetic"),
        means=False,
    ),
    "motor": Pair(
        {"rotor": ("rotor", in_line(0.08, **{"omega.x": 0.0})), "motor": ("motor", {})},
        (("rotor.drive.phi", "motor.phi"), ("rotor.drive.w", "motor.w"), ("motor.tau", "rotor.drive.tau")),
        ("rotor.drive.w",),
        0.2,
        integrated(motor_rates, (0.0, 0.0, 0.0, 0.0), (1,), 0.2),
        advised=ORDER_1 | {"drive.k": 2e4, "drive.d": 2.0, "drive.ahead": 0.5},
    ),
    "two_rotors": Pair(
        {
            "rotor": ("rotor", in_line(0.08, phi=1e-3, **{"omega.x": 100.0})),
            "other": ("rotor", in_line(0.05, phi=-1.6e-3, **{"omega.x": 100.0})),
            "spring": ("torsion", {"k": 2e4, "d": 1.0}),
        },
        tuple(
            link
            for n, name in enumerate(("rotor", "other"), 1)
            for link in (
                (f"{name}.drive.phi", f"spring.phi{n}"),
                (f"{name}.drive.w", f"spring.w{n}"),
                (f"spring.tau{n}", f"{name}.drive.tau"),
            )
        ),
        ("rotor.drive.w",),
        0.05,
        integrated(two_rates, (1e-3, 100.0, -1.6e-3, 100.0), (1,), 0.05),
        advised=ORDER_1 | {"drive.k": 2e4, "drive.d": 1.0},
    ),
}
