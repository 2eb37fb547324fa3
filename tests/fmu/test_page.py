"""documentation/index.html: whole by itself, and in accord with modelDescription.xml."""

import html
import re
from html.parser import HTMLParser

import project
import pytest

VOID = {"br", "hr", "meta"}
"""Elements without an end tag, of those that the page may use."""

LOADING = {"script", "link", "img", "image", "use", "iframe", "object", "embed", "video", "audio", "source", "base"}
"""Elements that load something, or run."""

COLUMNS = ["name", "value reference", "causality", "unit", "start", "must be", "description"]


class Page(HTMLParser):
    """The page taken apart; a tag that is not closed, or closed twice, fails."""

    def __init__(self, text):
        super().__init__()
        self.open, self.elements, self.tables, self.headings = [], [], [], []
        self.feed(text)
        self.close()
        assert self.open == [], "never closed"

    def handle_starttag(self, tag, attributes):
        self.handle_startendtag(tag, attributes)
        if tag not in VOID:
            self.open.append(tag)
        if tag == "table":
            self.tables.append([])
        elif tag == "tr":
            self.tables[-1].append([])
        elif tag in ("td", "th"):
            self.tables[-1][-1].append("")
        elif tag == "h3":
            self.headings.append(dict(attributes).get("id"))

    def handle_startendtag(self, tag, attributes):
        assert len(dict(attributes)) == len(attributes), f"an attribute twice: {attributes}"
        self.elements.append((tag, dict(attributes)))

    def handle_endtag(self, tag):
        assert self.open and self.open[-1] == tag, f"</{tag}> where {self.open} are open, line {self.getpos()[0]}"
        self.open.pop()

    def handle_data(self, data):
        if "td" in self.open or "th" in self.open:
            self.tables[-1][-1][-1] += data

    @property
    def ids(self):
        """Every id, in order."""
        return [attributes["id"] for _, attributes in self.elements if "id" in attributes]

    @property
    def rows(self):
        """The rows of all tables of variables, without their heads."""
        tables = [table for table in self.tables if table[0] == COLUMNS]
        return [dict(zip(COLUMNS, row, strict=True)) for table in tables for row in table[1:]]


@pytest.fixture
def text(fmu):
    """The page as it was packaged."""
    return (fmu.directory / "documentation" / "index.html").read_text(encoding="utf-8")


@pytest.fixture
def page(text):
    """The page, taken apart."""
    return Page(text)


@pytest.mark.parametrize("slip", ["<p><b>open</p>", "<p>open", "closed</p>"])
def test_exact_the_parser_sees_a_slip(slip):
    with pytest.raises(AssertionError):
        Page(slip)


def test_exact_nothing_is_loaded_or_run(text, page):
    assert {tag for tag, _ in page.elements} & LOADING == set()
    for tag, attributes in page.elements:
        assert not {"src", "srcset", "style", "background"} & attributes.keys(), tag
        assert not any(key.startswith("on") for key in attributes), tag
        link = attributes.get("href", "#")
        assert link.startswith("#") or (tag == "a" and link.startswith("https://doi.org/")), link
    assert not re.search(r"url\(|@import|javascript:", text, re.IGNORECASE)


def test_exact_links_within_the_page_lead_somewhere(page):
    assert len(set(page.ids)) == len(page.ids)
    links = {attributes["href"][1:] for _, attributes in page.elements if attributes.get("href", "").startswith("#")}
    assert links and links <= set(page.ids)


def test_exact_nothing_of_the_template_is_left(text):
    assert not re.search(r"\{[{%#]|[}%#]\}", text.partition("</style>")[2])


def test_exact_each_variable_stands_once_as_the_xml_has_it(fmu, page):
    variables = fmu.xml.findall("ModelVariables/ScalarVariable")
    assert sorted(row["name"] for row in page.rows) == sorted(variable.get("name") for variable in variables)
    rows = {row["name"]: row for row in page.rows}
    for variable in variables:
        name, kind = variable.get("name"), variable[0]
        expected = {
            "name": name,
            "value reference": variable.get("valueReference"),
            "causality": variable.get("causality"),
            "unit": kind.get("unit", ""),
            "start": kind.get("start", ""),
            "description": variable.get("description").removesuffix(", > 0"),
        }
        assert {key: rows[name][key] for key in expected} == expected


def test_exact_bounds_are_those_of_the_xml(fmu, page):
    rows = {row["name"]: row["must be"].strip() for row in page.rows}
    for variable in fmu.xml.findall("ModelVariables/ScalarVariable"):
        name, kind = variable.get("name"), variable[0]
        if kind.tag == "Enumeration":
            items = fmu.xml.findall(f"TypeDefinitions/SimpleType[@name='{kind.get('declaredType')}']/Enumeration/Item")
            assert rows[name] == " or ".join(f"{item.get('value')} ({item.get('name')})" for item in items)
        elif name == "solver.order":
            assert rows[name] == "2 or 4 or 6 or 8"
        elif name == "extrapolation.order":
            assert rows[name] == "0 or 1 or 2"
        elif kind.tag == "Boolean":
            assert rows[name] == "", name
        elif name == "solver.method_number":
            assert rows[name] == "0 or 1 or 2 or 3 or 4 or 5 or 6"
        elif name == "solver.absolute_tolerance":
            assert rows[name] == "0 or a number from 1e-20 to 0.01"
            assert (kind.get("min"), kind.get("max")) == ("0.0", "0.01")
        elif kind.get("max"):
            number = int if kind.tag == "Integer" else float
            assert rows[name] == f"a number from {number(kind.get('min'))!r} to {number(kind.get('max'))!r}"
        else:
            # What must be above 0 has no least value that FMI's `min` could state; its description says so.
            assert (rows[name] == ">= 0") == (kind.get("min") == "0.0"), name
            assert (rows[name] == "> 0") == variable.get("description").endswith(", > 0"), name
            assert rows[name] or not kind.get("min"), name


def test_exact_only_the_effects_of_the_scene_are_told_of(fmu, page):
    known = {text.stem for text in (project.ROOT / "modelDescription/documentation/effects").glob("*.html")}
    assert set(page.ids) & known == project.effects(fmu.scene)


def test_exact_it_tells_of_what_the_xml_claims(fmu, page):
    inputs = [variable for variable in fmu.variables.values() if variable.causality == "input"]
    assert ("model-exchange" in page.headings) == (fmu.xml.find("ModelExchange") is not None)
    assert ("co-simulation" in page.headings) == (fmu.xml.find("CoSimulation") is not None)
    assert ("inputs" in page.headings) == bool(inputs)


def test_exact_it_says_what_it_is(fmu, text):
    assert f"<h1>{fmu.description.description}</h1>" in html.unescape(text)
    for said in (f"<code>{fmu.description.coSimulation.modelIdentifier}</code>", "10.21595/vp.2018.19911"):
        assert said in text
