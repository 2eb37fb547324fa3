"""What the pictures of this folder share: their style, and how they are saved. Needs matplotlib."""

import sys
from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt

HERE = Path(__file__).resolve().parent
sys.path.insert(0, str(HERE.parents[1] / "xtask" / "python"))

from looks import svg  # noqa: E402

BLUE, ORANGE, GREY = "#1f5fa8", "#c8500a", "#666666"

plt.rcParams.update(
    {
        "svg.fonttype": "none",  # text stays text
        "svg.hashsalt": "split-rotor",  # the same ids at every run
        "font.family": "sans-serif",  # DejaVu comes with matplotlib
        "font.sans-serif": ["DejaVu Sans"],
        "font.size": 10,
        "axes.spines.top": False,
        "axes.spines.right": False,
    }
)


def save(figure, name):
    """Write the figure beside this file; the same picture gives the same bytes."""
    HERE.joinpath(name).write_text(svg(figure), encoding="utf-8")
