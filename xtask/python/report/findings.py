"""The results that stand first: a few numbers of a run and of its linear view."""

from dataclasses import dataclass

import numpy as np

from . import linear, measure, stations, vibration
from .notation import number, quantity, rpm
from .panels import loads
from .result import Deflection

MOST = 5
"""Critical speeds that are named."""
SHARP = 2.5
"""From this amplification factor on a resonance counts as a critical speed (API Std 617 and RP 684); below it is critically damped."""

ROUNDING = 1e-9
"""A speed that is beyond a table by less than this part of it is not."""

TURNS = 1e-3
"""A speed of less than this part of the largest has no sense of rotation."""

LEANS = 10.0
"""A rotor at rest that leans by more [°] was hardly meant to."""

CIRCLE_BACKWARD = -1.0 + 1e-6
"""Up to this sense, the area of orbits over that of circles, a mode whirls backward in circles."""


@dataclass(frozen=True)
class Finding:
    """A number, what it is, and whether it is `good`, `bad` or neither."""

    value: str
    what: str
    judged: str = ""


def findings(result, view, unheld=""):
    """All that this run and its linear view have; `unheld` says in which directions nothing holds the rotor, "" where something does."""
    contact = _contact(result)
    found = [_backwards(result), _critical(view), *_passed(result, view), *_held(result, view), _unheld(unheld)]
    found += [_stability(result, view, contact is not None, unheld), _rest(result), *_motion(result), contact]
    found += [_load(result), _time(result), _energy(result)]
    return [finding for finding in found if finding]


def _backwards(result):
    """That the rotor turns backwards, since speeds are shown by their size."""
    spin = result.columns["omega_phi"]
    if spin.min() >= -TURNS * np.abs(spin).max():
        return None
    how = "in part of this run" if spin.max() > 0.0 else "in this run"
    return Finding("backwards", f"the rotor turns against its axis (ω_φ < 0) {how}; speeds are shown by their size")


def _critical(view):
    if view is None or view.floquet:
        return None
    highest = max(row["speed_rad_s"] for row in view.modes)
    if not view.critical:
        return Finding("none", f"critical speeds (1×), looked for up to {rpm(highest)}")
    # Modes in two planes of a round machine cross at one speed.
    speeds = list(dict.fromkeys(_numbers(view.critical)))
    more = f", the first {MOST} of {len(speeds)}" if len(speeds) > MOST else f", up to {rpm(highest)}"
    held = _names(crossing for crossing in view.critical if crossing.get("held"))
    doubt = f"; not known but extrapolated, where the coefficients of {held} are held beyond a table" if held else ""
    return Finding(_in_rpm(speeds[:MOST]), f"critical speeds (1×){more}{doubt}")


def _names(crossings):
    """The effects whose coefficients are held at these crossings."""
    return ", ".join(sorted({name for crossing in crossings for name in crossing.get("held", [])}))


def _held(result, view):
    """Tables that the run leaves: coefficients are held there, and nobody knows them."""
    if view is None:
        return
    spin = np.abs(result.columns["omega_phi"])
    for effect, first, last in view.tables:
        if spin.min() < first * (1.0 - ROUNDING) or spin.max() > last * (1.0 + ROUNDING):
            known = f"whose table is known from {rpm(first)} to {rpm(last)}"
            yield Finding("beyond a table", f"coefficients of {effect}, {known}, are held at other speeds; this run, {_range(spin)}", "bad")


