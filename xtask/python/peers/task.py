"""What is asked of a peer, how it is timed, and what it answers; written by `xtask/src/accuracy/peers.rs`."""

import json
import math
import os
import sys
from dataclasses import dataclass
from importlib.metadata import version
from time import process_time
from typing import Any, Callable

import numpy as np


# Only answers go to the standard output, whatever a peer's library prints.
ANSWERS = os.fdopen(os.dup(1), "w", encoding="utf-8")
os.dup2(2, 1)


def rotation(vector):
    """The matrix of a rotation vector [rad], by Rodrigues' formula."""
    x, y, z = vector
    theta = math.hypot(x, y, z)
    across = np.array([[0.0, -z, y], [z, 0.0, -x], [-y, x, 0.0]])
    return np.eye(3) + np.sinc(theta / np.pi) * across + 0.5 * np.sinc(0.5 * theta / np.pi) ** 2 * across @ across


class Rotor:
    """The scene: parameters by their names, zero where the scene lacks the effect. Symbols as in docs/theory.md."""

    def __init__(self, values):
        def vector(name):
            return [values.get(f"{name}.{c}", 0.0) for c in "xyz"]

        self.m, self.Ja, self.Jt, self.l = (values[f"rotor.{name}"] for name in ("m", "Ja", "Jt", "l"))
        self.g = vector("gravity.g")
        self.c1, self.c2, self.d1, self.d2 = (values.get(f"support.{name}", 0.0) for name in ("c1", "c2", "d1", "d2"))
        self.tau = values.get("drive.tau", 0.0)
        self.r_c, self.v_c, self.omega = vector("start.r_c"), vector("start.v_c"), vector("start.omega")
        self.phi = values["start.phi"]
        self.gamma = [0.0, values["start.gamma.y"], values["start.gamma.z"]]
        # eq. 1: L = L(γ) L(φ e)
        self.attitude = rotation(self.gamma) @ rotation([self.phi, 0.0, 0.0])
        self.axis = self.attitude[:, 0].tolist()

    def energy(self, r_c, v_c, omega, axis):
        """Kinetic and potential energy [J] of states in rows."""
        spin = np.sum(omega * axis, axis=1)
        theta = np.arctan2(np.hypot(axis[:, 1], axis[:, 2]), axis[:, 0])
        kinetic = self.m * np.sum(v_c**2, axis=1) + self.Jt * np.sum(omega**2, axis=1) + (self.Ja - self.Jt) * spin**2
        springs = self.c1 * np.sum((r_c - self.l * axis) ** 2, axis=1) + self.c2 * theta**2
        return 0.5 * (kinetic + springs) - self.m * r_c @ self.g


@dataclass
class Motion:
    """What a run showed at the points, in rows, and what it cost; phi None: only known modulo 2 pi."""

    r_c: np.ndarray
    v_c: np.ndarray
    omega: np.ndarray
    axis: np.ndarray
    phi: np.ndarray | None
    steps: int | None = None
    evaluations: int | None = None


@dataclass
class Attempt:
    """A run that stands ready: everything is compiled."""

    run: Callable[[], Any]
    """The run itself, from its start to its end with all outputs: this is what is timed."""
    read: Callable[[Any], Motion]
    """What the run returned, as a motion."""
    reset: Callable[[], None] = lambda: None
    """Back to the start."""


class Task:
    """The scene, when it is looked at, and which settings are wanted."""

    def __init__(self, text, package):
        asked = json.loads(text)
        self._version = version(package)
        self.rotor = Rotor(asked["values"])
        self.times = np.array(asked["times"])
        """The start, then the points at which the motion is read [s]: irregular."""
        self.parts = asked["parts"]
        """After how many of the equal parts of the span each of them lies."""
        self.largest_tilt = asked["largest_tilt"]
        """Of the axis against e, on the whole way [rad]."""
        self.tolerances = asked["tolerances"]
        self.decades = [tolerance for tolerance in self.tolerances if f"{tolerance:e}".startswith("1.000000e")]
        """The tolerances for slow peers."""
        self._rule = asked["repeats"]
        self._budget = asked["budget"]
        self._attempts = []
        """One for each answer, to be run again."""

    def steps(self):
        """Step sizes [s] that end at every point, with the number of them in a part of the span."""
        part = (self.times[-1] - self.times[0]) / self.parts[-1]
        return {part / n: n for n in (m * 10**k for k in range(5) for m in (1, 2, 5))}

    def answer(self, method, parameter, values, prepare, **told):
        """Try each value, from loose to tight; `prepare` makes an `Attempt` of it. What else is `told` stands in each answer."""
        began = process_time()
        for value in values:
            if process_time() - began > self._budget:
                break
            line = {"version": self._version, "method": method, "parameter": parameter, "value": value, **told}
            attempt = None
            try:
                attempt = prepare(value)
                line |= self._measured(attempt)
            except Exception as failure:  # whatever a peer raises is its answer
                line["failure"] = f"{type(failure).__name__}: {failure}"
            self._attempts.append(attempt)
            print(json.dumps(line), file=ANSWERS, flush=True)

    def answer_again(self):
        """After an empty line, the time of one more run for each answer whose number, from 0, is read: `interleaved.rs`."""
        print(file=ANSWERS, flush=True)
        for number in sys.stdin:
            print(_time(self._attempts[int(number)]), file=ANSWERS, flush=True)

    def _measured(self, attempt):
        attempt.reset()
        motion = attempt.read(attempt.run())
        columns = [motion.r_c, motion.axis, self.rotor.energy(motion.r_c, motion.v_c, motion.omega, motion.axis)]
        if len(motion.r_c) != len(self.times) - 1 or not all(np.isfinite(column).all() for column in columns):
            raise ArithmeticError("the run did not reach its end")
        least, repeats = self._least_time(attempt)
        return {
            "r_c": motion.r_c.tolist(),
            "axis": motion.axis.tolist(),
            "energy": columns[2].tolist(),
            "phi": None if motion.phi is None else motion.phi.tolist(),
            "cpu_time": least,
            "repeats": repeats,
            "steps": motion.steps,
            "evaluations": motion.evaluations,
        }

    def _least_time(self, attempt):
        """As `repeats.rs` has it."""
        least, spent, repeats = math.inf, 0.0, 0
        rule = self._rule
        while not (
            spent >= rule["patience"]
            or repeats >= rule["most"]
            or (repeats >= rule["least"] and spent >= rule["enough"])
        ):
            time = _time(attempt)
            least, spent, repeats = min(least, time), spent + time, repeats + 1
        return least, repeats


def _time(attempt):
    """What a run takes [s of CPU time]."""
    attempt.reset()
    began = process_time()
    attempt.run()
    return process_time() - began


def read(package):
    """The task, a line on the standard input, for the package of this name."""
    return Task(sys.stdin.readline(), package)
