"""Draws the rotor of the FMU's documentation page: modelDescription/documentation/rotor.svg.

The split rotation to scale: the axis t is e carried by L(γ) about γ, the mark on the disk is turned by φ. The page's style
sheet gives the colours, by class, so that the picture suits a light and a dark page.

Needs Python alone:  python rotor.py
Equation numbers are those of ../theory.md.
"""

from math import atan2, cos, degrees, hypot, pi, radians, sin, sqrt
from pathlib import Path

TARGET = Path(__file__).parents[2] / "modelDescription" / "documentation" / "rotor.svg"

GAMMA = (0.0, -0.16, 0.72)  # γ [rad]
PHI = radians(80.0)  # φ
LENGTH = 2.1  # l, from the support point a to the mass centre c
RADIUS = 0.56  # of the disk
CAMERA = (radians(15.0), radians(18.0))  # turned about z, and raised, from the view along y
SCALE, WIDTH, HEIGHT, ORIGIN = 170.0, 620, 270, (110.0, 200.0)  # a stands at ORIGIN [px]
E = (1.0, 0.0, 0.0)


def add(a, b, factor=1.0):
    """a + factor·b"""
    return tuple(p + factor * q for p, q in zip(a, b))


def cross(a, b):
    """a×b"""
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def dot(a, b):
    """a·b"""
    return sum(p * q for p, q in zip(a, b))


def scaled(a, length):
    """The vector along a of this length."""
    return tuple(length * p / sqrt(dot(a, a)) for p in a)


def turned(v, about, angle):
    """L(angle·about)·v for a unit vector `about` (Rodrigues)."""
    across, along = cross(about, v), dot(about, v)
    return tuple(cos(angle) * p + sin(angle) * q + (1.0 - cos(angle)) * along * k for p, q, k in zip(v, across, about))


def seen(point):
    """Where a point of O stands in the picture [px]."""
    turn, rise = CAMERA
    right = point[0] * cos(turn) + point[1] * sin(turn)
    away = point[1] * cos(turn) - point[0] * sin(turn)
    return ORIGIN[0] + SCALE * right, ORIGIN[1] - SCALE * (point[2] * cos(rise) + away * sin(rise))


def path(points, kind, closed=False):
    """A line through these points of O."""
    ends = " L".join(f"{x:.1f} {y:.1f}" for x, y in map(seen, points))
    return f'<path class="{kind}" d="M{ends}{" Z" if closed else ""}"/>'


def head(points, kind):
    """An arrow head at the end of a line of points, along its last piece."""
    (x0, y0), (x1, y1) = seen(points[-2]), seen(points[-1])
    angle = degrees(atan2(y1 - y0, x1 - x0))
    return f'<path class="{kind} head" d="M0 0 L-11 4.5 L-11 -4.5 Z" transform="translate({x1:.1f} {y1:.1f}) rotate({angle:.1f})"/>'


def arrow(points, kind):
    """A line that ends in an arrow head."""
    return path(points, kind) + "\n" + head(points, kind)


def label(point, text, kind, right=0.0, down=0.0, anchor="middle"):
    """A text beside a point of O."""
    x, y = seen(point)
    return f'<text class="{kind}" x="{x + right:.1f}" y="{y + down:.1f}" text-anchor="{anchor}">{text}</text>'


def arc(start, about, angle, centre, radius, pieces=40):
    """Points on a circle about `centre`, from the direction `start` through an angle about a unit vector."""
    return [add(centre, turned(start, about, angle * i / pieces), radius) for i in range(pieces + 1)]


