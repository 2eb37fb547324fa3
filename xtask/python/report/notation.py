"""How numbers are written for people."""

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
