"""The tables of the documents that are drawn from CSV are what the scripts in docs/pictures draw."""

import runpy

import project
import pytest

DOCS = project.ROOT / "docs"


@pytest.fixture
def script(monkeypatch):
    """The names of a script."""
    monkeypatch.syspath_prepend(str(DOCS / "pictures"))
    return lambda name: runpy.run_path(str(DOCS / "pictures" / f"{name}.py"))


def test_golden_table_of_settings_is_what_the_script_draws(script):
    page = (DOCS / "accuracy.md").read_text(encoding="utf-8")
    assert script("accuracy")["table"]() in page, "run `python docs/pictures/accuracy.py --again`"


def test_golden_table_of_families_is_what_the_script_draws(script):
    page, made = (DOCS / "hard-cases.md").read_text(encoding="utf-8"), script("hard_cases")
    assert made["families"](made["read"]()) in page, "run `python docs/pictures/hard_cases.py --again`"
