"""The forms of plots, as JSON that the page draws (web/lines.js, web/paths.js)."""

from .pack import extremes, packed

COLOURS = ("blue", "orange", "green", "purple")
"""Of the style sheet, in the order in which curves take them."""


def curve(label, values, colour, **style):
    """A curve of `lines`; `style`: dash (0 to 2), points, width."""
    return {"label": label, "values": values, "colour": colour, **style}


def lines(title, caption, x, *plots):
    """Curves against a common ascending `x`, (label, values); each plot (label, curves, options: log, marks, lines)."""
    label, along = x
    rows = extremes(*(one["values"] for _, curves, _ in plots for one in curves))

    def thinned(one):
        return one | {"values": packed(one["values"][rows])}

    drawn = [{"label": label, "curves": [thinned(one) for one in curves], **more} for label, curves, more in plots]
    return {
        "kind": "lines",
        "title": title,
        "caption": caption,
        "x": {"label": label, "values": packed(along[rows])},
        "plots": drawn,
    }


def paths(title, caption, x_label, *plots, equal=False):
    """Paths in planes over a common x axis; each plot (label, paths), a path (label, x, y, marks)."""

    def path(colour, label, x, y, marks=()):
        return {"label": label, "x": packed(x), "y": packed(y), "colour": colour, "marks": list(marks)}

    drawn = [{"label": label, "paths": [path(c, *one) for c, one in zip(COLOURS, ways)]} for label, ways in plots]
    return {"kind": "paths", "title": title, "caption": caption, "x": x_label, "plots": drawn, "equal": equal}