def picture():
    """The SVG's text."""
    theta = sqrt(dot(GAMMA, GAMMA))
    about = scaled(GAMMA, 1.0)
    t = turned(E, about, theta)  # eq. 2
    a, c = (0.0, 0.0, 0.0), scaled(t, LENGTH)
    zero = turned((0.0, 1.0, 0.0), about, theta)  # the body's y axis where φ = 0: eq. 1
    mark = turned(zero, t, PHI)
    rim = arc(zero, t, 2.0 * pi, c, RADIUS, 72)[:-1]
    # Dimension line of l: beside the rod, in the picture's plane.
    (x0, y0), (x1, y1) = seen(a), seen(c)
    aside = tuple(20.0 * p / hypot(x1 - x0, y1 - y0) for p in (y1 - y0, x0 - x1))
    ends = [(x0 + aside[0], y0 + aside[1]), (x1 + aside[0], y1 + aside[1])]
    middle = (0.5 * (ends[0][0] + ends[1][0]), 0.5 * (ends[0][1] + ends[1][1]))
    bold = '<tspan font-weight="bold">{}</tspan>'.format
    spin = arc(zero, t, PHI, c, 0.55 * RADIUS)
    tilt = arc(E, about, theta, a, 1.15)
    corner = (-0.42, 0.0, 0.62)
    lines = [
        path([a, scaled(E, 3.15)], "reference"),
        arrow([a, scaled(E, 1.0)], "e"),
        label(E, bold("e"), "e", -4.0, 20.0),
        path([a, c], "rod"),
        path(rim, "disk", closed=True),
        path([c, add(c, zero, RADIUS)], "reference"),
        path([c, add(c, mark, RADIUS)], "phi"),
        arrow(spin, "phi"),
        label(add(c, turned(zero, t, 0.55 * PHI), 0.55 * RADIUS), "φ", "phi", -9.0, -3.0),
        arrow([c, add(c, t, 0.85)], "t"),
        label(add(c, t, 0.85), bold("t"), "t", 12.0, 6.0),
        arrow([a, scaled(GAMMA, 0.85)], "gamma"),
        label(scaled(GAMMA, 0.85), bold("γ"), "gamma", 0.0, -8.0),
        arrow(tilt, "gamma"),
        label(tilt[len(tilt) // 2], "θ = |" + bold("γ") + "|", "gamma", 8.0, 5.0, "start"),
        *(f'<circle class="point" cx="{x:.1f}" cy="{y:.1f}" r="4"/>' for x, y in ((x0, y0), (x1, y1))),
        label(a, "a", "point", -12.0, 6.0),
        label(c, "c", "point", 3.0, 20.0),
        f'<path class="size" d="M{ends[0][0]:.1f} {ends[0][1]:.1f} L{ends[1][0]:.1f} {ends[1][1]:.1f}"/>',
        *(
            f'<path class="size" d="M{x - 0.25 * aside[0]:.1f} {y - 0.25 * aside[1]:.1f} '
            f'L{x + 0.25 * aside[0]:.1f} {y + 0.25 * aside[1]:.1f}"/>'
            for x, y in ends
        ),
        f'<text class="size" x="{middle[0]:.1f}" y="{middle[1] - 7.0:.1f}" text-anchor="middle">l</text>',
        *(arrow([corner, add(corner, axis, 0.24)], "frame") for axis in (E, (0.0, 1.0, 0.0), (0.0, 0.0, 1.0))),
        label(add(corner, E, 0.24), "x", "frame", 8.0, 8.0),
        label(add(corner, (0.0, 1.0, 0.0), 0.24), "y", "frame", 9.0, 0.0),
        label(add(corner, (0.0, 0.0, 1.0), 0.24), "z", "frame", -9.0, 4.0),
    ]
    title = "The rotor: its axis t, tilted from the reference axis e by gamma, and turned about t by phi"
    return "\n".join(
        [
            f'<svg viewBox="0 0 {WIDTH} {HEIGHT}" role="img" xmlns="http://www.w3.org/2000/svg">',
            f"<title>{title}</title>",
            *lines,
            "</svg>\n",
        ]
    )


if __name__ == "__main__":
    TARGET.write_text(picture(), encoding="utf-8", newline="\n")
