"""How numbers are written for people."""

import math

SUPERSCRIPT = str.maketrans("-0123456789", "⁻⁰¹²³⁴⁵⁶⁷⁸⁹")


def number(value, digits=4):
    """`value` with `digits` significant digits: 0.0625, −12.5, 1.5 × 10⁻⁹, 125 664."""
    mantissa, power, exponent = f"{value:.{digits}g}".partition("e")
    if power:
        text = f"{mantissa} × 10{str(int(exponent)).translate(SUPERSCRIPT)}"
    else:
        text = mantissa
    return text.replace("-", "−")


def count(value):
    """A whole number in groups of three, with narrow no-break spaces."""
    return f"{round(value):,}".replace(",", "\u202f")


def vector(components, digits):
    """(x, y, z), every component with `digits` decimals."""
    return "(" + ", ".join(f"{c:.{digits}f}" for c in components).replace("-", "−") + ")"


PREFIXES = {"m": (("m", 1e0), ("mm", 1e-3), ("µm", 1e-6), ("nm", 1e-9))} | {
    unit: ((f"M{unit}", 1e6), (f"k{unit}", 1e3), (unit, 1.0), (f"m{unit}", 1e-3), (f"µ{unit}", 1e-6), (f"n{unit}", 1e-9), (f"p{unit}", 1e-12))
    for unit in ("N", "J", "s")
}
"""Of each unit the multiples that engineers read, the largest first; lengths from the metre, times from the second."""
PREFIXES["s"] = PREFIXES["s"][2:]

RPM = 60.0 / math.tau
"""Revolutions a minute in a rad/s."""
STANDSTILL = 1e-9
"""What turns slower than this [rad/s], a turn in two centuries, stands still."""


def multiple(largest, unit):
    """(multiple, its size) of `unit` in which `largest` is a number from 1 to 1000, as far as there are such."""
    return next((m for m in PREFIXES[unit] if abs(largest) >= m[1]), PREFIXES[unit][-1] if largest else (unit, 1.0))


def quantity(value, unit, digits=3):
    """`value`, given in `unit`, with the multiple that suits it: 20.5 µm."""
    name, size = multiple(value, unit)
    return f"{number(value / size, digits)}\u00a0{name}"


def rpm(speed):
    """A speed [rad/s] in rpm, in whole ones from 100 up."""
    turns = speed * RPM if abs(speed) > STANDSTILL else 0.0
    return f"{count(turns).replace('-', '−') if abs(turns) >= 100.0 else number(turns, 3)}\u00a0rpm"
