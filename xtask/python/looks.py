"""What pictures by matplotlib look like: colours, and its settings."""

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
