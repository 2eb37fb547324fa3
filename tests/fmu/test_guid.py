"""The GUID follows the scene: its values, and nothing else; and it follows every change of the XML."""

import re
import uuid

import project
import pytest

PAPER = (project.ROOT / "scenes" / "paper.toml").read_text(encoding="utf-8")


NAMESPACE = uuid.UUID("8a1c66f0-52b3-4d0e-9b1d-7c6f2f4e5a31")
"""That of model/src/xml.rs."""


def test_exact_guid_is_made_of_the_whole_text(fmu):
    """Of the text with an empty guid, as UUID of version 5: whatever changes there, the GUID follows."""
    text = (fmu.directory / "modelDescription.xml").read_text(encoding="utf-8")
    guid = fmu.description.guid
    assert text.count(guid) == 1
    assert guid == f"{{{uuid.uuid5(NAMESPACE, text.replace(guid, ''))}}}"


@pytest.fixture
def guid(xtask, tmp_path):
    """The GUID of a text as the scene `paper`."""

    def of(text):
        scene = tmp_path / "paper.toml"
        scene.write_text(text, encoding="utf-8")
        described = xtask("describe", "--xml", scene)
        assert described.returncode == 0, described.stderr
        return re.search('guid="([^"]+)"', described.stdout)[1]

    return of


def test_exact_guid_does_not_follow_comments_and_order(paper, guid):
    head, _, experiment = PAPER.partition("[experiment]")
    assert guid(f"# another comment\n{head}[experiment]{experiment}") == paper.description.guid
    title, _, rest = head.partition("[rotor]")
    assert guid(f"{title}[experiment]{experiment}[rotor]{rest}") == paper.description.guid
