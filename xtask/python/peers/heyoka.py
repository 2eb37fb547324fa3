"""heyoka: Taylor's method, compiled just in time for each tolerance; compilation is not timed."""

import math
import sys

import heyoka
import numpy as np

from . import equations, task

TIGHTER = 5e-14, 1e-14, 1e-15, sys.float_info.epsilon
"""Tolerances beyond those that everybody tries, down to heyoka's own default: its errors are larger than its tolerances."""


def fitted_stretch(largest_tilt):
    """theta / sin(theta) as a polynomial in u = 1 - cos(theta), as short as this range needs for a double.

    Taylor's method needs a law that is regular at theta = 0, where the closed form is 0/0.
    """
    widest = 1.0 - math.cos(largest_tilt)

    def exact(u):
        return 2.0 * np.arcsin(np.sqrt(0.5 * u)) / np.sqrt(u * (2.0 - u))

    u = np.linspace(1e-6, 1.0, 1000) * widest
    for degree in range(1, 30):
        fit = np.polynomial.Chebyshev.interpolate(exact, degree, domain=(0.0, widest))
        fit = fit.convert(kind=np.polynomial.Polynomial)
        if np.max(np.abs(fit(u) - exact(u))) < 1e-15:
            return fit.coef
    raise ValueError(f"no polynomial follows the law of the spring up to a tilt of {largest_tilt:g} rad")


def horner(coefficients, u):
    """The polynomial's value."""
    value = coefficients[-1]
    for coefficient in reversed(coefficients[:-1]):
        value = value * u + coefficient
    return value


def distinct_orders(tolerances):
    """Of all tolerances that lead to one order, the loosest: heyoka's step follows from the order alone."""
    return list({math.ceil(1.0 - 0.5 * math.log(tolerance)): tolerance for tolerance in reversed(tolerances)}.values())[::-1]


def main():
    asked = task.read("heyoka")
    rotor, times = asked.rotor, asked.times
    names = [f"y{n}" for n in range(13)]
    y = heyoka.make_vars(*names)
    law = horner(fitted_stretch(asked.largest_tilt), 1.0 - y[9]) if rotor.c2 else None
    system = list(zip(y, equations.rates(rotor, y, law)))
    begin = equations.start(rotor)

    def prepare(tolerance):
        taylor = heyoka.taylor_adaptive(system, begin, time=times[0], tol=tolerance, compact_mode=False)

        def reset():
            taylor.time = times[0]
            taylor.state[:] = begin

        def read(result):
            return task.Motion(**equations.motion(rotor, result[-1][1:]), steps=result[3])

        return task.Attempt(lambda: taylor.propagate_grid(times), read, reset)

    # The integrator of one motion: no vector of motions, though the processor has room for so many.
    widths = {"vector_width": 1, "vector_width_of_processor": heyoka.recommended_simd_size()}
    asked.answer("Taylor", "tolerance", distinct_orders([*asked.tolerances, *TIGHTER]), prepare, **widths)
    asked.answer_again()


if __name__ == "__main__":
    main()
