"""Links in the text of a page lead to moments of its scene."""

import json
import re

import pytest
from moments import check_moment
from support import ROOT

PAGES = sorted((ROOT / "book").glob("[0-9]*.ipynb"))
LINK = re.compile(r'<a href="#(\w+\.[^"]+)">([^<]+)</a>')


def links(path):
    cells = json.loads(path.read_text(encoding="utf-8"))["cells"]
    text = "\n".join(
        "".join(c["source"]) for c in cells if c["cell_type"] == "markdown"
    )
    return LINK.findall(text)


@pytest.mark.parametrize("path", PAGES, ids=lambda path: path.stem)
def test_the_text_of_a_page_drives_its_scene(path):
    found = links(path)

    assert 2 <= len(found) <= 4
    assert len({moment for moment, _ in found}) == len(found)
    for moment, words in found:
        check_moment(moment, path.read_text(encoding="utf-8"))
        assert len(words.split()) >= 2, "the link says where it leads"
