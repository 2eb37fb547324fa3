"""A page of the documentation, parts of which stand between marks and are made."""

import re


def put(page, mark, made):
    """The file `page` with `made` between `<!-- mark -->` and the next `<!-- end -->`."""
    block = rf"(<!-- {mark} -->\n).*?(<!-- end -->)"
    text = page.read_text(encoding="utf-8")
    text, count = re.subn(block, lambda match: f"{match[1]}\n{made.strip()}\n\n{match[2]}", text, flags=re.DOTALL)
    assert count == 1, f"{page.name} has no place for {mark}"
    page.write_text(text, encoding="utf-8")
