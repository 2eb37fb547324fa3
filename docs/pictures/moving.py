"""Draws run-up.svg, the README's moving picture: the turbo rotor on its way through the critical speeds.

Needs what `cargo xtask run turbo` leaves, and numpy:  python moving.py
"""

from pathlib import Path

import numpy as np

HERE = Path(__file__).resolve().parent
RUN = HERE.parents[1] / "target" / "run" / "turbo" / "result.csv"

FRAMES, SECONDS = 160, 12
A_TURN = 12
"""Frames of a turn: the rotor is seen as by a stroboscope that lags behind it."""
RIDE = 3.1
"""The run-up and a moment after it [s]."""
HALF = 0.16
"""Half the shaft [m]."""

STYLE = """
svg { color-scheme: light dark; font: 13px sans-serif; --ink: #24292f; --faint: #8c959f; --blue: #1f5fa8; --red: #c8500a; --steel: #b6c2cf; }
@media (prefers-color-scheme: dark) { svg { --ink: #e6edf3; --faint: #768390; --blue: #6cb0ff; --red: #ff9a5c; --steel: #57657a; } }
text { fill: var(--ink); } .faint { fill: none; stroke: var(--faint); } .blue { fill: none; stroke: var(--blue); stroke-width: 2; }
.rotor { fill: var(--steel); stroke: var(--ink); } .mark { fill: var(--red); } .axes { fill: none; stroke: var(--ink); }
"""


def main():
    """Writes the picture."""
    run = np.genfromtxt(RUN, delimiter=",", names=True, deletechars="")
    time, turns = run["time"], run["phi"] / (2 * np.pi)
    rest = {name: run[name][0] for name in run.dtype.names}
    lift = run["r_c.z"] - rest["r_c.z"]
    tilt = run["axis.z"] - rest["axis.z"]
    y, z = (run[f"probe[1].r.{c}"] - rest[f"probe[1].r.{c}"] for c in "yz")
    largest = np.hypot(y, z).max()
    seen = np.array([_seen(time, turns, frame) for frame in range(FRAMES)])
    rpm = run["omega_phi"] * 30 / np.pi

    # Side view: x along the shaft, 0.32 m are 280 px; the motion is shown so much larger.
    scale, centre, height = 280 / (2 * HALF), 180, 130
    larger = 0.04 / largest
    up = -lift[seen] * larger * scale
    turn = -np.degrees(np.arctan(tilt[seen] * larger))
    mark = -38 * np.sin(2 * np.pi * turns[seen])  # unbalance.angle is 0: along y where the rotor starts
    side = "".join(
        [
            *(_bearing(centre + x * scale, height) for x in (-0.12, 0.12)),
            f'<g transform="translate({centre} {height})"><g>{_move("translate", [f"0 {v:.1f}" for v in up])}',
            f'<g>{_move("rotate", [f"{v:.2f}" for v in turn])}',
            '<rect class="rotor" x="-140" y="-7" width="280" height="14"/><rect class="rotor" x="18" y="-44" width="18" height="88"/>',
            f'<circle class="mark" cx="27" r="4">{_animate("cy", [f"{v:.0f}" for v in mark])}</circle></g></g></g>',
        ]
    )

    # End view: the last turn at the probe.
    wide = 62 / largest
    orbits = []
    for one in seen:
        way = turns[one] - np.linspace(min(1, turns[one]), 0, 33)
        orbits.append("M" + " ".join(f"{a * wide:.0f} {-b * wide:.0f}" for a, b in zip(*(np.interp(way, turns, c) for c in (y, z)))))
    end = (
        f'<g transform="translate(440 {height})"><circle class="faint" r="62"/><path class="faint" d="M-70 0H70M0 -70V70"/>'
        f'<path class="blue">{_animate("d", orbits)}</path><circle class="mark" r="4">'
        f'{_animate("cx", [f"{v:.0f}" for v in y[seen] * wide])}{_animate("cy", [f"{v:.0f}" for v in -z[seen] * wide])}</circle></g>'
    )

    # Whirl against speed: its largest in each of the last 400 samples.
    parts = np.array_split(np.arange(np.searchsorted(time, RIDE)), 200)
    whirl = np.array([np.hypot(y[part], z[part]).max() for part in parts])
    speed = np.array([rpm[part].mean() for part in parts])
    top = np.ceil(speed.max() / 5000) * 5000
    across, upward = 250 / top, 120 / (largest * 1.05)
    line = "M" + " ".join(f"{a * across:.1f} {-w * upward:.1f}" for a, w in zip(speed, whirl))
    now = [np.interp(time[i], [time[part].mean() for part in parts], whirl) for i in seen]
    ticks = "".join(
        f'<text x="{at * across:.0f}" y="16" text-anchor="middle">{at / 1000:.0f}</text>' for at in np.arange(0, top + 1, 5000)
    )
    plot = (
        f'<g transform="translate(570 190)"><path class="axes" d="M0 -130V0H255"/><path class="blue" d="{line}"/>{ticks}'
        f'<text x="127" y="34" text-anchor="middle">spin [1000 rpm]</text><text x="4" y="-134">whirl, up to {largest * 1e6:.0f} µm</text>'
        f'<circle class="mark" r="5">{_animate("cx", [f"{v * across:.1f}" for v in rpm[seen]])}'
        f'{_animate("cy", [f"{-v * upward:.1f}" for v in now])}</circle></g>'
    )
    words = (
        f'<text x="{centre}" y="24" text-anchor="middle">12 kg on two bearings, motion {round(larger, -1):.0f} times larger</text>'
        '<text x="440" y="24" text-anchor="middle">orbit at a bearing</text>'
        '<text x="697" y="24" text-anchor="middle">through the critical speeds</text>'
    )
    title = "A turbo rotor runs up through its critical speeds: from the side, its orbit at a bearing, whirl against speed"
    text = (
        f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="0 0 850 240" role="img"><title>{title}</title>'
        f"<style>{STYLE}</style>{words}{side}{end}{plot}</svg>\n"
    )
    (HERE / "run-up.svg").write_text(text, encoding="utf-8")


def _seen(time, turns, frame):
    """The sample of a frame: soon after its time, when the rotor has turned by a part of a turn more than at the frame before."""
    first = np.searchsorted(time, RIDE * frame / FRAMES)
    last = max(first + 2, np.searchsorted(turns, turns[first] + 1))
    phase = (turns[first:last] - frame / A_TURN) % 1
    return min(first + int(np.argmin(np.minimum(phase, 1 - phase))), len(time) - 1)


def _bearing(x, y):
    """A spring above and one below the shaft."""
    spring = " ".join(f"l{dx} 4" for dx in (5, -10, 10, -10, 10, -5))
    return "".join(f'<path class="faint" d="M{x:.0f} {y + at}v4 {spring} v4"/>' for at in (-40, 8))


def _animate(what, values):
    return f'<animate attributeName="{what}" dur="{SECONDS}s" repeatCount="indefinite" values="{";".join(values)}"/>'


def _move(how, values):
    return (
        f'<animateTransform attributeName="transform" type="{how}" dur="{SECONDS}s" repeatCount="indefinite" values="{";".join(values)}"/>'
    )


if __name__ == "__main__":
    main()