def _passed(result, view):
    """Critical speeds with little damping among the speeds of this run, or nearer to them than API 617 allows."""
    if view is None or view.floquet:
        return
    spin = np.abs(result.columns["omega_phi"])
    # An unbalance that is missing drives nothing here, and the machine that is built will have one.
    has_unbalance = bool(result.scene.blocks("unbalance"))
    drives, judged = ("an unbalance drives", "bad") if has_unbalance else ("an unbalance would drive (this scene has none)", "")
    alike, unknown = {}, []
    for crossing in view.critical:
        speed, ratio = crossing["speed_rad_s"], crossing["damping_ratio"]
        away = max(spin.min() - speed, speed - spin.max())
        allowed = _margin(ratio, spin, speed)
        # An unbalance goes round forward: it does not drive a mode whose orbits are circles backward, as those of a round machine are.
        is_driven = crossing["sense"] > CIRCLE_BACKWARD
        if allowed is not None and away <= allowed and is_driven:
            if crossing.get("held"):
                unknown.append(crossing)
                continue
            where, how = "within" if away <= 0.0 else "nearer than API 617 allows to", None
            if ratio <= linear.NEITHER:
                how = "its mode grows by itself" if ratio < -linear.NEITHER else "without damping"
            alike.setdefault((where, how), []).append(crossing)
    for (where, how), crossings in alike.items():
        several = "s" if len(crossings) > 1 else ""
        if not how:
            factors = ", ".join(number(0.5 / crossing["damping_ratio"], 2) for crossing in crossings)
            how = f"amplification factor{several} {factors} (from {SHARP} on it counts as critical, API 617)"
        what = f"critical speed{several} that {drives}, {where} the speeds of this run, {_range(spin)}; {how}"
        yield Finding(_in_rpm(_numbers(crossings)), what, judged)
    if unknown:
        several = "s" if len(unknown) > 1 else ""
        what = f"critical speed{several} beyond a table: coefficients of {_names(unknown)} are held there, so API 617 does not judge them"
        yield Finding(_in_rpm(_numbers(unknown)), what, "bad")


def _margin(ratio, spin, speed):
    """How near to the speeds of a run a critical speed must not lie [rad/s]: API 617 and RP 684; None where it is damped too well to count."""
    factor = 0.5 / max(ratio, linear.NEITHER)
    if factor < SHARP:
        return None
    margin = min(0.16, 0.17 * (1.0 - 1.0 / (factor - 1.5)))
    return margin * spin.min() if speed < spin.min() else (0.1 + margin) * spin.max()


def _numbers(crossings):
    """The speeds of crossings in rpm, without the unit."""
    return [rpm(crossing["speed_rad_s"]).removesuffix("\u00a0rpm") for crossing in crossings]


def _in_rpm(numbers):
    """One after another, with the unit."""
    return " · ".join(numbers) + "\u00a0rpm"


def _range(spin):
    """The speeds of a run [rad/s] in rpm; one if it hardly changes."""
    return f"{rpm(spin.min())} to {rpm(spin.max())}" if np.ptp(spin) > 0.01 * spin.max() else rpm(spin.max())


def _unheld(words):
    return Finding("not held", words, "bad") if words else None


def _stability(result, view, touches=False, unheld=""):
    if view is None:
        return None
    spin = np.abs(result.columns["omega_phi"])
    if view.floquet:
        speed, rate = view.fastest_growth(spin.min(), spin.max())
        bounds = ", ".join(rpm(threshold) + _when(result, threshold) for threshold, *_ in view.thresholds)
        bounds = f"; begins or ceases at {bounds}" if bounds else ""
        what = f"fastest growth {number(rate, 3)}\u00a01/s at {rpm(speed)}, beside the motion that repeats (Floquet){bounds}"
        if speed in view.growing:
            return Finding("unstable", what, "bad")
        return Finding("nothing grows", f"{what}; {_looked(view, spin)}")
    # Nothing is said of speeds at which nobody looked.
    looked = [row["speed_rad_s"] for row in view.modes]
    spin = np.clip(spin, min(looked), max(looked))
    # A partner at a port may hold what nothing else does.
    held = ", with the loads at its ports held" if result.scene.blocks("port") else ""
    range_ = _range(spin) + held
    if row := view.fastest_growing(spin.min(), spin.max()):
        bounds = "".join(
            f"; {'it' if mode == row['mode'] else 'another'} grows {grows} {rpm(speed)}{_when(result, speed)}"
            for speed, grows, mode in view.thresholds
        )
        at, in_ = rpm(row["speed_rad_s"]), quantity(1.0 / row["growth_rate_1_s"], "s")
        return Finding("unstable", f"{row['direction']} mode grows by e in {in_} at {at}{held}, {_decrement(row)}{bounds}", "bad")
    row = view.least_damped(spin.min(), spin.max())
    if row is None:
        return None
    at, how = f"at {rpm(row['speed_rad_s'])}", _decrement(row)
    if abs(row["damping_ratio"]) <= linear.NEITHER:
        return Finding("undamped", f"no mode grows and one or more do not die out, at {range_}; {_looked(view, spin)}")
    what = f"at {range_}; least {how}, {row['direction']} mode {at}; {_looked(view, spin)}"
    if unheld:
        return Finding("no mode grows", f"beside the directions in which nothing holds the rotor, {what}")
    return Finding("stable", f"while nothing touches, {what}") if touches else Finding("stable", what, "good")


