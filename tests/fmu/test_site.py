"""`cargo xtask docs`: the documents as a site that asks nothing of a network."""

import json
import re
import shutil
import subprocess
from html import unescape
from html.parser import HTMLParser
from urllib.parse import unquote, urlsplit

import project
import pytest
from browser import CHROMIUM, MISSING

# Heard from the first line of the page on: scripts that fail, and pictures, scripts and styles that are not there.
EARLY = "<script>window.wrong = []; addEventListener('error', e => wrong.push(e.message || e.target.outerHTML), true)</script>"
LATE = """<script>addEventListener('load', () => setTimeout(() => {
  const told = document.createElement('pre'); told.id = 'check';
  const flat = [...document.querySelectorAll('math')].filter(m => m.getBoundingClientRect().height < 4).length;
  told.textContent = JSON.stringify({wrong, flat}); document.body.append(told);
}, 200))</script>"""


class Page(HTMLParser):
    """A page: its anchors, what it links to, what it loads, its equations, and its words outside code."""

    def __init__(self, file):
        super().__init__()
        self.anchors, self.links, self.loads, self.equations, self.words, self.silent = set(), [], [], 0, "", 0
        self.feed(file.read_text(encoding="utf-8"))

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        self.anchors |= {attributes.get("id"), attributes.get("name")}
        self.silent += tag in ("code", "script", "style")
        self.equations += tag == "math"
        if tag == "a" and "href" in attributes:
            self.links.append(attributes["href"])
        load = attributes.get("href") if tag == "link" else attributes.get("src")
        self.loads += [load] if load else []

    def handle_endtag(self, tag):
        self.silent -= tag in ("code", "script", "style")

    def handle_data(self, data):
        self.words += data * (not self.silent)


@pytest.fixture(scope="module")
def site(xtask):
    done = xtask("docs")
    assert done.returncode == 0, done.stderr
    folder = project.ROOT / "target" / "book"
    assert done.stdout.split() == [str(folder / "index.html")]
    return folder


@pytest.fixture(scope="module")
def pages(site):
    # The page of all pages is for printing: its anchors are those of many.
    return {file: Page(file) for file in site.rglob("*.html") if file.name not in ("print.html", "toc.html", "404.html")}


@pytest.mark.long
def test_it_has_each_page_with_its_equations(site, pages):
    titles = {file.relative_to(site).as_posix() for file in pages}
    wanted = {f"docs/{file.stem}.html" for file in (project.ROOT / "docs").glob("*.md")} - {"docs/SUMMARY.html"}
    assert wanted | {"index.html", "CONTRIBUTING.html", "CHANGELOG.html"} <= titles
    theory = (project.ROOT / "docs" / "theory.md").read_text(encoding="utf-8")
    page = pages[site / "docs" / "theory.html"]
    assert page.equations == len(re.findall(r"\$\$.+?\$\$|\$[^$\n]+\$", theory, re.DOTALL)) > 1000
    assert {f"eq-{number}" for number in re.findall(r"\\tag\{(\d+)\}", theory)} <= page.anchors
    for file, page in pages.items():
        assert "$" not in page.words and "\\" not in page.words.replace("\\|", ""), file


@pytest.mark.long
def test_no_link_is_broken_and_nothing_is_loaded_from_elsewhere(pages):
    for file, page in pages.items():
        for load in page.loads:
            assert not urlsplit(load).scheme or load.startswith("data:"), f"{file} loads {load}"
        for link in page.links:
            parts = urlsplit(link)
            if parts.scheme:
                continue
            target = (file.parent / unquote(parts.path)).resolve() if parts.path else file
            assert target.is_file(), f"{file}: {link}"
            if parts.fragment and target in pages:
                assert unquote(parts.fragment) in pages[target].anchors, f"{file}: {link}"


@pytest.mark.long
def test_a_browser_shows_each_page_without_an_error(site, pages, tmp_path):
    assert CHROMIUM, MISSING
    copy = tmp_path / "site"
    shutil.copytree(site, copy)
    for file in pages:
        shown = copy / file.relative_to(site)
        text = shown.read_text(encoding="utf-8").replace("<head>", f"<head>{EARLY}", 1)
        shown.write_text(text.replace("</body>", f"{LATE}</body>"), encoding="utf-8")
        command = [CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={tmp_path / 'profile'}"]
        command += ["--virtual-time-budget=5000", "--dump-dom", shown.as_uri()]
        done = subprocess.run(command, capture_output=True, encoding="utf-8", timeout=300, check=True)
        found = re.search(r'<pre id="check">(.*?)</pre>', done.stdout, re.DOTALL)
        assert found, f"{file}: the check did not end: {done.stderr[-2000:]}"
        assert json.loads(unescape(found[1])) == {"wrong": [], "flat": 0}, file
