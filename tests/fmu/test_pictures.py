"""The icon and the page's picture: what the scripts in docs/pictures draw, and legible."""

import io
import sys

import matplotlib.image
import numpy as np
import project
import pytest

PICTURES = project.ROOT / "docs" / "pictures"
MADE = project.ROOT / "modelDescription"
SIZE, SMALL = 256, 32  # [px]
SAME = 2.0 / 255.0  # mean difference of the colours, measured 0 with the pinned matplotlib


@pytest.fixture
def scripts(monkeypatch):
    """The scripts as modules."""
    monkeypatch.syspath_prepend(str(PICTURES))
    yield
    for name in ("icon", "rotor", "style"):
        sys.modules.pop(name, None)


def colours(file):
    """Rows of red, green, blue, opacity, from 0 to 1."""
    return matplotlib.image.imread(file, format="png")


def test_golden_icon_is_what_the_script_draws(scripts):
    import icon

    drawn = io.BytesIO()
    icon.write(drawn)
    drawn.seek(0)
    committed = colours(MADE / "model.png")
    assert np.mean(np.abs(colours(drawn) - committed)) <= SAME, "run `python docs/pictures/icon.py`"


def test_golden_picture_is_what_the_script_draws(scripts):
    import rotor

    committed = (MADE / "documentation" / "rotor.svg").read_text(encoding="utf-8")
    assert committed == rotor.picture(), "run `python docs/pictures/rotor.py`"


def test_exact_icon_stands_where_fmi_2_and_fmi_3_look_for_it(fmu):
    committed = (MADE / "model.png").read_bytes()
    assert (fmu.directory / "model.png").read_bytes() == committed
    assert (fmu.directory / "terminalsAndIcons" / "icon.png").read_bytes() == committed


def test_exact_icon_keeps_its_parts_when_small(paper):
    """Disk, shaft and spin are still there at 32 by 32, and around them is nothing."""
    icon = colours(paper.directory / "model.png")
    assert icon.shape == (SIZE, SIZE, 4)
    step = SIZE // SMALL
    opacity = icon[:, :, 3:]
    blocks = np.concatenate([icon[:, :, :3] * opacity, opacity], axis=2).reshape(SMALL, step, SMALL, step, 4)
    small = blocks.mean(axis=(1, 3))
    red, blue, opaque = small[:, :, 0], small[:, :, 2], small[:, :, 3] > 0.5
    assert 0.2 < np.mean(opaque) < 0.6  # measured 0.38
    assert np.sum(opaque & (blue > red + 0.2)) > 150  # disk and shaft, measured 305
    assert np.sum(opaque & (red > blue + 0.2)) > 25  # spin and support point, measured 66
    assert not opaque[[0, -1], :].any() and not opaque[:, [0, -1]].any()
