"""The documents as a site in target/book that asks nothing of a network: mdBook's pages, equations as MathML.

The pages are those of docs/SUMMARY.md. What they link to in the project comes with them, at the same place."""

import re
import shutil
import subprocess
import sys
from pathlib import Path

from math_core import LatexToMathML

ROOT = Path(__file__).resolve().parents[2]
DOCS = ROOT / "docs"
SOURCE = ROOT / "target" / "book-source"
SITE = ROOT / "target" / "book"
LINK = re.compile(r"\]\(([^)\s#]+)(#[^)\s]*)?\)")
# Code, which stays as it is; an equation that stands alone, maybe with a number; an equation within a line.
PARTS = re.compile(
    r"(?P<code>^```.*?^```|`[^`\n]+`)|\$\$(?P<alone>.+?)(?:\\tag\{(?P<number>\d+)\}\s*)?\$\$|\$(?P<within>[^$\n]+)\$",
    re.DOTALL | re.MULTILINE,
)
MATHML = LatexToMathML(xml_namespace=False)


def mathml(latex, alone):
    """An equation as MathML that Markdown leaves as it is: what it could take for its own marks stands as numbers."""
    made = MATHML.convert_with_local_state(latex.strip(), displaystyle=alone)
    return re.sub(r">[^<]+<", lambda text: re.sub(r"[^\w\s&;#<>]|_", lambda c: f"&#{ord(c[0])};", text[0]), made)


def with_equations(page):
    """A page with its equations as MathML."""

    def made(part):
        if part["code"]:
            return part[0]
        if part["within"]:
            return mathml(part["within"], alone=False)
        number = f'<span id="eq-{part["number"]}">({part["number"]})</span>' if part["number"] else ""
        return f'<div class="equation">{mathml(part["alone"], alone=True)}{number}</div>'

    return PARTS.sub(made, page)


def linked(page):
    """The files of the project to which the page, a path, links."""
    words = PARTS.sub("", page.read_text(encoding="utf-8"))
    targets = {link[1] for link in LINK.finditer(words) if "://" not in link[1]}
    found = {(page.parent / target).resolve() for target in targets}
    missing = sorted(str(file.relative_to(ROOT)) for file in found if not file.exists())
    if missing:
        sys.exit(f"error: {page.relative_to(ROOT)} links to what is not there: {', '.join(missing)}")
    return {file for file in found if file.is_file()}


def main():
    shutil.rmtree(SOURCE, ignore_errors=True)
    summary = DOCS / "SUMMARY.md"
    pages = linked(summary)
    others = set.union(*map(linked, pages)) - pages | {DOCS / "book.css"}
    for file in pages | others:
        copy = SOURCE / file.relative_to(ROOT)
        copy.parent.mkdir(parents=True, exist_ok=True)
        if file in pages:
            # mdBook makes the index of the README, and does not follow links to it.
            page = re.sub(r"\]\((\.\./)?README\.md", r"](\1index.md", file.read_text(encoding="utf-8"))
            copy.write_text(with_equations(page), encoding="utf-8")
        else:
            shutil.copyfile(file, copy)
    # mdBook wants both at the root of what it reads.
    shutil.copyfile(DOCS / "book.toml", SOURCE / "book.toml")
    from_root = re.sub(r"\]\((\.\./)?", lambda link: "](" if link[1] else "](docs/", summary.read_text(encoding="utf-8"))
    (SOURCE / "SUMMARY.md").write_text(from_root, encoding="utf-8")
    mdbook = Path(sys.executable).parent / "mdbook"
    subprocess.run([mdbook, "build", SOURCE, "--dest-dir", SITE], check=True)


if __name__ == "__main__":
    main()
