"""Pictures of runs for the gallery: each function returns an SVG, as text.

`result` is a structured array, `time` and the outputs in SI units, `scene` a `report.scene.Scene`.
"""

import re
from functools import wraps

import numpy as np
from looks import BLACK, BLUE, GREEN, PURPLE, STYLE, VERMILLION, svg
from matplotlib import rc_context
from matplotlib.figure import Figure
from report import measure, paper, stations
from report.notation import RPM, multiple, number
from report.turns import turns

WIDTH = 7.2  # [in]


def _inline(height, label):
    """Turn `draw(figure, result, scene)` into a function that returns an SVG of `height` [in]."""

    def decorate(draw):
        @wraps(draw)
        def render(result, scene):
            with rc_context(STYLE):
                figure = Figure(figsize=(WIDTH, height), layout="constrained")
                draw(figure, result, scene)
                text = svg(figure)
            return _element(text, draw.__name__, label)

        return render

    return decorate


def _element(document, name, label):
    """The <svg> element of `document`, fit to stand beside others in one page."""
    svg = document[document.index("<svg") :]
    svg = re.sub(r' (?:width|height)="[\d.]+pt"', "", svg, count=2)
    svg = re.sub(r'( id="|url\(#|href="#)', rf"\g<1>{name}-", svg)
    return svg.replace("<svg ", f'<svg role="img" aria-label="{label}" ', 1)


def _limits(values, floor):
    """Axis limits around `values` with some air, at least 2 `floor` apart: rounding noise stays a line."""
    low, high = np.min(values), np.max(values)
    half = 1.08 * max((high - low) / 2.0, floor)
    return (low + high) / 2.0 - half, (low + high) / 2.0 + half


def _path_and_components(figure, time, path, components, unit, floor):
    """A plane path with equal scales, and beside it its `components` against time.

    `path` is ((name, values), (name, values)), across and upwards; `components` a list of the same.
    """
    grid = figure.add_gridspec(len(components), 2, width_ratios=(1.0, 1.15))
    (across, y), (upwards, z) = path
    half = max(np.ptp(y) / 2.0, np.ptp(z) / 2.0, floor)
    plane = figure.add_subplot(grid[:, 0], aspect="equal")
    plane.plot(y, z, color=BLUE, linewidth=0.7)
    plane.plot(y[0], z[0], "o", color=BLACK, markersize=8, markerfacecolor="none", label="start")
    plane.plot(y[-1], z[-1], "s", color=VERMILLION, markersize=5, label="end")
    plane.set(xlabel=f"{across} [{unit}]", ylabel=f"{upwards} [{unit}]", xlim=_limits(y, half), ylim=_limits(z, half))
    plane.legend(loc="lower center", bbox_to_anchor=(0.5, 1.0), ncols=2)
    first = None
    for i, (name, values) in enumerate(components):
        panel = figure.add_subplot(grid[i, 1], sharex=first)
        first = first or panel
        panel.plot(time, values, color=BLUE, linewidth=0.8)
        panel.set(ylabel=f"{name} [{unit}]", ylim=_limits(values, floor))
        panel.tick_params(labelbottom=i == len(components) - 1)
    panel.set_xlabel("time [s]")
    figure.align_ylabels()


@_inline(3.7, "Path of the mass centre in the y–z plane, and its coordinates against time")
def trajectory(figure, result, scene):
    """The path of the mass centre (the paper's Figure 5)."""
    r = {c: (f"$r_{{c{c}}}$", result[f"r_c.{c}"]) for c in "xyz"}
    _path_and_components(figure, result["time"], (r["y"], r["z"]), list(r.values()), "m", floor=1e-6)


@_inline(3.7, "Transverse Euler vector in its plane, and its components and length against time")
def attitude(figure, result, scene):
    """The transverse Euler vector γ and its length θ."""
    y, z = ((rf"$\gamma_{c}$", result[f"gamma.{c}"]) for c in "yz")
    theta = (r"$\theta=|\gamma|$", measure.tilt(result))
    _path_and_components(figure, result["time"], (y, z), [y, z, theta], "rad", floor=1e-6)


