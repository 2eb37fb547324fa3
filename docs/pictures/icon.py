"""Draws the FMU's icon, modelDescription/model.png: 256 by 256, legible at 32 by 32, on a light and a dark ground.

A rotor that leans from the reference axis (dashed) and spins (the orange arrow).

Needs numpy and matplotlib:  python icon.py
"""

from pathlib import Path

import matplotlib.pyplot as plt
import numpy as np
from matplotlib.patches import Polygon
from style import BLUE, ORANGE

TARGET = Path(__file__).parents[2] / "modelDescription" / "model.png"
PIXELS = 256
PIXEL = 72.0 / PIXELS  # [pt]: the picture is an inch wide
LIGHT, MIDDLE = "#a9cbee", "#8a8a8a"  # the disk's face; the reference axis

LEAN = np.radians(20.0)  # of the shaft from the reference axis, in the picture
PIVOT = np.array([22.0, 84.0])  # the support point [px, upwards]
ALONG = np.array([np.cos(LEAN), np.sin(LEAN)])
ACROSS = np.array([-np.sin(LEAN), np.cos(LEAN)])


def place(along, across):
    """A point of the leaning rotor [px]."""
    return PIVOT + np.multiply.outer(along, ALONG) + np.multiply.outer(across, ACROSS)


def ellipse(centre, half_width, half_height, first=0.0, last=2.0 * np.pi):
    """Points of a disk seen from the side, or of a part of its rim."""
    angle = np.linspace(first, last, 181)
    return place(centre + half_width * np.cos(angle), half_height * np.sin(angle))


def line(axes, points, colour, width, **style):
    """A line through points, `width` in pixels, in front of what is drawn before."""
    style = {"solid_capstyle": "round", "solid_joinstyle": "round"} | style
    axes.plot(*np.transpose(points), color=colour, lw=width * PIXEL, zorder=len(axes.get_children()), **style)


def shape(axes, points, face, edge, width):
    """A filled shape with an edge, `width` in pixels, in front of what is drawn before."""
    width *= PIXEL
    axes.add_patch(Polygon(points, fc=face, ec=edge, lw=width, joinstyle="round", zorder=len(axes.get_children())))


def draw():
    """The icon as a figure."""
    figure = plt.figure(figsize=(1.0, 1.0), dpi=PIXELS)
    axes = figure.add_axes((0.0, 0.0, 1.0, 1.0))
    axes.set(xlim=(0.0, PIXELS), ylim=(0.0, PIXELS))
    axes.axis("off")
    # From the back to the front: reference axis, shaft, disk, shaft again, spin, support point.
    line(axes, [[26.0, PIVOT[1]], [246.0, PIVOT[1]]], MIDDLE, 8.0, linestyle=(0, (2.2, 1.4)), dash_capstyle="butt")
    line(axes, place(np.array([0.0, 128.0]), np.zeros(2)), BLUE, 20.0)
    for centre, face in ((124.0, BLUE), (140.0, LIGHT)):
        shape(axes, ellipse(centre, 38.0, 102.0), face, BLUE, 13.0)
    line(axes, place(np.array([142.0, 232.0]), np.zeros(2)), BLUE, 20.0)
    spin = ellipse(200.0, 19.0, 44.0, np.radians(125.0), np.radians(365.0))
    line(axes, spin, ORANGE, 15.0)
    tip = spin[-1] + 38.0 * ACROSS
    shape(axes, [tip, spin[-1] + 24.0 * ALONG, spin[-1] - 24.0 * ALONG], ORANGE, ORANGE, 2.0)
    shape(axes, ellipse(0.0, 17.0, 17.0), ORANGE, ORANGE, 2.0)
    return figure


def write(file):
    """The icon as a PNG; without text chunks, which would hold matplotlib's version."""
    draw().savefig(file, format="png", dpi=PIXELS, transparent=True, metadata={"Software": None})


if __name__ == "__main__":
    write(TARGET)
