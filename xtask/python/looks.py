"""What pictures by matplotlib look like: colours, its settings, and how they are written."""

import io

# Okabe and Ito's palette: told apart by colour-blind readers too.
BLUE, VERMILLION, GREEN, PURPLE, ORANGE, BLACK = "#0072b2", "#d55e00", "#009e73", "#cc79a7", "#e69f00", "#222222"

STYLE = {
    "svg.fonttype": "none",  # text stays text
    "svg.hashsalt": "split-rotor",  # the same run gives the same bytes
    "font.size": 9,
    "axes.titlesize": 9,
    "axes.titlelocation": "left",
    "axes.edgecolor": "#888888",
    "axes.labelcolor": BLACK,
    "axes.spines.top": False,
    "axes.spines.right": False,
    "axes.grid": True,
    "axes.formatter.use_mathtext": True,
    "axes.formatter.useoffset": False,
    "axes.formatter.limits": (-3, 4),
    "axes.xmargin": 0.01,
    "axes.unicode_minus": True,
    "grid.color": "#e4e4e4",
    "grid.linewidth": 0.6,
    "xtick.color": "#555555",
    "ytick.color": "#555555",
    "lines.linewidth": 1.0,
    "legend.frameon": False,
    "legend.borderaxespad": 0.2,
}

PALE = "#e6edf3"
DARK = {
    "#ffffff": "#0d1117",
    "#000000": PALE,
    "#222222": PALE,
    "#3d3d3d": "#adbac7",
    "#555555": "#9da7b3",
    "#666666": "#9da7b3",
    "#888888": "#768390",
    "#e4e4e4": "#2d333b",
    "#eeeeee": "#2d333b",
    "#0072b2": "#58a6ff",
    "#1f5fa8": "#58a6ff",
}
"""What stands for a colour where the reader prefers a dark page."""


def svg(figure):
    """The figure as an SVG, light or dark as its reader prefers; the same figure gives the same text."""
    text = io.StringIO()
    figure.savefig(text, format="svg", metadata=dict.fromkeys(("Creator", "Date", "Format", "Type")))
    return in_both_lights(text.getvalue())


def in_both_lights(text):
    """An SVG by matplotlib with a rule for each colour of DARK."""
    rules = "".join(
        f'[style*="{what}: {light}"]{{{what}:{dark} !important}}' for what in ("fill", "stroke") for light, dark in DARK.items()
    )
    style = f'<style type="text/css">@media (prefers-color-scheme:dark){{text{{fill:{PALE}}}{rules}}}</style>'
    return text.replace("</defs>", f"{style}\n </defs>", 1)
