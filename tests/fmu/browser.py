"""Chromium without a window: what a page says of itself once its scripts have run."""

import json
import re
import shutil
import subprocess
from html import escape, unescape
from pathlib import Path

CHROMIUM = shutil.which("chromium") or shutil.which("chromium-browser") or shutil.which("google-chrome")
MISSING = "the report's tests need a browser (Debian: apt-get install chromium)"
CHECK = Path(__file__).with_name("report_check.js")


def look(page, width, folder):
    """What report_check.js found in this page at this width [px]; `folder` keeps the browser's profile and what it opened."""
    text = page.read_text(encoding="utf-8")
    early, late = CHECK.read_text(encoding="utf-8").split("// After the page's own scripts.\n")
    # What goes wrong is heard from the first script on.
    text = text.replace("<head>", f"<head><script>{early}</script>", 1)
    text = text.replace("</body>", f'<script type="module">{late}</script></body>')
    # A window is never as narrow as a telephone, but a frame is.
    frame = folder / f"{page.parent.name}-{width}.html"
    frame.write_text(f'<body><iframe width="{width}" height="900" srcdoc="{escape(text)}"></iframe></body>', encoding="utf-8")
    command = [CHROMIUM, "--headless", "--no-sandbox", "--disable-gpu", f"--user-data-dir={folder / 'profile'}"]
    command += ["--window-size=1400,1000", "--virtual-time-budget=20000", "--dump-dom", frame.as_uri()]
    done = subprocess.run(command, capture_output=True, encoding="utf-8", timeout=300, check=True)
    found = re.search(r'<pre id="check">(.*?)</pre>', done.stdout, re.DOTALL)
    assert found, f"the check did not end: {done.stderr[-2000:]}"
    return json.loads(unescape(found[1]))
