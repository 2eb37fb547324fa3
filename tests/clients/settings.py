"""What a client's program is told: PROGRAM FMU STOP STEP [NAME=VALUE ...], times in seconds, start values of variables."""

import sys


def settings():
    """The FMU, the stop time [s], the step [s], and the start values by name."""
    fmu, stop, step, *pairs = sys.argv[1:]
    values = dict(pair.split("=") for pair in pairs)
    return fmu, float(stop), float(step), {name: _number(value) for name, value in values.items()}


def _number(text):
    """A whole number is for an Integer."""
    return int(text) if text.lstrip("-").isdigit() else float(text)