def _decrement(row):
    size = linear.decrement(row["damping_ratio"])
    return f"log. decrement {number(size, 2)}" if np.isfinite(size) else "without swinging"


def _looked(view, spin):
    """At how many speeds of the linear view, of those of a run [rad/s], this was looked at."""
    speeds = np.unique([row["speed_rad_s"] for row in view.modes])
    within = int(np.count_nonzero((speeds >= spin.min()) & (speeds <= spin.max())))
    return f"looked at {within} speeds within those of the run" if within > 1 else "looked at the speeds nearest to that of the run"


def _when(result, threshold):
    """When a run first comes above a speed [rad/s] that it began below, in words; nothing where it does not."""
    spin = np.abs(result.columns["omega_phi"])
    above = np.flatnonzero(spin > threshold)
    return f", passed at {number(result.columns['time'][above[0]], 3)}\u00a0s" if len(above) and above[0] else ""


def _rest(result):
    """A rotor whose axis leans far where loads balance at the start: it may lack what should hold it."""
    at_rest = result.scene.parameters.get("start.at_rest")
    lean = np.degrees(np.arccos(np.clip(result.columns["axis.x"][0], -1.0, 1.0)))
    if at_rest is None or at_rest.value != "true" or lean < LEANS:
        return None
    return Finding(f"{number(lean, 3)}°", "tilt where loads balance at the start; is a bearing, or its kt, missing?", "bad")


def _contact(result):
    """Where the shaft came to touch a ring: its station went as far as the gap."""
    columns = result.columns
    touches = {ring: columns["time"][columns[f"{ring}.contact"] > 0.0] for ring in result.scene.blocks("rub")}
    first = {ring: times[0] for ring, times in touches.items() if len(times)}
    if not first:
        return None
    ring = min(first, key=first.get)
    gap = quantity(result.scene.value(f"{ring}.gap"), "m")
    return Finding("contact", f"the shaft touches {ring}, whose gap is {gap}, first at {number(first[ring], 3)}\u00a0s", "bad")


def _motion(result):
    columns = result.columns
    largest = max(result.deflections or _sampled(result), key=lambda found: found.largest)
    if largest.largest > 0.0:
        kind = "largest sample of the deflection" if largest.is_sample else "largest deflection"
        when = f"at {number(largest.at, 6)}\u00a0s"
        yield Finding(_micrometres(largest.largest), f"{kind} off the x axis, static deflection included: {largest.station}, {when}")
    tilt = measure.tilt(columns)
    if tilt.max() > 0.0 and not (stations.is_machine(result.scene) and tilt.max() <= measure.SMALL_TILT):
        when = number(columns["time"][tilt.argmax()])
        yield Finding(f"{number(np.degrees(tilt.max()), 3)}°", f"largest tilt θ of the samples, at {when}\u00a0s")


def _sampled(result):
    """The largest samples of the deflections of c and of the probes."""
    places = [stations.Station("r_c", 0.0), *stations.all_of(result.scene, "probe")]
    for place in places:
        distance = np.abs(place.offset(result.columns))
        when = distance.argmax()
        yield Deflection(place.name, distance[when], result.columns["time"][when], is_sample=True)


def _micrometres(length):
    """A length [m] as `cargo xtask run` prints it."""
    return f"{number(1e6 * length, 6)}\u00a0µm"


def _load(result):
    found = loads(result)
    if not found:
        return None
    name = max(found, key=lambda name: found[name].max())
    when = result.columns["time"][found[name].argmax()]
    return Finding(quantity(found[name].max(), "N"), f"largest load of the samples, {name}, at {number(when)}\u00a0s")


def _time(result):
    if result.timings is None:
        return None
    spent = result.timings
    if spent.total:
        more = f", of {quantity(spent.total, 's')} with fmpy’s own work"
    else:
        lasted = quantity(result.scene.stop - result.scene.start, "s")
        more = f" and of the search for the largest deflections, for {lasted}"
    return Finding(quantity(spent.solver, "s"), f"CPU time of the solver{more}")


def _energy(result):
    balance = measure.energy_balance(result.columns, result.scene.relative_tolerance)
    bound, moved = quantity(balance.bound, "J"), quantity(balance.turnover, "J")
    kept, judged = ("less", "good") if balance.holds else ("not less", "bad")
    what = f"energy that does not add up, at most: {kept} than the {bound} that tolerance and rounding allow where {moved} moves"
    return Finding(quantity(balance.residual, "J"), what, judged)
