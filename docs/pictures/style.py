"""What the pictures of this folder share: their style, and how they are saved. Needs matplotlib."""

from pathlib import Path

import matplotlib

matplotlib.use("svg")
import matplotlib.pyplot as plt

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
    metadata = dict.fromkeys(("Date", "Creator", "Format", "Type"))
    figure.savefig(Path(__file__).with_name(name), metadata=metadata)