@_inline(4.6, "Axial angle, rotor axis and transverse Euler vector against time, around the largest tilt")
def passage(figure, result, scene):
    """φ, the axis t and γ while the axis leans by more than a right angle, around the largest tilt."""
    shown = result[measure.around_largest_tilt(result)]
    time = shown["time"]
    angle, axis, gamma = figure.subplots(3, sharex=True)
    angle.plot(time, shown["phi"], color=BLUE)
    angle.set(ylabel=r"$\varphi$ [rad]")
    for panel, name, components in ((axis, "axis", "xyz"), (gamma, "gamma", "yz")):
        for component, color in zip(components, (BLUE, VERMILLION, GREEN)[-len(components) :]):
            symbol = rf"$t_{component}$" if name == "axis" else rf"$\gamma_{component}$"
            panel.plot(time, shown[f"{name}.{component}"], color=color, label=symbol)
        panel.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=3)
    axis.set(ylabel="axis t [1]", ylim=(-1.08, 1.08))
    gamma.set(ylabel=r"$\gamma$ [rad]", xlabel="time [s]")
    figure.align_ylabels()


@_inline(3.7, "Phase portrait of the tilt: its rate against the tilt")
def portrait(figure, result, scene):
    """The tilt θ and its rate: a nutating top goes round a loop."""
    theta, rate = measure.tilt(result), _tilt_rate(result)
    axes = figure.add_subplot()
    axes.plot(theta, rate, color=BLUE, linewidth=0.7)
    axes.plot(theta[0], rate[0], "o", color=BLACK, markersize=8, markerfacecolor="none", label="start")
    axes.set(xlabel=r"$\theta$ [rad]", ylabel=r"$\dot\theta$ [rad/s]")
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0))


@_inline(3.4, "Orbits of the stations that probes look at")
def orbits(figure, result, scene):
    """The path of each probe's station across the x axis."""
    probes = _probes(result)
    panels = figure.subplots(1, len(probes), squeeze=False)[0]
    for panel, probe in zip(panels, probes):
        y, z = result[f"{probe}.r.y"], result[f"{probe}.r.z"]
        half = max(np.ptp(y) / 2.0, np.ptp(z) / 2.0, 1e-9)
        panel.plot(y, z, color=BLUE, linewidth=0.6)
        panel.plot(y[-1], z[-1], "s", color=VERMILLION, markersize=5)
        panel.set(title=probe, xlabel="y [m]", xlim=_limits(y, half), ylim=_limits(z, half), aspect="equal")
    panels[0].set_ylabel("z [m]")


@_inline(2.6, "Whirl of a station, turn by turn, against the speed")
def whirl(figure, result, scene):
    """The largest distance of a station from its middle in each turn, against the speed of that turn."""
    station = stations.looked_at(scene)[0]
    found = turns(station, result)
    unit, size = multiple(found.whirl.max(), "m")
    axes = figure.add_subplot()
    axes.plot(found.speed[1:] * RPM, found.whirl[1:] / size, color=BLUE, linewidth=0.8)
    axes.ticklabel_format(style="plain", axis="x")
    axes.set(title=f"{scene.title}: {station.name}", xlabel="speed [rpm]", ylabel=f"whirl [{unit}]", ylim=(0.0, None))


@_inline(2.6, "Distance of the mass centre from the x axis against time, on a logarithmic scale")
def growth(figure, result, scene):
    """How a whirl grows or dies: a straight line is an exponential."""
    axes = figure.add_subplot()
    axes.semilogy(result["time"], np.hypot(result["r_c.y"], result["r_c.z"]), color=BLUE, linewidth=0.8)
    axes.set(xlabel="time [s]", ylabel=r"$|(r_{cy}, r_{cz})|$ [m]")


