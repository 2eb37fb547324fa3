"""A picture of a pair against time: the motion, and the error of each way."""

import matplotlib

matplotlib.use("Agg")
import matplotlib.pyplot as plt  # noqa: E402
import numpy as np  # noqa: E402

# Colour, width and line; a later one is drawn over an earlier one, which stays visible where both agree.
STYLES = {"exact": ("0.75", 5.0, "-"), "held": ("orange", 3.0, "-"), "nothing set": ("navy", 1.2, "--"), "advised": ("C3", 1.5, ":")}


def draw(path, title, times, name, found):
    """Draws the first watched output, `name`, for each way that did not fail, and below it the error relative to the largest motion."""
    exact = found["exact"]
    figure, (motion, errors) = plt.subplots(2, sharex=True, figsize=(8, 7), layout="constrained")
    for head, (color, width, line) in STYLES.items():
        if found.get(head) is None:
            continue
        style = {"color": color, "linewidth": width, "linestyle": line}
        motion.plot(1e3 * times, found[head][:, 0], label=head, **style)
        if head != "exact":
            off = np.abs(found[head] - exact).max(axis=1) / np.abs(exact).max()
            # A log axis has no place for an error of 0.
            errors.semilogy(1e3 * times, np.maximum(off, 1e-16), **style)
    # A way that grows without end would hide the others.
    low, high = exact[:, 0].min(), exact[:, 0].max()
    motion.set_ylim(low - 0.3 * (high - low), high + 0.3 * (high - low))
    motion.set(ylabel=f"{name} [{'rad/s' if name.endswith('.w') else 'm'}]")
    motion.grid(alpha=0.3)
    errors.set(xlabel="time [ms]", ylabel="error, relative to the largest motion")
    errors.grid(alpha=0.3)
    figure.suptitle(title)
    figure.legend(loc="outside lower center", ncols=4, frameon=False)
    figure.savefig(path)
    plt.close(figure)
