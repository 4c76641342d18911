"""Links to moments of scenes: what they may ask for."""

import re
from urllib.parse import unquote

from abstransfer.scenes import KINDS


def check_moment(moment, page_text):
    """Fail unless an address is a state of a scene that a page shows."""
    for part in moment.replace("&amp;", "&").split("&"):
        scene, name, value = re.fullmatch(r"(\w+)\.(\w+)=([^=&]+)", part).groups()
        field = KINDS[scene].spec()["fields"][name]
        value = unquote(value)

        assert f'data-scene=\\"{scene}\\"' in page_text, f"no {scene} here"
        assert not field["isLocal"]
        if field["kind"] == "choice":
            assert value in field["bounds"]
        elif field["kind"] == "flag":
            assert value in ("true", "false")
        elif field["kind"] in ("whole", "number"):
            least, most = field["bounds"]
            assert least <= float(value) <= most
        else:
            assert value, f"an empty {field['kind']}"