@_inline(2.8, "Radius of the whirl that lasts against the imposed speed")
def response(figure, result, scene):
    """The response to unbalance: the whirl that lasts, over the speed."""
    axes = figure.add_subplot()
    axes.plot(result["speed"], result["radius"], color=BLUE, marker="o", markersize=2.5, linewidth=0.8)
    axes.set(xlabel=r"imposed $\omega_\varphi$ [rad/s]", ylabel="radius of the whirl [m]", ylim=(0.0, None))


@_inline(2.6, "Deviation of the axial rate from its start value against time")
def spin(figure, result, scene):
    """How far ω_φ strays from its start value (the paper's Figure 6)."""
    deviation = measure.spin_deviation(result)
    t, value = result["time"][deviation.extremum], deviation.values[deviation.extremum]
    shown = [*deviation.values, 0.0]
    axes = figure.add_subplot()
    axes.plot(result["time"], deviation.values, color=BLUE, linewidth=0.8)
    if scene.identifier == paper.IDENTIFIER:
        claim = f"the paper: at most {paper.SPIN_BOUND:g} %"
        for bound, label in ((paper.SPIN_BOUND, claim), (-paper.SPIN_BOUND, None)):
            shown.append(bound)
            axes.axhline(bound, color=VERMILLION, linestyle=(0, (5, 3)), label=label)
    label = f"{number(value, 3)} {deviation.unit} at {number(t)} s"
    axes.plot(t, value, "o", color=BLACK, markersize=4, label=label)
    relative, absolute = r"$\omega_\varphi/\omega_\varphi(0)-1$", r"$\omega_\varphi-\omega_\varphi(0)$"
    quantity = relative if deviation.unit == "%" else absolute
    axes.set(xlabel="time [s]", ylabel=f"{quantity} [{deviation.unit}]", ylim=_limits(shown, floor=1e-9))
    axes.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=2)


@_inline(4.2, "Change of the energies against time, and the residual of the ledger")
def energy(figure, result, scene):
    """The exchange of energy (the paper's Figure 7) and what its ledger leaves over."""
    turnover = measure.energy_balance(result, scene.relative_tolerance).turnover
    time = result["time"]
    work = result["energy.supplied"] - result["energy.dissipated"]
    curves = [
        ("kinetic", result["energy.kinetic"], BLUE, "-"),
        ("potential", result["energy.potential"], VERMILLION, "-"),
        ("total", result["energy.total"], BLACK, (0, (4, 2))),
    ]
    if np.any(work):
        curves.insert(2, ("work supplied − lost", work, GREEN, "-"))
    changes = [values - values[0] for _, values, _, _ in curves]
    exchange, rest = figure.subplots(2, sharex=True, height_ratios=(2.2, 1.0))
    for (name, _, color, dash), change in zip(curves, changes):
        exchange.plot(time, change, color=color, linestyle=dash, label=name)
    exchange.set(ylabel="change of energy [J]", ylim=_limits(changes, floor=1e-6 * turnover or 1.0))
    exchange.legend(loc="lower right", bbox_to_anchor=(1.0, 1.0), ncols=len(curves))
    residual = result["energy.residual"]
    rest.plot(time, residual, color=PURPLE, linewidth=0.8)
    rest.set(xlabel="time [s]", ylabel="residual [J]", ylim=_limits(residual, floor=1e-17 * turnover or 1.0))
    figure.align_ylabels()


def _tilt_rate(result):
    """dθ/dt = −e·(ω×t)/sin θ [rad/s], not a number where θ = 0."""
    sine = np.hypot(result["axis.y"], result["axis.z"])
    along = result["omega.y"] * result["axis.z"] - result["omega.z"] * result["axis.y"]
    return np.divide(-along, sine, out=np.full_like(sine, np.nan), where=sine > 0.0)


def _probes(result):
    """The names of the probes: `probe[1]`, …"""
    return [f"probe[{index}]" for index in range(1, 5) if f"probe[{index}].r.y" in result.dtype.names]
